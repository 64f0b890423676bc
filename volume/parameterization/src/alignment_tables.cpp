#include "octafield/volume/alignment_tables.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>

#include "axis_numbers.hpp"
#include "octafield/disjoint_sets.hpp"
#include "octafield/error.hpp"
#include "require_frames.hpp"

namespace octafield::volume {
namespace {

using frames::Vector3;
using Edge = std::pair<Index, Index>;

Index signed_axis(int number) { return number < 3 ? number + 1 : 2 - number; }
int axis_number(Index axis) { return axis > 0 ? axis - 1 : 2 - axis; }

// The nearest axis of a frame to a direction, and the angle between.
std::pair<Index, double> nearest(const Quaternions& frames, Index tet, const Vector3& direction) {
    const Vector3 in_frame = frames::from_wxyz(frames.row(tet)).conjugate() * direction;
    const int number = nearest_axis_number(in_frame);
    const Vector3 axis = axis_unit(number);
    return {signed_axis(number), std::atan2(axis.cross(in_frame).norm(), axis.dot(in_frame))};
}

// Matching per row of the table; 0 on the boundary.
std::vector<std::uint8_t> matchings_by_row(const TriangleTable& table, const FaceMatchings& faces) {
    std::vector<std::uint8_t> result(table.triangles.rows(), 0);
    std::size_t f = 0;
    bool same = true;
    for (Eigen::Index t = 0; t < table.triangles.rows(); ++t) {
        if (table.sides(t, 1) < 0) continue;
        same = same && f < faces.matching.size() && faces.matching[f] < frames::octahedral_order;
        if (same) result[t] = faces.matching[f];
        ++f;
    }
    if (!same || f != faces.matching.size())
        throw InvalidInput("the combed field has " + std::to_string(faces.matching.size()) +
                               " matchings for other triangles than the mesh has between tets, " + std::to_string(f) +
                               "; give what comb returns for this mesh",
                           "wrong_mesh");
    return result;
}

// A side of a triangle of the surface.
struct Side {
    Edge edge;  // of the surface, lower vertex first
    Index triangle;
    auto operator<=>(const Side&) const = default;
};

// Pairs of triangles of the surface at edges that are no features and have two of them.
std::vector<std::pair<Side, Side>> smooth_pairs(const surface::TriangleMesh& mesh, std::vector<Edge> features) {
    std::vector<Side> sides;
    for (Index f = 0; f < mesh.triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k)
            sides.push_back({std::minmax({mesh.triangles(f, k), mesh.triangles(f, (k + 1) % 3)}), f});
    std::sort(sides.begin(), sides.end());
    std::sort(features.begin(), features.end());
    std::vector<std::pair<Side, Side>> pairs;
    for (std::size_t i = 0, end; i < sides.size(); i = end) {
        for (end = i + 1; end < sides.size() && sides[end].edge == sides[i].edge;) ++end;
        if (end - i == 2 && !std::binary_search(features.begin(), features.end(), sides[i].edge))
            pairs.emplace_back(sides[i], sides[i + 1]);
    }
    return pairs;
}

// Carries axes round edges from triangle to triangle of the surface.
class Carrier {
public:
    Carrier(const TetMesh& mesh, const TriangleTable& table, const FaceMatchings& faces, const std::vector<Index>& rows)
        : mesh_(mesh), table_(table), matching_(matchings_by_row(table, faces)), on_surface_(matching_.size(), 0) {
        for (const Index row : rows) on_surface_[row] = 1;
    }

    // The axis of `tet`, behind the triangle `row`, in the last tet round the edge before the next triangle of the
    // surface.
    int carried(Index row, Index tet, const Edge& edge, int axis) const {
        for (;;) {
            row = next_row(row, tet, edge);
            if (on_surface_[row] || table_.sides(row, 1) < 0) return axis;
            const bool forward = table_.sides(row, 0) / 4 == tet;
            const int m = matching_[row];
            axis = turned_axis(forward ? frames::octahedral_inverse(m) : m, axis);
            tet = table_.sides(row, forward ? 1 : 0) / 4;
        }
    }

private:
    // The tet's other triangle at the edge.
    Index next_row(Index row, Index tet, const Edge& edge) const {
        for (int k = 0; k < 4; ++k) {
            const Index v = mesh_.tets(tet, k), other = table_.tet_triangles(tet, k);
            if (v != edge.first && v != edge.second && other != row) return other;
        }
        return row;
    }

