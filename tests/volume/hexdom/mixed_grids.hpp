// Grids of cubes, each filled in its own way, and a check of meshes that looks at nothing of the library's.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <random>
#include <set>
#include <vector>

#include "octafield/volume/mixed_mesh.hpp"

namespace octafield::volume::testing {

enum class Filled { empty, hexahedron, wedges, kuhn, about_centre };

// Cubes of edge 1 with their low corners at integers, vertices moved by up to `jitter` in each direction where inside.
// kuhn: six tets round the diagonal; all faces have the diagonal from low to high. about_centre: two tets on each face,
// with a diagonal at random (that of a neighbour of Kuhn's or of wedges where one is). wedges: two, upright.
class CubeGrid {
public:
    using Kinds = std::function<Filled(int, int, int)>;
    CubeGrid(std::array<int, 3> size, const Kinds& kind, double jitter, unsigned seed) : n_(size), kind_(kind) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> uniform(-jitter, jitter);
        for (int k = 0; k <= n_[2]; ++k)
            for (int j = 0; j <= n_[1]; ++j)
                for (int i = 0; i <= n_[0]; ++i) {
                    Eigen::Vector3d p(i, j, k);
                    for (int a = 0; a < 3; ++a)
                        if (p[a] > 0 && p[a] < n_[a]) p[a] += uniform(random);
                    points_.push_back(p);
                }
        for (int k = 0; k < n_[2]; ++k)
            for (int j = 0; j < n_[1]; ++j)
                for (int i = 0; i < n_[0]; ++i) fill({i, j, k}, random);
    }

    MixedMesh mesh() const {
        MixedMesh mesh;
        const auto copy = [](auto& rows, const auto& from) {
            rows.resize(from.size(), rows.cols());
            for (std::size_t i = 0; i < from.size(); ++i)
                for (Eigen::Index k = 0; k < rows.cols(); ++k) rows(i, k) = from[i][k];
        };
        copy(mesh.vertices, points_);
        copy(mesh.tets, tets_);
        copy(mesh.hexahedra, hexahedra_);
        copy(mesh.wedges, wedges_);
        return mesh;
    }

private:
    using Cube = std::array<int, 3>;
    Index vertex(const Cube& p) const { return (p[2] * (n_[1] + 1) + p[1]) * (n_[0] + 1) + p[0]; }
    Filled kind_at(const Cube& c) const {
        for (int a = 0; a < 3; ++a)
            if (c[a] < 0 || c[a] >= n_[a]) return Filled::empty;
        return kind_(c[0], c[1], c[2]);
    }
    void add_tet(Index a, Index b, Index c, Index d) {
        const auto edge = [&](Index v) -> Eigen::Vector3d { return points_[v] - points_[a]; };
        if (edge(b).cross(edge(c)).dot(edge(d)) < 0) std::swap(c, d);
        tets_.push_back({a, b, c, d});
    }

    void fill(const Cube& c, std::mt19937& random) {
        const auto at = [&](int x, int y, int z) { return vertex({c[0] + x, c[1] + y, c[2] + z}); };
        const std::array<Index, 8> v{at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0),
                                     at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)};
        const Filled kind = kind_at(c);
        if (kind == Filled::hexahedron) hexahedra_.push_back(v);
        if (kind == Filled::wedges) {
            wedges_.push_back({v[0], v[1], v[2], v[4], v[5], v[6]});
            wedges_.push_back({v[0], v[2], v[3], v[4], v[6], v[7]});
        }
        if (kind == Filled::kuhn)
            for (const auto& path : {std::array{1, 2}, {1, 5}, {3, 2}, {3, 7}, {4, 5}, {4, 7}})
                add_tet(v[0], v[path[0]], v[path[1]], v[6]);
        if (kind == Filled::about_centre) fill_about_centre(c, random);
    }

    void fill_about_centre(const Cube& c, std::mt19937& random) {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        std::vector<std::array<Index, 4>> faces;
        for (int axis = 0; axis < 3; ++axis)
            for (int side = 0; side < 2; ++side) {
                const int u = (axis + 1) % 3, w = (axis + 2) % 3;
                std::array<Index, 4> round;
                for (int k = 0; k < 4; ++k) {
                    Cube p = c;
                    p[axis] += side;
                    p[u] += k == 1 || k == 2;
                    p[w] += k >= 2;
                    round[k] = vertex(p);
                }
                Cube beside = c;
                beside[axis] += 2 * side - 1;
                const Filled other = kind_at(beside);
                const auto [entry, added] = turned_.try_emplace(std::array{axis, c[axis] + side, c[u], c[w]}, false);
                if (added) entry->second = random() % 2;
                if (entry->second && other != Filled::kuhn && other != Filled::wedges)
                    std::rotate(round.begin(), round.begin() + 1, round.end());
                faces.push_back(round);
            }
        for (int k = 0; k < 8; ++k) sum += points_[vertex({c[0] + (k & 1), c[1] + (k >> 1 & 1), c[2] + (k >> 2)})];
        const Index centre = static_cast<Index>(points_.size());
        points_.push_back(sum / 8);
        for (const auto& f : faces) {
            add_tet(f[0], f[1], f[2], centre);
            add_tet(f[0], f[2], f[3], centre);
        }
    }

    Cube n_;
    Kinds kind_;
    std::vector<Eigen::Vector3d> points_;
    std::vector<std::array<Index, 4>> tets_;
    std::vector<std::array<Index, 8>> hexahedra_;
    std::vector<std::array<Index, 6>> wedges_;
    std::map<std::array<int, 4>, bool> turned_;
};

