#include "seen_point.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace octafield::volume::detail {
namespace {

constexpr int most_moves = 400;
constexpr double first_move = 0.3, next_move = 0.98;  // of the cell's size; of the move before
constexpr double least_depth = 1e-3;                  // of that size

}  // namespace

std::optional<Eigen::Vector3d> seen_point(const TetMesh& mesh, const TriangleTable& table,
                                          const std::vector<Index>& tets, const std::vector<Index>& inner) {
    std::vector<Eigen::Vector4d> planes;  // normal inwards, what is added to its product with a point
    Eigen::Vector3d at = Eigen::Vector3d::Zero();
    double volume = 0;
    for (const Index t : tets) {
        const auto p = [&](int k) -> Eigen::Vector3d { return mesh.vertices.row(mesh.tets(t, k)).transpose(); };
        volume += (p(1) - p(0)).dot((p(2) - p(0)).cross(p(3) - p(0))) / 6;
        at += (p(0) + p(1) + p(2) + p(3)) / (4 * static_cast<double>(tets.size()));
        for (int k = 0; k < 4; ++k) {
            if (std::binary_search(inner.begin(), inner.end(), table.tet_triangles(t, k))) continue;
            const auto& face = tet_face[k];
            const Eigen::Vector3d inward = (p(face[2]) - p(face[0])).cross(p(face[1]) - p(face[0])).normalized();
            planes.emplace_back(inward[0], inward[1], inward[2], -inward.dot(p(face[0])));
        }
    }
    const double size = std::cbrt(volume);
    const auto nearest = [&] {
        return *std::min_element(planes.begin(), planes.end(), [&](const auto& a, const auto& b) {
            return a.dot(at.homogeneous()) < b.dot(at.homogeneous());
        });
    };
    Eigen::Vector3d best = at;
    double most = nearest().dot(at.homogeneous());
    double step = first_move * size;
    for (int move = 0; move < most_moves; ++move, step *= next_move) {
        at += step * nearest().head<3>();
        const double depth = nearest().dot(at.homogeneous());
        if (depth > most) {
            most = depth;
            best = at;
        }
    }
    if (!(most > least_depth * size)) return std::nullopt;
    return best;
}

}  // namespace octafield::volume::detail
