// A triangle surface cut by curves into polygons. What crosses what follows from the order of the curves' points round
// each triangle alone, so the result is a valid subdivision whatever the rounding; a curve crosses another one at most
// once per triangle.
#pragma once

#include <functional>

#include "charts.hpp"
#include "octafield/surface/layout_curves.hpp"

namespace octafield::surface::detail {

// A place along a curve.
struct CurveNode {
    Index node;
    double length;  // from the curve's start
};

struct CutSurface {
    // Nodes: the vertices of the surface, then where curves cross edges, then where they cross one another.
    Points positions;
    std::vector<bool> is_crossing;               // (nodes)
    std::vector<std::vector<CurveNode>> curves;  // all nodes along each curve
    std::vector<std::vector<Index>> edge_nodes;  // (E) from lower to higher vertex

    // Polygons, convex, each in one triangle. Corner c of polygon p: first[p] <= c < first[p + 1], counter-clockwise;
    // side c runs to the next corner.
    std::vector<Index> triangles;  // of each polygon
    std::vector<Index> first;
    std::vector<Index> nodes;   // of each corner
    std::vector<Index> mates;   // side of the polygon across; -1: boundary
    std::vector<bool> is_cut;   // of each side: along a curve or the boundary
    std::vector<Index> points;  // of each corner: what is one point of the surface cut open
    Index point_count = 0;
    std::vector<Index> patches;  // of each polygon, by its lowest
    Index patch_count = 0;

    Index polygon_count() const { return static_cast<Index>(first.size()) - 1; }
    Index next(Index polygon, Index c) const { return c + 1 == first[polygon + 1] ? first[polygon] : c + 1; }
};

// Of each curve, the place in CutSurface::curves of the last node that it cuts to: a crossing with a curve that goes on
// there, or its end.
using CurveEnds = std::function<std::vector<std::size_t>(const CutSurface&)>;

// The curves' points on edges are moved off the vertices, by 1e-4 of the edge at most, all in the same way. With `ends`
// what is behind them is not cut.
CutSurface cut_surface(const Charts& charts, const std::vector<LayoutCurve>& curves, const CurveEnds& ends = {});

}  // namespace octafield::surface::detail
