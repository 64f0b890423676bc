// What the ways to seed streamlines have in common: checks, and tracing both ways from a place.
#pragma once

#include <optional>

#include "direction_tracer.hpp"

namespace octafield::surface::detail {

// One polyline of two curves from the same place, `back` against the direction.
Streamline joined(const TracedCurve& back, const TracedCurve& ahead);

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
