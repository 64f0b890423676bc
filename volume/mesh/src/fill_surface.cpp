#include "fill_surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "flat_tets.hpp"
#include "octafield/error.hpp"
#include "octafield/volume/triangle_table.hpp"

namespace octafield::volume {
namespace {

using surface::TriangleMesh;

// Whether some connected component encloses negative volume, as the surface of a cavity does.
bool has_cavity(const TriangleMesh& mesh) {
    std::vector<Index> root(mesh.vertices.rows());
    for (std::size_t v = 0; v < root.size(); ++v) root[v] = static_cast<Index>(v);
    const auto find = [&](Index v) {
        while (root[v] != v) v = root[v] = root[root[v]];
        return v;
    };
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
        for (int k = 0; k < 2; ++k) root[find(mesh.triangles(t, k))] = find(mesh.triangles(t, k + 1));
    std::vector<double> volume(root.size(), 0);
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
        const Index component = find(mesh.triangles(t, 0));
        const auto p = [&](int k) {
            return Eigen::Vector3d(mesh.vertices.row(mesh.triangles(t, k)) - mesh.vertices.row(component));
        };
        volume[component] += p(0).dot(p(1).cross(p(2)));
    }
    return std::any_of(volume.begin(), volume.end(), [](double v) { return v < 0; });
}

// The triangle with its lowest vertex first, orientation kept.
std::array<Index, 3> lowest_first(Index a, Index b, Index c) {
    if (a < b && a < c) return {a, b, c};
    return b < c ? std::array<Index, 3>{b, c, a} : std::array<Index, 3>{c, a, b};
}

std::vector<std::array<Index, 3>> oriented_triangles(const Triangles& triangles) {
    std::vector<std::array<Index, 3>> sorted(triangles.rows());
    for (Eigen::Index t = 0; t < triangles.rows(); ++t)
        sorted[t] = lowest_first(triangles(t, 0), triangles(t, 1), triangles(t, 2));
    std::sort(sorted.begin(), sorted.end());
    return sorted;
}

void orient(TetMesh& mesh) {
    const Eigen::VectorXd volumes = tet_volumes(mesh);
    for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t)
        if (volumes[t] < 0) std::swap(mesh.tets(t, 2), mesh.tets(t, 3));
}

TetMesh run_checked(const TriangleMesh& mesh, const TetgenParameters& parameters, const Progress& progress) {
    TetgenOutcome outcome = run_tetgen(mesh, parameters, progress);
    if (!outcome.finished) throw Failed{outcome.reason};
    TetMesh& result = outcome.mesh;
    if (result.tets.rows() == 0) throw Failed{"it found no interior"};
    if (result.vertices.rows() < mesh.vertices.rows() || result.vertices.topRows(mesh.vertices.rows()) != mesh.vertices)
        throw Failed{"it did not keep the surface's vertices"};
    orient(result);
    return std::move(result);
}

// One point inside each cavity: the regions of the filled convex hull that touch the outer side of the surface. The
// centroid of a region's largest tet is as far inside as any.
std::vector<Eigen::Vector3d> cavity_points(const TriangleMesh& mesh, const Progress& progress) {
    TetgenParameters fill_only;
    fill_only.refine = false;
    const TetMesh filled = run_checked(mesh, fill_only, progress);
    const TriangleTable table = triangle_table(filled);
    const auto outward = oriented_triangles(mesh.triangles);
    const auto on_surface = [&](Index a, Index b, Index c) {
        return std::binary_search(outward.begin(), outward.end(), lowest_first(a, b, c));
    };
    const Eigen::VectorXd volumes = tet_volumes(filled);
    std::vector<std::uint8_t> seen(filled.tets.rows(), 0);
    std::vector<Eigen::Vector3d> points;
    for (Index seed = 0; seed < filled.tets.rows(); ++seed) {
        if (seen[seed]) continue;
        bool outside = false;
        Index largest = seed;
        std::vector<Index> stack{seed};
        seen[seed] = 1;
        while (!stack.empty()) {
            const Index tet = stack.back();
            stack.pop_back();
            if (volumes[tet] > volumes[largest]) largest = tet;
            for (int k = 0; k < 4; ++k) {
                const auto corner = [&](int i) { return filled.tets(tet, tet_face[k][i]); };
                const bool inner_side = on_surface(corner(0), corner(1), corner(2));
                const bool outer_side = on_surface(corner(0), corner(2), corner(1));
                outside = outside || outer_side;
                const auto sides = table.sides.row(table.tet_triangles(tet, k));
                if (inner_side || outer_side || sides[1] < 0) continue;
                const Index other = sides[0] / 4 == tet ? sides[1] / 4 : sides[0] / 4;
                if (!seen[other]) stack.push_back(other);
                seen[other] = 1;
            }
        }
        if (!outside) continue;
        Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
        for (int k = 0; k < 4; ++k) centroid += filled.vertices.row(filled.tets(largest, k)).transpose() / 4;
        points.push_back(centroid);
    }
    return points;
}

void require_surface_kept(const TetMesh& result, const TriangleMesh& mesh) {
    if (!flat_tets(result, flat_for_tetgen).empty()) throw Failed{"it left tets without volume"};
    BoundarySurface boundary;
    try {
        boundary = boundary_surface(result);
    } catch (const GeometryError&) {  // folded tets
        throw Failed{"its tets overlap"};
    }
    Triangles triangles = boundary.mesh.triangles;
    for (Index& v : triangles.reshaped()) v = boundary.vertex_map[v];
    if (oriented_triangles(triangles) != oriented_triangles(mesh.triangles))
        throw Failed{
            "the boundary of its mesh is not the surface given; components may lie inside one another without being a "
            "cavity"};
}

Eigen::Matrix3d turn() {
    return Eigen::AngleAxisd(0.7316, Eigen::Vector3d(0.3713, -0.6127, 0.6977).normalized()).toRotationMatrix();
}

}  // namespace

const std::vector<Attempt>& attempts() {
    static const std::vector<Attempt> all = {
        {"", false, 0, 1, 1},
        {"turned in space", true, 0, 1, 1},
        {"with a tolerance of 1e-12 for coplanar points", false, 1e-12, 1, 1},
        {"with slightly other bounds on shape and size", false, 0, 1.1, 0.8},
        {"turned in space, with slightly other bounds on shape and size", true, 1e-10, 1.2, 1.25},
        {"with wide bounds on the shape of tets", false, 1e-6, 1.6, 1},
    };
    return all;
}

TetMesh fill_surface(const TriangleMesh& mesh, const TetgenParameters& asked, const Attempt& attempt,
                     const Progress& progress) {
    TetgenParameters parameters = asked;
    parameters.tolerance = attempt.tolerance;
    parameters.radius_edge_ratio *= attempt.ratio_factor;
    parameters.max_volume *= attempt.volume_factor;
    TriangleMesh turned = mesh;
    if (attempt.turned) turned.vertices = mesh.vertices * turn().transpose();
    if (has_cavity(turned)) parameters.holes = cavity_points(turned, progress);
    TetMesh result = run_checked(turned, parameters, progress);
    require_surface_kept(result, turned);
    if (attempt.turned) {
        result.vertices = (result.vertices * turn()).eval();
        result.vertices.topRows(mesh.vertices.rows()) = mesh.vertices;
    }
    try {
        require_valid(result);
    } catch (const GeometryError&) {
        throw Failed{"it made tets without volume"};
    }
    return result;
}

}  // namespace octafield::volume
