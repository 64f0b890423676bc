// The laws of representation.hpp, checked for sh6 on random frames. Prints the largest error of each; exit code 1 where
// one is above its bound. Then what the representation is worth as a distance.
#include <cstdio>

#include "octafield/frames/sh4.hpp"
#include "octafield/frames/sh469.hpp"
#include "sh6.hpp"

namespace {

using namespace octafield::frames;
using example::Sh6;

std::vector<Quaternion> random_frames(int n, int seed) {
    const octafield::Quaternions rows = random_rotations(n, seed);
    std::vector<Quaternion> list;
    for (int i = 0; i < n; ++i) list.push_back(from_wxyz(Vector4(rows.row(i).transpose())));
    return list;
}

bool all_hold = true;

void report(const char* law, double error, double bound) {
    std::printf("%-62s %8.1e, bound %.0e\n", law, error, bound);
    if (!(error <= bound)) all_hold = false;
}

// --8<-- [start:laws]
void check_symmetry(const std::vector<Quaternion>& list) {
    double error = 0;
    for (const Quaternion& q : list)
        for (const Quaternion& o : octahedral_group())
            error = std::max(error, (Sh6::embed(q * o) - Sh6::embed(q)).norm());
    report("embed(q o) = embed(q) for the 24 rotations o", error, 1e-13);
}

void check_differential(const std::vector<Quaternion>& list) {
    const double h = 1e-5;
    double error = 0;
    for (const Quaternion& q : list)
        for (int k = 0; k < 3; ++k) {
            const Vector3 w = h * Vector3::Unit(k);
            const Sh6::Vector numeric = (Sh6::embed(exp(w) * q) - Sh6::embed(exp(-w) * q)) / (2 * h);
            error = std::max(error, (Sh6::differential(q).col(k) - numeric).norm());
        }
    report("differential against central differences", error, 2e-8);
}

// The gradient of v . embed(exp(w) q) in w is differential(exp(w) q)^T v at w = 0; its derivative is the Hessian up to
// a term that is antisymmetric, because rotations do not commute.
void check_hessian(const std::vector<Quaternion>& list) {
    const double h = 1e-5;
    double error = 0;
    for (std::size_t i = 0; i + 1 < list.size(); ++i) {
        const Sh6::Vector v = Sh6::embed(list[i + 1]);
        Matrix3 numeric;
        for (int k = 0; k < 3; ++k) {
            const Vector3 w = h * Vector3::Unit(k);
            numeric.col(k) =
                (Sh6::differential(exp(w) * list[i]) - Sh6::differential(exp(-w) * list[i])).transpose() * v / (2 * h);
        }
        error = std::max(error, (Sh6::hessian(list[i], v) - (numeric + numeric.transpose()) / 2).norm());
    }
    report("hessian against central differences", error, 1e-7);
}

void check_rotation(const std::vector<Quaternion>& list) {
    double action = 0, isotropy = 0;
    for (std::size_t i = 0; i + 1 < list.size(); ++i) {
        const Quaternion &g = list[i], &q = list[i + 1];
        action = std::max(action, (Sh6::rotate(g, Sh6::embed(q)) - Sh6::embed(g * q)).norm());
        const Matrix3 metric = Sh6::differential(q).transpose() * Sh6::differential(q);
        isotropy = std::max(isotropy, (metric - Sh6::speed * Sh6::speed * Matrix3::Identity()).norm());
    }
    report("rotate(g, embed(q)) = embed(g q)", action, 1e-13);
    report("every turn moves every frame at the same speed", isotropy, 1e-12);
}

void check_projection(const std::vector<Quaternion>& list) {
    double inverse = 0;
    for (const Quaternion& q : list) inverse = std::max(inverse, distance(Sh6::project(Sh6::embed(q)).frame, q));
    report("project(embed(q)) = q, radians", inverse, 1e-12);

    // Sums of embedded frames, which no frame embeds into. The library's sh469 with the weights of degree 6 only is the
    // same embedding, with a projection written independently of ours.
    double difference = 0;
    for (std::size_t i = 0; i + 2 < list.size(); i += 3) {
        const Sh6::Vector v = Sh6::embed(list[i]) + Sh6::embed(list[i + 1]) + Sh6::embed(list[i + 2]);
        Sh469::Vector padded = Sh469::Vector::Zero();
        padded.segment<Sh6::dimension>(Harmonics<4>::size) = v;
        const Projection known = Sh469::project(padded, nullptr, Sh6::band_weights);
        difference = std::max(difference, std::abs(Sh6::project(v).distance - known.distance));
    }
    report("distance to the nearest frame against sh469 (weights 0, 1, 0)", difference, 1e-12);
}
// --8<-- [end:laws]

// How much the chord distorts the angle: largest over smallest ratio of the two, over random pairs.
template <class R>
double distortion(const std::vector<Quaternion>& a, const std::vector<Quaternion>& b) {
    double least = 1e300, most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double ratio = (R::embed(a[i]) - R::embed(b[i])).norm() / distance(a[i], b[i]);
        least = std::min(least, ratio), most = std::max(most, ratio);
    }
    return most / least;
}

}  // namespace

int main() {
    const std::vector<Quaternion> list = random_frames(200, 1);
    check_symmetry(list);
    check_differential(list);
    check_hessian(list);
    check_rotation(list);
    check_projection(list);
    const auto a = random_frames(50000, 2), b = random_frames(50000, 3);
    std::printf("chord over angle, largest over smallest: sh4 %.3f, sh6 %.3f\n", distortion<Sh4>(a, b),
                distortion<Sh6>(a, b));
    return all_hold ? 0 : 1;
}
