#include "octafield/volume/meshability.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>

#include "axis_numbers.hpp"
#include "octafield/error.hpp"
#include "octafield/frames/octahedral_group.hpp"
#include "octafield/volume/smoothed_curves.hpp"
#include "require_frames.hpp"

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
bool turns_about_normal(const TetMesh& mesh, const Quaternions& frames, const SingularTriangle& t) {
    const Eigen::Vector3d a = mesh.vertices.row(t.a), b = mesh.vertices.row(t.b), c = mesh.vertices.row(t.c);
    const Quaternion q = frames::from_wxyz(frames.row(t.a));
    const Eigen::Vector3d normal = q.conjugate() * (b - a).cross(c - a);  // in the frame's own axes
    Eigen::Index nearest, turned;
    normal.cwiseAbs().maxCoeff(&nearest);
    frames::octahedral_group()[t.holonomy].vec().cwiseAbs().maxCoeff(&turned);
    return t.quarter_turns != 0 && nearest == turned;
}

// Points where a curve ends, with a number each. A closed curve that passes its first point with one type ends nowhere.
struct Ends {
    std::vector<Index> vertex_of_point;  // -1: none
    std::vector<std::uint8_t> is_node;
    std::vector<Index> points;  // ascending
};

bool on_boundary(const SingularGraph& graph, Index point) {
    return point < static_cast<Index>(graph.triangles.size()) && graph.triangles[point].boundary;
}

Ends find_ends(const SingularGraph& graph) {
    Ends ends{std::vector<Index>(graph.points.rows(), -1), std::vector<std::uint8_t>(graph.points.rows(), 0), {}};
    for (const Index p : graph.nodes) ends.is_node[p] = 1;
    for (const auto& curve : graph.curves)
        for (const Index p : {curve.front(), curve.back()})
            if (curve.front() != curve.back() || ends.is_node[p] || on_boundary(graph, p)) ends.vertex_of_point[p] = 0;
    for (Index p = 0; p < graph.points.rows(); ++p) {
        if (ends.vertex_of_point[p] < 0) continue;
        ends.vertex_of_point[p] = static_cast<Index>(ends.points.size());
        ends.points.push_back(p);
    }
    return ends;
}

template <class Counted>
void count_curve(Counted& at, int quarter_turns) {
    ++(quarter_turns == 1    ? at.valence3
       : quarter_turns == -1 ? at.valence5
       : quarter_turns == 2  ? at.valence2
                             : at.valence6);
}

std::vector<SingularVertex> make_vertices(const TetMesh& mesh, const Quaternions& frames, const SingularGraph& graph,
                                          const Ends& ends) {
    std::vector<SingularVertex> vertices;
    for (const Index p : ends.points) {
        SingularVertex v{};
        v.point = p;
        v.kind = ends.is_node[p]         ? SingularVertexKind::node
                 : on_boundary(graph, p) ? SingularVertexKind::boundary_end
                                         : SingularVertexKind::change;
        v.about_normal =
            v.kind == SingularVertexKind::boundary_end && turns_about_normal(mesh, frames, graph.triangles[p]);
        v.junction = -1;
        vertices.push_back(v);
    }
    for (std::size_t c = 0; c < graph.curves.size(); ++c)
        for (const Index p : {graph.curves[c].front(), graph.curves[c].back()})
            if (const Index v = ends.vertex_of_point[p]; v < 0)
                continue;
            else if (graph.curve_quarter_turns[c] == 0)
                ++vertices[v].complex;
            else
                count_curve(vertices[v], graph.curve_quarter_turns[c]);
    return vertices;
}

