#include "octafield/volume/tet_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "flat_tets.hpp"
#include "octafield/error.hpp"
#include "triangle_table.hpp"

namespace octafield::volume {
namespace {

double tet_volume(const TetMesh& mesh, Eigen::Index t) {
    const auto p = [&](int k) { return Eigen::Vector3d(mesh.vertices.row(mesh.tets(t, k))); };
    return (p(1) - p(0)).dot((p(2) - p(0)).cross(p(3) - p(0))) / 6;
}

void throw_if_any(const std::vector<Index>& ids, const char* kind, const std::string& what, const std::string& remedy) {
    if (!ids.empty()) throw GeometryError(what + " (" + first_few(ids) + "); " + remedy, kind, ids);
}

void require_indices_in_range(const TetMesh& mesh) {
    std::vector<Index> bad;
    for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t)
        if (mesh.tets.row(t).minCoeff() < 0 || mesh.tets.row(t).maxCoeff() >= mesh.vertices.rows())
            bad.push_back(static_cast<Index>(t));
    throw_if_any(bad, "index_out_of_range", "tets refer to vertices that do not exist",
                 "vertex ids count from 0 to " + std::to_string(mesh.vertices.rows() - 1));
}

void require_finite(const TetMesh& mesh) {
    std::vector<Index> bad;
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
        if (!mesh.vertices.row(v).allFinite()) bad.push_back(static_cast<Index>(v));
    throw_if_any(bad, "non_finite_vertex", "vertices have coordinates that are not finite", "correct or remove them");
}

}  // namespace

Eigen::VectorXd tet_volumes(const TetMesh& mesh) {
    Eigen::VectorXd volumes(mesh.tets.rows());
    for (Eigen::Index t = 0; t < volumes.size(); ++t) volumes[t] = tet_volume(mesh, t);
    return volumes;
}

std::vector<Index> flat_tets(const TetMesh& mesh, double least) {
    std::vector<Index> flat;
    for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t) {
        const auto p = [&](int k) { return mesh.vertices.row(mesh.tets(t, k)); };
        double longest = 0;  // squared
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < i; ++j) longest = std::max(longest, (p(i) - p(j)).squaredNorm());
        if (!(6 * tet_volume(mesh, t) > least * longest * std::sqrt(longest))) flat.push_back(static_cast<Index>(t));
    }
    return flat;
}

BoundarySurface boundary_surface(const TetMesh& mesh) {
    require_indices_in_range(mesh);
    const TriangleTable table = triangle_table(mesh);
    std::vector<Index> compact(mesh.vertices.rows(), -1);
    Eigen::Index count = 0;
    for (Eigen::Index t = 0; t < table.triangles.rows(); ++t)
        if (table.sides(t, 1) < 0) {
            ++count;
            for (int k = 0; k < 3; ++k) compact[table.triangles(t, k)] = 0;
        }

    BoundarySurface boundary;
    for (std::size_t v = 0; v < compact.size(); ++v)
        if (compact[v] == 0) {
            compact[v] = static_cast<Index>(boundary.vertex_map.size());
            boundary.vertex_map.push_back(static_cast<Index>(v));
        }
    boundary.mesh.vertices.resize(boundary.vertex_map.size(), 3);
    for (std::size_t b = 0; b < boundary.vertex_map.size(); ++b)
        boundary.mesh.vertices.row(b) = mesh.vertices.row(boundary.vertex_map[b]);

    boundary.mesh.triangles.resize(count, 3);
    Eigen::Index row = 0;
    for (Eigen::Index t = 0; t < table.triangles.rows(); ++t) {
        if (table.sides(t, 1) >= 0) continue;
        const Index tet = table.sides(t, 0) / 4;
        const auto& face = tet_face[table.sides(t, 0) % 4];
        for (int k = 0; k < 3; ++k) boundary.mesh.triangles(row, k) = compact[mesh.tets(tet, face[k])];
        ++row;
    }
    return boundary;
}

void require_valid(const TetMesh& mesh) {
    if (mesh.tets.rows() == 0) throw GeometryError("the mesh has no tets; give a tet mesh with at least one", "empty");
    require_indices_in_range(mesh);
    require_finite(mesh);
    throw_if_any(flat_tets(mesh, rounding_of_volumes), "inverted_tet", "tets have no positive volume",
                 "swap two vertices of an inverted tet, remove or remesh flat ones");
}

}  // namespace octafield::volume
