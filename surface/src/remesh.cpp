#include "octafield/surface/remesh.hpp"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>

#include "octafield/error.hpp"
#include "octafield/surface/validate.hpp"
#include "shells.hpp"
#include "short_number.hpp"
#include "surface_mesh.hpp"

namespace octafield::surface {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Point = Kernel::Point_3;
using Vertex = SurfaceMesh::Vertex_index;
using Edge = SurfaceMesh::Edge_index;
using Face = SurfaceMesh::Face_index;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_face_graph_triangle_primitive<SurfaceMesh>>>;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// The mesh in CGAL's hands, with what must survive marked on it.
struct Marked {
    SurfaceMesh mesh;
    SurfaceMesh::Property_map<Edge, bool> feature;
    SurfaceMesh::Property_map<Vertex, bool> corner;
    SurfaceMesh::Property_map<Face, int> patch;  // between features
    int patches = 0;
};

// Patches are numbered by their lowest face, so splitting edges does not change the numbers.
void number_patches(Marked& marked) {
    marked.patches = static_cast<int>(pmp::connected_components(
        marked.mesh, marked.patch, CGAL::parameters::edge_is_constrained_map(marked.feature)));
}

Marked mark(const TriangleMesh& mesh, const FeatureGraph& features) {
    Marked marked;
    if (!to_surface_mesh(mesh, marked.mesh))
        throw GeometryError("the surface is not an oriented manifold; validate and repair it first",
                            "non_manifold_edge");
    marked.feature = marked.mesh.add_property_map<Edge, bool>("e:feature", false).first;
    marked.corner = marked.mesh.add_property_map<Vertex, bool>("v:corner", false).first;
    marked.patch = marked.mesh.add_property_map<Face, int>("f:patch", 0).first;
    for (const auto edge : features.edges.rowwise())
        marked.feature[marked.mesh.edge(marked.mesh.halfedge(Vertex(edge[0]), Vertex(edge[1])))] = true;
    for (const Edge edge : marked.mesh.edges())
        if (marked.mesh.is_border(edge)) marked.feature[edge] = true;
    for (const Index v : features.corners) marked.corner[Vertex(v)] = true;
    number_patches(marked);
    return marked;
}

// Nearest point of the input's patch to which a vertex belongs, so that thin walls do not attract each other.
class Projection {
public:
    explicit Projection(const Marked& input) : trees_(input.patches) {
        std::vector<std::vector<Face>> faces(input.patches);
        for (const Face face : input.mesh.faces()) faces[input.patch[face]].push_back(face);
        for (int p = 0; p < input.patches; ++p)
            trees_[p] = std::make_unique<Tree>(faces[p].begin(), faces[p].end(), input.mesh);
    }
    Point operator()(const Marked& marked, Vertex v) const {
        return trees_[marked.patch[marked.mesh.face(marked.mesh.halfedge(v))]]->closest_point(marked.mesh.point(v));
    }

private:
    std::vector<std::unique_ptr<Tree>> trees_;
};

// `protect`: feature edges are split once before and then left alone, instead of being split and merged in every round.
void run_rounds(Marked& marked, const Projection& projection, double length, int rounds, bool protect,
                const Progress& progress) {
    if (protect) {
        std::vector<Edge> edges;
        for (const Edge edge : marked.mesh.edges())
            if (marked.feature[edge]) edges.push_back(edge);
        pmp::split_long_edges(edges, length, marked.mesh, CGAL::parameters::edge_is_constrained_map(marked.feature));
        number_patches(marked);
    }
    int calls = 0;
    const auto project = [&](Vertex v) {
        if (++calls % 1000 == 0) report_or_throw(progress, "remesh", -1, kNone);
        return projection(marked, v);
    };
    for (int round = 0; round < rounds; ++round) {
        report_or_throw(progress, "remesh", static_cast<double>(round) / rounds, kNone);
        pmp::isotropic_remeshing(marked.mesh.faces(), length, marked.mesh,
                                 CGAL::parameters::number_of_iterations(1)
                                     .edge_is_constrained_map(marked.feature)
                                     .vertex_is_constrained_map(marked.corner)
                                     .face_patch_map(marked.patch)
                                     .protect_constraints(protect)
                                     .projection_functor(project));
    }
}

RemeshResult to_arrays(Marked& marked) {
    for (const Vertex v : marked.mesh.vertices())
        if (marked.mesh.is_isolated(v)) marked.mesh.remove_vertex(v);
    marked.mesh.collect_garbage();
    const SurfaceMesh& mesh = marked.mesh;
    RemeshResult result;
    result.mesh.vertices.resize(mesh.number_of_vertices(), 3);
    result.mesh.triangles.resize(mesh.number_of_faces(), 3);
    for (const Vertex v : mesh.vertices()) {
        const Point& point = mesh.point(v);
        result.mesh.vertices.row(static_cast<Index>(v)) << point.x(), point.y(), point.z();
        if (marked.corner[v]) result.features.corners.push_back(static_cast<Index>(v));
    }
    for (const Face face : mesh.faces()) {
        int k = 0;
        for (const Vertex v : CGAL::vertices_around_face(mesh.halfedge(face), mesh))
            result.mesh.triangles(static_cast<Index>(face), k++) = static_cast<Index>(v);
    }
    std::vector<std::pair<Index, Index>> edges;
    for (const Edge edge : mesh.edges())
        if (marked.feature[edge])
            edges.push_back(
                std::minmax(static_cast<Index>(mesh.vertex(edge, 0)), static_cast<Index>(mesh.vertex(edge, 1))));
    std::ranges::sort(edges);
    result.features.edges.resize(edges.size(), 2);
    for (std::size_t i = 0; i < edges.size(); ++i) result.features.edges.row(i) << edges[i].first, edges[i].second;
    return result;
}

struct Topology {
    int euler = 0;
    Index pieces = 0;
    bool closed = true;
    bool operator==(const Topology&) const = default;
};

Topology topology_of(const TriangleMesh& mesh) {
    const std::vector<Index> piece = connected_pieces(mesh, sorted_half_edges(mesh.triangles));
    const EdgeTopology edges = edge_topology(mesh);
    return {euler_characteristic(mesh), *std::ranges::max_element(piece) + 1, edges.edge_triangles.minCoeff() >= 0};
}

// Why the result is unusable; none if it is sound.
std::optional<std::string> fault(const RemeshResult& result, const Topology& wanted) {
    const auto defects = find_defects(result.mesh, {.closed = wanted.closed});
    if (!defects.empty()) return defects.front().message.substr(0, defects.front().message.find("; "));
    if (topology_of(result.mesh) != wanted) return "holes or pieces of the surface were lost";
    return std::nullopt;
}

double checked_edge_length(const TriangleMesh& mesh, const RemeshOptions& options) {
    if (options.iterations < 1) throw InvalidInput("remeshing needs at least 1 iteration", "invalid_option");
    if (!(options.edge_length >= 0 && std::isfinite(options.edge_length)))
        throw InvalidInput("the target edge length must be positive, or 0 for 1/25 of the bounding-box diagonal",
                           "invalid_option");
    const double length = options.edge_length > 0 ? options.edge_length : bounding_box_diagonal(mesh.vertices) / 25;
    const double expected = triangle_areas(mesh).sum() / (std::numbers::sqrt3 / 4 * length * length), most = 5e7;
    if (expected > most)
        throw InvalidInput("a target edge length of " + short_number(length) + " would give about " +
                               short_number(expected) + " triangles; choose a larger one",
                           "invalid_option");
    return length;
}

}  // namespace

