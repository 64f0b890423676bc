#include "field_tracer.hpp"

#include "charted_field.hpp"

namespace octafield::surface::detail {

template class FieldTracer<ChartedField>;

}  // namespace octafield::surface::detail
