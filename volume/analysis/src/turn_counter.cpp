#include "turn_counter.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
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

double wedge_angle(const TetMesh& mesh, const Wedge& wedge, const StretchedDirections& seen = {}) {
    const auto from_a = [&](Index v) -> Vector3 {
        return seen.tangent((mesh.vertices.row(v) - mesh.vertices.row(wedge.a)).transpose());
    };
    double sum = 0;
    for (std::size_t i = 0; i + 1 < wedge.link.size(); ++i)
        sum += std::abs(angle_about(from_a(wedge.b), from_a(wedge.link[i]), from_a(wedge.link[i + 1])));
    return sum;
}

// A sector of the surface round v: the fan of triangles (v, link[i], link[i + 1]), counter-clockwise from outside.
struct Sector {
    double angle = 0;
    Vector3 mean = Vector3::Zero();  // of the normals, weighted by angle
    std::vector<Vector3> normals;    // unit, per triangle
};

// from_v: the direction from v to a vertex of the link.
Sector sector_of(const std::vector<Index>& link, const std::function<Vector3(Index)>& from_v) {
    Sector sector;
    for (std::size_t i = 0; i + 1 < link.size(); ++i) {
        sector.normals.push_back(from_v(link[i]).cross(from_v(link[i + 1])).normalized());
        const double part = angle_about(sector.normals.back(), from_v(link[i]), from_v(link[i + 1]));
        sector.angle += part;
        sector.mean += part * sector.normals.back();
    }
    return sector;
}

}  // namespace

std::pair<Vector3, Vector3> outward_normals(const TetMesh& mesh, const Wedge& wedge, const StretchedDirections& seen) {
    const auto from_a = [&](Index v) -> Vector3 {
        return seen.tangent((mesh.vertices.row(v) - mesh.vertices.row(wedge.a)).transpose());
    };
    const Vector3 edge = from_a(wedge.b);
    return {from_a(wedge.link.front()).cross(edge), edge.cross(from_a(wedge.link.back()))};
}

int TurnCounter::hexahedra(const Wedge& wedge, Index v, bool round_the_link) const {
    const StretchedDirections seen = seen_from(v);
    const Vector3 edge = seen.tangent(p(wedge.b) - p(wedge.a));
    const auto [first, last] = outward_normals(mesh_, wedge, seen);
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
    return nearest_of_residue((*turns + 2) % 4, (wedge_angle(mesh_, wedge, seen) - carried.turn) / quarter);
}

std::optional<int> TurnCounter::quadrilaterals(Index v, const std::vector<Index>& link) const {
    const Sector sector = sector_of(link, [&](Index w) { return seen_way(v, w); });
    const int normal = axes_.nearest(link.front(), sector.normals.front());
    Carried carried(axes_, link.front(), normal, nearest_across(axes_, link.front(), seen_way(v, link.front()), normal),
                    sector.mean);
    for (std::size_t i = 1; i < link.size(); ++i) carried.to(link[i]);
    const Index end = link.back();
    if (carried.about != axes_.nearest(end, sector.normals.back())) return std::nullopt;
    const auto turns =
        quarter_turns(carried.about, carried.across, nearest_across(axes_, end, seen_way(v, end), carried.about));
    if (!turns) return std::nullopt;
    return nearest_of_residue(*turns, (sector.angle - carried.turn) / quarter);
}

FeatureWedge TurnCounter::judge(const Wedge& wedge) const {
    FeatureWedge result{wedge.a,
                        wedge.b,
                        wedge_angle(mesh_, wedge),
                        hexahedra(wedge, wedge.a, false),
                        hexahedra(wedge, wedge.b, false),
                        hexahedra(wedge, wedge.a, true),
                        false};
    const auto fails = [](int number) { return number < 1 && number != no_number; };
    result.meshable = (result.hexahedra_a != no_number || result.hexahedra_b != no_number) &&
                      !fails(result.hexahedra_a) && !fails(result.hexahedra_b);
    return result;
}

