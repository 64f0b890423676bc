#include <cmath>

#include "octafield/error.hpp"
#include "place_points.hpp"

namespace octafield::volume::detail {
namespace {

// Of weights that count as exact: rounding of what was normalized by somebody else.
constexpr double weight_rounding = 1e-9;

template <class Bad>
std::vector<Index> where(Index count, const Bad& bad) {
    std::vector<Index> found;
    for (Index i = 0; i < count; ++i)
        if (bad(i)) found.push_back(i);
    return found;
}

template <class Kind = InvalidInput>
void throw_if_any(const std::vector<Index>& bad, const char* kind, const std::string& what, const std::string& remedy) {
    if (!bad.empty()) throw Kind(what + " (" + first_few(bad) + "); " + remedy, kind, bad);
}

void require_size(const std::string& what, Eigen::Index given, Eigen::Index wanted, const std::string& of) {
    if (given != wanted)
        throw InvalidInput(what + ": " + std::to_string(given) + " are given for " + std::to_string(wanted) + " " + of,
                           "wrong_size");
}

void require_mesh(const surface::TriangleMesh& mesh) {
    const Index vertices = static_cast<Index>(mesh.vertices.rows()), n = static_cast<Index>(mesh.triangles.rows());
    throw_if_any(where(n,
                       [&](Index t) {
                           return mesh.triangles.row(t).minCoeff() < 0 || mesh.triangles.row(t).maxCoeff() >= vertices;
                       }),
                 "index_out_of_range", "triangles name vertices that the mesh does not have",
                 "vertex ids count from 0 to " + std::to_string(vertices - 1));
    throw_if_any(where(vertices, [&](Index v) { return !mesh.vertices.row(v).allFinite(); }), "not_finite",
                 "vertices have coordinates that are not finite", "correct or remove them");
    const auto flat = [&](Index t) {
        const auto corner = [&](int k) -> Eigen::Vector3d { return mesh.vertices.row(mesh.triangles(t, k)); };
        const Eigen::Vector3d a = corner(1) - corner(0), b = corner(2) - corner(0);
        const double area = a.cross(b).norm();
        return !(area > 0 && area > 1e-14 * (a.squaredNorm() + b.squaredNorm()));
    };
    throw_if_any<GeometryError>(
        where(n, flat), "degenerate_triangle", "triangles of no area",
        "they have no normal that new ones could be compared with: collapse their shortest edges");
}

void require_points(const surface::TriangleMesh& mesh, const SurfacePoints& points) {
    require_size("weights", points.weights.rows(), static_cast<Eigen::Index>(points.triangle.size()), "points");
    const Index n = static_cast<Index>(points.triangle.size());
    throw_if_any(
        where(n, [&](Index p) { return points.triangle[p] < 0 || points.triangle[p] >= mesh.triangles.rows(); }),
        "index_out_of_range", "points lie in triangles that the mesh does not have",
        "it has " + std::to_string(mesh.triangles.rows()) + ", numbered from 0");
    const auto bad = [&](Index p) {
        const auto w = points.weights.row(p);
        return !w.allFinite() || w.minCoeff() < 0 || std::abs(w.sum() - 1) > weight_rounding;
    };
    throw_if_any(where(n, bad), "invalid_weights", "points have weights that are no place in a triangle",
                 "weights must be >= 0 and add up to 1");
}

void require_quads(const Quads& quads, Index points) {
    const Index n = static_cast<Index>(quads.rows());
    throw_if_any(where(n, [&](Index q) { return quads.row(q).minCoeff() < 0 || quads.row(q).maxCoeff() >= points; }),
                 "index_out_of_range", "quads name points that are not given",
                 "there are " + std::to_string(points) + ", numbered from 0");
    const auto repeats = [&](Index q) {
        for (int i = 0; i < 4; ++i)
            for (int k = 0; k < i; ++k)
                if (quads(q, i) == quads(q, k)) return true;
        return false;
    };
    throw_if_any(where(n, repeats), "repeated_vertex", "quads use a point twice", "a quad has four different corners");
}

}  // namespace

void require_usable(const surface::TriangleMesh& mesh, const std::vector<Index>& groups, const SurfacePoints& points,
                    const Quads& quads, double edge_length) {
    require_mesh(mesh);
    require_size("groups", static_cast<Eigen::Index>(groups.size()), mesh.triangles.rows(), "triangles");
    require_points(mesh, points);
    require_quads(quads, static_cast<Index>(points.triangle.size()));
    if (!(edge_length > 0) || !std::isfinite(edge_length))
        throw InvalidInput("edge_length must be a finite number above 0", "invalid_option");
}

}  // namespace octafield::volume::detail
