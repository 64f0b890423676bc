// All separatrices at once: the tracks of a motorcycle graph (Eppstein, Goodrich, Kim, Tamstorf, "Motorcycle graphs:
// canonical quad mesh partitioning", 2008), on the exact curves of the field.
#pragma once

#include "known_walk.hpp"
#include "layout_input.hpp"

namespace octafield::surface::detail {

struct Track {
    Slot slot;
    LayoutCurve curve;             // to the end of the triangle that it stops in
    Index stopped_by = -1;         // wall, or number of walls plus track; -1: ends at the boundary
    double stopped_at = 0;         // length along that one, from its start
    bool from_left = false;        // on which side of it this one comes
    double length = 0;             // until it stops, in parameters
    bool ended = false;            // otherwise it is longer than allowed
    std::vector<Passing> passing;  // points passed before, by slot
};

// One track from each slot, all at unit speed in parameters. One that crosses a track, as told by the order of their
// points round a triangle, stops if the other one was there before it, or at the same time and comes before it in
// `slots`. Walls are there from the start. known: of races before by the same tracer, and of this one afterwards.
std::vector<Track> race(const LocalField& local, const SeparatrixTracer& tracer, const std::vector<LayoutCurve>& walls,
                        const std::vector<Slot>& slots, double max_length, KnownWalks& known);

}  // namespace octafield::surface::detail
