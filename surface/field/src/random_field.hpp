// Seeded random fields, the same on every platform.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>

namespace octafield::surface::detail {

// Independent entries, uniform in [-1, 1). The standard's distributions differ between libraries; the engine does not.
inline Eigen::VectorXd random_vector(Eigen::Index size, std::uint64_t seed) {
    std::mt19937_64 engine(seed);
    Eigen::VectorXd vector(size);
    for (Eigen::Index i = 0; i < size; ++i) vector[i] = static_cast<double>(engine() >> 11) * 0x1p-52 - 1;
    return vector;
}

}  // namespace octafield::surface::detail
