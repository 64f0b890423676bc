// A direction field in plane coordinates of each triangle: what tracing curves needs of it.
#pragma once

#include <array>

#include "charts.hpp"
#include "octafield/surface/direction_field.hpp"

namespace octafield::surface::detail {

class ChartedField : public Charts {
public:
    ChartedField(const DirectionField& field, const std::vector<CornerLink>& links);

    int symmetry() const { return symmetry_; }

    // F, linear; directions are the N-th roots of it.
    Complex value(Index t, Complex z) const {
        return linear_[t].constant + z.real() * linear_[t].by_x + z.imag() * linear_[t].by_y;
    }
    // Change of F along z.
    Complex slope(Index t, Complex z) const { return z.real() * linear_[t].by_x + z.imag() * linear_[t].by_y; }
    // The one of the N unit directions at z that is nearest to `heading`; that itself where F = 0.
    Complex direction(Index t, Complex z, Complex heading) const;

private:
    struct Linear {
        Complex constant, by_x, by_y;
    };

    int symmetry_;
    std::vector<Linear> linear_;  // F in each triangle
};

}  // namespace octafield::surface::detail
