#include "octafield/volume/tet_singularities.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "edge_loops.hpp"
#include "octafield/volume/triangle_table.hpp"
#include "quarter_turns.hpp"
#include "require_frames.hpp"
#include "singular_curves.hpp"

namespace octafield::volume {
namespace {

// The curve runs from the vertex before an edge to the one after it where it goes on in one edge alone: steadier than
// the edge, which may run across a curve that no edges follow.
void set_quarter_turns(const TetMesh& mesh, const std::vector<Turn>& turns, std::vector<SingularEdge>& edges) {
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
        const auto way = [&](Index from, Index to) -> Eigen::Vector3d {
            return (mesh.vertices.row(to) - mesh.vertices.row(from)).transpose();
        };
        const Eigen::Vector3d along = way(beyond(e.a, e.b), beyond(e.b, e.a)), edge = way(e.a, e.b);
        e.quarter_turns = quarter_turns(turns[i], along);
        e.undecided |= across(turns[i], along);
        if (turns[i].size > 0 && !across(turns[i], edge)) e.valence = 4 - quarter_turns(turns[i], edge);
    }
}

void add_curves(const TetDomain& domain, SingularEdges& result) {
    const TetMesh& mesh = domain.mesh();
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
    for (const Index v : domain.boundary().vertex_map) on_boundary[v] = 1;
    for (const Index v : result.vertices)
        if (degree[v] != 2 && !on_boundary[v]) graph.nodes.push_back(number[v]);
    std::vector<std::uint8_t> ends;
    for (const Index v : result.vertices) ends.push_back(on_boundary[v]);
    CurveSet set = chain_segments(segments, static_cast<Index>(result.vertices.size()), ends);
    graph.curves = std::move(set.curves);
    graph.curve_quarter_turns = std::move(set.types);
}

}  // namespace

SingularEdges singular_edges(const TetDomain& domain, const Quaternions& of_tets, int threads) {
    const TetMesh& mesh = domain.mesh();
    require_frames(of_tets, mesh.tets.rows());
    const TriangleTable& table = domain.triangles();
    const std::vector<TetAtEdge> tets = tets_at_edges(mesh, table, threads);
    const LiftedMatchings matchings = lifted_matchings(table, of_tets, threads);
    SingularEdges result;
    std::vector<Turn> turns;
    for_each_edge_loop(tets, table, matchings.element, [&](std::size_t first, std::size_t last, const EdgeLoop& loop) {
        if (loop.lift == 0) return;
        const auto tied = [&](const TetAtEdge& at) { return matchings.tie[at.triangle] != 0; };
        result.edges.push_back({tets[first].a, tets[first].b, loop.holonomy, 0});
        result.edges.back().undecided = std::any_of(&tets[first], &tets[last - 1] + 1, tied);
        turns.push_back(turn_of(loop.lift, frames::from_wxyz(of_tets.row(tets[first].tet))));
    });
    set_quarter_turns(mesh, turns, result.edges);
    for (const SingularEdge& e : result.edges) result.undecided_edges += e.undecided;
    for (const std::uint8_t tie : matchings.tie) result.tied_triangles += tie;
    add_curves(domain, result);
    return result;
}

}  // namespace octafield::volume
