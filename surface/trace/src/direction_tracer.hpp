// Traces the directions of a DirectionField.
#pragma once

#include "charted_field.hpp"
#include "field_tracer.hpp"

namespace octafield::surface::detail {

using DirectionTracer = FieldTracer<ChartedField>;
extern template class FieldTracer<ChartedField>;

}  // namespace octafield::surface::detail
