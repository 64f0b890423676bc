// What curves of a layout are traced in.
#pragma once

#include "layout_points.hpp"
#include "octafield/surface/layout_curves.hpp"

namespace octafield::surface::detail {

struct LayoutInput {
    // Throws as layout_curves. general: the field may be rotated, and cut_vertices may be inside the surface, too, at
    // points of index 0; four curves start there.
    LayoutInput(const ImposedField& given, const LayoutCurveOptions& options, bool general = false);
    LayoutCurves no_curves() const;  // but all else

    ImposedField field;  // split between points
    LocalField local;
    LayoutPoints points;
    double parameter_area;
    double end_tolerance, max_length;
};

// Throws GeometryError (kind "long_separatrix") if there are vertices.
void require_short(const std::vector<Index>& vertices, double max_length);

}  // namespace octafield::surface::detail
