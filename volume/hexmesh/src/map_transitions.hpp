// Parameters of single tets and how they go on across triangles.
#pragma once

#include <array>

#include "octafield/volume/seamless_map.hpp"
#include "octafield/volume/triangle_table.hpp"

namespace octafield::volume::detail {

inline Eigen::Vector3d parameters_at(const Rows<double, 12>& parameters, Index tet, int corner) {
    return parameters.block<1, 3>(tet, 3 * corner).transpose();
}

// Rotation, one of the 24 of the cube, then translation.
struct Transition {
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    Eigen::Vector3d translation = Eigen::Vector3d::Zero();
    double residual = 0;  // largest distance that is left at a corner of the triangle

    Eigen::Vector3d operator()(const Eigen::Vector3d& x) const { return rotation * x + translation; }
};

// The one that takes the three points `from` nearest to those of `to`.
Transition transition(const std::array<Eigen::Vector3d, 3>& from, const std::array<Eigen::Vector3d, 3>& to);

// Between the half planes of x and y at the line from `origin` to `end`, 0 to pi: what a tet has of the turn round an edge.
double angle_round(const Eigen::Vector3d& origin, const Eigen::Vector3d& end, const Eigen::Vector3d& x,
                   const Eigen::Vector3d& y);

// Corner of the tet at a vertex that it has.
inline int corner_at(const Tets& tets, Index tet, Index vertex) {
    int k = 0;
    while (tets(tet, k) != vertex) ++k;
    return k;
}

// Parameters of the corners of row `triangle` of the table, as the tet on the given side (0, 1) has them.
std::array<Eigen::Vector3d, 3> triangle_parameters(const Rows<double, 12>& parameters, const Tets& tets,
                                                   const TriangleTable& table, Index triangle, int side);

// Row of the triangle of these vertices in any order; -1: there is none.
class TriangleRows {
public:
    explicit TriangleRows(const TriangleTable& table) : table_(table) {}
    Index operator()(std::array<Index, 3> vertices) const;

private:
    const TriangleTable& table_;
};

// Throws what seamless_report throws, and GeometryError: kinds "flipped_tet", "torn_map" (tets).
void require_seamless(const SeamlessMap& map);

// Largest extent of the parameters of a tet.
double extent(const Rows<double, 12>& parameters, Index tet);

}  // namespace octafield::volume::detail
