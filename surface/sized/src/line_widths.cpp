#include "line_widths.hpp"

#include <cmath>
#include <numbers>

namespace octafield::surface::detail {

std::vector<double> width_growth(const ChartedField& field, const Streamline& line) {
    std::vector<double> growth{0};
    for (std::size_t i = 0; i < line.triangles.size(); ++i) {
        const Index t = line.triangles[i];
        const Complex from = field.lower(t, line.points.row(static_cast<Index>(i))),
                      to = field.lower(t, line.points.row(static_cast<Index>(i) + 1));
        const Complex f = field.value(t, (from + to) / 2.0), across = Complex(0, 1) * (to - from);
        const double turn = f == 0.0 ? 0 : cross(f, field.slope(t, across)) / std::norm(f) / field.symmetry();
        growth.push_back(growth.back() + turn);
    }
    return growth;
}

void LineIndex::add(Index number, const Streamline& line) {
    for (std::size_t i = 0; i < line.triangles.size(); ++i) {
        const Index t = line.triangles[i], row = static_cast<Index>(i);
        segments_[t].push_back(
            {number, row, charts_.lower(t, line.points.row(row)), charts_.lower(t, line.points.row(row + 1))});
    }
}

std::vector<LineCrossing> LineIndex::crossings(Index number, const Streamline& line) const {
    const double least_sine = std::sin(std::numbers::pi / 8);
    std::vector<LineCrossing> found;
    for (std::size_t i = 0; i < line.triangles.size(); ++i) {
        const Index t = line.triangles[i], row = static_cast<Index>(i);
        const Complex from = charts_.lower(t, line.points.row(row)), to = charts_.lower(t, line.points.row(row + 1));
        for (const Segment& other : segments_[t]) {
            const Complex along = to - from, across = other.to - other.from;
            const double sine = cross(along, across);
            if (!(std::abs(sine) > least_sine * std::abs(along) * std::abs(across))) continue;
            const double here = cross(other.from - from, across) / sine, there = cross(other.from - from, along) / sine;
            // Half-open, so that a crossing at the common end of two segments counts once.
            if (here < 0 || here >= 1 || there < 0 || there >= 1) continue;
            found.push_back({{number, row, here}, {other.line, other.segment, there}, t, from + here * along});
        }
    }
    return found;
}

}  // namespace octafield::surface::detail