// Direction of a smoothed curve at one end, over three of its segments, but not beyond its middle.
Vector3 end_direction(const Points& smoothed, const std::vector<Index>& curve, bool backwards) {
    const std::size_t step = std::clamp<std::size_t>((curve.size() - 1) / 2, 1, 3);
    const Index from = backwards ? curve.back() : curve.front();
    const Index to = backwards ? curve[curve.size() - 1 - step] : curve[step];
    return (smoothed.row(to) - smoothed.row(from)).transpose();
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

double angle_between(const Vector3& a, const Vector3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

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

// Whether every curve that comes along the axis can go on as one of its type.
bool curves_pass(const std::vector<Leaving>& leaving, const std::vector<int>& turns) {
    std::array<int, 5> more{};  // leaving along the axis, less those against it, by quarter turns + 2
    for (std::size_t i = 0; i < leaving.size(); ++i) more[turns[i] + 2] += leaving[i].axis < 3 ? 1 : -1;
    return std::all_of(more.begin(), more.end(), [](int m) { return m == 0; });
}

void judge(const SingularGraph& graph, const VertexAxes& axes, std::vector<Leaving> leaving,
           const std::vector<int>& turns, SingularVertex& v) {
    v.one_axis = v.kind == SingularVertexKind::node && !leaving.empty() && all_about_one_axis(graph, axes, leaving);
    v.meshable = v.complex == 0 && v.valence2 == 0;
    if (v.kind == SingularVertexKind::boundary_end)
        v.meshable &= v.about_normal;
    else
        v.meshable &= v.one_axis ? curves_pass(leaving, turns) : hex_vertex_exists(v.valence3, v.valence5, v.valence6);
}

// Lists the ends of the curves and judges the vertices by them.
void find_curve_ends(const Quaternions& frames, const SingularGraph& graph, Meshability& result) {
    const VertexAxes axes(frames);
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

// Sets of vertices joined by complex curves.
class Components {
public:
    explicit Components(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
    Index root(Index v) {
        while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
        return v;
    }
    void join(Index v, Index w) {
        const Index a = root(v), b = root(w);
        parent_[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<Index> parent_;
};

void find_junctions(const SingularGraph& graph, Meshability& result) {
    auto& vertices = result.vertices;
    Components components(vertices.size());
    const auto is_inside = [&](std::size_t c) {
        return graph.curve_quarter_turns[c] == 0 && result.curve_ends(c, 0) >= 0;
    };
    for (std::size_t c = 0; c < graph.curves.size(); ++c)
        if (is_inside(c)) components.join(result.curve_ends(c, 0), result.curve_ends(c, 1));
    std::vector<bool> reaches_boundary;
    for (Index v = 0; v < static_cast<Index>(vertices.size()); ++v) {
        const Index root = components.root(v);  // the lowest vertex of the junction
        if (root == v) {
            vertices[v].junction = static_cast<Index>(result.junctions.size());
            result.junctions.push_back({0, 0, 0, 0, 0, 0, vertices[v].meshable});
            reaches_boundary.push_back(false);
        }
        vertices[v].junction = vertices[root].junction;
        SingularJunction& junction = result.junctions[vertices[v].junction];
        ++junction.vertices;
        junction.valence2 += vertices[v].valence2;
        junction.valence3 += vertices[v].valence3;
        junction.valence5 += vertices[v].valence5;
        junction.valence6 += vertices[v].valence6;
        if (vertices[v].kind == SingularVertexKind::boundary_end) reaches_boundary[vertices[v].junction] = true;
    }
    for (std::size_t c = 0; c < graph.curves.size(); ++c)
        if (is_inside(c)) ++result.junctions[vertices[result.curve_ends(c, 0)].junction].complex;
    for (std::size_t j = 0; j < result.junctions.size(); ++j) {
        SingularJunction& junction = result.junctions[j];
        if (junction.vertices == 1) continue;
        junction.meshable = !reaches_boundary[j] && junction.complex == junction.vertices - 1 &&
                            junction.valence2 == 0 &&
                            hex_vertex_exists(junction.valence3, junction.valence5, junction.valence6);
    }
}

}  // namespace

Meshability local_meshability(const TetMesh& mesh, const Quaternions& frames, const SingularGraph& graph) {
    require_frames(frames, mesh.vertices.rows());
    require_fitting(mesh, graph);
    const Ends ends = find_ends(graph);
    Meshability result;
    result.vertices = make_vertices(mesh, frames, graph, ends);
    result.curve_ends.resize(static_cast<Eigen::Index>(graph.curves.size()), 2);
    for (std::size_t c = 0; c < graph.curves.size(); ++c) {
        result.curve_ends(c, 0) = ends.vertex_of_point[graph.curves[c].front()];
        result.curve_ends(c, 1) = ends.vertex_of_point[graph.curves[c].back()];
        result.closed_curves += result.curve_ends(c, 0) < 0;
    }
    find_curve_ends(frames, graph, result);
    find_junctions(graph, result);
    for (const int turns : graph.curve_quarter_turns) result.non_meshable_curves += turns == 0 || turns == 2;
    for (const SingularVertex& v : result.vertices) {
        result.non_meshable_vertices += !v.meshable;
        result.boundary_ends += v.kind == SingularVertexKind::boundary_end;
        result.boundary_ends_about_normal += v.about_normal;
    }
    for (const SingularJunction& j : result.junctions) result.non_meshable_junctions += !j.meshable;
    return result;
}

}  // namespace octafield::volume
