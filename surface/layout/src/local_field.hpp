// f = exp(H + i theta) of an imposed field in each triangle, and the curves along it.
#pragma once

#include "charts.hpp"
#include "octafield/surface/imposed_field.hpp"

namespace octafield::surface::detail {

class LocalField {
public:
    explicit LocalField(const ImposedField& field);

    const Charts& charts() const { return charts_; }
    const SurfaceDomain& domain() const { return charts_.domain(); }
    double log_size(Index t, Complex z) const { return at_[t].log_size + (at_[t].slope * (z - at_[t].centre)).real(); }
    // Of one of the four directions in the triangle's chart, always the same one.
    double angle(Index t, Complex z) const { return at_[t].angle + (at_[t].slope * (z - at_[t].centre)).imag(); }

    // A curve in triangle t at z, along that direction turned by `turn`.
    struct Place {
        Index t;
        Complex z;
        double turn;
    };
    Complex velocity(const Place& at) const {
        return std::polar(std::exp(log_size(at.t, at.z)), angle(at.t, at.z) + at.turn);
    }
    // Where it leaves the triangle that it entered by side `entry` (-1: it starts inside).
    struct Exit {
        int side;
        double fraction;  // of the side, strictly between 0 and 1
        double length;    // in parameters
    };
    Exit exit(const Place& from, int entry) const;
    // From a place on side `entry`: along it to its end, and out by the next side.
    Exit along_side(const Place& from, int entry) const;
    // Parameters of z against those of `from`, whose curve runs along the real axis.
    Complex parameters(const Place& from, Complex z) const;
    // In the triangle across the side, at `fraction` of it: the turn nearest to the heading that is `shear` more than
    // quarter turns.
    Place across(Charts::Side from, double fraction, double heading, double shear) const;
    double heading(const Place& at) const { return angle(at.t, at.z) + at.turn; }

private:
    struct Linear {
        Complex centre, slope;  // d log f / dz
        double log_size, angle;
    };
    Complex point(const Place& from, Complex way) const;  // way: velocity times length
    // Through a side, if that is before another one is met.
    double first_exit(const Place& from, int side, bool entered, double before) const;

    Charts charts_;
    std::vector<Linear> at_;
};

}  // namespace octafield::surface::detail
