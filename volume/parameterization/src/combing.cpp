#include "octafield/volume/combing.hpp"

#include <algorithm>
#include <array>
#include <deque>
#include <utility>

#include "edge_loops.hpp"
#include "matched_combing.hpp"
#include "octafield/frames/octahedral_group.hpp"
#include "require_frames.hpp"

namespace octafield::volume {
namespace {

using frames::octahedral_inverse;
using frames::octahedral_product;

// Rows of the table between two tets.
FaceMatchings interior(const TriangleTable& table, const std::vector<std::uint8_t>& matching) {
    Eigen::Index count = 0;
    for (Eigen::Index t = 0; t < table.triangles.rows(); ++t) count += table.sides(t, 1) >= 0;
    FaceMatchings faces{Triangles(count, 3), Edges(count, 2), {}};
    faces.matching.reserve(count);
    for (Eigen::Index t = 0, f = 0; t < table.triangles.rows(); ++t) {
        if (table.sides(t, 1) < 0) continue;
        faces.triangles.row(f) = table.triangles.row(t);
        faces.tets.row(f++) << table.sides(t, 0) / 4, table.sides(t, 1) / 4;
        faces.matching.push_back(matching[t]);
    }
    return faces;
}

// Breadth first from the lowest tet of each part: representatives that agree along the tree.
struct SpanningTree {
    Quaternions frames;
    std::vector<std::uint8_t> element, in_tree;  // per tet; per triangle
    Index parts = 0;
};

SpanningTree spanning_tree(const TriangleTable& table, const std::vector<std::uint8_t>& matching,
                           const Quaternions& of_tets) {
    const Index count = static_cast<Index>(of_tets.rows());
    SpanningTree tree{of_tets, std::vector<std::uint8_t>(count, 0),
                      std::vector<std::uint8_t>(table.triangles.rows(), 0)};
    std::vector<std::uint8_t> reached(count, 0);
    std::deque<Index> queue;
    const auto reach_neighbours = [&](Index tet) {
        std::array<Index, 4> triangles;  // ascending: the order of a tet's vertices does not matter
        for (int k = 0; k < 4; ++k) triangles[k] = table.tet_triangles(tet, k);
        std::sort(triangles.begin(), triangles.end());
        for (const Index triangle : triangles) {
            if (table.sides(triangle, 1) < 0) continue;
            const bool forward = table.sides(triangle, 0) / 4 == tet;
            const Index child = table.sides(triangle, forward ? 1 : 0) / 4;
            if (reached[child]) continue;
            reached[child] = tree.in_tree[triangle] = 1;
            const int step = forward ? octahedral_inverse(matching[triangle]) : matching[triangle];
            const int element = octahedral_product(step, tree.element[tet]);
            if (element != 0)  // else all bits stay
                tree.frames.row(child) =
                    frames::to_wxyz(frames::from_wxyz(of_tets.row(child)) * frames::octahedral_group()[element])
                        .transpose();
            if (tree.frames.row(child).dot(tree.frames.row(tet)) < 0) tree.frames.row(child) *= -1;
            tree.element[child] = static_cast<std::uint8_t>(element);
            queue.push_back(child);
        }
    };
    for (Index root = 0; root < count; ++root) {
        if (reached[root]) continue;
        ++tree.parts;
        reached[root] = 1;
        for (queue.push_back(root); !queue.empty(); queue.pop_front()) reach_neighbours(queue.front());
    }
    return tree;
}

// Edges inside the mesh without holonomy, and the triangles round them.
struct RegularEdges {
    std::vector<std::size_t> begin, end;  // their tets; each has one of their triangles
    Triangles of_triangle;                // (t, 3) in no order, -1: none

    RegularEdges(const std::vector<TetAtEdge>& tets, const TriangleTable& table,
                 const std::vector<std::uint8_t>& matching)
        : of_triangle(Triangles::Constant(table.triangles.rows(), 3, -1)) {
        for_each_edge_loop(tets, table, matching, [&](std::size_t first, std::size_t last, const EdgeLoop& loop) {
            if (!loop.closed || loop.holonomy != 0) return;
            for (std::size_t i = first; i < last; ++i) {
                int k = 0;
                while (of_triangle(tets[i].triangle, k) >= 0) ++k;
                of_triangle(tets[i].triangle, k) = static_cast<Index>(begin.size());
            }
            begin.push_back(first);
            end.push_back(last);
        });
    }
};

// Takes triangles back that are the only one of the cut at a regular edge: all others round it are crossed without a
// turn, so this one is too.
void prune(const std::vector<TetAtEdge>& tets, const RegularEdges& edges, std::vector<std::uint8_t>& cut) {
    std::vector<Index> count(edges.begin.size(), 0);
    std::deque<Index> queue;
    for (std::size_t e = 0; e < count.size(); ++e) {
        for (std::size_t i = edges.begin[e]; i < edges.end[e]; ++i) count[e] += cut[tets[i].triangle];
        if (count[e] == 1) queue.push_back(static_cast<Index>(e));
    }
    for (; !queue.empty(); queue.pop_front()) {
        const Index e = queue.front();
        if (count[e] != 1) continue;
        std::size_t i = edges.begin[e];
        while (!cut[tets[i].triangle]) ++i;
        const Index triangle = tets[i].triangle;
        cut[triangle] = 0;
        for (int k = 0; k < 3; ++k)
            if (const Index other = edges.of_triangle(triangle, k); other >= 0 && --count[other] == 1)
                queue.push_back(other);
    }
}

}  // namespace

FaceMatchings face_matchings(const TetDomain& domain, const Quaternions& of_tets, int threads) {
    const TetMesh& mesh = domain.mesh();
    require_frames(of_tets, mesh.tets.rows());
    const TriangleTable& table = domain.triangles();
    return interior(table, triangle_matchings(table, of_tets, threads));
}

CombedField comb(const TetDomain& domain, const Quaternions& of_tets, int threads) {
    require_frames(of_tets, domain.mesh().tets.rows());
    return comb_matched(domain, of_tets, triangle_matchings(domain.triangles(), of_tets, threads), threads);
}

CombedField comb_matched(const TetDomain& domain, const Quaternions& of_tets, std::vector<std::uint8_t> matching,
                         int threads) {
    const TetMesh& mesh = domain.mesh();
    const TriangleTable& table = domain.triangles();
    SpanningTree tree = spanning_tree(table, matching, of_tets);
    std::vector<std::uint8_t> cut(matching.size(), 0);
    for (std::size_t t = 0; t < cut.size(); ++t) cut[t] = table.sides(t, 1) >= 0 && !tree.in_tree[t];
    {
        const std::vector<TetAtEdge> tets = tets_at_edges(mesh, table, threads);
        prune(tets, RegularEdges(tets, table, matching), cut);
    }
    CombedField result;
    for (std::size_t t = 0; t < cut.size(); ++t) {
        if (table.sides(t, 1) < 0) continue;
        const int first = tree.element[table.sides(t, 0) / 4], second = tree.element[table.sides(t, 1) / 4];
        matching[t] = static_cast<std::uint8_t>(
            octahedral_product(octahedral_inverse(first), octahedral_product(matching[t], second)));
        result.cut.push_back(cut[t]);
    }
    result.faces = interior(table, matching);
    result.frames = std::move(tree.frames);
    result.element = std::move(tree.element);
    result.parts = tree.parts;
    return result;
}

}  // namespace octafield::volume
