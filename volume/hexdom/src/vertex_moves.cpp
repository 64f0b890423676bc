#include "vertex_moves.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace octafield::volume::detail {
namespace {

using Vector = Eigen::Vector3d;

constexpr double longest_step = 0.4;  // of the mean edge at the vertex
constexpr double least_step = 1e-4;   // of it: shorter ones are not worth a move
constexpr double least_gain = 1e-4;   // of a quality
constexpr int hull_rounds = 40;

// The shortest vector in the convex hull (Mitchell, Demyanov, Malozemov 1974).
Vector shortest_in_hull(const std::vector<Vector>& points) {
    static thread_local std::vector<double> weights;
    weights.assign(points.size(), 0);
    std::size_t start = 0;
    for (std::size_t i = 1; i < points.size(); ++i)
        if (points[i].squaredNorm() < points[start].squaredNorm()) start = i;
    weights[start] = 1;
    Vector shortest = points[start];
    for (int round = 0; round < hull_rounds; ++round) {
        std::size_t low = 0, high = points.size();
        double least = std::numeric_limits<double>::infinity(), most = -least;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double along = points[i].dot(shortest);
            if (along < least) least = along, low = i;
            if (weights[i] > 0 && along > most) most = along, high = i;
        }
        if (high == points.size() || !(most - least > 1e-3 * shortest.squaredNorm())) break;
        const Vector across = points[low] - points[high];
        const double share = std::min(weights[high], (most - least) / across.squaredNorm());
        weights[high] -= share;
        weights[low] += share;
        shortest += share * across;
    }
    return shortest;
}

// Values with gradients at a place, and the direction in which those within `band` of the lowest all rise.
struct Slopes {
    std::vector<double> values;
    std::vector<Vector> gradients, lowest;

    Vector direction(double band) {
        const double least = *std::ranges::min_element(values);
        lowest.clear();
        for (std::size_t i = 0; i < values.size(); ++i)
            if (values[i] <= least + band) lowest.push_back(gradients[i]);
        return shortest_in_hull(lowest);
    }
    // Least of the values a step along the unit vector ahead, were they linear.
    double ahead(const Vector& unit, double step) const {
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < values.size(); ++i)
            least = std::min(least, values[i] + step * gradients[i].dot(unit));
        return least;
    }
    // Halvings of `longest` after which that is greatest, at most 8.
    int halvings(const Vector& unit, double longest) const {
        int best = 0;
        double most = -std::numeric_limits<double>::infinity();
        for (int k = 0; k <= 8; ++k) {
            const double least = ahead(unit, std::ldexp(longest, -k));
            if (least > most) most = least, best = k;
        }
        return best;
    }
};

Slopes& slopes() {
    static thread_local Slopes scratch;
    return scratch;
}

// One step uphill of the least of several functions; `fill` evaluates all with gradients, `least` the least alone.
template <class Fill, class Least>
bool step_up(double size, const Slide& slide, Move& move, const Fill& fill, const Least& least) {
    Slopes& at = slopes();
    fill(move.x, at.values, at.gradients);
    const Eigen::Matrix3d tangential = slide.tangential(move.place);
    for (Vector& gradient : at.gradients) gradient = tangential * gradient;
    const double before = *std::ranges::min_element(at.values);
    for (const double band : {0.05, 0.005}) {
        const Vector direction = at.direction(band * std::max(0.2, std::abs(before)));
        const double slope = direction.norm();
        if (!(slope * size > 2e-3)) continue;
        const Vector unit = direction / slope;
        const int first = at.halvings(unit, longest_step * size);
        for (int k = first; k < first + 3; ++k) {
            Move next;
            next.x = slide.allowed(move.x + std::ldexp(longest_step * size, -k) * unit, next.place);
            if (!(least(next.x, before + least_gain) > before + least_gain)) continue;
            move = next;
            return true;
        }
    }
    return false;
}

// Whether no quality below `floor` falls: `before` is the lowest there was.
bool keeps(const VertexStar& star, const Vector& x, double before, double floor) {
    const double bound = std::min(before, floor);
    return star.lowest(x, bound) >= bound;
}

}  // namespace

Slide::Slide(const SurfaceGuide* guide, Along along, const Vector& start, const Place& place)
    : guide_(guide), along_(along), start_(start), place_(place) {
    if (along != Along::space) away_ = start - place.point;
}

Vector Slide::allowed(const Vector& x, Place& place) const {
    if (along_ == Along::space) return x;
    const Vector wanted = place_.point + x;
    place =
        along_ == Along::patch ? guide_->nearest_in_patch(wanted, place_) : guide_->nearest_in_curve(wanted, place_);
    return place.point + kept_ * away_ - start_;
}

Eigen::Matrix3d Slide::tangential(const Place& place) const {
    if (along_ == Along::space) return Eigen::Matrix3d::Identity();
    const Vector unit = along_ == Along::patch ? guide_->normal(place.element) : guide_->tangent(place.element);
    if (along_ == Along::curve) return unit * unit.transpose();
    return Eigen::Matrix3d::Identity() - unit * unit.transpose();
}

bool raise_lowest(const VertexStar& star, const Slide& slide, Move& move) {
    bool moved = false;
    for (int step = 0; step < 3; ++step) {
        const bool up = step_up(
            star.size(), slide, move, [&](auto&&... args) { star.qualities(args...); },
            [&](const Vector& x, double enough) { return star.lowest(x, enough); });
        if (!up) break;
        moved = true;
    }
    return moved;
}

bool untangle(const VertexStar& star, const Slide& slide, Move& move) {
    bool moved = false;
    for (int step = 0; step < 10; ++step) {
        const bool up = step_up(
            star.size(), slide, move, [&](auto&&... args) { star.determinants(args...); },
            [&](const Vector& x, double) { return star.lowest_determinant(x); });
        if (!up) break;
        moved = true;
    }
    return moved;
}

Smoothed smooth(const VertexStar& star, const Slide& slide, Move& move, double floor) {
    Vector gradient;
    Eigen::Matrix3d hessian;
    const double energy = star.energy(move.x, gradient, hessian);
    if (!std::isfinite(energy)) return Smoothed::rests;
    // Along the piece only: the rest of the space gets a matrix that leaves it alone.
    const Eigen::Matrix3d tangential = slide.tangential(move.place);
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - tangential;
    hessian = tangential * hessian * tangential + hessian.trace() * across;
    Vector step = -hessian.ldlt().solve(tangential * gradient);
    const double length = step.norm(), size = star.size();
    if (!(length > least_step * size)) return Smoothed::rests;
    if (length > longest_step * size) step *= longest_step * size / length;
    const double before = star.lowest(move.x);
    Smoothed result = Smoothed::rests;
    for (int halvings = 0; halvings < 3; ++halvings, step /= 2) {
        Move next;
        next.x = slide.allowed(move.x + step, next.place);
        if (!(star.energy(next.x) < energy)) continue;
        if (!keeps(star, next.x, before, floor)) {
            result = Smoothed::barred;
            continue;
        }
        move = next;
        return Smoothed::moved;
    }
    return result;
}

bool snap(const VertexStar& star, Slide& slide, Move& move, double floor) {
    const double before = star.lowest(move.x);
    for (const double kept : {0.0, 0.5, 0.8, 0.95}) {
        slide.bring_nearer(kept);
        Move next;
        next.x = slide.allowed(move.x, next.place);
        if (!keeps(star, next.x, before, floor)) continue;
        move = next;
        return true;
    }
    slide.bring_nearer(1);
    return false;
}

}  // namespace octafield::volume::detail