// Faces, edges and reference places of the four kinds, by the number of their vertices.
struct Reference {
    std::vector<std::vector<int>> faces;
    std::vector<std::vector<int>> joined;  // three neighbours of corners, right-handed in the reference cell
};

inline const Reference& reference(int vertices) {
    static const std::map<int, Reference> all{
        {4, {{{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {0, 2, 3}}, {{0, 1, 2, 3}}}},
        {5,
         {{{0, 1, 2, 3}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}},
          {{0, 1, 3, 4}, {1, 2, 0, 4}, {2, 3, 1, 4}, {3, 0, 2, 4}}}},
        {6,
         {{{0, 1, 2}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}},
          {{0, 1, 2, 3}, {1, 2, 0, 4}, {2, 0, 1, 5}, {3, 5, 4, 0}, {4, 3, 5, 1}, {5, 4, 3, 2}}}},
        {8,
         {{{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}},
          {{0, 1, 3, 4},
           {1, 2, 0, 5},
           {2, 3, 1, 6},
           {3, 0, 2, 7},
           {4, 7, 5, 0},
           {5, 4, 6, 1},
           {6, 5, 7, 2},
           {7, 6, 4, 3}}}}};
    return all.at(vertices);
}

template <class Visit>
void each_cell(const MixedMesh& mesh, const Visit& visit) {
    const auto rows = [&](const auto& cells) {
        for (Eigen::Index i = 0; i < cells.rows(); ++i)
            visit(std::vector<Index>(cells.row(i).data(), cells.row(i).data() + cells.cols()));
    };
    rows(mesh.tets);
    rows(mesh.hexahedra);
    rows(mesh.wedges);
    rows(mesh.pyramids);
}

// Faces by their vertices, ascending: how often, and of quads the vertex across from the lowest.
struct FaceUse {
    int count = 0;
    std::set<Index> across;
};
using Faces = std::map<std::vector<Index>, FaceUse>;

inline Faces faces_of(const MixedMesh& mesh) {
    Faces faces;
    each_cell(mesh, [&](const std::vector<Index>& cell) {
        for (const auto& local : reference(static_cast<int>(cell.size())).faces) {
            std::vector<Index> ids;
            for (const int k : local) ids.push_back(cell[k]);
            const auto lowest = std::min_element(ids.begin(), ids.end()) - ids.begin();
            const Index across = ids.size() == 4 ? ids[(lowest + 2) % 4] : -1;
            std::sort(ids.begin(), ids.end());
            ++faces[ids].count;
            faces[ids].across.insert(across);
        }
    });
    return faces;
}

// Faces of one cell; a quad counts as its four triangles, so that it is the same as two triangles on either diagonal
// but for the other two.
inline std::set<std::vector<Index>> outside(const MixedMesh& mesh) {
    std::set<std::vector<Index>> result;
    for (const auto& [ids, use] : faces_of(mesh))
        if (use.count == 1) result.insert(ids);
    return result;
}

inline double least_corner(const MixedMesh& mesh) {
    double least = 1;
    each_cell(mesh, [&](const std::vector<Index>& cell) {
        for (const auto& corner : reference(static_cast<int>(cell.size())).joined) {
            Eigen::Matrix3d edges;
            for (int k = 0; k < 3; ++k)
                edges.col(k) =
                    (mesh.vertices.row(cell[corner[k + 1]]) - mesh.vertices.row(cell[corner[0]])).normalized();
            least = std::min(least, edges.determinant());
        }
    });
    return least;
}

// Faces match all over, round quads too, no corner is flat.
inline void expect_sound(const MixedMesh& mesh, double least = 1e-10) {
    std::set<std::vector<Index>> loose_quads;
    const Faces faces = faces_of(mesh);
    for (const auto& [ids, use] : faces) {
        ASSERT_LE(use.count, 2);
        ASSERT_EQ(use.across.size(), 1u) << "a quad twisted";
        if (use.count == 1 && ids.size() == 4) loose_quads.insert(ids);
    }
    for (const auto& quad : loose_quads)
        for (int without = 0; without < 4; ++without) {
            std::vector<Index> triangle = quad;
            triangle.erase(triangle.begin() + without);
            const auto found = faces.find(triangle);
            ASSERT_FALSE(found != faces.end() && found->second.count == 1) << "a quad meets a triangle";
        }
    EXPECT_GT(least_corner(mesh), least);
    EXPECT_TRUE(find_cell_defects(mesh).empty());
}

}  // namespace octafield::volume::testing
