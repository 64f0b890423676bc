// Meshes to improve, with the surfaces they fill.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <map>
#include <random>
#include <vector>

#include "octafield/volume/cell_quality.hpp"

namespace octafield::volume {

struct ImproveCase {
    MixedMesh mesh;
    VertexSupport support;
    surface::TriangleMesh surface;
    surface::FeatureGraph features;

    MixedMesh improved(const ImproveOptions& options = {}) const {
        return improve_cells(mesh, support, surface, features, options);
    }
};

template <class Rows>
void append(Rows& rows, const std::vector<Index>& ids) {
    rows.conservativeResize(rows.rows() + 1, Eigen::NoChange);
    for (Index k = 0; k < rows.cols(); ++k) rows(rows.rows() - 1, k) = ids[k];
}

// The box of n x n x n unit cubes; vertices moved at random by up to `amount` along each axis, those of faces and edges
// within them. The cells for which cut(i, j, k) is true are six tets each.
template <class Cut>
ImproveCase box_case(int n, double amount, unsigned seed, const Cut& cut) {
    ImproveCase box;
    const int m = n + 1;
    const auto id = [&](int i, int j, int k) { return Index((i * m + j) * m + k); };
    box.mesh.vertices.resize(m * m * m, 3);
    box.support.kind.resize(m * m * m);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> move(-amount, amount);
    for (int i = 0; i < m; ++i)
        for (int j = 0; j < m; ++j)
            for (int k = 0; k < m; ++k) {
                const std::array<int, 3> at{i, j, k};
                int rims = 0;
                for (int axis = 0; axis < 3; ++axis) {
                    const bool rim = at[axis] == 0 || at[axis] == n;
                    rims += rim;
                    box.mesh.vertices(id(i, j, k), axis) = at[axis] + (rim ? 0 : move(random));
                }
                box.support.kind[id(i, j, k)] = static_cast<VertexSupport::Kind>(rims);
            }
    const int tets[6][4] = {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}};
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            for (int k = 0; k < n; ++k) {
                const std::vector<Index> cell{
                    id(i, j, k),     id(i + 1, j, k),     id(i + 1, j + 1, k),     id(i, j + 1, k),
                    id(i, j, k + 1), id(i + 1, j, k + 1), id(i + 1, j + 1, k + 1), id(i, j + 1, k + 1)};
                if (!cut(i, j, k)) {
                    append(box.mesh.hexahedra, cell);
                    continue;
                }
                for (const auto& t : tets) append(box.mesh.tets, {cell[t[0]], cell[t[1]], cell[t[2]], cell[t[3]]});
            }
    box.surface.vertices.resize(8, 3);
    box.surface.vertices << 0, 0, 0, n, 0, 0, n, n, 0, 0, n, 0, 0, 0, n, n, 0, n, n, n, n, 0, n, n;
    box.surface.triangles.resize(12, 3);
    box.surface.triangles << 0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,  //
        1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7;
    box.features = surface::detect_features(box.surface);
    return box;
}

inline ImproveCase box_of_hexahedra(int n, double amount, unsigned seed = 1) {
    return box_case(n, amount, seed, [](int, int, int) { return false; });
}
// The lower two fifths tets. Faces between them and the hexahedra do not match, which does not matter here.
inline ImproveCase box_of_both(int n, double amount, unsigned seed = 1) {
    return box_case(n, amount, seed, [n](int, int, int k) { return 5 * k < 2 * n; });
}

// Points of the surface of the cube [-1, 1]^3 in a grid, n quads along each edge, outward.
struct CubeSurface {
    std::vector<Eigen::Vector3d> points;
    std::vector<std::array<Index, 4>> quads;
};

