#include "checks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace octafield::bindings {

namespace {

using Text = std::string;

// Throws when `bad(i)` holds for some i in [0, n), with all such ids.
template <class Bad>
void require_none(std::int64_t n, const Bad& bad, std::string_view name, std::string_view what, const char* kind) {
    std::vector<Index> ids;
    for (std::int64_t i = 0; i < n; ++i)
        if (bad(i)) ids.push_back(static_cast<Index>(i));
    if (!ids.empty()) throw InvalidInput(Text(name) + ": " + Text(what) + " in row " + first_few(ids), kind, ids);
}

template <class Matrix>
void require_finite(const Matrix& matrix, std::string_view name) {
    require_none(
        matrix.rows(), [&](auto i) { return !matrix.row(i).allFinite(); }, name, "a value is not finite", "non_finite");
}

template <class Matrix>
void require_ids(const Matrix& ids, std::int64_t count, std::string_view name, Index least = 0) {
    require_none(
        ids.rows(), [&](auto i) { return (ids.row(i).array() < least).any() || (ids.row(i).array() >= count).any(); },
        name, "an id outside [" + std::to_string(least) + ", " + std::to_string(count) + ")", "index_out_of_range");
}

void require_ids(const std::vector<Index>& ids, std::int64_t count, std::string_view name) {
    require_ids(
        Eigen::Map<const Eigen::Matrix<Index, Eigen::Dynamic, 1>>(ids.data(), static_cast<Eigen::Index>(ids.size())),
        count, name);
}

void require_rows(std::int64_t rows, std::int64_t expected, std::string_view name, std::string_view per) {
    if (rows == expected) return;
    throw InvalidInput(Text(name) + ": " + std::to_string(rows) + " rows, expected " + std::to_string(expected) +
                           ", one per " + Text(per),
                       "wrong_shape");
}

void require_known(const std::vector<volume::VertexConstraint>& kinds, std::string_view name) {
    require_none(
        static_cast<std::int64_t>(kinds.size()), [&](auto i) { return !volume::is_known(kinds[i]); }, name,
        "a value above " + std::to_string(volume::ConstraintKinds::info.size() - 1) + " (" + volume::listed_kinds() +
            ")",
        "unknown_word");
}

std::pair<Index, Index> ordered(Index a, Index b) { return std::minmax(a, b); }

std::vector<std::pair<Index, Index>> sorted_edges(const surface::TriangleMesh& mesh) {
    std::vector<std::pair<Index, Index>> edges;
    edges.reserve(3 * mesh.triangles.rows());
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k) edges.push_back(ordered(mesh.triangles(t, k), mesh.triangles(t, (k + 1) % 3)));
    std::sort(edges.begin(), edges.end());
    return edges;
}

}  // namespace

double finite(double value, std::string_view name) {
    if (!std::isfinite(value)) throw InvalidInput(Text(name) + ": not a finite number", "non_finite");
    return value;
}

int threads_option(int threads) {
    if (threads < 0)
        throw InvalidInput("threads: " + std::to_string(threads) + "; use 0 for all, or a positive number",
                           "option_out_of_range");
    return threads;
}

void check(const surface::TriangleMesh& mesh, bool require_elements) {
    require_finite(mesh.vertices, "vertices");
    require_ids(mesh.triangles, mesh.vertices.rows(), "triangles");
    if (require_elements && mesh.triangles.rows() == 0) throw InvalidInput("triangles: the mesh has none", "empty");
}

void check(const volume::TetMesh& mesh, bool require_elements) {
    require_finite(mesh.vertices, "vertices");
    require_ids(mesh.tets, mesh.vertices.rows(), "tets");
    if (require_elements && mesh.tets.rows() == 0) throw InvalidInput("tets: the mesh has none", "empty");
}

void check_edges(const Edges& edges, const surface::TriangleMesh& mesh, std::string_view name) {
    require_ids(edges, mesh.vertices.rows(), name);
    if (edges.rows() == 0) return;
    const auto known = sorted_edges(mesh);
    const auto missing = [&](auto i) {
        return !std::binary_search(known.begin(), known.end(), ordered(edges(i, 0), edges(i, 1)));
    };
    require_none(edges.rows(), missing, name, "not an edge of the mesh", "not_an_edge");
}

void check(const surface::DirectionField& field) {
    if (field.symmetry < 1 || field.symmetry > surface::largest_symmetry)
        throw InvalidInput("field.symmetry: " + std::to_string(field.symmetry) + " is not in 1 .. " +
                               std::to_string(surface::largest_symmetry),
                           "option_out_of_range");
    require_rows(field.values.rows(), field.domain.edge_count(), "field.values", "edge of field.domain");
    require_none(
        field.values.rows(), [&](auto i) { return !std::isfinite(std::abs(field.values[i])); }, "field.values",
        "a value is not finite", "non_finite");
}

void check(const surface::DirectionConstraints& constraints, const surface::TriangleMesh& mesh) {
    const auto weights = [](const Eigen::VectorXd& given, std::int64_t rows, std::string_view name,
                            std::string_view per) {
        if (given.size() > 0) require_rows(given.size(), rows, name, per);
        require_none(
            given.size(), [&](auto i) { return !(given[i] > 0); }, name, "a weight that is not above 0",
            "option_out_of_range");
    };
    const auto edges = constraints.edges.rows();
    const auto vertices = static_cast<std::int64_t>(constraints.vertices.size());
    check_edges(constraints.edges, mesh, "constraints.edges");
    require_ids(constraints.vertices, mesh.vertices.rows(), "constraints.vertices");
    check_vectors(constraints.edge_directions, edges, "constraints.edge_directions", "edge");
    check_vectors(constraints.vertex_directions, vertices, "constraints.vertex_directions", "vertex");
    weights(constraints.edge_weights, edges, "constraints.edge_weights", "edge");
    weights(constraints.vertex_weights, vertices, "constraints.vertex_weights", "vertex");
}

