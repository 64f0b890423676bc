// A non-orthogonal field in plane coordinates of each triangle: what tracing curves needs of it.
#pragma once

#include <array>

#include "charts.hpp"
#include "field_tracer.hpp"
#include "octafield/surface/non_orthogonal_field.hpp"
#include "vertex_charts.hpp"

namespace octafield::surface::detail {

// Between vertices the power sums are linear. In the plane they are continuous from triangle to triangle; on a curved
// surface they jump a little at edges.
class ChartedLines : public Charts {
public:
    ChartedLines(const NonOrthogonalField& field, const VertexCharts& vertices);

    int symmetry() const { return 4; }  // two lines, both ways
    PowerSums sums(Index t, Complex z) const;
    // Of the four unit directions at z the one nearest to `heading`; that itself where there are no lines.
    Complex direction(Index t, Complex z, Complex heading) const;
    // Where (u - v)^2 = 2 p2 - p1^2, linear between its values at the corners, is zero; the middle where that is
    // outside.
    Complex singular_place(Index t) const;

private:
    std::vector<std::array<PowerSums, 3>> corner_sums_;  // of each triangle, in its chart
};

static_assert(TracedField<ChartedLines>);

// Throws InvalidInput (kinds "wrong_size", "not_finite" and "bad_quads" with the vertices) where the field does not fit
// its domain.
void require_fit(const NonOrthogonalField& field);

using LinesTracer = FieldTracer<ChartedLines>;
extern template class FieldTracer<ChartedLines>;

}  // namespace octafield::surface::detail
