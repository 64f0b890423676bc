#include "octafield/surface/triangle_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "half_edges.hpp"
#include "octafield/error.hpp"

namespace octafield::surface {
namespace {

std::string edge_name(const HalfEdge& side) { return std::to_string(side.low) + "-" + std::to_string(side.high); }

// Twice the area times the unit normal.
Eigen::Vector3d area_vector(const TriangleMesh& mesh, Index t) {
    const Eigen::Vector3d a = mesh.vertices.row(mesh.triangles(t, 0));
    const Eigen::Vector3d b = mesh.vertices.row(mesh.triangles(t, 1));
    const Eigen::Vector3d c = mesh.vertices.row(mesh.triangles(t, 2));
    return (b - a).cross(c - a);
}

}  // namespace

EdgeTopology edge_topology(const TriangleMesh& mesh) {
    const std::vector<HalfEdge> sides = sorted_half_edges(mesh.triangles);
    if (static_cast<Eigen::Index>(sides.size()) != 3 * mesh.triangles.rows())
        throw GeometryError("a triangle uses the same vertex twice; repair the mesh first", "degenerate_triangle");
    Index count = 0;
    for_each_edge(sides, [&](auto, auto) { ++count; });

    EdgeTopology topology;
    topology.edges.resize(count, 2);
    topology.triangle_edges.resize(mesh.triangles.rows(), 3);
    topology.edge_triangles.setConstant(count, 2, -1);
    Index edge = 0;
    for_each_edge(sides, [&](auto first, auto last) {
        if (last - first > 2)
            throw GeometryError(std::to_string(last - first) + " triangles share edge " + edge_name(*first) +
                                    ", where at most 2 may; repair the mesh first",
                                "non_manifold_edge", {first->low, first->high});
        topology.edges.row(edge) << first->low, first->high;
        for (auto side = first; side != last; ++side) {
            Index& slot = topology.edge_triangles(edge, side->forward ? 0 : 1);
            if (slot >= 0)
                throw GeometryError("triangles " + std::to_string(slot) + " and " + std::to_string(side->triangle) +
                                        " run edge " + edge_name(*side) + " the same way; orient the mesh first",
                                    "inconsistent_orientation", {side->low, side->high});
            slot = side->triangle;
            topology.triangle_edges(side->triangle, side->corner) = edge;
        }
        ++edge;
    });
    return topology;
}

double bounding_box_diagonal(const Points& points) {
    if (points.rows() == 0) return 0;
    return (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm();
}

double shape_size(const TriangleMesh& mesh) {
    // The rule of the edges' midpoints is exact for squares of coordinates.
    if (mesh.triangles.rows() == 0) return 0;
    const Eigen::RowVector3d origin = mesh.vertices.row(mesh.triangles(0, 0));
    const double unit = bounding_box_diagonal(mesh.vertices);
    if (!(unit > 0)) return 0;
    double area = 0, square = 0;
    Eigen::RowVector3d first = Eigen::RowVector3d::Zero();
    const Eigen::VectorXd areas = triangle_areas(mesh) / unit / unit;
    for (Index t = 0; t < areas.size(); ++t) {
        area += areas[t];
        for (int k = 0; k < 3; ++k) {
            const Eigen::RowVector3d ends =
                mesh.vertices.row(mesh.triangles(t, k)) + mesh.vertices.row(mesh.triangles(t, (k + 1) % 3));
            const Eigen::RowVector3d middle = (ends / 2 - origin) / unit;
            first += areas[t] / 3 * middle;
            square += areas[t] / 3 * middle.squaredNorm();
        }
    }
    return area > 0 ? 3 * unit * std::sqrt(std::max(0.0, square / area - (first / area).squaredNorm())) : 0;
}

double signed_volume(const TriangleMesh& mesh) {
    if (mesh.triangles.rows() == 0) return 0;
    // Measured from the middle of the box: meshes far from the origin keep their digits.
    const Eigen::Vector3d middle = (mesh.vertices.colwise().maxCoeff() + mesh.vertices.colwise().minCoeff()) / 2;
    double six_volumes = 0;
    for (Index t = 0; t < mesh.triangles.rows(); ++t) {
        const Eigen::Vector3d corner = mesh.vertices.row(mesh.triangles(t, 0));
        six_volumes += area_vector(mesh, t).dot(corner - middle);
    }
    return six_volumes / 6;
}

Eigen::VectorXd triangle_areas(const TriangleMesh& mesh) {
    Eigen::VectorXd areas(mesh.triangles.rows());
    for (Index t = 0; t < areas.size(); ++t) areas[t] = area_vector(mesh, t).norm() / 2;
    return areas;
}

Points triangle_normals(const TriangleMesh& mesh) {
    Points normals(mesh.triangles.rows(), 3);
    for (Index t = 0; t < normals.rows(); ++t) normals.row(t) = area_vector(mesh, t).stableNormalized();
    return normals;
}

Points vertex_normals(const TriangleMesh& mesh) {
    Points normals = Points::Zero(mesh.vertices.rows(), 3);
    for (Index t = 0; t < mesh.triangles.rows(); ++t) {
        const Eigen::RowVector3d normal = area_vector(mesh, t);
        for (int k = 0; k < 3; ++k) normals.row(mesh.triangles(t, k)) += normal;
    }
    for (Index v = 0; v < normals.rows(); ++v) normals.row(v).stableNormalize();
    return normals;
}

double mean_edge_length(const TriangleMesh& mesh) {
    double sum = 0;
    Index count = 0;
    for_each_edge(sorted_half_edges(mesh.triangles), [&](auto first, auto) {
        sum += (mesh.vertices.row(first->low) - mesh.vertices.row(first->high)).norm();
        ++count;
    });
    return count ? sum / count : 0;
}

int euler_characteristic(const TriangleMesh& mesh) {
    const EdgeTopology topology = edge_topology(mesh);
    std::vector<bool> used(mesh.vertices.rows(), false);
    for (const Index v : mesh.triangles.reshaped()) used[v] = true;
    const auto vertices = std::count(used.begin(), used.end(), true);
    return static_cast<int>(vertices - topology.edges.rows() + mesh.triangles.rows());
}

}  // namespace octafield::surface
