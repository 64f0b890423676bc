#include "map_transitions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "octafield/frames/octahedral_group.hpp"

namespace octafield::volume::detail {
namespace {

const std::array<Eigen::Matrix3d, frames::octahedral_order>& rotations() {
    static const auto made = [] {
        std::array<Eigen::Matrix3d, frames::octahedral_order> all;
        for (int o = 0; o < frames::octahedral_order; ++o)
            all[o] = frames::octahedral_group()[o].toRotationMatrix().array().round().matrix();
        return all;
    }();
    return made;
}

}  // namespace

Transition transition(const std::array<Eigen::Vector3d, 3>& from, const std::array<Eigen::Vector3d, 3>& to) {
    const Eigen::Vector3d a = (from[0] + from[1] + from[2]) / 3, b = (to[0] + to[1] + to[2]) / 3;
    Transition best;
    best.residual = std::numeric_limits<double>::infinity();
    for (const Eigen::Matrix3d& rotation : rotations()) {
        double residual = 0;
        for (int k = 0; k < 3; ++k) residual = std::max(residual, (rotation * (from[k] - a) - (to[k] - b)).norm());
        if (residual < best.residual) best = {rotation, b - rotation * a, residual};
    }
    return best;
}

double angle_round(const Eigen::Vector3d& origin, const Eigen::Vector3d& end, const Eigen::Vector3d& x,
                   const Eigen::Vector3d& y) {
    const Eigen::Vector3d along = (end - origin).normalized();
    const auto beside = [&](const Eigen::Vector3d& at) -> Eigen::Vector3d {
        return at - origin - (at - origin).dot(along) * along;
    };
    const Eigen::Vector3d a = beside(x), b = beside(y);
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

std::array<Eigen::Vector3d, 3> triangle_parameters(const Rows<double, 12>& parameters, const Tets& tets,
                                                   const TriangleTable& table, Index triangle, int side) {
    const Index tet = table.sides(triangle, side) / 4;
    std::array<Eigen::Vector3d, 3> result;
    for (int k = 0; k < 3; ++k)
        result[k] = parameters_at(parameters, tet, corner_at(tets, tet, table.triangles(triangle, k)));
    return result;
}

Index TriangleRows::operator()(std::array<Index, 3> vertices) const {
    std::sort(vertices.begin(), vertices.end());
    const auto row = [&](Index t) {
        return std::array<Index, 3>{table_.triangles(t, 0), table_.triangles(t, 1), table_.triangles(t, 2)};
    };
    Index low = 0, high = static_cast<Index>(table_.triangles.rows());
    while (low < high) {
        const Index middle = low + (high - low) / 2;
        (row(middle) < vertices ? low : high) = row(middle) < vertices ? middle + 1 : middle;
    }
    return low < table_.triangles.rows() && row(low) == vertices ? low : -1;
}

double extent(const Rows<double, 12>& parameters, Index tet) {
    Eigen::Vector3d low = parameters_at(parameters, tet, 0), high = low;
    for (int k = 1; k < 4; ++k) {
        low = low.cwiseMin(parameters_at(parameters, tet, k));
        high = high.cwiseMax(parameters_at(parameters, tet, k));
    }
    return (high - low).maxCoeff();
}

}  // namespace octafield::volume::detail
