// One separatrix at a time, and what it passes.
#pragma once

#include <algorithm>
#include <optional>

#include "octafield/surface/layout_curves.hpp"
#include "passed_points.hpp"

namespace octafield::surface::detail {

struct Trace {
    LayoutCurve curve;
    std::vector<Passing> passing;  // by slot
    bool arrived = false;          // at the target
    bool boundary = false;
};

class SeparatrixTracer {
public:
    // A separatrix under way: its trace so far, which ends on a side of the last triangle.
    struct Walk;

    SeparatrixTracer(const LocalField& local, const LayoutPoints& points, double tolerance, double max_length);

    // The straight line in parameters at angle `shear` from the separatrix, until it meets the boundary, is too long,
    // or comes to the triangles at the target's point, by its sector, at more than half the target's length.
    Trace trace(const Slot& start, double shear = 0, const std::optional<Passing>& target = {}) const;
    // The separatrix itself, up to the first side after `reach`. What it passes before is told as by the whole.
    Trace beginning(const Slot& start, double reach) const;
    // The same step by step: as far as the first triangle goes, then one triangle more each time; false, and nothing
    // done, at the boundary. `looking`: for points that are passed.
    Walk begin(const Slot& start, double shear = 0) const;
    bool step(Walk& walk, bool looking = true, const std::optional<Passing>& target = {}) const;
    // The line from one point to the other; none if it goes another way.
    std::optional<LayoutCurve> joined(const Slot& start, Passing target) const;

    // In parameters, of the separatrices of a point.
    double tolerance(const Slot& start) const {
        return std::min(tolerance_, points_.points[start.point].most_tolerance);
    }

private:
    Trace trace_to(const Slot& start, double shear, const std::optional<Passing>& target, double longest) const;
    const LayoutPoint& point(const Slot& slot) const { return points_.points[slot.point]; }
    LocalField::Exit kept_inside(const LocalField::Place& at, const LocalField::Exit& exit, double length) const;
    bool arrives(const Passing& target, const LocalField::Place& at, int entry, double length) const;

    static bool comes_by(const Passing& target, const Walk& walk, double step);

    const LocalField& local_;
    const LayoutPoints& points_;
    PassedPoints near_;
    double tolerance_, max_length_;
};

struct SeparatrixTracer::Walk {
    Trace trace;    // `passing` is not filled in
    double length;  // up to the end of the last triangle
    double shear, tolerance;
    Charts::Side side;  // that it ends on
    double fraction, heading;
    std::vector<PassedPoints::Nearest> found;
};

std::vector<Passing> by_slot(const std::vector<PassedPoints::Nearest>& found);

// Takes out what leaves a triangle by the side it came in by, and runs along a side of its first or last triangle.
void tighten(LayoutCurve& curve, const Charts& charts);

}  // namespace octafield::surface::detail
