// Inputs for tests of the nearest sh4 frame: random vectors, and sums of frames near which several frames are equally
// near.
#pragma once

#include "octafield/frames/sh4.hpp"
#include "representation_laws.hpp"

namespace octafield::frames {

using Vectors = std::vector<Sh4::Vector>;

inline Vectors random_inputs(int n, std::uint64_t seed) {
    std::mt19937_64 generator(seed);
    Vectors list(n);
    for (auto& v : list) v = random_vector<Sh4>(generator).normalized();
    return list;
}

inline Quaternion random_rotation(std::mt19937_64& generator) {
    Vector4 q;
    for (int c = 0; c < 4; ++c) q[c] = normal01(generator);
    return from_wxyz(q.normalized());
}

// Sums of frames at equal distances, so that several frames or whole curves of frames are about equally near.
inline Sh4::Vector equidistant_sum(int family, std::mt19937_64& generator) {
    const Quaternion q = random_rotation(generator);
    const double pi = std::numbers::pi;
    const double face = std::tan(pi / 8);
    const Quaternion farthest = Quaternion(1, face, face, 1 - 2 * face).normalized();
    Sh4::Vector sum = Sh4::embed(q);
    switch (family) {
        case 0:  // the largest distance there is
            return sum + Sh4::embed((q * farthest).normalized());
        case 1:  // 45 degrees about an axis: the sum is axial, its maximisers are a curve
            return sum + Sh4::embed((q * exp({0, 0, pi / 4})).normalized());
        case 2:  // 60 degrees about a diagonal: another curve
            return sum + Sh4::embed((q * exp(pi / 3 * Vector3(1, 1, 1).normalized())).normalized());
        case 3: {  // 3 to 5 frames placed evenly round any axis
            const int n = 3 + static_cast<int>(3 * uniform01(generator));
            const Vector3 axis = random_rotation(generator) * Vector3::UnitX();
            sum.setZero();
            for (int k = 0; k < n; ++k) sum += Sh4::embed((exp(2 * pi * k / n * axis) * q).normalized());
            return sum;
        }
        case 4:  // frames that share an axis, twisted evenly
            return sum + Sh4::embed((q * exp({0, 0, pi / 6})).normalized()) +
                   Sh4::embed((q * exp({0, 0, pi / 3})).normalized());
        default: {  // 2 to 4 random frames
            for (int more = 1 + static_cast<int>(3 * uniform01(generator)); more > 0; --more)
                sum += Sh4::embed(random_rotation(generator));
            return sum;
        }
    }
}

constexpr int equidistant_families = 6;

inline Vectors near_cut_locus(int n, std::uint64_t seed) {
    std::mt19937_64 generator(seed);
    Vectors list;
    while (static_cast<int>(list.size()) < n) {
        const Sh4::Vector sum = equidistant_sum(static_cast<int>(list.size()) % equidistant_families, generator);
        if (sum.norm() < 1e-6) continue;
        const double noise = std::pow(10, -13 + 12 * uniform01(generator));
        list.push_back(sum.normalized() + noise * random_vector<Sh4>(generator).normalized());
    }
    return list;
}

inline double value(const Sh4::Vector& v, const Quaternion& q) { return v.dot(Sh4::embed(q)); }

}  // namespace octafield::frames
