#include "singular_vertices.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "octafield/disjoint_sets.hpp"

namespace octafield::volume {
namespace {

// The counter of curves of that type: of a SingularVertex or a SingularJunction.
template <class Counted>
int& count_of(Counted& at, int quarter_turns) {
    switch (quarter_turns) {
        case 3:
            return at.valence1;
        case 2:
            return at.valence2;
        case 1:
            return at.valence3;
        case -1:
            return at.valence5;
        case -2:
            return at.valence6;
        case -3:
            return at.valence7;
        case -4:
            return at.valence8;
        default:
            return at.complex;
    }
}

bool is_complex(int quarter_turns) { return quarter_turns == 0 || quarter_turns > 3 || quarter_turns < -4; }

}  // namespace

Meshability singular_vertices(const SingularGraph& graph, const std::vector<std::uint8_t>& on_boundary) {
    std::vector<Index> number(graph.points.rows(), -1);
    std::vector<std::uint8_t> is_node(graph.points.rows(), 0);
    for (const Index p : graph.nodes) is_node[p] = 1;
    for (const auto& curve : graph.curves)
        for (const Index p : {curve.front(), curve.back()})
            if (curve.front() != curve.back() || is_node[p] || on_boundary[p]) number[p] = 0;
    Meshability result;
    for (Index p = 0; p < graph.points.rows(); ++p) {
        if (number[p] < 0) continue;
        number[p] = static_cast<Index>(result.vertices.size());
        SingularVertex v{};
        v.point = p;
        v.kind = is_node[p]       ? SingularVertexKind::node
                 : on_boundary[p] ? SingularVertexKind::boundary_end
                                  : SingularVertexKind::change;
        v.junction = -1;
        result.vertices.push_back(v);
    }
    result.curve_ends.resize(static_cast<Eigen::Index>(graph.curves.size()), 2);
    for (std::size_t c = 0; c < graph.curves.size(); ++c) {
        for (const int k : {0, 1}) {
            const Index v = number[k == 0 ? graph.curves[c].front() : graph.curves[c].back()];
            result.curve_ends(static_cast<Eigen::Index>(c), k) = v;
            if (v >= 0) ++count_of(result.vertices[v], graph.curve_quarter_turns[c]);
        }
        result.closed_curves += result.curve_ends(static_cast<Eigen::Index>(c), 0) < 0;
    }
    return result;
}

bool hex_vertex_exists(const SingularVertex& v) {
    return hex_vertex_exists(v.valence3, v.valence5, v.valence6, v.valence7, v.valence8);
}

bool curves_pass(const std::vector<int>& axes, const std::vector<int>& turns) {
    std::array<int, 9> more{};  // leaving along the axis, less those against it, by quarter turns + 4
    for (std::size_t i = 0; i < axes.size(); ++i) more[turns[i] + 4] += axes[i] < 3 ? 1 : -1;
    return std::all_of(more.begin(), more.end(), [](int m) { return m == 0; });
}

frames::Vector3 end_direction(const Points& smoothed, const std::vector<Index>& curve, bool backwards) {
    const std::size_t step = std::clamp<std::size_t>((curve.size() - 1) / 2, 1, 3);
    const Index from = backwards ? curve.back() : curve.front();
    const Index to = backwards ? curve[curve.size() - 1 - step] : curve[step];
    return (smoothed.row(to) - smoothed.row(from)).transpose();
}

double angle_between(const frames::Vector3& a, const frames::Vector3& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

void find_junctions(const SingularGraph& graph, Meshability& result) {
    auto& vertices = result.vertices;
    DisjointSets sets(vertices.size());
    const auto is_inside = [&](std::size_t c) {
        return graph.curve_quarter_turns[c] == 0 && result.curve_ends(static_cast<Eigen::Index>(c), 0) >= 0;
    };
    for (std::size_t c = 0; c < graph.curves.size(); ++c)
        if (is_inside(c)) sets.join(result.curve_ends(c, 0), result.curve_ends(c, 1));
    std::vector<bool> reaches_boundary;
    for (Index v = 0; v < static_cast<Index>(vertices.size()); ++v) {
        const Index root = sets.lowest(v);
        if (root == v) {
            vertices[v].junction = static_cast<Index>(result.junctions.size());
            result.junctions.push_back({});
            result.junctions.back().meshable = vertices[v].meshable;
            reaches_boundary.push_back(false);
        }
        vertices[v].junction = vertices[root].junction;
        SingularJunction& junction = result.junctions[vertices[v].junction];
        ++junction.vertices;
        junction.valence1 += vertices[v].valence1;
        junction.valence2 += vertices[v].valence2;
        junction.valence3 += vertices[v].valence3;
        junction.valence5 += vertices[v].valence5;
        junction.valence6 += vertices[v].valence6;
        junction.valence7 += vertices[v].valence7;
        junction.valence8 += vertices[v].valence8;
        if (vertices[v].kind == SingularVertexKind::boundary_end) reaches_boundary[vertices[v].junction] = true;
    }
    for (std::size_t c = 0; c < graph.curves.size(); ++c)
        if (is_inside(c)) ++result.junctions[vertices[result.curve_ends(c, 0)].junction].complex;
    for (std::size_t j = 0; j < result.junctions.size(); ++j) {
        SingularJunction& junction = result.junctions[j];
        if (junction.vertices == 1) continue;
        junction.meshable = !reaches_boundary[j] && junction.complex == junction.vertices - 1 &&
                            junction.valence1 == 0 && junction.valence2 == 0 &&
                            hex_vertex_exists(junction.valence3, junction.valence5, junction.valence6,
                                              junction.valence7, junction.valence8);
    }
}

void add_totals(const SingularGraph& graph, Meshability& result) {
    for (const int turns : graph.curve_quarter_turns) result.non_meshable_curves += turns >= 2 || is_complex(turns);
    for (const SingularVertex& v : result.vertices) {
        result.non_meshable_vertices += !v.meshable;
        result.boundary_ends += v.kind == SingularVertexKind::boundary_end;
        result.boundary_ends_about_normal += v.about_normal;
    }
    for (const SingularJunction& j : result.junctions) result.non_meshable_junctions += !j.meshable;
}

}  // namespace octafield::volume
