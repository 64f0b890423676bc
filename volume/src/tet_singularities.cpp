#include "octafield/volume/tet_singularities.hpp"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "octafield/frames/octahedral_group.hpp"
#include "octafield/parallel.hpp"
#include "quarter_turns.hpp"
#include "require_frames.hpp"
#include "singular_curves.hpp"
#include "triangle_table.hpp"

namespace octafield::volume {
namespace {

using frames::Quaternion;

// Corners (a, b, c, d) of a positively oriented tet for each of its edges ab: an even permutation, so that the way
// round a -> b (right-handed) enters the tet through the triangle abc and leaves it through abd.
constexpr std::array<std::array<int, 4>, 6> even{
    {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}}};

// A tet round an edge: entered at the triangle with vertex `enter`, left at the one with vertex `leave`.
struct Wedge {
    Index a, b, tet, enter, leave, triangle;  // triangle: that of `leave`
};

Wedge wedge(const TetMesh& mesh, const TriangleTable& table, Index tet, int edge) {
    const auto& c = even[edge];
    const auto id = [&](int k) { return mesh.tets(tet, c[k]); };
    if (id(0) < id(1)) return {id(0), id(1), tet, id(2), id(3), table.tet_triangles(tet, c[2])};
    return {id(1), id(0), tet, id(3), id(2), table.tet_triangles(tet, c[3])};
}

// All wedges by edge, then by tet: bucketed by lowest vertex, then sorted in the buckets.
std::vector<Wedge> sorted_wedges(const TetMesh& mesh, const TriangleTable& table, int threads) {
    const Eigen::Index n = mesh.vertices.rows(), m = mesh.tets.rows();
    std::vector<std::int64_t> begin(n + 1, 0);
    for (Index t = 0; t < m; ++t)
        for (int e = 0; e < 6; ++e) ++begin[std::min(mesh.tets(t, even[e][0]), mesh.tets(t, even[e][1])) + 1];
    for (Eigen::Index v = 0; v < n; ++v) begin[v + 1] += begin[v];
    std::vector<std::int64_t> next(begin.begin(), begin.end() - 1);
    std::vector<Wedge> wedges(6 * m);
    for (Index t = 0; t < m; ++t)
        for (int e = 0; e < 6; ++e) {
            const Wedge w = wedge(mesh, table, t, e);
            wedges[next[w.a]++] = w;
        }
    parallel_for(n, threads, [&](std::int64_t v) {
        std::sort(wedges.begin() + begin[v], wedges.begin() + begin[v + 1],
                  [](const Wedge& x, const Wedge& y) { return std::tie(x.b, x.tet) < std::tie(y.b, y.tet); });
    });
    return wedges;
}

// From the tet on a triangle's first side to the one on its second: both edges of the triangle then agree, also in a
// tie.
std::vector<std::uint8_t> matchings(const TriangleTable& table, const Quaternions& of_tets, int threads) {
    std::vector<std::uint8_t> result(table.triangles.rows(), 0);
    parallel_for(table.triangles.rows(), threads, [&](std::int64_t t) {
        if (table.sides(t, 1) < 0) return;
        const Quaternion p = frames::from_wxyz(of_tets.row(table.sides(t, 0) / 4)),
                         q = frames::from_wxyz(of_tets.row(table.sides(t, 1) / 4));
        result[t] = static_cast<std::uint8_t>(frames::matching(p, q));
    });
    return result;
}

// Of the loop round the edge of [first, last), from its lowest tet; 0 where the tets do not close round it. As for
// triangles, h is the inverse of the product of the matchings along the loop.
int holonomy(const Wedge* first, const Wedge* last, const TriangleTable& table,
             const std::vector<std::uint8_t>& matching) {
    int product = 0;
    const Wedge* at = first;
    for (auto step = first; step != last; ++step) {
        if (table.sides(at->triangle, 1) < 0) return 0;
        const bool forward = table.sides(at->triangle, 0) / 4 == at->tet;
        const int m = matching[at->triangle];
        product = frames::octahedral_product(product, forward ? m : frames::octahedral_inverse(m));
        const Index enter = at->leave;
        at = std::find_if(first, last, [&](const Wedge& w) { return w.enter == enter; });
        if (at == last) return 0;
        if (at == first && step + 1 != last) return 0;  // two fans that touch in this edge
    }
    return frames::octahedral_inverse(product);
}

// The curve runs from the vertex before an edge to the one after it where it goes on in one edge alone: steadier than
// the edge, which may run across a curve that no edges follow.
void set_quarter_turns(const TetMesh& mesh, const Quaternions& of_tets, const std::vector<Index>& first_tets,
                       std::vector<SingularEdge>& edges) {
    std::vector<std::array<Index, 2>> neighbours(mesh.vertices.rows(), {-1, -1});
    std::vector<Index> degree(mesh.vertices.rows(), 0);
    for (const SingularEdge& e : edges)
        for (const auto& [v, other] : {std::pair(e.a, e.b), std::pair(e.b, e.a)})
            if (degree[v]++ < 2) neighbours[v][degree[v] - 1] = other;
    const auto beyond = [&](Index v, Index from) {
        if (degree[v] != 2) return v;
        return neighbours[v][neighbours[v][0] == from];
    };
    for (std::size_t i = 0; i < edges.size(); ++i) {
        SingularEdge& e = edges[i];
        const Eigen::Vector3d along =
            (mesh.vertices.row(beyond(e.b, e.a)) - mesh.vertices.row(beyond(e.a, e.b))).transpose();
        const Eigen::Vector3d axis =
            frames::from_wxyz(of_tets.row(first_tets[i])) * frames::octahedral_group()[e.holonomy].vec();
        e.quarter_turns = quarter_turns(e.holonomy, axis, along);
        // The two ways of a half turn come to the same frames in every tet.
        if (e.quarter_turns == -2) e.quarter_turns = 2;
    }
}

void add_curves(const TetMesh& mesh, SingularEdges& result) {
    std::vector<Index> number(mesh.vertices.rows(), -1), degree(mesh.vertices.rows(), 0);
    for (const SingularEdge& e : result.edges) ++degree[e.a], ++degree[e.b];
    for (std::size_t v = 0; v < number.size(); ++v) {
        if (degree[v] == 0) continue;
        number[v] = static_cast<Index>(result.vertices.size());
        result.vertices.push_back(static_cast<Index>(v));
    }
    SingularGraph& graph = result.graph;
    graph.points = mesh.vertices(result.vertices, Eigen::all);
    std::vector<Segment> segments;
    for (const SingularEdge& e : result.edges) {
        segments.push_back({{number[e.a], number[e.b]}, e.quarter_turns});
        graph.length += (mesh.vertices.row(e.a) - mesh.vertices.row(e.b)).norm();
        result.complex_edges += e.quarter_turns == 0;
    }
    std::vector<std::uint8_t> on_boundary(mesh.vertices.rows(), 0);
    for (const Index v : boundary_surface(mesh).vertex_map) on_boundary[v] = 1;
    for (const Index v : result.vertices)
        if (degree[v] != 2 && !on_boundary[v]) graph.nodes.push_back(number[v]);
    CurveSet set = chain_segments(segments, static_cast<Index>(result.vertices.size()));
    graph.curves = std::move(set.curves);
    graph.curve_quarter_turns = std::move(set.types);
}

}  // namespace

SingularEdges singular_edges(const TetMesh& mesh, const Quaternions& of_tets, int threads) {
    require_valid(mesh);
    require_frames(of_tets, mesh.tets.rows());
    const TriangleTable table = triangle_table(mesh, threads);
    const std::vector<std::uint8_t> matching = matchings(table, of_tets, threads);
    const std::vector<Wedge> wedges = sorted_wedges(mesh, table, threads);
    SingularEdges result;
    std::vector<Index> first_tets;
    for (std::size_t i = 0, end; i < wedges.size(); i = end) {
        for (end = i + 1; end < wedges.size() && wedges[end].a == wedges[i].a && wedges[end].b == wedges[i].b;) ++end;
        const int h = holonomy(&wedges[i], wedges.data() + end, table, matching);
        if (h == 0) continue;
        result.edges.push_back({wedges[i].a, wedges[i].b, h, 0});
        first_tets.push_back(wedges[i].tet);
    }
    set_quarter_turns(mesh, of_tets, first_tets, result.edges);
    add_curves(mesh, result);
    return result;
}

}  // namespace octafield::volume
