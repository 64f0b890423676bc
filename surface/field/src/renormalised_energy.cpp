#include "octafield/surface/renormalised_energy.hpp"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "octafield/error.hpp"

namespace octafield::surface {
namespace {

using std::numbers::pi;

// Adds up -log of the distances of all pairs.
template <class Distance>
double minus_log_pairs(Index count, const Distance& distance) {
    double sum = 0;
    for (Index i = 0; i < count; ++i)
        for (Index j = i + 1; j < count; ++j) {
            const double d = distance(i, j);
            if (!(d > 0) || !std::isfinite(d))
                throw InvalidInput("points " + std::to_string(i) + " and " + std::to_string(j) +
                                       " are the same or not finite: their energy is not defined",
                                   "coincident_points", {i, j});
            sum -= std::log(d);
        }
    return sum;
}

void require_polygon(int d) {
    if (d < 1) throw InvalidInput("a polygon of critical points needs at least one");
}

}  // namespace

double disk_renormalised_energy(std::span<const std::complex<double>> points) {
    const Index count = static_cast<Index>(points.size());
    std::vector<Index> outside;
    for (Index i = 0; i < count; ++i)
        if (!(std::abs(points[i]) < 1)) outside.push_back(i);
    if (!outside.empty())
        throw InvalidInput("points " + first_few(outside) + " are not inside the unit disk", "outside", outside);
    double sum = 2 * minus_log_pairs(count, [&](Index i, Index j) { return std::abs(points[i] - points[j]); });
    for (const auto& a : points)
        for (const auto& b : points) sum -= std::log(std::abs(1.0 - a * std::conj(b)));
    return pi * sum;
}

double disk_polygon_energy(int d, double r) {
    require_polygon(d);
    if (!(r > 0 && r < 1)) throw InvalidInput("the radius of a polygon in the unit disk must be in (0, 1)");
    return -pi * d * (std::log(d) + (d - 1) * std::log(r) + std::log1p(-std::pow(r, 2.0 * d)));
}

double disk_polygon_radius(int d) {
    require_polygon(d);
    return std::pow((d - 1.0) / (3.0 * d - 1), 1 / (2.0 * d));
}

double logarithmic_energy(const Points& points) {
    return minus_log_pairs(static_cast<Index>(points.rows()),
                           [&](Index i, Index j) { return (points.row(i) - points.row(j)).norm(); });
}

double sphere_renormalised_energy(const Points& points) {
    const double count = static_cast<double>(points.rows());
    if (points.rows() == 0 || points.rows() % 2 != 0)
        throw InvalidInput("an N-direction field on the sphere has 2 N simple points: an even number, at least 2");
    std::vector<Index> off;
    for (Index i = 0; i < points.rows(); ++i)
        if (!(std::abs(points.row(i).norm() - 1) < 1e-6)) off.push_back(i);
    if (!off.empty()) throw InvalidInput("points " + first_few(off) + " are not on the unit sphere", "outside", off);
    return 2 * pi * logarithmic_energy(points) + pi * count * count * (std::numbers::ln2 - 0.5);
}

double asymptotic_energy(int points, double renormalised_energy, double epsilon) {
    if (points < 0) throw InvalidInput("the number of points must not be negative");
    if (!(epsilon > 0 && epsilon < 1)) throw InvalidInput("epsilon must be in (0, 1)");
    return -pi * points * std::log(epsilon) + renormalised_energy + points * core_energy;
}

}  // namespace octafield::surface
