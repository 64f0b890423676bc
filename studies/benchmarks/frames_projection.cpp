// Nearest sh4 frames per second on one core: sh4_project, sh4_project_certified, and a straightforward version.
//
//     cmake -B build -DOCTAFIELD_BENCHMARKS=ON && ninja -C build benchmark_frames_projection
//     build/studies/benchmarks/benchmark_frames_projection
//
// Inputs: random directions in R^9; frames plus noise of at most 0.17 (10 degrees in R^9), alone and with a guess up to
// 10 degrees off the frame; sums of two frames at the largest distance, with noise 1e-6. items_per_second counts
// projections by CPU time. The last line repeats the fast and the straightforward version in turns on one input
// and gives the ratio.
#include <benchmark/benchmark.h>

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <ctime>
#include <numbers>
#include <vector>

#include "../../frames/src/quartic.hpp"
#include "../../frames/src/sh4_basis.hpp"
#include "octafield/frames/octahedral_group.hpp"
#include "octafield/frames/sh4_projection.hpp"

namespace {

using namespace octafield::frames;

// ---- the straightforward version: Newton ascent with the absolute Hessian from eight fixed seeds, the best of all

struct Expansion {
    double value = 0;
    Vector3 gradient = Vector3::Zero();
    Matrix3 hessian = Matrix3::Zero();
};

Expansion expand(const Quartic& p, const Matrix3& axes) {
    Expansion e;
    for (int k = 0; k < 3; ++k) {
        const Vector3 r = axes.col(k);
        const Matrix3 m = p.contract(r);
        const Vector3 mr = m * r;
        const double value = r.dot(mr);
        Matrix3 x;
        x << 0, -r.z(), r.y(), r.z(), 0, -r.x(), -r.y(), r.x(), 0;
        e.value += value;
        e.gradient += 4 * r.cross(mr);
        e.hessian += 12 * x.transpose() * m * x + 2 * (mr * r.transpose() + r * mr.transpose()) -
                     4 * value * Matrix3::Identity();
    }
    return e;
}

double value_at(const Quartic& p, const Matrix3& axes) {
    double value = 0;
    for (int k = 0; k < 3; ++k) value += axes.col(k).dot(p.contract(axes.col(k)) * axes.col(k));
    return value;
}

double ascend(const Quartic& p, Quaternion& q) {
    Expansion e = expand(p, q.toRotationMatrix());
    Eigen::SelfAdjointEigenSolver<Matrix3> eigen;
    for (int step = 0; step < 60; ++step) {
        eigen.computeDirect(e.hessian);
        const Vector3 curvature = eigen.eigenvalues().cwiseAbs();
        const double floor = 1e-6 * curvature.maxCoeff() + 1e-300;
        const Vector3 along = eigen.eigenvectors().transpose() * e.gradient;
        Vector3 move = eigen.eigenvectors() * along.cwiseQuotient(curvature.cwiseMax(floor));
        const double angle = move.norm();
        if (angle > 0.5) move *= 0.5 / angle;
        if (angle < 1e-15) break;
        Quaternion next;
        double next_value = e.value;
        bool ascended = false;
        for (double scale = 1; scale > 1e-4 && !ascended; scale /= 2) {
            next = (exp(scale * move) * q).normalized();
            next_value = value_at(p, next.toRotationMatrix());
            ascended = next_value >= e.value;
        }
        if (!ascended) break;
        const bool settled = next_value - e.value <= 0 && angle < 1e-7;
        q = next;
        e = expand(p, q.toRotationMatrix());
        if (settled || angle < 1e-9) break;
    }
    return e.value;
}

Projection straightforward(const Sh4::Vector& v) {
    static const auto seeds = [] {
        std::array<Quaternion, 8> s;
        s[0] = Quaternion::Identity();
        const Vector3 axes[7] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {0, 1, 1}, {1, 0, 1}, {1, 1, 1}};
        for (int i = 0; i < 7; ++i) s[i + 1] = exp(std::numbers::pi / 4 * axes[i].normalized());
        return s;
    }();
    const Quartic p(axis_basis().transpose() * v.normalized());
    Quaternion best = Quaternion::Identity();
    double best_value = -2;
    for (Quaternion q : seeds) {
        const double value = ascend(p, q);
        if (value > best_value + 1e-12) best = q, best_value = value;
    }
    return {best, (v - Sh4::embed(best)).norm()};
}

// ---- inputs

constexpr int count = 20000;

struct Inputs {
    std::vector<double> v, guess;
};

Vector3 random_direction(std::mt19937_64& generator) {
    const double z = 2 * uniform01(generator) - 1, t = 2 * std::numbers::pi * uniform01(generator);
    const double r = std::sqrt(1 - z * z);
    return {r * std::cos(t), r * std::sin(t), z};
}

Sh4::Vector random_vector(std::mt19937_64& generator) {
    Sh4::Vector v;
    for (int c = 0; c < 9; ++c)
        v[c] =
            std::sqrt(-2 * std::log(1 - uniform01(generator))) * std::cos(2 * std::numbers::pi * uniform01(generator));
    return v.normalized();
}