RemeshResult remesh(const TriangleMesh& mesh, const FeatureGraph& features, const RemeshOptions& options,
                    const Progress& progress) {
    report_or_throw(progress, "remesh", 0, kNone);
    require_valid(mesh, {.closed = false});
    feature_graph(mesh, features.edges);  // throws where they are no edges of the mesh
    for (const Index v : features.corners)
        if (v < 0 || v >= mesh.vertices.rows())
            throw InvalidInput("corner " + std::to_string(v) + " is no vertex of the mesh", "index_out_of_range", {v});
    const double length = checked_edge_length(mesh, options);
    const Topology topology = topology_of(mesh);
    const Marked input = mark(mesh, features);
    const Projection projection(input);
    std::string why;
    for (const bool protect : {false, true}) {
        try {
            Marked marked = mark(mesh, features);
            run_rounds(marked, projection, length, options.iterations, protect, progress);
            RemeshResult result = to_arrays(marked);
            const auto problem = fault(result, topology);
            if (!problem) return result;
            if (why.empty()) why = *problem;
        } catch (const CGAL::Failure_exception& failure) {
            if (why.empty()) why = failure.what();
        }
    }
    throw GeometryError("remeshing to edge length " + short_number(length) + " spoils the surface: " + why +
                            ". The target is too coarse for the shape; choose a smaller edge length",
                        "too_coarse");
}

}  // namespace octafield::surface
