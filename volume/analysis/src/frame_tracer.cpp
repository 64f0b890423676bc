#include "frame_tracer.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace octafield::volume {
namespace {

using Eigen::Matrix4d;
using Eigen::Vector3d;
using Eigen::Vector4d;

constexpr double largest_turn = 0.3;    // radians in a step: (0.3)^5 / 5! of its length is lost
constexpr double smallest_step = 1e-6;  // of the tet's edge: shorter ones make no point of their own
constexpr double off_faces = 1e-9;  // barycentric: kept from the faces behind, so that edges and vertices are passed
constexpr int patience = 256;       // steps that may together advance less than a hundredth of an edge

// The curve of a linear interpolant in barycentric coordinates: w' = G w, so w(t) = exp(t G) w(0), as a polynomial.
class TetCurve {
public:
    TetCurve(const Matrix4d& rates, const Vector4d& start) {
        terms_[0] = start;
        for (int n = 1; n < count; ++n) terms_[n] = rates * terms_[n - 1] / n;
    }
    Vector4d at(double t) const {
        Vector4d sum = terms_[count - 1];
        for (int n = count - 2; n >= 0; --n) sum = sum * t + terms_[n];
        return sum;
    }
    const Vector4d& rate() const { return terms_[1]; }

    // First t in (0, high] at which a coordinate that is below 0 at `high` vanishes, and which one.
    std::pair<double, int> exit(double high) const {
        const Vector4d last = at(high);
        double first = std::numeric_limits<double>::infinity();
        int corner = -1;
        for (int k = 0; k < 4; ++k) {
            if (last[k] >= 0) continue;
            const double t = root(k, high);
            if (t < first) first = t, corner = k;
        }
        return {first, corner};
    }

private:
    // Bisection, sped up by secants.
    double root(int k, double high) const {
        double low = 0, value_low = at(0)[k], value_high = at(high)[k];
        for (int step = 0; step < 60 && high - low > 1e-15 * high; ++step) {
            const double secant = low + (high - low) * value_low / (value_low - value_high);
            const double t = step % 2 ? (low + high) / 2 : std::clamp(secant, low, high);
            const double value = at(t)[k];
            if (value == 0) return t;
            (value < 0 ? high : low) = t;
            (value < 0 ? value_high : value_low) = value;
        }
        return high;
    }

    static constexpr int count = 5;
    std::array<Vector4d, count> terms_;
};

}  // namespace

Vector3d FrameTracer::position(const Place& place) const {
    Vector3d sum = Vector3d::Zero();
    for (int k = 0; k < 4; ++k) sum += place.weights[k] * mesh_.vertices.row(vertex(place.tet, k)).transpose();
    return sum;
}

std::optional<FrameTracer::Place> FrameTracer::start(const FrameStreamlineSeed& seed) const {
    Place place{seed.tet, seed.weights.cwiseMax(off_faces), {}};
    place.weights /= place.weights.sum();
    int nearest = 0;
    for (int k = 1; k < 4; ++k) {
        const double more = seed.weights[k] - seed.weights[nearest];
        if (more > 0 || (more == 0 && vertex(seed.tet, k) < vertex(seed.tet, nearest))) nearest = k;
    }
    place.axes[nearest] = axes_.nearest(vertex(seed.tet, nearest), seed.direction);
    for (int k = 0; k < 4; ++k)
        if (k != nearest)
            place.axes[k] = axes_.carried(vertex(seed.tet, nearest), vertex(seed.tet, k), place.axes[nearest]);
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < i; ++j)
            if (axes_.carried(vertex(seed.tet, i), vertex(seed.tet, j), place.axes[i]) != place.axes[j])
                return std::nullopt;
    return place;
}

std::optional<FrameTracer::Place> FrameTracer::cross(const Place& place, int corner, FrameStreamlineEnd& end) const {
    const Index row = table_.tet_triangles(place.tet, corner);
    const Index side = table_.sides(row, table_.sides(row, 0) / 4 == place.tet ? 1 : 0);
    end = FrameStreamlineEnd::boundary;
    if (side < 0) return std::nullopt;
    Place next{side / 4, Vector4d::Zero(), {}};
    const int ahead = side % 4;
    end = FrameStreamlineEnd::singular;
    int carried = -1;
    for (int k = 0; k < 4; ++k) {
        if (k == ahead) continue;
        int same = 0;
        while (vertex(place.tet, same) != vertex(next.tet, k)) ++same;
        next.weights[k] = place.weights[same];
        next.axes[k] = place.axes[same];
        const int axis = axes_.carried(vertex(next.tet, k), vertex(next.tet, ahead), next.axes[k]);
        if (carried >= 0 && axis != carried) return std::nullopt;
        carried = axis;
    }
    next.axes[ahead] = carried;
    next.weights = next.weights.cwiseMax(off_faces);
    next.weights /= next.weights.sum();
    return next;
}

