#include "octafield/surface/streamlines.hpp"

#include <cmath>
#include <string>

#include "octafield/error.hpp"
#include "separatrix_starts.hpp"
#include "streamline_tools.hpp"

namespace octafield::surface {
namespace {

using detail::Complex;
using detail::Place;
using detail::TracedCurve;

std::vector<Place> seed_places(const detail::ChartedField& field, const std::vector<StreamlineSeed>& seeds) {
    const Eigen::Index count = field.mesh().triangles.rows();
    std::vector<Place> places;
    std::vector<Index> bad;
    for (std::size_t i = 0; i < seeds.size(); ++i) {
        const StreamlineSeed& seed = seeds[i];
        const bool usable = seed.triangle >= 0 && seed.triangle < count && seed.weights.minCoeff() >= 0 &&
                            std::abs(seed.weights.sum() - 1) < 1e-6;
        const Complex along = usable ? field.lower_vector(seed.triangle, seed.direction.stableNormalized()) : 0;
        if (!(std::abs(along) > 1e-9)) {
            bad.push_back(static_cast<Index>(i));
            continue;
        }
        const auto& corners = field.corners(seed.triangle);
        // A little towards the middle: seeds at vertices and on edges start inside.
        const Eigen::Vector3d weights = (1 - 1e-6) * seed.weights + Eigen::Vector3d::Constant(1e-6 / 3);
        const Complex at = weights[1] * corners[1] + weights[2] * corners[2];
        places.push_back({seed.triangle, at, field.direction(seed.triangle, at, along / std::abs(along))});
    }
    if (!bad.empty())
        throw InvalidInput(std::to_string(bad.size()) + " seeds (" + first_few(bad) +
                               ") are outside the mesh, which has " + std::to_string(count) +
                               " triangles, or have no direction in their triangle's plane",
                           "bad_seed", bad);
    return places;
}

// Index of the singular point's vertex among the fans; -1 where several parts of the surface touch.
const VertexFans::Fan* only_fan(const VertexFans& fans, Index vertex) {
    const auto found = std::lower_bound(fans.fans.begin(), fans.fans.end(), vertex,
                                        [](const auto& fan, Index v) { return fan.vertex < v; });
    if (found == fans.fans.end() || found->vertex != vertex) return nullptr;
    if (found + 1 != fans.fans.end() && (found + 1)->vertex == vertex) return nullptr;
    return &*found;
}

void prepend(TracedCurve& curve, const detail::SeparatrixStart& start) {
    for (std::size_t i = 0; i + 1 < start.points.size(); ++i)
        curve.length += (start.points[i + 1] - start.points[i]).norm();
    curve.points.insert(curve.points.begin(), start.points.begin(), start.points.end() - 1);
    curve.triangles.insert(curve.triangles.begin(), start.triangles.begin(), start.triangles.end());
}

// No longer than `most`.
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

std::vector<Streamline> streamlines(const DirectionField& field, const SurfaceSingularities& singularities,
                                    const std::vector<StreamlineSeed>& seeds, const StreamlineOptions& options) {
    const detail::TwoWayTracer tracer(field, singularities, options);
    std::vector<Streamline> lines;
    for (const Place& place : seed_places(tracer.field(), seeds)) lines.push_back(tracer.trace(place));
    return lines;
}

std::vector<Streamline> separatrices(const DirectionField& field, const SurfaceSingularities& singularities,
                                     const StreamlineOptions& options, const Progress& progress) {
    StreamlineOptions one_way = options;
    one_way.both_ways = false;
    const detail::TwoWayTracer tracer(field, singularities, one_way);
    const auto links = detail::corner_links(field.domain, field.symmetry);
    const Eigen::VectorXcd unit_values = detail::unit_values(field.values);
    std::vector<Streamline> lines;
    for (std::size_t i = 0; i < singularities.points.size(); ++i) {
        const SurfaceSingularity& point = singularities.points[i];
        report_or_throw(progress, "separatrices", static_cast<double>(i) / singularities.points.size(), NAN);
        std::vector<detail::SeparatrixStart> starts;
        if (point.vertex < 0) {
            starts = detail::starts_in_triangle(tracer.field(), point, tracer.forward());
        } else if (const auto* fan = only_fan(field.domain.fans(), point.vertex)) {
            starts = detail::starts_at_vertex(tracer.field(), links, unit_values, *fan, tracer.forward());
        }
        for (const auto& start : starts) {
            TracedCurve curve = tracer.forward().trace(start.place, static_cast<Index>(i));
            prepend(curve, start);
            cut(curve, tracer.forward().max_length());
            Streamline line = detail::joined({}, curve);
            line.first_end = StreamlineEnd::singularity;
            line.first_singularity = static_cast<Index>(i);
            lines.push_back(std::move(line));
        }
    }
    return lines;
}

}  // namespace octafield::surface
