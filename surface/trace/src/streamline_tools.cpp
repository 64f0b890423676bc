#include "streamline_tools.hpp"

#include <algorithm>
#include <string>

#include "octafield/error.hpp"

namespace octafield::surface::detail {
namespace {

void check(const DirectionField& field, const SurfaceSingularities& singularities, const StreamlineOptions& options) {
    if (field.values.size() != field.domain.edge_count())
        throw InvalidInput("the direction field has " + std::to_string(field.values.size()) +
                               " values; give one per edge, " + std::to_string(field.domain.edge_count()),
                           "wrong_size");
    if (!field.values.allFinite()) throw InvalidInput("the direction field is not finite", "not_finite");
    check_tracing(field.domain.mesh(), singularities, options);
}

std::vector<CornerLink> checked_links(const DirectionField& field, const SurfaceSingularities& singularities,
                                      const StreamlineOptions& options) {
    check(field, singularities, options);
    return corner_links(field.domain, field.symmetry);
}

DirectionField half_turned(const DirectionField& field) {
    DirectionField result;
    result.symmetry = field.symmetry;
    result.domain = field.domain;
    result.values = -field.values;
    return result;
}

void prepend(TracedCurve& curve, const SeparatrixStart& start) {
    for (std::size_t i = 0; i + 1 < start.points.size(); ++i)
        curve.length += (start.points[i + 1] - start.points[i]).norm();
    curve.points.insert(curve.points.begin(), start.points.begin(), start.points.end() - 1);
    curve.triangles.insert(curve.triangles.begin(), start.triangles.begin(), start.triangles.end());
}

void cut(TracedCurve& curve, double most) {
    if (curve.length <= most) return;
    double length = 0;
    std::size_t last = 0;  // the point reached
    for (; last + 1 < curve.points.size(); ++last) {
        const Eigen::Vector3d along = curve.points[last + 1] - curve.points[last];
        if (length + along.norm() > most) {
            curve.points[last + 1] = curve.points[last] + (most - length) / along.norm() * along;
            break;
        }
        length += along.norm();
    }
    curve.points.resize(std::min(last + 2, curve.points.size()));
    curve.triangles.resize(curve.points.size() - 1);
    curve.length = most;
    curve.end = StreamlineEnd::length;
    curve.singularity = -1;
}

}  // namespace

void check_tracing(const TriangleMesh& mesh, const SurfaceSingularities& singularities,
                   const StreamlineOptions& options) {
    for (const SurfaceSingularity& point : singularities.points)
        if (point.triangle >= mesh.triangles.rows() || point.vertex >= mesh.vertices.rows() ||
            (point.triangle < 0 && point.vertex < 0))
            throw InvalidInput("a singular point lies in triangle " + std::to_string(point.triangle) + ", vertex " +
                                   std::to_string(point.vertex) + ", which the mesh does not have",
                               "wrong_mesh");
    for (const double length : {options.max_length, options.singular_radius})
        if (!(length >= 0) || !std::isfinite(length))
            throw InvalidInput("max_length and singular_radius must be lengths, or 0 for the default");
}

Streamline joined(const TracedCurve& back, const TracedCurve& ahead) {
    Streamline line;
    const std::size_t skipped = back.points.empty() ? 0 : back.points.size() - 1;  // the seed is in both
    line.points.resize(static_cast<Eigen::Index>(skipped + ahead.points.size()), 3);
    for (std::size_t i = 0; i < skipped; ++i) line.points.row(i) = back.points[skipped - i];
    for (std::size_t i = 0; i < ahead.points.size(); ++i) line.points.row(skipped + i) = ahead.points[i];
    line.triangles.assign(back.triangles.rbegin(), back.triangles.rend());
    line.triangles.insert(line.triangles.end(), ahead.triangles.begin(), ahead.triangles.end());
    line.length = back.length + ahead.length;
    line.last_end = ahead.end;
    line.last_singularity = ahead.singularity;
    if (!back.points.empty()) {
        line.first_end = back.end;
        line.first_singularity = back.singularity;
    }
    return line;
}

Streamline separatrix(const SeparatrixStart& start, TracedCurve curve, double most, Index point) {
    prepend(curve, start);
    cut(curve, most);
    Streamline line = joined({}, curve);
    line.first_end = StreamlineEnd::singularity;
    line.first_singularity = point;
    return line;
}

TwoWayTracer::TwoWayTracer(const DirectionField& field, const SurfaceSingularities& singularities,
                           const StreamlineOptions& options)
    : both_ways_(options.both_ways),
      field_(field, checked_links(field, singularities, options)),
      forward_(field_, singularities, options) {
    if (!both_ways_ || field.symmetry % 2 == 0) return;
    opposite_field_.emplace(half_turned(field), corner_links(field.domain, field.symmetry));
    backward_.emplace(*opposite_field_, singularities, options);
}

Streamline TwoWayTracer::trace(const Place& place, const Admit& ahead, const Admit& back) const {
    return both_ways(forward_, backward_ ? *backward_ : forward_, place, both_ways_, ahead, back);
}

}  // namespace octafield::surface::detail
