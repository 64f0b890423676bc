#include "stars.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "octafield/error.hpp"

namespace octafield::surface::detail {
namespace {

constexpr double least_roundness = 0.25;  // inner radius over longest edge; 0.87 in a regular hexagon
constexpr int most_bisections = 200;      // for the sake of roundness, per place
constexpr int most_rounds = 400;

double distance_to_segment(const Vector& p, const Vector& a, const Vector& b) {
    const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    return (a + t * (b - a) - p).norm();
}

double angle_between(const Vector& a, const Vector& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

using Triangle = BisectedMesh::Triangle;

// All triangles at the vertex, counter-clockwise from one of them, then clockwise if the boundary is in the way.
void add_fan(const BisectedMesh& mesh, Star& star) {
    const auto corner_of = [&](Index at) {
        const auto& corners = mesh.triangles()[at].corners;
        return static_cast<int>(std::find(corners.begin(), corners.end(), star.centre) - corners.begin());
    };
    const auto add = [&](Index at) {
        const Triangle& triangle = mesh.triangles()[at];
        const int k = corner_of(at);
        star.parts.push_back({at, (k + 1) % 3, triangle.is_feature[k], triangle.is_feature[(k + 2) % 3]});
    };
    const Index first = mesh.triangle_at(star.centre);
    Index at = first;
    do {
        add(at);
        at = mesh.triangles()[at].neighbours[(corner_of(at) + 2) % 3];
    } while (at >= 0 && at != first);
    star.boundary = at < 0;
    if (!star.boundary) return;
    const auto clockwise = [&](Index t) { return mesh.triangles()[t].neighbours[corner_of(t)]; };
    for (at = clockwise(first); at >= 0; at = clockwise(at)) add(at);
}

void measure(const BisectedMesh& mesh, Star& star) {
    star.angle = star.longest = 0;
    star.inner_radius = std::numeric_limits<double>::infinity();
    for (const Star::Part& part : star.parts) {
        const auto [a, b, centre] = mesh.corners_from(part.triangle, part.side);
        star.angle += angle_between(a - centre, b - centre);
        star.inner_radius = std::min(star.inner_radius, distance_to_segment(centre, a, b));
        const double length = mesh.longest(part.triangle);
        if (length <= star.longest) continue;
        star.longest = length;
        star.longest_triangle = part.triangle;
    }
}

// Triangles that belong to the star of one place and lie in, or beside, that of another.
std::set<Index> overlaps(const BisectedMesh& mesh, std::vector<Index>& places) {
    std::map<Index, Index> owner;
    std::set<Index> found;
    std::vector<Star> stars;
    const auto clash = [&](Index triangle, Index a, Index b) {
        found.insert(triangle);
        places = {std::min(a, b), std::max(a, b)};
    };
    for (const Index centre : mesh.centres()) {
        const auto i = static_cast<Index>(stars.size());
        stars.push_back(star_of(mesh, centre));
        for (const Star::Part& part : stars.back().parts) {
            const auto [place_of, fresh] = owner.try_emplace(part.triangle, i);
            if (!fresh && place_of->second != i) clash(part.triangle, i, place_of->second);
        }
    }
    for (std::size_t i = 0; i < stars.size(); ++i)
        for (const Star::Part& part : stars[i].parts) {
            const Index beside = mesh.triangles()[part.triangle].neighbours[part.side];
            const auto other = owner.find(beside);
            if (other != owner.end() && other->second != static_cast<Index>(i))
                clash(beside, static_cast<Index>(i), other->second);
        }
    return found;
}

}  // namespace

Star star_of(const BisectedMesh& mesh, Index vertex) {
    Star star{vertex, {}, false, 0, 0, 0, -1};
    add_fan(mesh, star);
    measure(mesh, star);
    return star;
}

void separate_stars(BisectedMesh& mesh) {
    std::vector<int> bisections(mesh.centres().size(), 0);
    std::vector<Index> near;
    for (int round = 0; round < most_rounds; ++round) {
        bool all_round = true;
        for (std::size_t i = 0; i < bisections.size(); ++i) {
            const Star star = star_of(mesh, mesh.centres()[i]);
            if (star.inner_radius >= least_roundness * star.longest || bisections[i] == most_bisections) continue;
            ++bisections[i];
            all_round = false;
            mesh.bisect(star.longest_triangle);
        }
        if (!all_round) continue;
        const std::set<Index> shared = overlaps(mesh, near);
        if (shared.empty()) return;
        for (const Index t : shared) mesh.bisect(t);
    }
    throw InvalidInput("two singular points (" + first_few(near) +
                           ") are in the same place, or too near to tell apart; merge them into one",
                       "coincident_points", near);
}

}  // namespace octafield::surface::detail
