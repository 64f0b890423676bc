#include "tet_walk.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <limits>
#include <numeric>

namespace octafield::volume {
namespace {

using frames::Matrix3;
using frames::Vector3;

// Rounding may lead in circles; and no step is so long in tets.
constexpr int most_tets = 10000;

}  // namespace

TetWalker::TetWalker(const TetDomain& domain)
    : domain_(domain), wall_(domain.triangles().triangles.rows(), 0), first_(domain.vertex_count() + 1, 0) {
    for (const Index row : domain.surface_rows()) wall_[row] = 1;
    const Tets& tets = domain.mesh().tets;
    for (const Index v : tets.reshaped()) ++first_[v + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    tets_at_.resize(tets.size());
    std::vector<Index> next(first_.begin(), first_.end() - 1);
    for (Index t = 0; t < tets.rows(); ++t)
        for (const Index v : tets.row(t)) tets_at_[next[v]++] = t;
}

Eigen::Vector4d TetWalker::weights(Index tet, const Vector3& point) const {
    const TetMesh& mesh = domain_.mesh();
    const auto corner = [&](int k) -> Vector3 { return mesh.vertices.row(mesh.tets(tet, k)).transpose(); };
    Matrix3 edges;
    for (int k = 0; k < 3; ++k) edges.col(k) = corner(k + 1) - corner(0);
    const Vector3 w = edges.inverse() * (point - corner(0));
    return {1 - w.sum(), w[0], w[1], w[2]};
}

// The tet with the place, of several that which the way stays in longest, measured by its heights; -1: none.
Index TetWalker::start(const FrontPlace& from, const Vector3& way) const {
    const Tets& tets = domain_.mesh().tets;
    std::vector<Index> corners;
    for (int k = 0; k < 4; ++k)
        if (from.weights[k] > 0) corners.push_back(tets(from.tet, k));
    if (corners.size() == 4) return from.tet;
    Index best = -1;
    double most = -1e-9;
    for (Index i = first_[corners[0]]; i < first_[corners[0] + 1]; ++i) {
        const auto row = tets.row(tets_at_[i]);
        const auto has = [&](Index v) { return std::find(row.begin(), row.end(), v) != row.end(); };
        if (!std::all_of(corners.begin(), corners.end(), has)) continue;
        const Vector3 origin = domain_.mesh().vertices.row(row[0]).transpose();
        const Eigen::Vector4d change = weights(tets_at_[i], origin + way) - Eigen::Vector4d::Unit(0);
        double least = std::numeric_limits<double>::infinity();
        for (int k = 0; k < 4; ++k)
            if (std::find(corners.begin(), corners.end(), row[k]) == corners.end()) least = std::min(least, change[k]);
        if (least > most) most = least, best = tets_at_[i];
    }
    return best;
}

FrontStep TetWalker::along(const FrontPlace& from, const Vector3& way) const {
    const TriangleTable& table = domain_.triangles();
    FrontStep step{{}, way.normalized(), Vector3::Zero()};
    Vector3 begin = Vector3::Zero();
    for (int k = 0; k < 4; ++k)
        begin += from.weights[k] * domain_.mesh().vertices.row(domain_.mesh().tets(from.tet, k)).transpose();
    const Vector3 end = begin + way;
    Index tet = start(from, way);
    int entered = -1;
    for (int count = 0; tet >= 0 && count < most_tets; ++count) {
        const Eigen::Vector4d at_end = weights(tet, end);
        if (at_end.minCoeff() >= -1e-12) {
            step.place.tet = tet;
            step.place.weights = at_end.cwiseMax(1e-9);
            step.place.weights /= step.place.weights.sum();
            return step;
        }
        const Eigen::Vector4d at_begin = weights(tet, begin);
        int exit = -1;
        double first = std::numeric_limits<double>::infinity();
        for (int k = 0; k < 4; ++k) {
            if (k == entered || !(at_end[k] < 0) || !(at_begin[k] > at_end[k])) continue;
            const double part = at_begin[k] / (at_begin[k] - at_end[k]);
            if (part < first) first = part, exit = k;
        }
        if (exit < 0) return step;
        const Index row = table.tet_triangles(tet, exit);
        if (wall_[row]) return step;
        const Index side = table.sides(row, 0) / 4 == tet ? table.sides(row, 1) : table.sides(row, 0);
        tet = side / 4;
        entered = side % 4;
    }
    return step;
}

}  // namespace octafield::volume
