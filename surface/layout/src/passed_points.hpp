// The points that a curve passes, seen from triangle after triangle.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "layout_points.hpp"

namespace octafield::surface::detail {

struct Slot {
    Index point;
    int slot;
    auto operator<=>(const Slot&) const = default;
};

// A separatrix that comes back along the traced one.
struct Passing {
    Slot slot;
    double length;  // from the start to the point, in parameters
    double offset;  // of the point, to the left
    bool operator==(const Passing&) const = default;
};

constexpr double sector_part = 0.35;  // of the angle between separatrices: off their own direction

inline double wrapped(double angle, double period = 2 * std::numbers::pi) {
    return angle - period * std::round(angle / period);
}

// Length in parameters from the point to `end`, `radius` away in triangle t.
double spoke_length(const LocalField& local, const LayoutPoint& point, Index t, Complex end, double radius);

// Angle at the point, from its first edge, of z in triangle t, whose corner k it is.
double angle_at(const LocalField& local, const LayoutPoint& point, Index t, int k, Complex z);

// Unfolds the triangles within a tolerance of a curve. What that takes is kept for all triangles within three
// tolerances of a point, about 400 bytes each; others cost nothing. Not for several threads at once.
class PassedPoints {
public:
    struct Nearest {
        Passing passing;
        double behind;  // angle, in parameters, between the way back and where it was looked at from
        double from;    // how far along the curve
        bool operator==(const Nearest&) const = default;
    };

    PassedPoints(const LocalField& local, const LayoutPoints& points, double tolerance);

    // Of a curve, `shear` more than quarter turns off the field. The tolerance is at most that of this.
    struct Part {
        double shear, tolerance, from, to;
    };
    // Adds the points within the tolerance of a part that begins at `start`.
    void look_round(const LocalField::Place& start, const Part& part, std::vector<Nearest>& found) const;

private:
    // A way on through a side, unless a point is at an end of it.
    struct Way {
        Index to = -1;                // place in entered_, -1: none near points
        int quarters = 0;             // turns of the direction in the chart beyond
        Complex from, until, middle;  // parameters of the side
    };
    // A near triangle entered at the middle of a side, along the direction of the field that the chart tells: three of
    // each, by side, as searches spend nearly all their time here.
    struct Entered {
        std::array<Way, 2> ways;  // by the other sides
        bool at_point;            // it has a corner there
    };
    struct Unfolded {
        Index entered;
        int quarters;
        Complex offset;  // parameters where it is entered
    };

    void find_near();
    Way way_through(Index t, int side, const LocalField::Place& from) const;
    Entered entered(Index t, int entry) const;
    void look_at(const LocalField::Place& at, Complex offset, const Part& part, std::vector<Nearest>& found) const;
    void look_at_corner(const LocalField::Place& at, Complex offset, int k, const Part& part,
                        std::vector<Nearest>& found) const;

    const LocalField& local_;
    const LayoutPoints& points_;
    double tolerance_;
    std::vector<Index> near_of_;       // (F) place, -1: no point may be within the tolerance
    std::vector<Index> near_;          // triangles
    std::vector<Entered> entered_;     // three of each
    mutable std::vector<Index> seen_;  // round of each near triangle
    mutable Index round_ = 0;
    mutable std::vector<Unfolded> front_;
};

}  // namespace octafield::surface::detail
