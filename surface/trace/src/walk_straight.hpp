// Straight ways across triangles.
#pragma once

#include <vector>

#include "field_tracer.hpp"

namespace octafield::surface::detail {

// From `place` straight ahead for `length`, less where a feature or the boundary is in the way. Moves the place, and
// adds the end of each segment and its triangle.
template <TracedField Field>
void walk_straight(const Field& field, const FieldTracer<Field>& tracer, double length, Place& place,
                   std::vector<Eigen::Vector3d>& points, std::vector<Index>& triangles) {
    constexpr int most_walked = 200;  // triangles
    int entry = -1;
    const auto go = [&](Complex to) {
        place.at = to;
        points.push_back(field.lift(place.triangle, to));
        triangles.push_back(place.triangle);
    };
    for (int steps = 0; steps < most_walked; ++steps) {
        const Charts::Exit out = field.exit(place.triangle, place.at, place.heading, entry);
        if (out.side < 0) return;
        if (out.distance > length) return go(place.at + length * place.heading);
        const Charts::Side here{place.triangle, out.side}, there = field.across(here);
        if (there.triangle < 0 || tracer.is_feature(field.topology().triangle_edges(place.triangle, out.side)))
            return go(place.at + out.distance / 2 * place.heading);
        go(place.at + out.distance * place.heading);
        length -= out.distance;
        const Complex along = field.side(here.triangle, here.side);
        const double fraction = dot(along, place.at - field.corners(here.triangle)[here.side]) / std::norm(along);
        place = {there.triangle, field.on_side(there.triangle, there.side, 1 - fraction),
                 field.carried(place.heading, here, there)};
        entry = there.side;
    }
}

}  // namespace octafield::surface::detail
