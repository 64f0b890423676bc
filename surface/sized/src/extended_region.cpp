#include "octafield/surface/extended_region.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesher_no_edge_refinement_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <Eigen/Geometry>
#include <cmath>

#include "alignment.hpp"
#include "octafield/disjoint_sets.hpp"
#include "octafield/error.hpp"
#include "size_checks.hpp"
#include "vertex_laplacian.hpp"

namespace octafield::surface {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
// Info: the vertex of the extended mesh, -1 for a new one.
struct Number {
    Index value = -1;
};
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<Number, Kernel>;
using Structure2 = CGAL::Triangulation_data_structure_2<VertexBase, CGAL::Delaunay_mesh_face_base_2<Kernel>>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure2>;
using Criteria = CGAL::Delaunay_mesh_size_criteria_2<Triangulation>;
using Mesher = CGAL::Delaunay_mesher_no_edge_refinement_2<Triangulation, Criteria>;

constexpr double flatness = 1e-9;      // of the region's size
constexpr double shape_bound = 0.125;  // CGAL's: least angles of 20.7 degrees

// Coordinates in the region's plane.
struct Plane {
    Eigen::RowVector3d origin, x, y;

    explicit Plane(const SurfaceDomain& region) {
        const TriangleMesh& mesh = region.mesh();
        const auto corners = mesh.triangles.row(0);
        origin = mesh.vertices.row(corners[0]);
        const Eigen::RowVector3d normal = region.normals().row(0);
        x = (mesh.vertices.row(corners[1]) - origin).normalized();
        y = Eigen::Vector3d(normal).cross(Eigen::Vector3d(x)).transpose();
        std::vector<Index> off;
        for (const auto& fan : region.fans().fans)
            if (std::abs((mesh.vertices.row(fan.vertex) - origin).dot(normal)) > flatness * region.size())
                off.push_back(fan.vertex);
        for (Index t = 0; t < region.triangle_count(); ++t)
            if (region.normals().row(t).dot(normal) < 0) off.push_back(mesh.triangles(t, 0));
        if (!off.empty())
            throw InvalidInput("only a plane region can be extended, all triangles seen from the same side; vertices " +
                                   first_few(off) + " are off the plane or of triangles that face away",
                               "not_plane", off);
    }
    Eigen::Vector2d flat(const Eigen::RowVector3d& p) const { return {(p - origin).dot(x), (p - origin).dot(y)}; }
    Eigen::RowVector3d lifted(double u, double v) const { return origin + u * x + v * y; }
};

class Extension {
public:
    Extension(const SurfaceDomain& region, double margin, double longest) : region_(region), plane_(region) {
        add_boundary();
        add_frame(margin, longest);
        std::vector<Triangulation::Point> seeds = inner_points();
        Mesher mesher(triangulation_, Criteria(shape_bound, longest));
        mesher.set_seeds(seeds.begin(), seeds.end());
        mesher.refine_mesh();
    }

    ExtendedRegion result() {
        const TriangleMesh& given = region_.mesh();
        std::vector<Eigen::RowVector3d> points;
        std::vector<Eigen::RowVector3i> triangles;
        Index count = static_cast<Index>(given.vertices.rows());
        for (const auto& face : triangulation_.finite_face_handles()) {
            if (!face->is_in_domain()) continue;
            Eigen::RowVector3i corners;
            for (int k = 0; k < 3; ++k) {
                Index& number = face->vertex(k)->info().value;
                if (number < 0) {
                    number = count++;
                    points.push_back(plane_.lifted(face->vertex(k)->point().x(), face->vertex(k)->point().y()));
                }
                corners[k] = number;
            }
            triangles.push_back(corners);
        }
        ExtendedRegion extended;
        extended.vertices = static_cast<Index>(given.vertices.rows());
        extended.triangles = static_cast<Index>(given.triangles.rows());
        extended.mesh.vertices.resize(count, 3);
        extended.mesh.vertices.topRows(extended.vertices) = given.vertices;
        for (std::size_t i = 0; i < points.size(); ++i)
            extended.mesh.vertices.row(extended.vertices + static_cast<Index>(i)) = points[i];
        extended.mesh.triangles.resize(extended.triangles + static_cast<Index>(triangles.size()), 3);
        extended.mesh.triangles.topRows(extended.triangles) = given.triangles;
        for (std::size_t i = 0; i < triangles.size(); ++i)
            extended.mesh.triangles.row(extended.triangles + static_cast<Index>(i)) = triangles[i];
        return extended;
    }

private:
    Triangulation::Vertex_handle insert(Index v) {
        const Eigen::Vector2d p = plane_.flat(region_.mesh().vertices.row(v));
        low_ = low_.cwiseMin(p);
        high_ = high_.cwiseMax(p);
        const auto handle = triangulation_.insert({p.x(), p.y()});
        handle->info().value = v;
        return handle;
    }

    void add_boundary() {
        const EdgeTopology& topology = region_.topology();
        for (Index e = 0; e < region_.edge_count(); ++e) {
            if (topology.edge_triangles.row(e).minCoeff() >= 0) continue;
            const auto one = insert(topology.edges(e, 0)), other = insert(topology.edges(e, 1));
            triangulation_.insert_constraint(one, other);
        }
    }

