#include "octafield/volume/tet_meshability.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "edge_loops.hpp"
#include "octafield/error.hpp"
#include "octafield/volume/smoothed_curves.hpp"
#include "require_frames.hpp"
#include "singular_vertices.hpp"
#include "vertex_axes.hpp"

namespace octafield::volume {
namespace {

using frames::Vector3;

// A curve at one of its ends: its last edge, the lowest tet there, and the axis of that tet's frame about which the
// frames turn, away from the vertex; -1: none, as of complex curves.
struct Leaving {
    Index tet = -1;
    int axis = -1;
};

class LastEdges {
public:
    LastEdges(const TetMesh& mesh, const VertexAxes& axes, const SingularEdges& singular)
        : mesh_(mesh), axes_(axes), singular_(singular), tets_(singular.edges.size(), -1) {
        std::vector<std::uint8_t> marked(mesh.vertices.rows(), 0);
        for (const SingularEdge& e : singular.edges) marked[e.a] = marked[e.b] = 1;
        for (Index t = 0; t < mesh.tets.rows(); ++t)
            for (int i = 0; i < 4; ++i)
                for (int j = i + 1; j < 4; ++j) {
                    if (!marked[mesh.tets(t, i)] || !marked[mesh.tets(t, j)]) continue;
                    const std::int64_t e = place(mesh.tets(t, i), mesh.tets(t, j));
                    if (e >= 0 && tets_[e] < 0) tets_[e] = t;
                }
    }

    Leaving at(std::size_t curve, bool backwards) const {
        const std::vector<Index>& points = singular_.graph.curves[curve];
        const Index v = singular_.vertices[backwards ? points.back() : points.front()];
        const Index w = singular_.vertices[backwards ? points[points.size() - 2] : points[1]];
        const std::int64_t e = place(v, w);
        if (e < 0 || tets_[e] < 0)
            throw InvalidInput("the singular edges are not those of this mesh; give singular_edges(mesh, of_tets)",
                               "wrong_mesh");
        const Vector3 axis = frames::octahedral_group()[singular_.edges[e].holonomy].vec();
        const int turns = singular_.edges[e].quarter_turns;
        if (turns == 0 || turns == -4) return {tets_[e], -1};
        const int number = nearest_axis_number(axis);
        const Vector3 way = (mesh_.vertices.row(w) - mesh_.vertices.row(v)).transpose();
        return {tets_[e], way.dot(axes_.direction(tets_[e], number)) < 0 ? opposite_axis(number) : number};
    }

private:
    std::int64_t place(Index v, Index w) const {
        const std::pair<Index, Index> edge = std::minmax(v, w);
        const auto found = std::lower_bound(
            singular_.edges.begin(), singular_.edges.end(), edge,
            [](const SingularEdge& e, const std::pair<Index, Index>& key) { return std::pair(e.a, e.b) < key; });
        return found != singular_.edges.end() && found->a == edge.first && found->b == edge.second
                   ? found - singular_.edges.begin()
                   : -1;
    }

    const TetMesh& mesh_;
    const VertexAxes& axes_;
    const SingularEdges& singular_;
    std::vector<Index> tets_;
};

// Carries axes to one tet through those round a vertex, breadth first from it; the way matters only where frames turn
// about several axes.
class Star {
public:
    Star(const TetMesh& mesh, const TriangleTable& table, const VertexAxes& axes)
        : mesh_(mesh), table_(table), axes_(axes), element_(mesh.tets.rows(), -1) {}

