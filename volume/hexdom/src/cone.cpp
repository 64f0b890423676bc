#include "cone.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace octafield::volume::detail {
namespace {

using Vector = Eigen::Vector3d;

struct Corner {
    double determinant, longest;  // longest: the greatest product of the three edges at a vertex
};

Corner tet_corner(const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
    const Vector ab = b - a, ac = c - a, ad = d - a;
    const double ab2 = ab.squaredNorm(), ac2 = ac.squaredNorm(), ad2 = ad.squaredNorm(), bc2 = (c - b).squaredNorm(),
                 cd2 = (d - c).squaredNorm(), bd2 = (d - b).squaredNorm();
    const double longest = std::max({ab2 * ac2 * ad2, ab2 * bc2 * bd2, ac2 * bc2 * cd2, ad2 * bd2 * cd2});
    return {ab.cross(ac).dot(ad), std::sqrt(longest)};
}

double scaled(const Corner& corner) { return corner.longest > 0 ? corner.determinant / corner.longest : -1; }

// The least over the faces, or anything not above `enough` when it is no more than that.
double least_quality(const std::vector<ConeFace>& faces, const Vector& apex, double enough) {
    double least = std::numeric_limits<double>::infinity();
    for (const ConeFace& face : faces) {
        least = std::min(least, cone_quality(face, apex));
        if (least <= enough) break;
    }
    return least;
}

const std::array<Vector, 14>& directions() {
    static const std::array<Vector, 14> all = [] {
        std::array<Vector, 14> d;
        for (int k = 0; k < 3; ++k) d[2 * k] = Vector::Unit(k), d[2 * k + 1] = -Vector::Unit(k);
        for (int k = 0; k < 8; ++k) d[6 + k] = Vector(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1) / std::sqrt(3.0);
        return d;
    }();
    return all;
}

}  // namespace

double tet_quality(const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
    return std::sqrt(2.0) * scaled(tet_corner(a, b, c, d));
}

double pyramid_quality(const std::array<Vector, 4>& base, const Vector& apex) {
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 4; ++k)
        least = std::min(least, 2 * scaled(tet_corner(base[k], base[(k + 1) % 4], base[(k + 3) % 4], apex)));
    return least < 1 ? least : 2 - least;
}

double cone_quality(const ConeFace& face, const Vector& apex) {
    const auto& p = face.points;
    return face.corners == 3 ? tet_quality(p[0], p[2], p[1], apex) : pyramid_quality({p[0], p[3], p[2], p[1]}, apex);
}

Apex best_apex(const std::vector<ConeFace>& faces, const std::vector<Vector>& seeds, double step) {
    Apex best{seeds.front(), -std::numeric_limits<double>::infinity()};
    const auto improves = [&](const Vector& place) {
        const double quality = least_quality(faces, place, best.quality);
        if (!(quality > best.quality)) return false;
        best = {place, quality};
        return true;
    };
    for (const Vector& seed : seeds) improves(seed);
    const double last = step / 500;
    int moves = 0;
    while (step > last && moves < 60) {
        bool moved = false;
        for (const Vector& direction : directions()) moved = improves(best.place + step * direction) || moved;
        if (moved)
            ++moves;
        else
            step /= 2;
    }
    return best;
}

}  // namespace octafield::volume::detail
