#include "snap.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "deviation.hpp"
#include "triangle_tests.hpp"

namespace octafield::surface {
namespace {

constexpr double kTurned = 0.5;  // cosine of the largest turn
constexpr double kThin = 0.05;   // 2 sqrt(3) times the doubled area over the sides' squares; 1 for equilateral ones

// Whether a triangle with its corners moved is turned, or thin and thinner than it was.
bool spoilt(const Points& before, const Points& after, const Eigen::RowVector3i& t) {
    const auto vector = [&](const Points& points) {
        const Eigen::RowVector3d a = points.row(t[0]), b = points.row(t[1]), c = points.row(t[2]);
        return Eigen::Vector3d((b - a).cross(c - a));
    };
    const auto quality = [&](const Points& points, double twice) {
        double sides = 0;
        for (int k = 0; k < 3; ++k) sides += (points.row(t[k]) - points.row(t[(k + 1) % 3])).squaredNorm();
        return sides > 0 ? 2 * std::sqrt(3.) * twice / sides : 0;
    };
    const Eigen::Vector3d old = vector(before), made = vector(after);
    if (!(old.dot(made) > kTurned * old.norm() * made.norm())) return true;
    return quality(after, made.norm()) < std::min(kThin, quality(before, old.norm()));
}

}  // namespace

std::size_t snap(TriangleMesh& mesh, const TriangleMesh& to, double reach) {
    const Points before = mesh.vertices, targets = nearest_points(before, to);
    std::vector<bool> moved(before.rows());
    for (Index v = 0; v < before.rows(); ++v) moved[v] = (targets.row(v) - before.row(v)).norm() < reach;
    // Each round leaves fewer moved, down to the mesh as it was.
    while (true) {
        for (Index v = 0; v < before.rows(); ++v) mesh.vertices.row(v) = moved[v] ? targets.row(v) : before.row(v);
        std::vector<Index> bad;
        for (Index t = 0; t < mesh.triangles.rows(); ++t)
            if (spoilt(before, mesh.vertices, mesh.triangles.row(t))) bad.push_back(t);
        if (bad.empty()) bad = intersecting_triangles(mesh);
        bool fewer = false;
        for (const Index t : bad)
            for (const Index v : mesh.triangles.row(t)) {
                fewer = fewer || moved[v];
                moved[v] = false;
            }
        if (!fewer) return static_cast<std::size_t>(std::count(moved.begin(), moved.end(), true));
    }
}

}  // namespace octafield::surface