void check(const surface::DirectionGuide& guide, const surface::TriangleMesh& mesh) {
    finite(guide.length, "guide.length");
    if (guide.directions.rows() == 0 && guide.weights.size() == 0) return;
    check_vectors(guide.directions, mesh.triangles.rows(), "guide.directions", "triangle");
    if (guide.weights.size() == 0) return;
    require_rows(guide.weights.size(), mesh.triangles.rows(), "guide.weights", "triangle");
    require_finite(guide.weights, "guide.weights");
}

void check(const surface::SurfaceSingularities& singularities, const surface::TriangleMesh& mesh) {
    // Inside a triangle a linear interpolant turns once at most; some room for points that stand for several.
    constexpr int most_turns = 1000;
    const auto near = [&](const Eigen::Vector3d& position, Index triangle) {  // no farther than its longest side
        const Eigen::Matrix3d corners = mesh.vertices(mesh.triangles.row(triangle), Eigen::all);
        const double reach = (corners.rowwise() - corners.row(0)).rowwise().norm().maxCoeff();
        return (position - corners.colwise().mean().transpose()).norm() <= reach;
    };
    const double diagonal = surface::bounding_box_diagonal(mesh.vertices);
    const auto at = [&](const Eigen::Vector3d& position, Index vertex) {
        return (position - mesh.vertices.row(vertex).transpose()).norm() <= 1e-6 * diagonal;
    };
    const auto lost = [&](auto i) {
        const auto& p = singularities.points[i];
        const bool at_vertex = p.vertex >= 0 && p.vertex < mesh.vertices.rows() && at(p.position, p.vertex);
        const bool in_triangle = p.vertex == -1 && p.triangle >= 0 && p.triangle < mesh.triangles.rows() &&
                                 p.index_times_symmetry >= -most_turns && p.index_times_symmetry <= most_turns &&
                                 near(p.position, p.triangle);
        return !p.position.allFinite() || !(at_vertex || in_triangle);
    };
    require_none(static_cast<std::int64_t>(singularities.points.size()), lost, "singularities.points",
                 "a point that is not on the mesh", "wrong_mesh");
}

void check(const volume::BoundarySurface& boundary, Index vertex_count) {
    check(boundary.mesh, false);
    const auto& map = boundary.vertex_map;
    require_rows(static_cast<std::int64_t>(map.size()), boundary.mesh.vertices.rows(), "boundary.vertex_map",
                 "boundary vertex");
    require_ids(map, vertex_count, "boundary.vertex_map");
    const auto disordered = [&](auto i) { return i > 0 && map[i] <= map[i - 1]; };
    require_none(boundary.mesh.vertices.rows(), disordered, "boundary.vertex_map", "ids do not ascend",
                 "not_ascending");
}

void check(volume::BoundaryConstraints& constraints, Index vertex_count) {
    const auto& kind = constraints.kind;
    require_rows(static_cast<std::int64_t>(kind.size()), vertex_count, "constraints.kind", "vertex");
    require_rows(static_cast<std::int64_t>(constraints.on_boundary.size()), vertex_count, "constraints.on_boundary",
                 "vertex");
    require_known(kind, "constraints.kind");
    check_vectors(constraints.axis, vertex_count, "constraints.axis");
    const auto no_axis = [&](auto i) {
        return volume::info(kind[i]).takes_axis && std::abs(constraints.axis.row(i).norm() - 1) > 1e-6;
    };
    require_none(vertex_count, no_axis, "constraints.axis", "not of unit length where the kind takes an axis",
                 "not_unit");
    check_unit(constraints.frames, vertex_count, "constraints.frames");
    require_ids(constraints.released_corners, vertex_count, "constraints.released_corners");
    if (constraints.lengths.rows() > 0) check_vectors(constraints.lengths, vertex_count, "constraints.lengths");
}

void check(const volume::VertexConstraints& constraints) { require_known(constraints.kinds, "constraints.kinds"); }

void check(const volume::SingularGraph& graph) {
    require_finite(graph.points, "graph.points");
    for (const auto& curve : graph.curves) require_ids(curve, graph.points.rows(), "graph.curves");
    require_ids(graph.nodes, graph.points.rows(), "graph.nodes");
    require_rows(static_cast<std::int64_t>(graph.curve_quarter_turns.size()),
                 static_cast<std::int64_t>(graph.curves.size()), "graph.curve_quarter_turns", "curve");
    if (graph.points.rows() < static_cast<std::int64_t>(graph.triangles.size()))
        throw InvalidInput("graph.points: fewer rows than singular triangles", "wrong_shape");
}

void check_vectors(const Points& vectors, std::int64_t rows, std::string_view name, std::string_view per) {
    require_rows(vectors.rows(), rows, name, per);
    require_finite(vectors, name);
}

void check_unit(Quaternions& quaternions, std::int64_t rows, std::string_view name) {
    if (rows >= 0) require_rows(quaternions.rows(), rows, name, "vertex");
    for (Eigen::Index i = 0; i < quaternions.rows(); ++i) {
        const double length = quaternions.row(i).norm();
        if (!(std::abs(length - 1) <= 1e-6))
            throw InvalidInput(Text(name) + ": row " + std::to_string(i) + " has length " + std::to_string(length) +
                                   "; quaternions (w, x, y, z) must be unit within 1e-6: divide each row by its length",
                               "not_unit", {static_cast<Index>(i)});
        constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
        if (std::abs(length - 1) > rounding) quaternions.row(i) /= length;  // else all bits stay
    }
}

}  // namespace octafield::bindings
