// What the ways to seed streamlines have in common: checks, and tracing both ways from a place.
#pragma once

#include <optional>
#include <string>

#include "direction_tracer.hpp"
#include "octafield/error.hpp"
#include "separatrix_starts.hpp"

namespace octafield::surface::detail {

// One polyline of two curves from the same place, `back` against the direction.
Streamline joined(const TracedCurve& back, const TracedCurve& ahead);

// The straight way from singular point number `point` with the curve that begins at its end, no longer than `most`.
Streamline separatrix(const SeparatrixStart& start, TracedCurve curve, double most, Index point);

// From a place ahead and, if `back_too`, against the heading with the other tracer; one curve where it closes.
template <TracedField Field>
Streamline both_ways(const FieldTracer<Field>& forward, const FieldTracer<Field>& backward, const Place& place,
                     bool back_too, const Admit& ahead = {}, const Admit& back = {}) {
    const TracedCurve curve = forward.trace(place, -1, ahead);
    if (curve.end == StreamlineEnd::closed || !back_too) {
        Streamline line = joined({}, curve);
        if (curve.end == StreamlineEnd::closed) line.first_end = StreamlineEnd::closed;
        return line;
    }
    return joined(backward.trace({place.triangle, place.at, -place.heading}, -1, back), curve);
}

// Throws InvalidInput where singular points are not on the mesh (kind "wrong_mesh") and for options that are no
// lengths.
void check_tracing(const TriangleMesh& mesh, const SurfaceSingularities& singularities,
                   const StreamlineOptions& options);

// Throws InvalidInput (kind "bad_seed", elements: places of the seeds).
template <TracedField Field>
std::vector<Place> seed_places(const Field& field, const std::vector<StreamlineSeed>& seeds) {
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

class TwoWayTracer {
public:
    // Throws InvalidInput where values or singular points do not fit the mesh, and for options that are no lengths.
    TwoWayTracer(const DirectionField& field, const SurfaceSingularities& singularities,
                 const StreamlineOptions& options);

    const ChartedField& field() const { return field_; }
    const DirectionTracer& forward() const { return forward_; }
    Streamline trace(const Place& place, const Admit& ahead = {}, const Admit& back = {}) const;

private:
    bool both_ways_;
    ChartedField field_;
    DirectionTracer forward_;
    // With odd N the opposite of a direction is none of the N: the field turned by half a turn.
    std::optional<ChartedField> opposite_field_;
    std::optional<DirectionTracer> backward_;
};

}  // namespace octafield::surface::detail