int TurnCounter::hexahedra(Index v, Index w, const Vector3& normal_v, const Vector3& normal_w) const {
    const Vector3 at_v = seen_from(v).normal(normal_v), at_w = seen_from(w).normal(normal_w);
    const int carried = axes_.carried(v, w, axes_.nearest(v, at_v)), there = axes_.nearest(w, at_w);
    if (carried == there) return 2;
    const Vector3 about = (at_v + at_w).cross(seen_way(v, w));  // normals turn forward about it where convex
    const Vector3 from = axes_.direction(w, carried), to = axes_.direction(w, there);
    const bool convex = angle_about(about, at_v, at_w) > 0;
    if (carried == opposite_axis(there)) return convex ? 0 : 4;
    return about.dot(from.cross(to)) > 0 ? 1 : 3;
}

TetTurnCounter::TetTurnCounter(const TetMesh& mesh, const Quaternions& of_tets, const std::vector<Wedge>& wedges)
    : mesh_(mesh), axes_(of_tets) {
    for (const Wedge& w : wedges)
        if (const auto [at, added] = by_edge_.try_emplace({w.a, w.b}, &w); !added) at->second = nullptr;
}

const Wedge* TetTurnCounter::wedge_at(Index v, Index w) const {
    const auto found = by_edge_.find(std::minmax(v, w));
    return found == by_edge_.end() ? nullptr : found->second;
}

FeatureWedge TetTurnCounter::judge(const Wedge& wedge) const {
    const Vector3 edge = p(wedge.b) - p(wedge.a);
    const auto [first, last] = outward_normals(mesh_, wedge);
    const double size = wedge_angle(mesh_, wedge);
    const Index start = wedge.tets.front(), end = wedge.tets.back();
    const int normal = axes_.nearest(start, first), normal_there = axes_.nearest(end, last);
    Carried carried(axes_, start, nearest_across(axes_, start, edge, normal), normal, edge);
    for (std::size_t i = 1; i < wedge.tets.size(); ++i) carried.to(wedge.tets[i]);
    const auto turns = quarter_turns(carried.about, carried.across, normal_there);
    const bool told = turns && carried.about == nearest_across(axes_, end, edge, normal_there);
    // Normals are half a turn more than the wedge apart.
    const int number = told ? nearest_of_residue((*turns + 2) % 4, (size - carried.turn) / quarter) : no_number;
    return {wedge.a, wedge.b, size, number, number, number, told && number >= 1};
}

int TetTurnCounter::hexahedra(const Wedge& wedge) const {
    const auto [first, last] = outward_normals(mesh_, wedge);
    const Index end = wedge.tets.back();
    int carried = axes_.nearest(wedge.tets.front(), first);
    for (std::size_t i = 1; i < wedge.tets.size(); ++i)
        carried = axes_.carried(wedge.tets[i - 1], wedge.tets[i], carried);
    const int there = axes_.nearest(end, last);
    if (carried == there) return 2;
    if (carried == opposite_axis(there)) return wedge_angle(mesh_, wedge) < 2 * quarter ? 0 : 4;
    return (p(wedge.b) - p(wedge.a)).dot(axes_.direction(end, carried).cross(axes_.direction(end, there))) > 0 ? 3 : 1;
}

std::optional<int> TetTurnCounter::quadrilaterals(Index v, const std::vector<Index>& link) const {
    const Sector sector = sector_of(link, [&](Index w) -> Vector3 { return p(w) - p(v); });
    const Wedge* wedge = wedge_at(v, link.front());
    if (!wedge) return std::nullopt;
    Index tet = wedge->link.front() == link[1] ? wedge->tets.front() : wedge->tets.back();
    const int normal = axes_.nearest(tet, sector.normals.front());
    Carried carried(axes_, tet, normal, nearest_across(axes_, tet, p(link.front()) - p(v), normal), sector.mean);
    for (std::size_t i = 1; i + 1 < link.size(); ++i) {
        if (!(wedge = wedge_at(v, link[i]))) return std::nullopt;
        std::vector<Index> way = wedge->tets;
        if (wedge->link.front() != link[i - 1]) std::reverse(way.begin(), way.end());
        for (std::size_t k = 1; k < way.size(); ++k) carried.to(way[k]);
        tet = way.back();
    }
    if (carried.about != axes_.nearest(tet, sector.normals.back())) return std::nullopt;
    const auto turns =
        quarter_turns(carried.about, carried.across, nearest_across(axes_, tet, p(link.back()) - p(v), carried.about));
    if (!turns) return std::nullopt;
    return nearest_of_residue(*turns, (sector.angle - carried.turn) / quarter);
}

}  // namespace octafield::volume
