// Constrained fields on small meshes, for the tests of what lowers their energy.
#pragma once

#include <algorithm>
#include <cmath>

#include "octafield/frames/octahedral_group.hpp"
#include "octafield/volume/boundary.hpp"
#include "tet_fixtures.hpp"

namespace octafield::volume::testing {

// The same crosses by other ones of their 48 quaternions.
inline Quaternions mixed_representatives(Quaternions frames) {
    for (Eigen::Index v = 0; v < frames.rows(); ++v)
        frames.row(v) = frames::to_wxyz(frames::from_wxyz(frames::Vector4(frames.row(v).transpose())) *
                                        frames::binary_octahedral_group()[(5 * v + 1) % 48])
                            .transpose();
    return frames;
}

// Interior vertices displaced by up to `amount` grid steps: obtuse tets, negative cotangents.
inline TetMesh jittered_cube(int n, double amount, std::uint64_t seed) {
    TetMesh mesh = kuhn_cube(n);
    std::mt19937_64 generator(seed);
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
        for (int c = 0; c < 3; ++c) {
            const double shift = amount / n * (2 * frames::uniform01(generator) - 1);
            const auto x = mesh.vertices.row(v);
            if (x.minCoeff() > 1e-9 && x.maxCoeff() < 1 - 1e-9) mesh.vertices(v, c) += shift;
        }
    return mesh;
}

inline BoundaryConstraints constraints_on(const TetMesh& mesh, VertexConstraint kind, const Quaternions& frames) {
    BoundaryConstraints c;
    const std::size_t n = mesh.vertices.rows();
    c.kind.assign(n, VertexConstraint::free);
    c.on_boundary.assign(n, 0);
    c.axis = Points::Zero(n, 3);
    c.frames = Quaternions::Zero(n, 4);
    c.frames.col(0).setOnes();
    for (const Index v : boundary_surface(mesh).vertex_map) {
        c.kind[v] = kind;
        c.on_boundary[v] = 1;
        c.frames.row(v) = frames.row(v);
        if (kind == VertexConstraint::axis)
            c.axis.row(v) =
                (frames::from_wxyz(frames::Vector4(frames.row(v).transpose())) * frames::Vector3::UnitZ()).transpose();
    }
    return c;
}

// A smooth field without singularities, far from constant.
inline Quaternions smooth_field(const TetMesh& mesh) {
    return sample(mesh, [](const frames::Vector3& x) {
        return frames::exp({0.4 * std::sin(2 * x.y()), 0.5 * x.x() * x.z(), 0.6 * x.x() - 0.3 * x.z()});
    });
}

inline frames::Vector3 centroid(const TetMesh& mesh, Eigen::Index t) {
    return mesh.vertices(mesh.tets.row(t), Eigen::all).colwise().mean().transpose();
}

// The frames q(x) at the centroids of the tets.
template <class Field>
Quaternions sample_in_tets(const TetMesh& mesh, const Field& q) {
    Quaternions frames(mesh.tets.rows(), 4);
    for (Eigen::Index t = 0; t < frames.rows(); ++t) frames.row(t) = frames::to_wxyz(q(centroid(mesh, t))).transpose();
    return frames;
}

inline double largest_distance(const Quaternions& a, const Quaternions& b) {
    double largest = 0;
    for (Eigen::Index v = 0; v < a.rows(); ++v)
        largest = std::max(largest, frames::distance(frames::from_wxyz(frames::Vector4(a.row(v).transpose())),
                                                     frames::from_wxyz(frames::Vector4(b.row(v).transpose()))));
    return largest;
}

}  // namespace octafield::volume::testing
