#include "singular_place.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "unfolded_patch.hpp"

namespace octafield::surface::detail {
namespace {

using std::numbers::pi;
constexpr std::size_t parameters = 7, least_values = 3 * parameters;
constexpr double most_unexplained = 0.25;  // radians of the N-fold angle, root mean square
constexpr double most_moved = 1;           // edge lengths
constexpr double radii[] = {3, 2};         // edge lengths; the smaller one where another point is near

double edge_length(const ChartedField& field, Index t) {
    return (std::abs(field.side(t, 0)) + std::abs(field.side(t, 1)) + std::abs(field.side(t, 2))) / 3;
}

// a, by Gauss-Newton's method from 0; z in edge lengths from the first place.
std::optional<Complex> fitted(const std::vector<PatchValue>& values, int k) {
    const auto count = static_cast<Eigen::Index>(values.size());
    Eigen::Matrix<double, parameters, 1> model = Eigen::Matrix<double, parameters, 1>::Zero();  // a, c, p, q
    Complex mean = 0;
    for (const PatchValue& v : values) mean += v.f * std::polar(1.0, -k * std::arg(v.at));
    model[2] = std::arg(mean);
    Eigen::MatrixXd jacobian(count, static_cast<Eigen::Index>(parameters));
    Eigen::VectorXd residual(count), weights(count);
    for (int step = 0; step < 30; ++step) {
        const Complex a(model[0], model[1]);
        for (Eigen::Index i = 0; i < count; ++i) {
            const Complex z = values[i].at, away = z - a, inverse = away == 0.0 ? 0 : 1.0 / away;
            jacobian.row(i) << -k * inverse.imag(), -k * inverse.real(), 1, z.real(), -z.imag(), (z * z).real(),
                -(z * z).imag();
            const double smooth = jacobian.row(i).tail<parameters - 2>() * model.tail<parameters - 2>();
            residual[i] = std::arg(values[i].f * std::polar(1.0, -k * std::arg(away) - smooth));
            weights[i] = std::min(1.0, std::norm(away));  // nearer than an edge the values depend on the triangles
        }
        const Eigen::Matrix<double, parameters, 1> change =
            (weights.asDiagonal() * jacobian).colPivHouseholderQr().solve(weights.cwiseProduct(residual));
        if (!change.allFinite()) return {};
        const double length = change.head<2>().norm(), part = std::min(1.0, 0.5 / std::max(length, 1e-300));
        model += part * change;
        const Complex moved(model[0], model[1]);
        if (std::abs(moved) > most_moved) return {};
        if (change.norm() < 1e-8) {  // then the residual is that of the model, too
            const double unexplained = weights.cwiseProduct(residual).norm() / weights.norm();
            return unexplained < most_unexplained ? std::optional(moved) : std::nullopt;
        }
    }
    return {};
}

// Straight from `from` by `way`; nothing where a barrier or the boundary lies between.
std::optional<SurfacePlace> walked(const ChartedField& field, const std::function<bool(Index)>& is_barrier,
                                   SurfacePlace place, Complex way) {
    int entry = -1;
    double length = std::abs(way);
    if (length == 0) return place;
    Complex heading = way / length;
    for (int steps = 0; steps < 50; ++steps) {
        const auto out = field.exit(place.triangle, place.at, heading, entry);
        if (out.side < 0) return {};
        if (out.distance >= length) return SurfacePlace{place.triangle, place.at + length * heading};
        const ChartedField::Side here{place.triangle, out.side}, there = field.across(here);
        if (there.triangle < 0 || is_barrier(field.topology().triangle_edges(here.triangle, here.side))) return {};
        length -= out.distance;
        const Complex along = field.side(here.triangle, here.side);
        const double fraction =
            dot(along, place.at + out.distance * heading - field.corners(here.triangle)[here.side]) / std::norm(along);
        place = {there.triangle, field.on_side(there.triangle, there.side, 1 - fraction)};
        heading = field.carried(heading, here, there);
        entry = there.side;
    }
    return {};
}

}  // namespace

std::optional<SurfacePlace> fitted_place(const ChartedField& field, const std::function<bool(Index)>& is_barrier,
                                         SurfacePlace start, int index_times_symmetry) {
    const double edge = edge_length(field, start.triangle);
    for (const double radius : radii) {
        // Unfolded anew round where the point turned out to be: the middle is where the plane is truest.
        SurfacePlace place = start;
        double moved = 0;
        for (int round = 0; round < 3; ++round) {
            auto values = values_round(field, is_barrier, place.triangle, place.at, 0, radius * edge);
            if (values.size() < least_values) break;
            for (PatchValue& value : values) value.at = (value.at - place.at) / edge;
            const auto way = fitted(values, index_times_symmetry);
            if (!way) break;
            moved += std::abs(*way);
            if (moved > most_moved) break;
            const auto next = walked(field, is_barrier, place, edge * *way);
            if (!next) break;
            place = *next;
            if (round == 2 || std::abs(*way) < 1e-3) return place;
        }
    }
    return {};
}

}  // namespace octafield::surface::detail
