#include "shells.hpp"

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/box_intersection_d.h>

#include <Eigen/Geometry>
#include <memory>
#include <numeric>
#include <optional>

#include "surface_mesh.hpp"

namespace octafield::surface {
namespace {

using SideOf = CGAL::Side_of_triangle_mesh<SurfaceMesh, Kernel>;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, Index>;

struct Piece {
    TriangleMesh mesh;
    std::vector<Index> triangles;  // ids in the whole mesh
    Eigen::AlignedBox3d box;
    bool closed = true;
    SurfaceMesh surface;  // with `side`: made when first asked
    std::unique_ptr<SideOf> side;

    bool contains(const Eigen::Vector3d& point) {
        if (!side) {
            to_surface_mesh(mesh, surface);
            side = std::make_unique<SideOf>(surface);
        }
        return (*side)(Kernel::Point_3(point[0], point[1], point[2])) == CGAL::ON_BOUNDED_SIDE;
    }
};

Index find_root(std::vector<Index>& parent, Index t) {
    while (parent[t] != t) t = parent[t] = parent[parent[t]];
    return t;
}

// Each piece with its own vertex numbers: in the order of first use.
std::vector<Piece> split_into_pieces(const TriangleMesh& mesh, const std::vector<HalfEdge>& sides) {
    const std::vector<Index> piece_of = connected_pieces(mesh, sides);
    std::vector<Piece> pieces(piece_of.empty() ? 0 : *std::ranges::max_element(piece_of) + 1);
    for (Index t = 0; t < mesh.triangles.rows(); ++t) pieces[piece_of[t]].triangles.push_back(t);
    std::vector<Index> new_id(mesh.vertices.rows()), owner(mesh.vertices.rows(), -1);
    for (Index p = 0; p < static_cast<Index>(pieces.size()); ++p) {
        Piece& piece = pieces[p];
        const auto count = static_cast<Index>(piece.triangles.size());
        piece.mesh.triangles.resize(count, 3);
        std::vector<Index> used;
        for (Index i = 0; i < count; ++i)
            for (int k = 0; k < 3; ++k) {
                const Index v = mesh.triangles(piece.triangles[i], k);
                if (owner[v] != p) {
                    owner[v] = p;
                    new_id[v] = static_cast<Index>(used.size());
                    used.push_back(v);
                    piece.box.extend(mesh.vertices.row(v).transpose());
                }
                piece.mesh.triangles(i, k) = new_id[v];
            }
        if (repeats_vertex(piece.mesh.triangles, 0)) piece.closed = false;  // such a triangle is a piece of its own
        piece.mesh.vertices = mesh.vertices(used, Eigen::all);
    }
    for_each_edge(sides, [&](auto first, auto last) {
        if (last - first != 2) pieces[piece_of[first->triangle]].closed = false;
    });
    return pieces;
}

// By piece, the number of closed pieces round it; only closed pieces are looked at.
std::vector<int> depths(std::vector<Piece>& pieces) {
    std::vector<Box> boxes;
    for (Index p = 0; p < static_cast<Index>(pieces.size()); ++p) {
        const auto &low = pieces[p].box.min(), &high = pieces[p].box.max();
        if (pieces[p].closed) boxes.emplace_back(CGAL::Bbox_3(low[0], low[1], low[2], high[0], high[1], high[2]), p);
    }
    std::vector<int> depth(pieces.size(), 0);
    const auto count = [&](Index outer, Index inner) {
        const TriangleMesh& mesh = pieces[inner].mesh;
        if (pieces[outer].box.contains(pieces[inner].box) &&
            pieces[outer].contains(mesh.vertices.row(mesh.triangles(0, 0))))
            ++depth[inner];
    };
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
        count(a.info(), b.info());
        count(b.info(), a.info());
    });
    return depth;
}

}  // namespace

std::vector<Index> connected_pieces(const TriangleMesh& mesh, const std::vector<HalfEdge>& sides) {
    std::vector<Index> parent(mesh.triangles.rows());
    std::iota(parent.begin(), parent.end(), 0);
    for_each_edge(sides, [&](auto first, auto last) {
        for (auto side = first + 1; side != last; ++side) {
            const Index a = find_root(parent, first->triangle), b = find_root(parent, side->triangle);
            parent[std::max(a, b)] = std::min(a, b);
        }
    });
    std::vector<Index> piece(parent.size());
    Index count = 0;
    for (Index t = 0; t < static_cast<Index>(piece.size()); ++t) {
        const Index root = find_root(parent, t);
        piece[t] = root == t ? count++ : piece[root];  // the root is the lowest triangle
    }
    return piece;
}

std::vector<Index> wrong_way_triangles(const TriangleMesh& mesh, const std::vector<HalfEdge>& sides) {
    std::vector<Piece> pieces = split_into_pieces(mesh, sides);
    const std::vector<int> depth = depths(pieces);
    std::vector<Index> wrong;
    for (std::size_t p = 0; p < pieces.size(); ++p) {
        const Piece& piece = pieces[p];
        if (!piece.closed) continue;
        const double volume = signed_volume(piece.mesh);
        if (depth[p] % 2 == 0 ? volume <= 0 : volume >= 0)
            wrong.insert(wrong.end(), piece.triangles.begin(), piece.triangles.end());
    }
    std::ranges::sort(wrong);
    return wrong;
}

}  // namespace octafield::surface
