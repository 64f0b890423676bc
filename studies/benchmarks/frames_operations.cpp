// Operations on one frame per second on one core, for every representation: embed, differential, hessian, project of a
// random vector and of an embedded frame; the inverse map of su2; distance and Karcher mean.
//
//     cmake -B build -DOCTAFIELD_BENCHMARKS=ON && ninja -C build benchmark_frames_operations
//     build/studies/benchmarks/benchmark_frames_operations
#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "octafield/frames/geodesic.hpp"
#include "octafield/frames/registry.hpp"

namespace {

using namespace octafield::frames;
using octafield::Quaternions;

constexpr int samples = 256;

std::vector<Quaternion> random_frames(std::uint64_t seed) {
    const Quaternions rows = random_rotations(samples, seed);
    std::vector<Quaternion> frames;
    for (const auto& row : rows.rowwise()) frames.push_back(from_wxyz(row.transpose()));
    return frames;
}

// f(i) for i = 0, 1, ..., samples - 1, 0, ...
template <class Function>
void add(const std::string& name, Function f) {
    benchmark::RegisterBenchmark(name.c_str(), [f](benchmark::State& state) {
        int i = 0;
        for (auto _ : state) {
            benchmark::DoNotOptimize(f(i));
            i = (i + 1) % samples;
        }
        state.SetItemsProcessed(state.iterations());
    });
}

template <Representation R>
void add_representation() {
    const std::string name(R::name);
    const auto frames = random_frames(1);
    std::vector<typename R::Vector> embedded, random;
    std::mt19937_64 generator(2);
    for (const Quaternion& q : frames) {
        embedded.push_back(R::embed(q));
        typename R::Vector v;
        for (int c = 0; c < R::dimension; ++c) v[c] = 2 * uniform01(generator) - 1;
        random.push_back(v);
    }
    add(name + "/embed", [=](int i) { return R::embed(frames[i]); });
    add(name + "/differential", [=](int i) { return R::differential(frames[i]); });
    add(name + "/hessian", [=](int i) { return R::hessian(frames[i], random[i]); });
    add(name + "/project embedded", [=](int i) { return R::project(embedded[i]); });
    add(name + "/project random", [=](int i) { return R::project(random[i]); });
}

}  // namespace

int main(int argc, char** argv) {
    Representations::for_each([]<Representation R>() { add_representation<R>(); });
    const auto frames = random_frames(3), others = random_frames(4);
    std::vector<Complex3> points;
    for (const Quaternion& q : frames) points.push_back(Su2::complex(Su2::embed(q)));
    add("su2/inverse", [=](int i) { return Su2::inverse_frame(points[i]); });
    add("tensor4/recover", [=](int i) { return Tensor4::recover(Tensor4::embed(frames[i])); });
    add("odeco/nearest", [=](int i) { return Odeco::nearest(Odeco::embed(frames[i], {1.0, 0.7, 0.4})); });
    for (const Metric& m : metrics())
        add("distance/" + std::string(m.name), [=, &m](int i) { return m.distance(frames[i], others[i]); });
    const Quaternions ten = random_rotations(10, 5);
    add("frame_mean of 10", [=](int) { return frame_mean(ten).variance; });
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
}
