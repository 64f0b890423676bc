// The triangles round a point, unfolded into one plane.
#pragma once

#include <functional>
#include <vector>

#include "charted_field.hpp"

namespace octafield::surface::detail {

struct PatchValue {
    Complex at;     // edge midpoint, in the chart of the triangle in the middle
    Complex f;      // the field's unit value there, in the same chart
    double weight;  // a third of the triangle's area
};

// At edge midpoints between the two radii round `centre`, which lies in triangle t. The boundary and edges for which
// `is_barrier` holds are not crossed. Midpoints appear once for each of their triangles. If there are none, those of
// triangle t.
std::vector<PatchValue> values_round(const ChartedField& field, const std::function<bool(Index)>& is_barrier, Index t,
                                     Complex centre, double inner, double outer);

}  // namespace octafield::surface::detail