    // Element for every tet reached: its axis a is element a of `base`.
    void spread(Index base, Index vertex) {
        for (const Index t : reached_) element_[t] = -1;
        reached_ = {base};
        element_[base] = 0;
        for (std::size_t i = 0; i < reached_.size(); ++i) {
            const Index tet = reached_[i];
            for (int k = 0; k < 4; ++k) {
                const Index row = table_.tet_triangles(tet, k);
                if (mesh_.tets(tet, k) == vertex || table_.sides(row, 1) < 0) continue;
                const Index next = table_.sides(row, table_.sides(row, 0) / 4 == tet ? 1 : 0) / 4;
                if (element_[next] >= 0) continue;
                element_[next] = frames::octahedral_product(element_[tet], axes_.matching(tet, next));
                reached_.push_back(next);
            }
        }
    }
    int carried(Index tet, int axis) const { return element_[tet] < 0 ? axis : turned_axis(element_[tet], axis); }

private:
    const TetMesh& mesh_;
    const TriangleTable& table_;
    const VertexAxes& axes_;
    std::vector<int> element_;
    std::vector<Index> reached_;
};

struct SurfaceVertices {
    std::vector<std::uint8_t> on_boundary, on_feature;
    Points normals;  // (n, 3) sums over the triangles, weighted by area; out of the mesh where it is its boundary
};

SurfaceVertices surface_vertices(const TetDomain& domain) {
    const TetMesh& mesh = domain.mesh();
    const BoundarySurface& surface = domain.surface();
    SurfaceVertices result{std::vector<std::uint8_t>(mesh.vertices.rows(), 0),
                           std::vector<std::uint8_t>(mesh.vertices.rows(), 0), Points::Zero(mesh.vertices.rows(), 3)};
    for (const Index v : domain.boundary().vertex_map) result.on_boundary[v] = 1;
    for (const auto triangle : surface.mesh.triangles.rowwise()) {
        std::array<Vector3, 3> p;
        for (int k = 0; k < 3; ++k) p[k] = mesh.vertices.row(surface.vertex_map[triangle[k]]).transpose();
        for (int k = 0; k < 3; ++k)
            result.normals.row(surface.vertex_map[triangle[k]]) += (p[1] - p[0]).cross(p[2] - p[0]).transpose();
    }
    for (const Index v : domain.features().edges.reshaped()) result.on_feature[surface.vertex_map[v]] = 1;
    return result;
}

}  // namespace

Meshability tet_meshability(const TetDomain& domain, const Quaternions& of_tets, const SingularEdges& singular) {
    const TetMesh& mesh = domain.mesh();
    require_frames(of_tets, mesh.tets.rows());
    const SingularGraph& graph = singular.graph;
    if (singular.vertices.size() != static_cast<std::size_t>(graph.points.rows()))
        throw InvalidInput("the singular edges have " + std::to_string(singular.vertices.size()) + " vertices for " +
                               std::to_string(graph.points.rows()) + " points; give singular_edges(mesh, of_tets)",
                           "wrong_size");
    for (const Index v : singular.vertices)
        if (v < 0 || v >= mesh.vertices.rows())
            throw InvalidInput("the singular edges are not those of this mesh; give singular_edges(mesh, of_tets)",
                               "wrong_mesh", {v});
    const SurfaceVertices on = surface_vertices(domain);
    std::vector<std::uint8_t> boundary_points;
    for (const Index v : singular.vertices) boundary_points.push_back(on.on_boundary[v]);
    Meshability result = singular_vertices(graph, boundary_points);

    const VertexAxes axes(of_tets);
    const LastEdges last_edges(mesh, axes, singular);
    const Points smoothed = smoothed_curves(graph).points;
    std::vector<std::vector<Leaving>> leaving(result.vertices.size());
    std::vector<std::vector<SingularEnd>> ends(result.vertices.size());
    for (std::size_t c = 0; c < graph.curves.size(); ++c)
        for (const bool backwards : {false, true}) {
            const Index v = result.curve_ends(static_cast<Eigen::Index>(c), backwards);
            if (v < 0) continue;
            const Leaving l = last_edges.at(c, backwards);
            SingularEnd end{v, static_cast<Index>(c), graph.curve_quarter_turns[c], Vector3::Zero(), 0};
            if (l.axis >= 0) {
                end.axis = axes.direction(l.tet, l.axis);
                end.angle = angle_between(end.axis, end_direction(smoothed, graph.curves[c], backwards));
            }
            leaving[v].push_back(l);
            ends[v].push_back(end);
        }

    Star star(mesh, domain.triangles(), axes);
    for (std::size_t i = 0; i < result.vertices.size(); ++i) {
        SingularVertex& v = result.vertices[i];
        const Index id = singular.vertices[v.point];
        const bool all_have_axes =
            std::all_of(leaving[i].begin(), leaving[i].end(), [](const Leaving& l) { return l.axis >= 0; });
        v.meshable = all_curves_meshable(v);
        if (v.kind == SingularVertexKind::boundary_end) {
            const Leaving& l = leaving[i].front();
            v.about_normal = !on.on_feature[id] && all_have_axes && leaving[i].size() == 1 &&
                             axes.nearest(l.tet, on.normals.row(id).transpose()) % 3 == l.axis % 3;
            v.meshable &= on.on_feature[id] || v.about_normal;
        } else if (v.kind == SingularVertexKind::change) {
            v.meshable = false;
        } else {
            std::vector<int> numbers, turns;
            if (all_have_axes) star.spread(leaving[i].front().tet, id);
            for (std::size_t k = 0; k < leaving[i].size() && all_have_axes; ++k) {
                numbers.push_back(star.carried(leaving[i][k].tet, leaving[i][k].axis));
                turns.push_back(ends[i][k].quarter_turns);
            }
            v.one_axis = all_have_axes && std::all_of(numbers.begin(), numbers.end(),
                                                      [&](int n) { return n % 3 == numbers.front() % 3; });
            v.meshable &= v.one_axis ? curves_pass(numbers, turns) : hex_vertex_exists(v);
        }
        result.ends.insert(result.ends.end(), ends[i].begin(), ends[i].end());
    }
    find_junctions(graph, result);
    add_totals(graph, result);
    return result;
}

}  // namespace octafield::volume
