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
constexpr double clear_beyond = 0.35;

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
}

void PointFront::add(const std::vector<FrontPlace>& places) {
    const std::vector<LocalAxes> axes = field_.at(places);
    for (std::size_t i = 0; i < places.size(); ++i) add(places[i], field_.position(places[i]), axes[i]);
}

bool PointFront::near(const Vector3& at, const LocalAxes& axes) const {
    const Vector3 reach = least_distance * axes.lengths, half = axes.axes.cwiseAbs() * reach;
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
        if (walker.along(from, (1 + clear_beyond) * way).place.tet >= 0) places[i] = walker.along(from, way).place;
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
            if (near(at, axes[i])) continue;
            level.push_back(count());
            add(proposed[i], at, axes[i]);
        }
    }
}

void PointFront::advance(const TetWalker& walker, std::vector<Index> level) { spread(walker, std::move(level)); }
void PointFront::advance(const SurfaceWalker& walker, std::vector<Index> level) { spread(walker, std::move(level)); }

}  // namespace octafield::volume
