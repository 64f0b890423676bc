#include "turn_counter.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace octafield::volume {
namespace {

using frames::Vector3;

constexpr double quarter = std::numbers::pi / 2;

// Of v about the axis from its part across the axis to that of w, in (-pi, pi].
double angle_about(const Vector3& axis, const Vector3& v, const Vector3& w) {
    const Vector3 unit = axis.normalized();
    return std::atan2(unit.dot(v.cross(w)), v.dot(w) - unit.dot(v) * unit.dot(w));
}

// Quarter turns about axis `about` from axis `from` to axis `to`, 0 to 3, or none where one lies along `about`.
std::optional<int> quarter_turns(int about, int from, int to) {
    if (from % 3 == about % 3 || to % 3 == about % 3) return std::nullopt;
    if (from == to) return 0;
    if (from == opposite_axis(to)) return 2;
    return axis_unit(about).dot(axis_unit(from).cross(axis_unit(to))) > 0 ? 1 : 3;
}

// Two axes of a frame carried from vertex to vertex, and how far the second has turned about a direction of space.
class Carried {
public:
    Carried(const VertexAxes& axes, Index at, int about, int across, const Vector3& direction)
        : about(about), across(across), axes_(axes), at_(at), direction_(direction) {}
    void to(Index next) {
        const int matching = frames::octahedral_inverse(axes_.matching(at_, next));
        const Vector3 before = axes_.direction(at_, across);
        about = turned_axis(matching, about);
        across = turned_axis(matching, across);
        turn += angle_about(direction_, before, axes_.direction(next, across));
        at_ = next;
    }
    int about, across;
    double turn = 0;

private:
    const VertexAxes& axes_;
    Index at_;
    const Vector3 direction_;
};

// The axis nearest to `direction` among those at right angles to axis `normal`.
int nearest_across(const VertexAxes& axes, Index v, const Vector3& direction, int normal) {
    Vector3 in_frame = axes.frame(v).conjugate() * direction;
    in_frame[normal % 3] = 0;
    return nearest_axis_number(in_frame);
}

// The whole number of quarter turns of this residue (mod 4) nearest to the measured one.
int nearest_of_residue(int residue, double measured) {
    return residue + 4 * static_cast<int>(std::lround((measured - residue) / 4));
}

}  // namespace

double TurnCounter::angle(const Wedge& wedge) const {
    double sum = 0;
    for (std::size_t i = 0; i + 1 < wedge.link.size(); ++i)
        sum += std::abs(
            angle_about(p(wedge.b) - p(wedge.a), p(wedge.link[i]) - p(wedge.a), p(wedge.link[i + 1]) - p(wedge.a)));
    return sum;
}

int TurnCounter::hexahedra(const Wedge& wedge, Index v, double angle, bool round_the_link) const {
    const Vector3 edge = p(wedge.b) - p(wedge.a);
    const Vector3 first = (p(wedge.link.front()) - p(wedge.a)).cross(edge);  // normals out of the wedge
    const Vector3 last = edge.cross(p(wedge.link.back()) - p(wedge.a));
    const int normal = axes_.nearest(v, first);
    Carried carried(axes_, v, nearest_across(axes_, v, edge, normal), normal, edge);
    const int tangent = carried.about;
    if (round_the_link) {
        for (const Index l : wedge.link) carried.to(l);
        carried.to(v);
    }
    const auto turns = quarter_turns(carried.about, carried.across, axes_.nearest(v, last));
    if (carried.about != tangent || !turns) return no_number;
    // Normals are half a turn more than the wedge apart.
    return nearest_of_residue((*turns + 2) % 4, (angle - carried.turn) / quarter);
}

std::optional<int> TurnCounter::quadrilaterals(Index v, const std::vector<Index>& link) const {
    const auto normal_of = [&](std::size_t i) -> Vector3 {
        return (p(link[i]) - p(v)).cross(p(link[i + 1]) - p(v)).normalized();
    };
    double angle = 0;
    Vector3 mean = Vector3::Zero();
    for (std::size_t i = 0; i + 1 < link.size(); ++i) {
        const double part = angle_about(normal_of(i), p(link[i]) - p(v), p(link[i + 1]) - p(v));
        angle += part;
        mean += part * normal_of(i);
    }
    const int normal = axes_.nearest(link.front(), normal_of(0));
    Carried carried(axes_, link.front(), normal, nearest_across(axes_, link.front(), p(link.front()) - p(v), normal),
                    mean);
    for (std::size_t i = 1; i < link.size(); ++i) carried.to(link[i]);
    const Index end = link.back();
    if (carried.about != axes_.nearest(end, normal_of(link.size() - 2))) return std::nullopt;
    const auto turns =
        quarter_turns(carried.about, carried.across, nearest_across(axes_, end, p(end) - p(v), carried.about));
    if (!turns) return std::nullopt;
    return nearest_of_residue(*turns, (angle - carried.turn) / quarter);
}

FeatureWedge TurnCounter::judge(const Wedge& wedge) const {
    const double size = angle(wedge);
    FeatureWedge result{wedge.a,
                        wedge.b,
                        size,
                        hexahedra(wedge, wedge.a, size, false),
                        hexahedra(wedge, wedge.b, size, false),
                        hexahedra(wedge, wedge.a, size, true),
                        false};
    const auto fails = [](int number) { return number < 1 && number != no_number; };
    result.meshable = (result.hexahedra_a != no_number || result.hexahedra_b != no_number) &&
                      !fails(result.hexahedra_a) && !fails(result.hexahedra_b);
    return result;
}

int TurnCounter::hexahedra(Index v, Index w, const Vector3& normal_v, const Vector3& normal_w) const {
    const int carried = axes_.carried(v, w, axes_.nearest(v, normal_v)), there = axes_.nearest(w, normal_w);
    if (carried == there) return 2;
    const Vector3 about = (normal_v + normal_w).cross(p(w) - p(v));  // normals turn forward about it where convex
    const Vector3 from = axes_.direction(w, carried), to = axes_.direction(w, there);
    const bool convex = angle_about(about, normal_v, normal_w) > 0;
    if (carried == opposite_axis(there)) return convex ? 0 : 4;
    return about.dot(from.cross(to)) > 0 ? 1 : 3;
}

}  // namespace octafield::volume