    const TetMesh& mesh_;
    const TriangleTable& table_;
    std::vector<std::uint8_t> matching_, on_surface_;
};

void tell_triangles(const TetDomain& domain, const std::vector<Edge>& features, const CombedField& combed,
                    AlignmentTables& result) {
    const TetMesh& mesh = domain.mesh();
    const BoundarySurface& surface = domain.surface();
    const TriangleTable& table = domain.triangles();
    const std::vector<Index>& rows = domain.surface_rows();
    const Points normals = surface::triangle_normals(surface.mesh);
    const Index count = static_cast<Index>(rows.size());
    result.triangle_angle.resize(count);
    for (Index f = 0; f < count; ++f) {
        result.triangle_tet.push_back(domain.sides()(f, 0));
        const auto [axis, angle] = nearest(combed.frames, result.triangle_tet[f], normals.row(f).transpose());
        result.triangle_axis.push_back(axis);
        result.triangle_angle[f] = angle;
    }
    const auto pairs = smooth_pairs(surface.mesh, features);
    DisjointSets sets(count);
    for (const auto& [one, other] : pairs) sets.join(one.triangle, other.triangle);
    Index patches = 0;
    result.triangle_patch = std::move(sets).numbers(patches);
    result.patch_one_axis.assign(patches, 1);
    const Carrier carrier(mesh, table, combed.faces, rows);
    for (const auto& [one, other] : pairs) {
        const Edge edge{surface.vertex_map[one.edge.first], surface.vertex_map[one.edge.second]};
        const Index from = one.triangle, to = other.triangle;
        const int axis =
            carrier.carried(rows[from], result.triangle_tet[from], edge, axis_number(result.triangle_axis[from]));
        if (axis != axis_number(result.triangle_axis[to])) result.patch_one_axis[result.triangle_patch[from]] = 0;
    }
}

// The lowest tet at each edge of the mesh given.
std::vector<Index> lowest_tets(const TetMesh& mesh, const Edges& edges) {
    std::vector<std::pair<Edge, Index>> sorted;
    std::vector<std::uint8_t> marked(mesh.vertices.rows(), 0);
    for (Index e = 0; e < edges.rows(); ++e) {
        sorted.push_back({std::minmax({edges(e, 0), edges(e, 1)}), e});
        marked[edges(e, 0)] = marked[edges(e, 1)] = 1;
    }
    std::sort(sorted.begin(), sorted.end());
    std::vector<Index> result(edges.rows(), -1);
    for (Index t = 0; t < mesh.tets.rows(); ++t)
        for (int i = 0; i < 4; ++i)
            for (int j = i + 1; j < 4; ++j) {
                const Edge edge = std::minmax({mesh.tets(t, i), mesh.tets(t, j)});
                if (!marked[edge.first] || !marked[edge.second]) continue;
                auto found = std::lower_bound(sorted.begin(), sorted.end(), std::pair(edge, Index(0)));
                for (; found != sorted.end() && found->first == edge; ++found)
                    if (result[found->second] < 0) result[found->second] = t;
            }
    for (std::size_t e = 0; e < result.size(); ++e)
        if (result[e] < 0)
            throw InvalidInput("feature edge " + std::to_string(e) + " is no edge of the tet mesh", "wrong_mesh",
                               {static_cast<Index>(e)});
    return result;
}

void tell_features(const TetMesh& mesh, const BoundarySurface& surface, const surface::FeatureGraph& features,
                   const CombedField& combed, AlignmentTables& result) {
    const Index count = static_cast<Index>(features.edges.rows());
    result.feature_edges.resize(count, 2);
    for (Index e = 0; e < count; ++e)
        for (int k = 0; k < 2; ++k) result.feature_edges(e, k) = surface.vertex_map[features.edges(e, k)];
    result.feature_tet = lowest_tets(mesh, result.feature_edges);
    result.feature_angle.resize(count);
    for (Index e = 0; e < count; ++e) {
        const Vector3 along =
            (mesh.vertices.row(result.feature_edges(e, 1)) - mesh.vertices.row(result.feature_edges(e, 0))).transpose();
        const auto [axis, angle] = nearest(combed.frames, result.feature_tet[e], along);
        result.feature_axis.push_back(axis);
        result.feature_angle[e] = angle;
    }
}

}  // namespace

AlignmentTables alignment_tables(const TetDomain& domain, const CombedField& combed) {
    const TetMesh& mesh = domain.mesh();
    const BoundarySurface& surface = domain.surface();
    const surface::FeatureGraph& features = domain.features();
    require_frames(combed.frames, mesh.tets.rows());
    std::vector<Edge> edges;
    for (const auto edge : features.edges.rowwise()) edges.push_back(std::minmax({edge[0], edge[1]}));
    AlignmentTables result;
    tell_triangles(domain, edges, combed, result);
    tell_features(mesh, surface, features, combed, result);
    return result;
}

}  // namespace octafield::volume
