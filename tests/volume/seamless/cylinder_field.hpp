// A cylinder and a field with four singular curves along it.
#pragma once

#include <cmath>
#include <complex>
#include <numbers>

#include "tet_fixtures.hpp"

namespace octafield::volume::testing {

// Along z the square goes to the unit disk.
inline TetMesh cylinder(int n, int layers) {
    TetMesh mesh = kuhn_grid(n, n, layers, 2.0 / n, {-1, -1, 0});
    for (Index v = 0; v < mesh.vertices.rows(); ++v) {
        const double x = mesh.vertices(v, 0), y = mesh.vertices(v, 1);
        mesh.vertices(v, 0) = x * std::sqrt(1 - y * y / 2);
        mesh.vertices(v, 1) = y * std::sqrt(1 - x * x / 2);
    }
    return mesh;
}

// Four curves of index 1/4 along z; on the unit circle one axis is radial.
inline Quaternions four_curves(const TetMesh& mesh) {
    Quaternions result(mesh.vertices.rows(), 4);
    for (Index v = 0; v < mesh.vertices.rows(); ++v) {
        const std::complex<double> z(mesh.vertices(v, 0), mesh.vertices(v, 1));
        std::complex<double> product = 1;
        for (int k = 0; k < 4; ++k) {
            const auto at = std::polar(0.61, std::numbers::pi * (k + 0.5) / 2 + 0.05);
            product *= (z - at) * (1.0 - std::conj(at) * z);
        }
        const double angle = std::arg(product) / 4;
        result.row(v) << std::cos(angle / 2), 0, 0, std::sin(angle / 2);
    }
    return result;
}

}  // namespace octafield::volume::testing
