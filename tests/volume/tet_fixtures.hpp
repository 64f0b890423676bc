// Tet meshes made by rule, for the tests of volume/.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "octafield/frames/quaternion.hpp"
#include "octafield/volume/tet_mesh.hpp"

namespace octafield::volume::testing {

constexpr double degree = std::numbers::pi / 180;

inline frames::Quaternion row(const Quaternions& q, Eigen::Index v) {
    return frames::from_wxyz(frames::Vector4(q.row(v).transpose()));
}

// -1 where the tet has no such vertex.
inline int corner_of(const TetMesh& mesh, Index tet, Index vertex) {
    for (int k = 0; k < 4; ++k)
        if (mesh.tets(tet, k) == vertex) return k;
    return -1;
}

// Kuhn subdivision (six tets per cell round the diagonal) of the cells of a grid for which keep(i, j, k) holds.
// Vertex (i, j, k) is at origin + h (i, j, k); vertices in no kept cell are left out.
inline TetMesh kuhn_grid(int nx, int ny, int nz, double h, const Eigen::Vector3d& origin = Eigen::Vector3d::Zero(),
                         const std::function<bool(int, int, int)>& keep = {}) {
    static constexpr std::array<std::array<int, 3>, 6> orders{
        {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {0, 2, 1}, {2, 1, 0}}};  // even permutations first
    std::vector<Index> id((nx + 1) * (ny + 1) * (nz + 1), -1);
    std::vector<Eigen::Vector3d> points;
    const auto vertex = [&](const std::array<int, 3>& p) {
        Index& v = id[(p[2] * (ny + 1) + p[1]) * (nx + 1) + p[0]];
        if (v < 0) {
            v = static_cast<Index>(points.size());
            points.push_back(origin + h * Eigen::Vector3d(p[0], p[1], p[2]));
        }
        return v;
    };
    std::vector<std::array<Index, 4>> tets;
    for (int k = 0; k < nz; ++k)
        for (int j = 0; j < ny; ++j)
            for (int i = 0; i < nx; ++i) {
                if (keep && !keep(i, j, k)) continue;
                for (std::size_t o = 0; o < orders.size(); ++o) {
                    std::array<int, 3> p{i, j, k};
                    std::array<Index, 4> tet{vertex(p)};
                    for (int step = 0; step < 3; ++step) {
                        ++p[orders[o][step]];
                        tet[step + 1] = vertex(p);
                    }
                    if (o >= 3) std::swap(tet[2], tet[3]);
                    tets.push_back(tet);
                }
            }
    TetMesh mesh{Points(points.size(), 3), Tets(tets.size(), 4)};
    for (std::size_t v = 0; v < points.size(); ++v) mesh.vertices.row(v) = points[v].transpose();
    for (std::size_t t = 0; t < tets.size(); ++t)
        mesh.tets.row(t) = Eigen::Map<const Eigen::RowVector4i>(tets[t].data());
    return mesh;
}

// The unit cube [0, 1]^3 in 6 n^3 tets.
inline TetMesh kuhn_cube(int n) { return kuhn_grid(n, n, n, 1.0 / n); }

// The frames q(x) at the mesh's vertices.
template <class Field>
Quaternions sample(const TetMesh& mesh, const Field& q) {
    Quaternions frames(mesh.vertices.rows(), 4);
    for (Eigen::Index v = 0; v < frames.rows(); ++v)
        frames.row(v) = frames::to_wxyz(q(Eigen::Vector3d(mesh.vertices.row(v)))).transpose();
    return frames;
}

}  // namespace octafield::volume::testing
