#include "octafield/volume/meshability.hpp"

#include <algorithm>
#include <string>

#include "octafield/error.hpp"
#include "octafield/frames/octahedral_group.hpp"
#include "octafield/volume/smoothed_curves.hpp"
#include "require_frames.hpp"
#include "singular_vertices.hpp"
#include "vertex_axes.hpp"

namespace octafield::volume {
namespace {

using frames::Quaternion;
using frames::Vector3;

void require_fitting(const TetMesh& mesh, const SingularGraph& graph) {
    const auto require_below = [](Index id, Eigen::Index count, const char* what) {
        if (id < 0 || id >= count)
            throw InvalidInput("the singular graph uses " + std::string(what) + " " + std::to_string(id) + " of " +
                                   std::to_string(count) + "; give the graph of this mesh",
                               "index_out_of_range", {id});
    };
    if (graph.curve_quarter_turns.size() != graph.curves.size())
        throw InvalidInput("curve_quarter_turns has " + std::to_string(graph.curve_quarter_turns.size()) +
                               " entries for " + std::to_string(graph.curves.size()) + " curves; give one per curve",
                           "wrong_size");
    if (graph.points.rows() < static_cast<Eigen::Index>(graph.triangles.size()))
        throw InvalidInput("the singular graph has fewer points than triangles", "wrong_size");
    for (const SingularTriangle& t : graph.triangles) {
        for (const Index v : {t.a, t.b, t.c}) require_below(v, mesh.vertices.rows(), "mesh vertex");
        require_below(t.holonomy, frames::octahedral_order, "group element");
    }
    for (const auto& curve : graph.curves) {
        if (curve.size() < 2) throw InvalidInput("a singular curve has fewer than two points", "wrong_size");
        for (const Index p : curve) require_below(p, graph.points.rows(), "point");
    }
    for (const Index p : graph.nodes) require_below(p, graph.points.rows(), "point");
}

// Whether the frame of a, carried round the triangle, turns about its axis nearest to the triangle's normal.
bool turns_about_normal(const TetMesh& mesh, const Quaternions& frames, const Stretches* stretch,
                        const SingularTriangle& t) {
    const Eigen::Vector3d a = mesh.vertices.row(t.a), b = mesh.vertices.row(t.b), c = mesh.vertices.row(t.c);
    const Quaternion q = frames::from_wxyz(frames.row(t.a));
    const StretchedDirections seen = stretch ? stretched_directions(*stretch, t.a) : StretchedDirections();
    const Eigen::Vector3d normal = q.conjugate() * seen.normal((b - a).cross(c - a));  // in the frame's own axes
    Eigen::Index nearest, turned;
    normal.cwiseAbs().maxCoeff(&nearest);
    frames::octahedral_group()[t.holonomy].vec().cwiseAbs().maxCoeff(&turned);
    return t.quarter_turns != 0 && nearest == turned;
}

std::vector<std::uint8_t> boundary_points(const SingularGraph& graph) {
    std::vector<std::uint8_t> on_boundary(graph.points.rows(), 0);
    for (std::size_t t = 0; t < graph.triangles.size(); ++t) on_boundary[t] = graph.triangles[t].boundary;
    return on_boundary;
}

// Where a curve leaves one of its ends: the first triangle of its type, and the axis of the frame of the triangle's
// vertex a about which the frames turn, in the sense of leaving. -1: none, as for complex curves.
struct Leaving {
    Index triangle = -1;
    int axis = -1;
};

Leaving leave(const SingularGraph& graph, const VertexAxes& axes, const Points& smoothed, std::size_t c,
              bool backwards) {
    std::vector<Index> curve = graph.curves[c];
    if (backwards) std::reverse(curve.begin(), curve.end());
    const int turns = graph.curve_quarter_turns[c];
    const auto triangles = static_cast<Index>(graph.triangles.size());
    for (std::size_t i = 0; i < curve.size(); ++i) {
        if (curve[i] >= triangles || turns == 0 || graph.triangles[curve[i]].quarter_turns != turns) continue;
        const SingularTriangle& t = graph.triangles[curve[i]];
        const Index before = curve[i > 0 ? i - 1 : 0], after = curve[std::min(i + 1, curve.size() - 1)];
        Vector3 way = (graph.points.row(after) - graph.points.row(before)).transpose();
        if (way.isZero(0)) way = end_direction(smoothed, graph.curves[c], backwards);
        const int axis = nearest_axis_number(frames::octahedral_group()[t.holonomy].vec());
        return {curve[i], way.dot(axes.direction(t.a, axis)) < 0 ? opposite_axis(axis) : axis};
    }
    return {};
}

// The axes of the curves at a node, as axes of the lowest vertex of its tet. Two of the triangles have that vertex; the
// way from others to it matters only where the frames turn about several axes.
bool all_about_one_axis(const SingularGraph& graph, const VertexAxes& axes, std::vector<Leaving>& leaving) {
    Index base = -1;
    for (const Leaving& l : leaving) {
        if (l.axis < 0) return false;
        const Index a = graph.triangles[l.triangle].a;
        base = base < 0 ? a : std::min(base, a);
    }
    for (Leaving& l : leaving)
        if (const Index a = graph.triangles[l.triangle].a; a != base) l.axis = axes.carried(a, base, l.axis);
    return std::all_of(leaving.begin(), leaving.end(),
                       [&](const Leaving& l) { return l.axis % 3 == leaving.front().axis % 3; });
}

std::vector<int> axes_of(const std::vector<Leaving>& leaving) {
    std::vector<int> axes;
    for (const Leaving& l : leaving) axes.push_back(l.axis);
    return axes;
}

void judge(const SingularGraph& graph, const VertexAxes& axes, std::vector<Leaving> leaving,
           const std::vector<int>& turns, SingularVertex& v) {
    v.one_axis = v.kind == SingularVertexKind::node && !leaving.empty() && all_about_one_axis(graph, axes, leaving);
    v.meshable = all_curves_meshable(v);
    if (v.kind == SingularVertexKind::boundary_end)
        v.meshable &= v.about_normal;
    else
        v.meshable &= v.one_axis ? curves_pass(axes_of(leaving), turns) : hex_vertex_exists(v);
}

// Lists the ends of the curves and judges the vertices by them.
void find_curve_ends(const VertexAxes& axes, const SingularGraph& graph, Meshability& result) {
    const Points smoothed = smoothed_curves(graph).points;
    std::vector<std::vector<Leaving>> leaving(result.vertices.size());
    std::vector<std::vector<int>> turns(result.vertices.size());
    std::vector<std::vector<SingularEnd>> ends(result.vertices.size());
    for (std::size_t c = 0; c < graph.curves.size(); ++c)
        for (const bool backwards : {false, true}) {
            const Index v = result.curve_ends(static_cast<Eigen::Index>(c), backwards);
            if (v < 0) continue;
            const Leaving l = leave(graph, axes, smoothed, c, backwards);
            SingularEnd end{v, static_cast<Index>(c), graph.curve_quarter_turns[c], Vector3::Zero(), 0};
            if (l.axis >= 0) {
                end.axis = axes.direction(graph.triangles[l.triangle].a, l.axis);
                end.angle = angle_between(end.axis, end_direction(smoothed, graph.curves[c], backwards));
            }
            leaving[v].push_back(l);
            turns[v].push_back(end.quarter_turns);
            ends[v].push_back(end);
        }
    for (std::size_t v = 0; v < result.vertices.size(); ++v) {
        judge(graph, axes, leaving[v], turns[v], result.vertices[v]);
        result.ends.insert(result.ends.end(), ends[v].begin(), ends[v].end());
    }
}

}  // namespace

Meshability local_meshability(const TetDomain& domain, const Quaternions& frames, const SingularGraph& graph,
                              const Stretches& stretch) {
    const TetMesh& mesh = domain.mesh();
    require_frames(frames, mesh.vertices.rows());
    require_fitting(mesh, graph);
    const Stretches* stretched = stretch_or_none(stretch, domain.vertex_count());
    Meshability result = singular_vertices(graph, boundary_points(graph));
    for (SingularVertex& v : result.vertices)
        v.about_normal = v.kind == SingularVertexKind::boundary_end &&
                         turns_about_normal(mesh, frames, stretched, graph.triangles[v.point]);
    find_curve_ends(VertexAxes(frames, stretched), graph, result);
    find_junctions(graph, result);
    add_totals(graph, result);
    return result;
}

}  // namespace octafield::volume
