#include "integer_constraints.hpp"

#include <algorithm>
#include <cmath>

#include "axis_numbers.hpp"

namespace octafield::volume {

using frames::Vector3;

IntegerConstraints::IntegerConstraints(const TetDomain& domain, const Quaternions& of_tets, double angle)
    : domain_(domain),
      of_tets_(of_tets),
      cosine_(std::cos(angle)),
      normal_axis_(domain.triangles().triangles.rows(), -1),
      corner_(domain.vertex_count(), 0) {
    const BoundarySurface& surface = domain.surface();
    const Points normals = surface::triangle_normals(surface.mesh);
    for (std::size_t f = 0; f < domain.surface_rows().size(); ++f) {
        const Index row = domain.surface_rows()[f], tet = domain.triangles().sides(row, 0) / 4;
        const Vector3 in_frame = frames::from_wxyz(of_tets.row(tet)).conjugate() * Vector3(normals.row(f).transpose());
        const int axis = nearest_axis_number(in_frame);
        if (axis_unit(axis).dot(in_frame) >= cosine_) normal_axis_[row] = static_cast<std::int8_t>(axis % 3);
    }
    for (const Index v : domain.features().corners) corner_[surface.vertex_map[v]] = 1;
    for (Eigen::Index e = 0; e < domain.features().edges.rows(); ++e)
        features_.push_back(std::minmax(
            {surface.vertex_map[domain.features().edges(e, 0)], surface.vertex_map[domain.features().edges(e, 1)]}));
    std::sort(features_.begin(), features_.end());
}

int IntegerConstraints::fixed_axes(const EdgeFan& fan) const {
    int fixed = 0;
    const TriangleTable& table = domain_.triangles();
    const auto see = [&](Index row, const FanTet& at) {
        const int axis = normal_axis_[row];
        // Known in the frame of the first side; the other side's is the next or the previous tet of the fan.
        if (axis >= 0 && table.sides(row, 0) / 4 == at.tet) fixed |= 1 << (at.axes[axis] % 3);
    };
    for (const FanTet& at : fan.tets) see(at.entry, at), see(at.exit, at);
    return fixed | across_feature(fan);
}

int IntegerConstraints::across_feature(const EdgeFan& fan) const {
    if (!std::binary_search(features_.begin(), features_.end(), std::pair(fan.a, fan.b))) return 0;
    const Points& vertices = domain_.mesh().vertices;
    const Vector3 direction = (vertices.row(fan.b) - vertices.row(fan.a)).transpose().normalized();
    // Of the fan's tets the one that knows best: its axis is the nearest.
    double best = -1;
    int axis = 0;
    for (const FanTet& at : fan.tets) {
        const Vector3 in_frame = frames::from_wxyz(of_tets_.row(at.tet)).conjugate() * direction;
        const int nearest = nearest_axis_number(in_frame);
        const double cosine = axis_unit(nearest).dot(in_frame);
        if (cosine > best + 1e-12) {
            best = cosine;
            axis = at.axes[nearest % 3] % 3;
        }
    }
    return best >= cosine_ ? 7 & ~(1 << axis) : 0;
}

}  // namespace octafield::volume
