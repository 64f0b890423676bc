#include "octafield/surface/layout_curves.hpp"

#include <cmath>

#include "joiner.hpp"
#include "layout_input.hpp"

namespace octafield::surface {
namespace {

constexpr double first_reach = 1.5;  // of the root of the area in parameters

}  // namespace

LayoutCurves layout_curves(const ImposedField& given, const LayoutCurveOptions& options, const Progress& progress) {
    const detail::LayoutInput input(given, options);
    LayoutCurves result = input.no_curves();
    const detail::SeparatrixTracer tracer(input.local, input.points, result.end_tolerance, input.max_length);
    detail::Joiner joiner(tracer, input.points, input.max_length);
    const double unit = std::sqrt(input.parameter_area);
    for (double reach = first_reach * unit; joiner.trace(reach, progress); reach *= 4) joiner.join(reach);
    result.traced = joiner.count();
    detail::require_short(joiner.take_curves(result.curves), input.max_length);
    for (LayoutCurve& curve : result.curves) detail::tighten(curve, input.local.charts());
    return result;
}

}  // namespace octafield::surface
