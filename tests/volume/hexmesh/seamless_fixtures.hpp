// Seamless maps made by rule, for the tests of hex meshes.
#pragma once

#include <algorithm>
#include <functional>
#include <set>
#include <string>

#include "octafield/error.hpp"
#include "octafield/volume/seamless_map.hpp"
#include "tet_fixtures.hpp"

namespace octafield::volume::testing {

// Parameters are the positions.
inline SeamlessMap identity_map(TetMesh mesh) {
    SeamlessMap map;
    map.parameters.resize(mesh.tets.rows(), 12);
    for (Index t = 0; t < mesh.tets.rows(); ++t)
        for (int k = 0; k < 4; ++k) map.parameters.block<1, 3>(t, 3 * k) = mesh.vertices.row(mesh.tets(t, k));
    map.mesh = std::move(mesh);
    return map;
}

// Triangles between tets, and on the boundary, whose vertices all have this coordinate.
inline void add_plane(SeamlessMap& map, int axis, double at) {
    std::set<std::array<Index, 3>> found;
    for (Index t = 0; t < map.mesh.tets.rows(); ++t)
        for (int k = 0; k < 4; ++k) {
            std::array<Index, 3> face;
            bool inside = true;
            for (int j = 0, n = 0; j < 4; ++j) {
                if (j == k) continue;
                face[n++] = map.mesh.tets(t, j);
                inside &= map.mesh.vertices(map.mesh.tets(t, j), axis) == at;
            }
            std::sort(face.begin(), face.end());
            if (inside) found.insert(face);
        }
    const Index before = static_cast<Index>(map.walls.rows());
    map.walls.conservativeResize(before + static_cast<Index>(found.size()), 3);
    Index row = before;
    for (const auto& face : found) map.walls.row(row++) << face[0], face[1], face[2];
}

// An L of three unit cells along x and y, two high, with one of the two walls that start at its inner edge.
inline SeamlessMap l_shape() {
    SeamlessMap map = identity_map(
        kuhn_grid(2, 2, 2, 1, Eigen::Vector3d::Zero(), [](int i, int j, int) { return i == 0 || j == 0; }));
    add_plane(map, 0, 1);
    return map;
}

inline std::string kind_of(const std::function<void()>& call) {
    try {
        call();
    } catch (const Error& error) {
        return error.kind();
    }
    return "none";
}

}  // namespace octafield::volume::testing
