#include "octafield/volume/tet_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "flat_tets.hpp"
#include "octafield/error.hpp"
#include "octafield/volume/triangle_table.hpp"
#include "surface_of_tets.hpp"

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
    return surface_of_tets(mesh, triangle_table(mesh), {}).surface;
}

void require_valid(const TetMesh& mesh) {
    if (mesh.tets.rows() == 0) throw GeometryError("the mesh has no tets; give a tet mesh with at least one", "empty");
    require_indices_in_range(mesh);
    require_finite(mesh);
    throw_if_any(flat_tets(mesh, rounding_of_volumes), "inverted_tet", "tets have no positive volume",
                 "swap two vertices of an inverted tet, remove or remesh flat ones");
}

}  // namespace octafield::volume