inline CubeSurface cube_surface(int n) {
    CubeSurface grid;
    std::map<std::array<int, 3>, Index> known;
    for (int axis = 0; axis < 3; ++axis)
        for (const int side : {0, n})
            for (int i = 0; i < n; ++i)
                for (int j = 0; j < n; ++j) {
                    std::array<Index, 4> quad{};
                    const int steps[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
                    for (int k = 0; k < 4; ++k) {
                        std::array<int, 3> at{};
                        at[axis] = side;
                        at[(axis + 1) % 3] = i + steps[k][0];
                        at[(axis + 2) % 3] = j + steps[k][1];
                        const auto [found, fresh] = known.emplace(at, static_cast<Index>(grid.points.size()));
                        if (fresh)
                            grid.points.emplace_back(2.0 * at[0] / n - 1, 2.0 * at[1] / n - 1, 2.0 * at[2] / n - 1);
                        quad[side == 0 ? 3 - k : k] = found->second;
                    }
                    grid.quads.push_back(quad);
                }
    return grid;
}

// Directions spread more evenly than the points themselves.
inline Eigen::Vector3d on_sphere(const Eigen::Vector3d& cube_point) {
    return (cube_point.array() * (std::acos(-1.0) / 4)).tan().matrix().normalized();
}

// The unit ball: a cube of n^3 cells in the middle, `layers` of cells from it to the sphere. The surface is far finer.
inline ImproveCase ball_of_hexahedra(int n, int layers) {
    ImproveCase ball;
    const CubeSurface grid = cube_surface(n);
    std::vector<Eigen::Vector3d> points;
    std::map<std::array<int, 3>, Index> inner;
    const auto vertex = [&](int i, int j, int k) {
        const auto [found, fresh] = inner.emplace(std::array{i, j, k}, static_cast<Index>(points.size()));
        if (fresh) points.push_back(0.38 * Eigen::Vector3d(2.0 * i / n - 1, 2.0 * j / n - 1, 2.0 * k / n - 1));
        return found->second;
    };
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            for (int k = 0; k < n; ++k)
                append(ball.mesh.hexahedra, {vertex(i, j, k), vertex(i + 1, j, k), vertex(i + 1, j + 1, k),
                                             vertex(i, j + 1, k), vertex(i, j, k + 1), vertex(i + 1, j, k + 1),
                                             vertex(i + 1, j + 1, k + 1), vertex(i, j + 1, k + 1)});
    const auto layered = [&](Index point, int layer) {
        const auto index = [&](double x) { return static_cast<int>(std::lround((x + 1) * n / 2)); };
        const Eigen::Vector3d& at = grid.points[point];
        if (layer == 0) return vertex(index(at[0]), index(at[1]), index(at[2]));
        const double share = double(layer) / layers;
        const auto [found, fresh] = inner.emplace(std::array{-1, layer, int(point)}, static_cast<Index>(points.size()));
        if (fresh) points.push_back((1 - share) * 0.38 * at + share * on_sphere(at));
        return found->second;
    };
    for (int layer = 0; layer < layers; ++layer)
        for (const auto& q : grid.quads)
            append(ball.mesh.hexahedra, {layered(q[0], layer), layered(q[1], layer), layered(q[2], layer),
                                         layered(q[3], layer), layered(q[0], layer + 1), layered(q[1], layer + 1),
                                         layered(q[2], layer + 1), layered(q[3], layer + 1)});
    ball.mesh.vertices.resize(static_cast<Eigen::Index>(points.size()), 3);
    for (std::size_t v = 0; v < points.size(); ++v) ball.mesh.vertices.row(static_cast<Eigen::Index>(v)) = points[v];
    ball.support.kind.assign(points.size(), VertexSupport::Kind::inside);
    for (std::size_t v = 0; v < points.size(); ++v)
        if (points[v].norm() > 1 - 1e-9) ball.support.kind[v] = VertexSupport::Kind::surface;
    const CubeSurface fine = cube_surface(24);
    ball.surface.vertices.resize(static_cast<Eigen::Index>(fine.points.size()), 3);
    for (std::size_t v = 0; v < fine.points.size(); ++v)
        ball.surface.vertices.row(static_cast<Eigen::Index>(v)) = on_sphere(fine.points[v]);
    for (const auto& q : fine.quads) {
        append(ball.surface.triangles, {q[0], q[1], q[2]});
        append(ball.surface.triangles, {q[0], q[2], q[3]});
    }
    return ball;
}

}  // namespace octafield::volume
