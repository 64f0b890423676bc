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

constexpr double least_roundness = 0.12;  // inner radius over longest edge; 0.17 at the centroid of a right triangle
constexpr int most_bisections = 200;      // for the sake of roundness, per place
constexpr int most_rounds = 400;

double distance_to_segment(const Vector& p, const Vector& a, const Vector& b) {
    const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    return (a + t * (b - a) - p).norm();
}

double angle_between(const Vector& a, const Vector& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

using Triangle = BisectedMesh::Triangle;

// Corner k of t and all others of the fan there.
void add_fan(const BisectedMesh& mesh, Index t, int k, Star& star) {
    const Index vertex = mesh.triangles()[t].corners[k];
    const auto add = [&](Index at, int corner) {
        const Triangle& triangle = mesh.triangles()[at];
        star.parts.push_back({at, (corner + 1) % 3, Vector::Unit(corner), triangle.is_feature[corner],
                              triangle.is_feature[(corner + 2) % 3]});
    };
    // Across the side that ends (counter-clockwise) or starts (clockwise) at the vertex.
    const auto next = [&](Index at, bool counter_clockwise) {
        const Triangle& triangle = mesh.triangles()[at];
        for (int c = 0; c < 3; ++c)
            if (triangle.corners[c] == vertex) return triangle.neighbours[counter_clockwise ? (c + 2) % 3 : c];
        return Index{-1};
    };
    const auto corner_of = [&](Index at) {
        const auto& corners = mesh.triangles()[at].corners;
        return static_cast<int>(std::find(corners.begin(), corners.end(), vertex) - corners.begin());
    };
    Index at = t;
    do {
        add(at, corner_of(at));
        at = next(at, true);
    } while (at >= 0 && at != t);
    star.boundary = at < 0;
    if (at >= 0) return;
    for (at = next(t, false); at >= 0; at = next(at, false)) add(at, corner_of(at));
}

// The two parts of triangle t for a place on its side k at `fraction` from the side's first corner.
void add_half(const BisectedMesh& mesh, Index t, int k, double fraction, Star& star) {
    const bool feature = mesh.triangles()[t].is_feature[k];
    const Vector weights = (1 - fraction) * Vector::Unit(k) + fraction * Vector::Unit((k + 1) % 3);
    star.parts.push_back({t, (k + 1) % 3, weights, feature, false});
    star.parts.push_back({t, (k + 2) % 3, weights, false, feature});
}

void measure(const BisectedMesh& mesh, Star& star) {
    star.angle = star.longest = 0;
    star.inner_radius = std::numeric_limits<double>::infinity();
    for (const Star::Part& part : star.parts) {
        const Vector a = mesh.corner(part.triangle, part.side), b = mesh.corner(part.triangle, (part.side + 1) % 3);
        star.angle += angle_between(a - star.centre, b - star.centre);
        star.inner_radius = std::min(star.inner_radius, distance_to_segment(star.centre, a, b));
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
    for (const Place& place : mesh.places()) {
        const auto i = static_cast<Index>(stars.size());
        stars.push_back(star_of(mesh, place));
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

Star star_of(const BisectedMesh& mesh, const Place& place) {
    Star star{{}, mesh.position(place), -1, false, 0, 0, 0, place.triangle};
    const Triangle& triangle = mesh.triangles()[place.triangle];
    int zeros = 0, zero = 0, most = 0;
    for (int k = 0; k < 3; ++k) {
        if (place.weights[k] == 0) {
            ++zeros;
            zero = k;
        }
        if (place.weights[k] > place.weights[most]) most = k;
    }
    if (zeros == 2) {
        star.vertex = triangle.corners[most];
        add_fan(mesh, place.triangle, most, star);
    } else if (zeros == 1) {
        const int k = (zero + 1) % 3;
        const double fraction = place.weights[(k + 1) % 3];
        add_half(mesh, place.triangle, k, fraction, star);
        const Index other = triangle.neighbours[k];
        star.boundary = other < 0;
        if (other >= 0)
            add_half(mesh, other, mesh.side_to(other, place.triangle, triangle.corners[(k + 1) % 3]), 1 - fraction,
                     star);
    } else {
        for (int k = 0; k < 3; ++k) star.parts.push_back({place.triangle, k, place.weights, false, false});
    }
    measure(mesh, star);
    return star;
}

void separate_stars(BisectedMesh& mesh) {
    std::vector<int> bisections(mesh.places().size(), 0);
    std::vector<Index> near;
    for (int round = 0; round < most_rounds; ++round) {
        bool all_round = true;
        for (std::size_t i = 0; i < bisections.size(); ++i) {
            const Star star = star_of(mesh, mesh.places()[i]);
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
