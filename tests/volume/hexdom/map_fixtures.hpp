// Periodic maps of fields given by rule, for the tests of hexdom.
#pragma once

#include <cmath>
#include <numbers>

#include "../../surface/mesh_fixtures.hpp"
#include "field_fixtures.hpp"
#include "octafield/surface/features.hpp"
#include "octafield/volume/periodic_map.hpp"
#include "octafield/volume/tet_domain.hpp"
#include "octafield/volume/tetrahedralize.hpp"

namespace octafield::volume::testing {

inline Quaternions constant(const TetDomain& domain, const frames::Quaternion& q = frames::Quaternion::Identity()) {
    return testing::sample(domain.mesh(), [&](const Eigen::Vector3d&) { return q; });
}

inline TetDomain ball() { return TetDomain(tetrahedralize(surface::testing::icosphere(2))); }

// The features of the outer surface; those of interfaces are none.
inline TetDomain with_detected_features(const TetMesh& mesh, std::vector<Index> regions = {}) {
    const TetDomain plain(mesh, std::move(regions));
    const auto number = [&](Index v) {  // in surface(), of a vertex of boundary()
        const std::vector<Index>& map = plain.surface().vertex_map;
        return static_cast<Index>(std::lower_bound(map.begin(), map.end(), plain.boundary().vertex_map[v]) -
                                  map.begin());
    };
    surface::FeatureGraph features = surface::detect_features(plain.boundary().mesh);
    for (Index& v : features.edges.reshaped()) v = number(v);
    for (Index& v : features.corners) v = number(v);
    return plain.with_features(features);
}

// The tets with their vertices moved: place(x). Tets must not be turned over.
template <class Place>
TetMesh moved_mesh(TetMesh mesh, const Place& place) {
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
        mesh.vertices.row(v) = place(Eigen::Vector3d(mesh.vertices.row(v).transpose())).transpose();
    return mesh;
}

// A box from the origin, of about n x n x n cells of Kuhn's, with vertices inside moved at random.
inline TetMesh jittered_box(const Eigen::Vector3d& size, int n, double amount = 0.2, unsigned seed = 1) {
    return moved_mesh(jittered_cube(n, amount, seed),
                      [&](const Eigen::Vector3d& x) { return Eigen::Vector3d(x.cwiseProduct(size)); });
}

// A quarter of a tube about the z axis, radii from 1 to 2, angle from 0.
inline TetMesh tube_quarter(int n) {
    return moved_mesh(kuhn_cube(n), [](const Eigen::Vector3d& x) {
        const double r = 1 + x.x(), angle = x.y() * std::numbers::pi / 2;
        return Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), x.z());
    });
}

inline frames::Quaternion along_cylinder(const frames::Vector3& x) {
    return frames::exp(frames::Vector3(0, 0, std::atan2(x.y(), x.x())));
}

// Frames named anew, as by chance, tet by tet or vertex by vertex.
inline Quaternions renamed(const Quaternions& of, unsigned seed) {
    std::mt19937 random(seed);
    Quaternions result = of;
    for (Eigen::Index k = 0; k < of.rows(); ++k)
        result.row(k) = frames::to_wxyz(frames::from_wxyz(of.row(k)) *
                                        frames::octahedral_group()[random() % frames::octahedral_order])
                            .transpose();
    return result;
}

inline Quaternions random_frames(Eigen::Index count, unsigned seed) {
    std::mt19937_64 random(seed);
    Quaternions result(count, 4);
    std::normal_distribution<double> normal;
    for (Eigen::Index k = 0; k < count; ++k) {
        for (int i = 0; i < 4; ++i) result(k, i) = normal(random);
        result.row(k).normalize();
    }
    return result;
}

}  // namespace octafield::volume::testing