template <class Make>
Inputs make_inputs(const Make& make) {
    Inputs inputs{std::vector<double>(9 * count), std::vector<double>(4 * count)};
    std::mt19937_64 generator(1);
    const auto rotations = random_rotations(count, 2);
    for (int i = 0; i < count; ++i) {
        const Quaternion q = from_wxyz(Vector4(rotations.row(i).transpose()));
        Eigen::Map<Sh4::Vector>(&inputs.v[9 * i]) = make(q, generator);
        const Quaternion guess = (exp(0.17 * uniform01(generator) * random_direction(generator)) * q).normalized();
        Eigen::Map<Vector4>(&inputs.guess[4 * i]) = to_wxyz(guess);
    }
    return inputs;
}

const Inputs& random_inputs() {
    static const Inputs inputs =
        make_inputs([](const Quaternion&, auto& generator) { return random_vector(generator); });
    return inputs;
}

const Inputs& near_inputs() {
    static const Inputs inputs = make_inputs([](const Quaternion& q, auto& generator) -> Sh4::Vector {
        return Sh4::embed(q) + 0.17 * std::sqrt(uniform01(generator)) * random_vector(generator);
    });
    return inputs;
}

const Inputs& tied_inputs() {
    static const Inputs inputs = make_inputs([](const Quaternion& q, auto& generator) -> Sh4::Vector {
        const double face = std::tan(std::numbers::pi / 8);
        const Quaternion farthest = Quaternion(1, face, face, 1 - 2 * face).normalized();
        return (Sh4::embed(q) + Sh4::embed((q * farthest).normalized())).normalized() + 1e-6 * random_vector(generator);
    });
    return inputs;
}

// ---- benchmarks

void fast(benchmark::State& state, const Inputs& (*inputs)(), bool guess, std::string_view set) {
    const Inputs& in = inputs();
    std::vector<double> frames(4 * count), distances(count);
    for (auto _ : state) {
        sh4_project(in.v.data(), guess ? in.guess.data() : nullptr, count, frames.data(), distances.data(), set);
        benchmark::DoNotOptimize(distances.data());
    }
    state.SetItemsProcessed(state.iterations() * count);
}

void one_at_a_time(benchmark::State& state, const Inputs& (*inputs)(), Projection (*project)(const Sh4::Vector&)) {
    const Inputs& in = inputs();
    int i = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(project(Eigen::Map<const Sh4::Vector>(&in.v[9 * i])));
        i = (i + 1) % count;
    }
    state.SetItemsProcessed(state.iterations());
}

Projection single(const Sh4::Vector& v) { return Sh4::project(v); }
Projection certified(const Sh4::Vector& v) { return sh4_project_certified(v).projection; }

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void ratio(benchmark::State& state, const Inputs& (*inputs)()) {
    constexpr int part = 1000;
    const Inputs& in = inputs();
    std::vector<double> frames(4 * part), distances(part);
    double fast_seconds = 0, plain_seconds = 0;
    for (auto _ : state) {
        const double start = cpu_seconds();
        for (int times = 0; times < 20; ++times)
            sh4_project(in.v.data(), nullptr, part, frames.data(), distances.data());
        const double middle = cpu_seconds();
        for (int i = 0; i < part; ++i)
            benchmark::DoNotOptimize(straightforward(Eigen::Map<const Sh4::Vector>(&in.v[9 * i])));
        fast_seconds += (middle - start) / 20, plain_seconds += cpu_seconds() - middle;
    }
    state.counters["straightforward_over_fast"] = plain_seconds / fast_seconds;
}

}  // namespace

int main(int argc, char** argv) {
    for (const std::string_view set : sh4_instruction_sets()) {
        const std::string prefix = "fast/" + std::string(set) + "/";
        benchmark::RegisterBenchmark((prefix + "random").c_str(), fast, random_inputs, false, set);
        benchmark::RegisterBenchmark((prefix + "near").c_str(), fast, near_inputs, false, set);
        benchmark::RegisterBenchmark((prefix + "near_with_guess").c_str(), fast, near_inputs, true, set);
        benchmark::RegisterBenchmark((prefix + "tied").c_str(), fast, tied_inputs, false, set);
    }
    benchmark::RegisterBenchmark("one_at_a_time/random", one_at_a_time, random_inputs, single);
    benchmark::RegisterBenchmark("certified/random", one_at_a_time, random_inputs, certified);
    benchmark::RegisterBenchmark("certified/near", one_at_a_time, near_inputs, certified);
    benchmark::RegisterBenchmark("certified/tied", one_at_a_time, tied_inputs, certified);
    benchmark::RegisterBenchmark("straightforward/random", one_at_a_time, random_inputs, straightforward);
    benchmark::RegisterBenchmark("straightforward/near", one_at_a_time, near_inputs, straightforward);
    benchmark::RegisterBenchmark("ratio/random", ratio, random_inputs);
    benchmark::RegisterBenchmark("ratio/near", ratio, near_inputs);
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
