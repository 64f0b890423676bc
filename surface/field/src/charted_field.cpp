#include "charted_field.hpp"

#include <cmath>
#include <numbers>

namespace octafield::surface::detail {

ChartedField::ChartedField(const DirectionField& field, const std::vector<CornerLink>& links)
    : Charts(field.domain), symmetry_(field.symmetry), linear_(mesh().triangles.rows()) {
    // Directions do not depend on the size of f: scaled, its derivatives stay numbers.
    const double largest = field.values.size() > 0 ? field.values.cwiseAbs().maxCoeff() : 0;
    const Eigen::VectorXcd scaled = largest > 0 ? Eigen::VectorXcd(field.values / largest) : field.values;
    for (Index t = 0; t < domain().triangle_count(); ++t) {
        Linear& linear = linear_[t];
        const auto values = local_values(links, scaled, t);
        // The shape function of edge k is 1 - 2 times the barycentric function of corner k + 2, whose gradient is
        // i * side(k) / twice the area.
        linear.constant = linear.by_x = linear.by_y = 0;
        const double area = twice_area(t);
        for (int k = 0; k < 3; ++k) {
            const Complex gradient = -2.0 * Complex(0, 1) * side(t, k) / area;
            linear.by_x += values[k] * gradient.real();
            linear.by_y += values[k] * gradient.imag();
        }
        const Complex middle = on_side(t, 0, 0.5);
        linear.constant = values[0] - slope(t, middle);
    }
}

Complex ChartedField::direction(Index t, Complex z, Complex heading) const {
    const Complex f = value(t, z);
    if (f == 0.0) return heading;
    const double step = 2 * std::numbers::pi / symmetry_, angle = std::arg(f) / symmetry_;
    return std::polar(1.0, angle + step * std::round((std::arg(heading) - angle) / step));
}

}  // namespace octafield::surface::detail
