// A separatrix that race after race follows: it is traced once, as far as any of them has gone.
#pragma once

#include <map>

#include "separatrix_tracer.hpp"

namespace octafield::surface::detail {

class KnownWalk {
public:
    KnownWalk(const SeparatrixTracer& tracer, const Slot& slot);

    const LayoutCurve& curve() const { return walk_.trace.curve; }
    double tolerance() const { return walk_.tolerance; }
    Index triangle_count() const { return static_cast<Index>(curve().triangles.size()); }
    // Up to the end of that many triangles, at least 1 and at most as many as there are.
    double length(Index triangles) const { return curve().points[triangles].length; }
    bool at_boundary(Index triangles) const { return walk_.trace.boundary && triangles == triangle_count(); }
    std::vector<Passing> passing(Index triangles) const;  // by slot
    // A triangle more than that many; false at the boundary.
    bool goes_on(Index triangles);

private:
    struct Found {
        Index triangles;
        std::vector<PassedPoints::Nearest> points;
    };
    const SeparatrixTracer& tracer_;
    SeparatrixTracer::Walk walk_;
    std::vector<Found> found_;  // what is found from that many triangles on, until the next one
};

using KnownWalks = std::map<Slot, KnownWalk>;

}  // namespace octafield::surface::detail