FrameTracer::TetField FrameTracer::field_in(const Place& place) const {
    TetField field;
    Eigen::Matrix<double, 3, 4> corners;
    for (int k = 0; k < 4; ++k) {
        field.axes.col(k) = axes_.direction(vertex(place.tet, k), place.axes[k]);
        corners.col(k) = mesh_.vertices.row(vertex(place.tet, k)).transpose();
    }
    const Eigen::Matrix3d edges = corners.rightCols<3>().colwise() - corners.col(0);
    field.gradients.bottomRows<3>() = edges.inverse();
    field.gradients.row(0) = -field.gradients.bottomRows<3>().colwise().sum();
    field.edge = std::sqrt(edges.colwise().squaredNorm().maxCoeff());
    return field;
}

// Moves on in the tet, at most to its surface. Returns the corner opposite the face that is reached, or -1.
int FrameTracer::advance(Place& place, const TetField& field) const {
    const TetCurve curve(field.gradients * field.axes, place.weights);
    double step = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 4; ++k)
        if (curve.rate()[k] < 0) step = std::min(step, -2 * place.weights[k] / curve.rate()[k]);
    const double speed = (field.axes * place.weights).norm(), turn = (field.axes * curve.rate()).norm();
    if (turn * step > largest_turn * speed) step = largest_turn * speed / turn;
    const auto [exit_time, corner] = curve.exit(step);
    place.weights = curve.at(corner >= 0 ? exit_time : step).cwiseMax(0);
    if (corner >= 0) place.weights[corner] = 0;
    place.weights /= place.weights.sum();
    return corner;
}

FrameTracer::Way FrameTracer::follow(Place place) const {
    Way way;
    const Vector3d origin = position(place);
    TetField field = field_in(place);
    const Vector3d direction = (field.axes * place.weights).normalized();
    const double closing = options_.closing_distance > 0 ? options_.closing_distance : 0.1 * field.edge;
    Vector3d at = origin, last_point = origin;
    double recent = 0;
    for (int steps = 1;; ++steps) {
        const int corner = advance(place, field);
        Vector3d next = position(place);
        const double moved = (next - at).norm(), rest = options_.max_length - way.length;
        const double before = (at - origin).dot(direction), after = (next - origin).dot(direction);
        bool ended = false;
        if (before < 0 && after >= 0 && way.length > 4 * closing &&
            (at + (next - at) * (before / (before - after)) - origin).norm() <= closing) {
            next = origin, ended = true;
            way.end = FrameStreamlineEnd::closed;
        } else if (moved >= rest) {
            next = at + (next - at) * (moved > 0 ? rest / moved : 0), ended = true;
            way.end = FrameStreamlineEnd::length;
        }
        way.length += (next - at).norm();
        at = next;
        if (ended || (at - last_point).norm() > smallest_step * field.edge) {
            way.points.push_back(at);
            way.tets.push_back(place.tet);
            last_point = at;
        }
        if (ended) return way;
        recent += moved;
        if (steps % patience == 0 && std::exchange(recent, 0) < 0.01 * field.edge) {
            way.end = FrameStreamlineEnd::stuck;
            return way;
        }
        if (corner < 0) continue;
        const std::optional<Place> ahead = cross(place, corner, way.end);
        if (!ahead) return way;
        place = *ahead;
        field = field_in(place);
    }
}

FrameStreamline FrameTracer::trace(const FrameStreamlineSeed& seed) const {
    const std::optional<Place> place = start(seed);
    Way ahead, behind;
    ahead.end = FrameStreamlineEnd::singular;
    behind.end = options_.both_ways ? FrameStreamlineEnd::singular : FrameStreamlineEnd::seed;
    if (place) ahead = follow(*place);
    if (ahead.end == FrameStreamlineEnd::closed) {
        behind.end = ahead.end;
    } else if (place && options_.both_ways) {
        Place turned = *place;
        for (int& axis : turned.axes) axis = opposite_axis(axis);
        behind = follow(turned);
    }
    FrameStreamline line;
    line.tets.assign(behind.tets.rbegin(), behind.tets.rend());
    line.tets.insert(line.tets.end(), ahead.tets.begin(), ahead.tets.end());
    std::vector<Vector3d> points(behind.points.rbegin(), behind.points.rend());
    points.push_back(position(place ? *place : Place{seed.tet, seed.weights, {}}));
    points.insert(points.end(), ahead.points.begin(), ahead.points.end());
    line.points.resize(static_cast<Eigen::Index>(points.size()), 3);
    for (std::size_t i = 0; i < points.size(); ++i)
        line.points.row(static_cast<Eigen::Index>(i)) = points[i].transpose();
    line.length = behind.length + ahead.length;
    line.first_end = behind.end;
    line.last_end = ahead.end;
    return line;
}

}  // namespace octafield::volume