    // Its sides in equal parts, which the mesher does not split.
    void add_frame(double margin, double longest) {
        const Eigen::Vector2d low = low_.array() - margin, high = high_.array() + margin;
        const std::array<Eigen::Vector2d, 4> corners{low, Eigen::Vector2d(high.x(), low.y()), high,
                                                     Eigen::Vector2d(low.x(), high.y())};
        std::vector<Triangulation::Vertex_handle> frame;
        for (int k = 0; k < 4; ++k) {
            const Eigen::Vector2d side = corners[(k + 1) % 4] - corners[k];
            const int parts = std::max(1, static_cast<int>(std::ceil(side.norm() / longest)));
            for (int i = 0; i < parts; ++i) {
                const Eigen::Vector2d p = corners[k] + side * i / parts;
                frame.push_back(triangulation_.insert({p.x(), p.y()}));
            }
        }
        for (std::size_t i = 0; i < frame.size(); ++i)
            triangulation_.insert_constraint(frame[i], frame[(i + 1) % frame.size()]);
    }

    // One in each connected part of the region: what is not to be meshed.
    std::vector<Triangulation::Point> inner_points() const {
        const Triangles& triangles = region_.mesh().triangles;
        DisjointSets parts(region_.triangle_count());
        for (const auto beside : region_.topology().edge_triangles.rowwise())
            if (beside.minCoeff() >= 0) parts.join(beside[0], beside[1]);
        std::vector<Triangulation::Point> points;
        for (Index t = 0; t < region_.triangle_count(); ++t) {
            if (parts.lowest(t) != t) continue;
            Eigen::Vector2d middle = Eigen::Vector2d::Zero();
            for (const Index v : triangles.row(t)) middle += plane_.flat(region_.mesh().vertices.row(v)) / 3;
            points.emplace_back(middle.x(), middle.y());
        }
        return points;
    }

    const SurfaceDomain& region_;
    Plane plane_;
    Triangulation triangulation_;
    Eigen::Vector2d low_ = Eigen::Vector2d::Constant(INFINITY), high_ = Eigen::Vector2d::Constant(-INFINITY);
};

}  // namespace

ExtendedRegion extended_region(const SurfaceDomain& region, double margin, double longest) {
    detail::require_in_space(region);
    if (region.triangle_count() == 0) throw GeometryError("the region has no triangles", "empty");
    if (!(margin >= 0 && std::isfinite(margin)) || !(longest >= 0 && std::isfinite(longest)))
        throw InvalidInput("margin and longest must be lengths, or 0 for their defaults", "bad_option");
    if (margin == 0) margin = region.size() / 2;
    if (longest == 0) longest = margin / 4;
    if (margin < flatness * region.size() || longest < 1e-4 * (region.size() + margin))
        throw InvalidInput("margin or longest is too small against the region to mesh what is round it", "bad_option");
    return Extension(region, margin, longest).result();
}

Eigen::VectorXd extended_sizes(const ExtendedRegion& region, const Eigen::VectorXd& lengths) {
    detail::require_lengths(lengths, region.vertices, "vertex");
    if (region.vertices > region.mesh.vertices.rows() || region.triangles > region.mesh.triangles.rows() ||
        region.triangles < 0)
        throw InvalidInput("the mesh has fewer vertices or triangles than its region", "wrong_mesh");
    TriangleMesh outside = region.mesh;
    outside.triangles = region.mesh.triangles.bottomRows(region.mesh.triangles.rows() - region.triangles);
    const SurfaceDomain domain(outside);
    std::vector<bool> held(domain.vertex_count(), true);
    for (const auto& fan : domain.fans().fans) held[fan.vertex] = fan.vertex < region.vertices;
    Eigen::VectorXd logs = Eigen::VectorXd::Zero(domain.vertex_count());
    logs.head(region.vertices) = lengths.array().log();
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(domain.vertex_count());
    Eigen::VectorXd sizes = detail::VertexLaplacian(domain, held).solve(none, logs).array().exp();
    sizes.head(region.vertices) = lengths;
    return sizes;
}

DirectionField restricted_field(const DirectionField& field, const SurfaceDomain& region) {
    if (field.values.size() != field.domain.edge_count())
        throw InvalidInput("the direction field must have one value per edge", "wrong_size");
    DirectionField result;
    result.symmetry = field.symmetry;
    result.domain = region;
    result.epsilon = field.epsilon;
    result.converged = field.converged;
    result.iterations = field.iterations;
    result.values.resize(region.edge_count());
    const Edges& edges = region.topology().edges;
    for (Index e = 0; e < result.values.size(); ++e) {
        const Index same = detail::find_edge(field.domain.topology(), edges(e, 0), edges(e, 1));
        if (same < 0)
            throw InvalidInput("the region has an edge, " + std::to_string(edges(e, 0)) + "-" +
                                   std::to_string(edges(e, 1)) + ", that the field's mesh does not have",
                               "wrong_mesh");
        result.values[e] = field.values[same];
    }
    return result;
}

}  // namespace octafield::surface
