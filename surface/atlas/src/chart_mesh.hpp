// Some triangles of a surface cut open along edges: corners that are joined by uncut edges are one vertex of the chart.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "octafield/surface/surface_domain.hpp"

namespace octafield::surface::detail {

// A side of a triangle of the chart: from corner k to corner k + 1.
struct ChartSide {
    Index triangle;
    int corner;
};

struct ChartMesh {
    std::vector<Index> parents;             // of each triangle, that of the surface
    Triangles triangles{0, 3};              // chart vertices
    Triangles neighbours{0, 3};             // chart triangle across the side from corner k to k + 1; -1: boundary
    Rows<double, 3> lengths{0, 3};          // of that side
    Rows<double, 3> half_tangents{0, 3};    // tan of half the angle at corner k
    std::vector<Index> origins;             // of each vertex, that of the surface
    std::vector<std::vector<Index>> loops;  // boundary, surface on the left, the longest first
    int components = 0;

    Index triangle_count() const { return static_cast<Index>(triangles.rows()); }
    Index vertex_count() const { return static_cast<Index>(origins.size()); }
    // Of all components together, if there is one: handles. Loops count as if they were filled.
    int genus() const;
    double area() const;
    double twice_area(Index t) const;
};

// parents: ascending. Edges between two of them are open unless is_cut(edge).
ChartMesh chart_mesh(const SurfaceDomain& domain, const std::vector<Index>& parents,
                     const std::function<bool(Index)>& is_cut);

}  // namespace octafield::surface::detail
