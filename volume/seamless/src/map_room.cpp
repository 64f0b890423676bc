#include "map_room.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "axis_numbers.hpp"
#include "map_transitions.hpp"
#include "octafield/frames/octahedral_group.hpp"
#include "octafield/volume/locking.hpp"
#include "octafield/volume/triangle_table.hpp"
#include "surface_wedges.hpp"
#include "tet_splitter.hpp"

namespace octafield::volume::detail {
namespace {

using splitting::Key;

int axis_of_normal(const MatchedField& field, Index tet, const Eigen::Vector3d& normal) {
    return nearest_axis_number(frames::from_wxyz(field.frames.row(tet)).conjugate() * normal);
}

Eigen::Vector3d normal_of(const TetMesh& mesh, Index a, Index b, Index c) {
    const Eigen::Vector3d p = mesh.vertices.row(a), q = mesh.vertices.row(b), r = mesh.vertices.row(c);
    return (q - p).cross(r - p);
}

// Number of the axis of the wedge's first tet in its last one.
int carried(const MatchedField& field, const TriangleRows& row_of, const Wedge& wedge, int axis) {
    const TriangleTable& table = field.domain.triangles();
    for (std::size_t i = 1; i < wedge.tets.size(); ++i) {
        const Index row = row_of({wedge.a, wedge.b, wedge.link[i]});
        const int m = field.matching[row];
        axis = turned_axis(table.sides(row, 0) / 4 == wedge.tets[i - 1] ? frames::octahedral_inverse(m) : m, axis);
    }
    return axis;
}

std::vector<Key<2>> surface_edges(const TetDomain& domain) {
    const BoundarySurface& surface = domain.surface();
    std::vector<Key<2>> edges;
    for (const auto t : surface.mesh.triangles.rowwise())
        for (int k = 0; k < 3; ++k) {
            const auto [a, b] = std::minmax(surface.vertex_map[t[k]], surface.vertex_map[t[(k + 1) % 3]]);
            edges.push_back({a, b});
        }
    splitting::sort_unique(edges);
    return edges;
}

std::vector<Key<2>> keys_of(const Edges& edges) {
    std::vector<Key<2>> keys;
    for (const auto e : edges.rowwise()) keys.push_back({std::min(e[0], e[1]), std::max(e[0], e[1])});
    return keys;
}

MatchedField split_at_straight_edges(const MatchedField& field) {
    const TetMesh& mesh = field.domain.mesh();
    const std::vector<Key<2>> straight = keys_of(straight_edges(field));
    std::vector<std::uint8_t> on_one(mesh.vertices.rows(), 0);
    for (const Key<2>& key : straight) on_one[key[0]] = on_one[key[1]] = 1;
    std::vector<Key<2>> joining;
    for (const auto& tet : splitting::list_of(mesh.tets))
        for (const auto& corners : splitting::edge_corners)
            if (const Key<2> key = splitting::key_of(tet, corners);
                on_one[key[0]] && on_one[key[1]] && !splitting::contains(straight, key))
                joining.push_back(key);
    splitting::sort_unique(joining);
    splitting::Splitter splitter(mesh, splitting::surface_of(field.domain));
    splitter.split(joining, splitting::edge_corners);
    std::vector<Key<3>> between;
    for (const auto& tet : splitter.tets())
        for (const auto& corners : splitting::triangle_corners) {
            const Key<3> t = splitting::key_of(tet, corners);
            if (splitting::contains(straight, {t[0], t[1]}) && splitting::contains(straight, {t[1], t[2]}) &&
                splitting::contains(straight, {t[0], t[2]}))
                between.push_back(t);
        }
    splitting::sort_unique(between);
    splitter.split(between, splitting::triangle_corners);
    return of_parts(field, with_features_of(field.domain, splitter.mesh()), splitter.parent());
}

// Six tets round each edge of a curve, not three: five quarters in three tets are 150 degrees each.
MatchedField split_round_curves(const MatchedField& field) {
    const TetMesh& mesh = field.domain.mesh();
    std::vector<Key<2>> curves = keys_of(field.curves), held = keys_of(straight_edges(field)), opposite;
    splitting::sort_unique(curves);
    splitting::sort_unique(held);
    for (const auto& tet : splitting::list_of(mesh.tets))
        for (std::size_t k = 0; k < 6; ++k)
            if (splitting::contains(curves, splitting::key_of(tet, splitting::edge_corners[k])))
                if (const Key<2> key = splitting::key_of(tet, splitting::edge_corners[5 - k]);
                    !splitting::contains(held, key))
                    opposite.push_back(key);
    splitting::sort_unique(opposite);
    splitting::Splitter splitter(mesh, splitting::surface_of(field.domain));
    splitter.split(opposite, splitting::edge_corners);
    return of_parts(field, with_features_of(field.domain, splitter.mesh()), splitter.parent());
}

}  // namespace

std::vector<std::uint8_t> normal_axes(const MatchedField& field) {
    const BoundarySurface& surface = field.domain.surface();
    std::vector<std::uint8_t> result;
    for (Index f = 0; f < surface.mesh.triangles.rows(); ++f) {
        std::array<Index, 3> v;
        for (int k = 0; k < 3; ++k) v[k] = surface.vertex_map[surface.mesh.triangles(f, k)];
        const Eigen::Vector3d normal = normal_of(field.domain.mesh(), v[0], v[1], v[2]);
        result.push_back(static_cast<std::uint8_t>(axis_of_normal(field, field.domain.sides()(f, 0), normal) % 3));
    }
    return result;
}

Edges straight_edges(const MatchedField& field) {
    std::vector<Key<2>> found = keys_of(field.curves);
    const TetMesh& mesh = field.domain.mesh();
    const std::vector<Index>& map = field.domain.surface().vertex_map;
    for (const auto e : field.domain.features().edges.rowwise()) {
        const auto [a, b] = std::minmax(map[e[0]], map[e[1]]);
        found.push_back({a, b});
    }
    std::vector<std::pair<Index, Index>> edges;
    for (const Key<2>& key : surface_edges(field.domain)) edges.emplace_back(key[0], key[1]);
    const TriangleRows row_of(field.domain.triangles());
    for (const Wedge& w : surface_wedges(field.domain, edges, 1)) {
        const int first = axis_of_normal(field, w.tets.front(), normal_of(mesh, w.a, w.b, w.link.front()));
        const int last = axis_of_normal(field, w.tets.back(), normal_of(mesh, w.a, w.b, w.link.back()));
        if (carried(field, row_of, w, first) % 3 != last % 3) found.push_back({w.a, w.b});
    }
    splitting::sort_unique(found);
    return splitting::rows_of(found);
}

MatchedField make_room(const MatchedField& field) {
    const MatchedField apart = split_at_straight_edges(split_round_curves(field));
    LockingSplit split = split_locking(apart.domain);
    return of_parts(apart, with_features_of(apart.domain, std::move(split.mesh)), split.parent);
}

MatchedField split_round(const MatchedField& field, const std::vector<Index>& tets) {
    const TetMesh& mesh = field.domain.mesh();
    std::vector<Key<2>> held = keys_of(straight_edges(field)), split;
    splitting::sort_unique(held);
    const auto list = splitting::list_of(mesh.tets);
    for (const Index t : tets)
        for (const auto& corners : splitting::edge_corners)
            if (const Key<2> key = splitting::key_of(list[t], corners); !splitting::contains(held, key))
                split.push_back(key);
    splitting::sort_unique(split);
    splitting::Splitter splitter(mesh, splitting::surface_of(field.domain));
    splitter.split(split, splitting::edge_corners);
    return of_parts(field, with_features_of(field.domain, splitter.mesh()), splitter.parent());
}

}  // namespace octafield::volume::detail
