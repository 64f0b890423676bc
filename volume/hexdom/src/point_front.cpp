#include "point_front.hpp"

#include <algorithm>
#include <cmath>

#include "octafield/parallel.hpp"

namespace octafield::volume {
namespace {

using frames::Matrix3;
using frames::Vector3;
namespace bg = boost::geometry;

constexpr double least_distance = 0.7;  // in lengths
constexpr double least_gap = 0.35;
constexpr double neighbour_reach = 0.45, damping = 0.7, least_relaxed = 0.5;
constexpr int sweeps = 10;

struct Way {
    Vector3 direction;
    double length;
};

Way way_of(const LocalAxes& axes, int number) {
    const double sign = number < 3 ? 1 : -1;
    return {sign * axes.axes.col(number % 3), axes.lengths[number % 3]};
}

Way nearest_way(const LocalAxes& axes, const Vector3& direction) {
    const Vector3 cosines = axes.axes.transpose() * direction;
    Eigen::Index axis;
    cosines.cwiseAbs().maxCoeff(&axis);
    return way_of(axes, static_cast<int>(cosines[axis] < 0 ? axis + 3 : axis));
}

}  // namespace

PointFront::PointFront(const FrontField& field, int threads, std::function<void()> end_level)
    : field_(field), threads_(threads), end_level_(std::move(end_level)) {}

void PointFront::add(const FrontPlace& place, const Vector3& at, const LocalAxes& axes) {
    tree_.insert({Point(at[0], at[1], at[2]), count()});
    places_.push_back(place);
    axes_.push_back(axes);
    at_.push_back(at);
}

void PointFront::add(const std::vector<FrontPlace>& places) {
    const std::vector<LocalAxes> axes = field_.at(places);
    for (std::size_t i = 0; i < places.size(); ++i) add(places[i], field_.position(places[i]), axes[i]);
}

bool PointFront::near(const Vector3& at, const LocalAxes& axes, double distance) const {
    const Vector3 reach = distance * axes.lengths, half = axes.axes.cwiseAbs() * reach;
    const Vector3 low = at - half, high = at + half;
    const bg::model::box<Point> box(Point(low[0], low[1], low[2]), Point(high[0], high[1], high[2]));
    for (auto found = tree_.qbegin(bg::index::intersects(box)); found != tree_.qend(); ++found) {
        const Vector3 way(bg::get<0>(found->first) - at[0], bg::get<1>(found->first) - at[1],
                          bg::get<2>(found->first) - at[2]);
        if (((axes.axes.transpose() * way).array().abs() < reach.array()).all()) return true;
    }
    return false;
}

template <class Walker>
bool PointFront::clear(const Walker& walker, const FrontPlace& place, const LocalAxes& axes) const {
    for (int w = 0; w < 6; ++w) {
        const Way way = way_of(axes, w);
        if (!walker.free(place, least_gap * way.length * way.direction)) return false;
    }
    return true;
}

template <class Walker>
std::vector<FrontPlace> PointFront::proposals(const Walker& walker, const std::vector<Index>& level) const {
    const std::int64_t count = 6 * static_cast<std::int64_t>(level.size());
    std::vector<FrontStep> half(count);
    const auto first_way = [&](std::int64_t i) { return way_of(axes_[level[i / 6]], static_cast<int>(i % 6)); };
    parallel_for(count, threads_, [&](std::int64_t i) {
        const Way way = first_way(i);
        half[i] = walker.along(places_[level[i / 6]], way.length / 2 * way.direction);
    });
    std::vector<FrontPlace> places(count);
    for (std::int64_t i = 0; i < count; ++i) places[i] = half[i].place;
    const std::vector<LocalAxes> middle = field_.at(places);
    parallel_for(count, threads_, [&](std::int64_t i) {
        places[i] = {};
        if (half[i].place.tet < 0) return;
        const FrontPlace& from = places_[level[i / 6]];
        const Way at_middle = nearest_way(middle[i], half[i].direction);
        const Vector3 way =
            at_middle.length * walker.corrected(half[i], first_way(i).direction, at_middle.direction).normalized();
        if (walker.free(from, (1 + least_gap) * way)) places[i] = walker.along(from, way).place;
    });
    std::erase_if(places, [](const FrontPlace& place) { return place.tet < 0; });
    return places;
}

template <class Walker>
void PointFront::spread(const Walker& walker, std::vector<Index> level) {
    while (!level.empty()) {
        end_level_();
        const std::vector<FrontPlace> proposed = proposals(walker, level);
        const std::vector<LocalAxes> axes = field_.at(proposed);
        level.clear();
        for (std::size_t i = 0; i < proposed.size(); ++i) {
            const Vector3 at = field_.position(proposed[i]);
            if (near(at, axes[i], least_distance) || !clear(walker, proposed[i], axes[i])) continue;
            level.push_back(count());
            add(proposed[i], at, axes[i]);
        }
    }
}

std::vector<PointFront::Neighbour> PointFront::neighbours(Index point) const {
    std::vector<Neighbour> result;
    const LocalAxes& axes = axes_[point];
    for (int w = 0; w < 6; ++w) {
        const Way way = way_of(axes, w);
        const Vector3 wanted = at_[point] + way.length * way.direction;
        const Vector3 half = neighbour_reach * (axes.axes.cwiseAbs() * axes.lengths), low = wanted - half,
                      high = wanted + half;
        const bg::model::box<Point> box(Point(low[0], low[1], low[2]), Point(high[0], high[1], high[2]));
        double least = neighbour_reach;
        Index nearest = -1;
        for (auto found = tree_.qbegin(bg::index::intersects(box)); found != tree_.qend(); ++found) {
            const Index q = found->second;
            const double distance =
                (axes.axes.transpose() * (at_[q] - wanted)).cwiseAbs().cwiseQuotient(axes.lengths).maxCoeff();
            if (q == point || !(distance < least || (distance == least && q < nearest))) continue;
            least = distance;
            nearest = q;
        }
        if (nearest >= 0) result.push_back({nearest, w});
    }
    return result;
}

Vector3 PointFront::pull(Index point, const std::vector<Neighbour>& neighbours) const {
    Vector3 sum = Vector3::Zero();
    for (const auto& [other, number] : neighbours) {
        const Way here = way_of(axes_[point], number), there = nearest_way(axes_[other], here.direction);
        const Vector3 step = (here.direction + there.direction).normalized() * (here.length + there.length) / 2;
        sum += at_[other] - step - at_[point];
    }
    return neighbours.empty() ? sum : Vector3(damping * sum / static_cast<double>(neighbours.size()));
}

void PointFront::drop_crowded(Index first) {
    const std::vector<FrontPlace> places = std::exchange(places_, {});
    const std::vector<LocalAxes> axes = std::exchange(axes_, {});
    const std::vector<Vector3> at = std::exchange(at_, {});
    tree_.clear();
    for (std::size_t p = 0; p < places.size(); ++p)
        if (static_cast<Index>(p) < first || !near(at[p], axes[p], least_relaxed)) add(places[p], at[p], axes[p]);
}

template <class Walker>
void PointFront::even_out(const Walker& walker, Index first) {
    const std::int64_t moving = count() - first;
    std::vector<std::vector<Neighbour>> links(moving);
    parallel_for(moving, threads_, [&](std::int64_t i) { links[i] = neighbours(first + static_cast<Index>(i)); });
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        end_level_();
        std::vector<FrontPlace> next(moving);
        parallel_for(moving, threads_, [&](std::int64_t i) {
            const Index p = first + static_cast<Index>(i);
            next[i] = walker.along(places_[p], pull(p, links[i])).place;
        });
        for (std::int64_t i = 0; i < moving; ++i) {
            if (next[i].tet < 0) continue;
            places_[first + i] = next[i];
            at_[first + i] = field_.position(next[i]);
        }
        axes_ = field_.at(places_);
    }
    drop_crowded(first);
}

void PointFront::relax(const TetWalker& walker, Index first) { even_out(walker, first); }
void PointFront::relax(const SurfaceWalker& walker, Index first) { even_out(walker, first); }

void PointFront::advance(const TetWalker& walker, std::vector<Index> level) { spread(walker, std::move(level)); }
void PointFront::advance(const SurfaceWalker& walker, std::vector<Index> level) { spread(walker, std::move(level)); }

}  // namespace octafield::volume
