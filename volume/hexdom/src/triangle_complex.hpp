// Triangles that change, by lists of those at each vertex: edges of one, two, three triangles and more are all alike
// here.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "octafield/cell_arrays.hpp"

namespace octafield::volume::detail {

using Corners = std::array<Index, 3>;

inline Corners turned(const Corners& t, Index v) {  // the same triangle, v first
    return v == t[0] ? t : v == t[1] ? Corners{t[1], t[2], t[0]} : Corners{t[2], t[0], t[1]};
}

// An edge that stays an edge, or part of a longer one: of a feature, of a border of groups, where triangles end or
// meet.
struct CurveEdge {
    Index a, b;
    bool feature;
    std::vector<Eigen::Vector3d> beneath;  // unit directions, a to b, of the old edges it stands for
};

// Triangles that go, and those that take their place.
struct Change {
    std::vector<Index> gone;
    std::vector<Corners> made;
};

// What is left of one side of a vertex when it goes: triangles (vertex, ring[i], ring[i + 1]). A page round a free
// vertex is closed, its ring a cycle; those of a vertex on a curve reach from one curve edge to the other.
struct Page {
    std::vector<Index> ring, triangles;
};

class TriangleComplex {
public:
    using Vector = Eigen::Vector3d;

    Points at;                       // (V)
    std::vector<Corners> triangles;  // -1, -1, -1: none
    std::vector<Index> group;
    std::vector<std::vector<Index>> star;  // (V) the triangles at a vertex
    std::vector<CurveEdge> curve_edges;
    std::vector<std::vector<Index>> curves_at;  // (V) ids of curve edges

    explicit TriangleComplex(Points places) : at(std::move(places)), star(at.rows()), curves_at(at.rows()) {}

    // A triangle that lies on the old one of the unit normal given.
    void add(const Corners& t, Index group_of_it, Index old_triangle, const Vector& old_normal);
    void add_curve_edge(Index a, Index b, bool feature, const Vector& direction);

    Vector place(Index v) const { return at.row(v); }
    Vector middle(const Corners& t) const { return (place(t[0]) + place(t[1]) + place(t[2])) / 3; }
    double distance(Index a, Index b) const { return (at.row(a) - at.row(b)).norm(); }
    bool alive(Index t) const { return triangles[t][0] >= 0; }
    Index curve_edge(Index a, Index b) const;  // -1: none
    void triangles_at_edge(Index a, Index b, std::vector<Index>& found) const;
    bool has_edge(Index a, Index b) const;
    bool has_triangle(Index a, Index b, Index c) const;
    double quality(const Corners& t) const;  // 1 for an equilateral one, 0 for a flat one
    double worst_quality(const std::vector<Index>& some) const;
    Index across(Index a, Index b, Index triangle) const;  // the other triangle at an edge of two; -1 else
    // Empty where the vertex is neither inside a disc nor on one curve that runs through.
    std::vector<Page> pages(Index v) const;

    // Whether each triangle made turns by less than the angle of this cosine from the old triangles beneath.
    bool lies_on_surface(const Change& change, double least_cosine) const;
    void apply(const Change& change);
    // The curve edges at v joined to one, between its two neighbours on the curve.
    CurveEdge joined_curve(Index v) const;
    void join_curve(Index v);

    Index nearest_old_triangle(Index t) const;  // of its group

private:
    struct Sample {  // the middle of a piece of an old triangle: which new triangle lies over it
        Vector place, normal;
        Index old_triangle;
        Index next;  // sample of the same triangle, or -1
    };
    Vector scaled_normal(const Corners& t) const;
    std::vector<Index> samples_of(const std::vector<Index>& some) const;
    std::vector<Index> references_of(const std::vector<Index>& some) const;
    std::vector<int> owners(const std::vector<Index>& samples, const std::vector<Corners>& made) const;
    Index nearest_sample(const std::vector<Index>& samples, const Vector& place) const;
    void remove(Index t);
    void put(Index t, const Corners& corners);

    std::vector<Sample> samples_;
    std::vector<Index> first_sample_;  // (F)
    std::vector<Index> reference_;     // (F) for a triangle so small that no sample lies beneath: one that is near
};

}  // namespace octafield::volume::detail
