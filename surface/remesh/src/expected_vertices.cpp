#include "expected_vertices.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "octafield/error.hpp"
#include "octafield/surface/size_field.hpp"
#include "short_number.hpp"

namespace octafield::surface {
namespace {

constexpr double kMostVertices = 2.5e7;               // vertices
constexpr double kPerArea = 2 / std::numbers::sqrt3;  // over a squared length: half as many as equilateral triangles
constexpr double kCutOff = 4;                         // of an edge's length times turn: its distance, cut off by
constexpr double kOverArc = 4.8;  // of both curvatures' sum times squared length: that of one, on a ball
// Per length along an edge, over the length there: of vertices on both sides, where lengths grow.
const double kBesideCreases = 2 * kPerArea / SizeFieldOptions{}.growth;

// The fewest of any closed triangulated surface (Ringel, Youngs 1968), of several balls: of each.
double fewest(int euler) { return euler > 1 ? 2 * euler : std::ceil((7 + std::sqrt(49 - 24. * euler)) / 2); }

bool without_rims(const TriangleMesh& mesh) { return (edge_topology(mesh).edge_triangles.array() >= 0).all(); }

void require_enough(const TriangleMesh& mesh, double expected, bool given) {
    const double least = fewest(euler_characteristic(mesh));
    if (expected >= least) return;
    const double area = triangle_areas(mesh).sum();
    throw InvalidInput((given ? short_number(expected) + " vertices are wanted"
                              : "edges are wanted that would give about " + short_number(expected) + " vertices") +
                           ", but no triangles of such a surface have fewer than " + short_number(least) +
                           "; ask for more vertices, or edges below " +
                           short_number(std::sqrt(kPerArea * area / least)),
                       "too_few_cells");
}

}  // namespace

double vertices_at(const TriangleMesh& mesh, const Eigen::VectorXd& lengths) {
    const Eigen::VectorXd areas = triangle_areas(mesh);
    double sum = 0;
    for (Index t = 0; t < areas.size(); ++t) {
        double length = 0;
        for (const Index v : mesh.triangles.row(t)) length += lengths[v] / 3;
        sum += areas[t] / (length * length);
    }
    return kPerArea * sum;
}

double vertices_within(const TriangleMesh& mesh, const FeatureGraph& features, double deviation) {
    std::set<std::pair<Index, Index>> followed;
    for (const auto edge : features.edges.rowwise()) followed.insert(std::minmax(edge[0], edge[1]));
    const EdgeTopology topology = edge_topology(mesh);
    const Points normals = triangle_normals(mesh);
    const Eigen::VectorXd areas = triangle_areas(mesh);
    double sum = 0;
    for (Index e = 0; e < topology.edges.rows(); ++e) {
        const auto ends = topology.edges.row(e), sides = topology.edge_triangles.row(e);
        if (sides.minCoeff() < 0 || followed.contains(std::minmax(ends[0], ends[1]))) continue;
        const Eigen::Vector3d one = normals.row(sides[0]), two = normals.row(sides[1]);
        const double turn = std::atan2(one.cross(two).norm(), one.dot(two));
        const double along = (mesh.vertices.row(ends[0]) - mesh.vertices.row(ends[1])).norm();
        const double area = (areas[sides[0]] + areas[sides[1]]) / 3;
        if (!(turn > 0 && along > 0)) continue;
        const double length =
            std::min(kCutOff * deviation / turn, std::sqrt(kOverArc * deviation * area / (along * turn)));
        sum += std::min(kPerArea * area / (length * length), kBesideCreases * along / length);
    }
    return sum;
}

void require_possible(const TriangleMesh& mesh, const FeatureGraph& features, const Eigen::VectorXd& lengths,
                      const CloseRemeshOptions& options) {
    const double expected = options.vertices > 0 ? options.vertices : vertices_at(mesh, lengths);
    if (expected > kMostVertices)
        throw InvalidInput("these lengths would give about " + short_number(expected) +
                               " vertices; ask for longer edges or fewer vertices",
                           "too_many_cells");
    const double within = options.deviation > 0 ? vertices_within(mesh, features, options.deviation) : 0;
    if (within > std::min(kMostVertices, options.max_vertices))
        throw InvalidInput("triangles within " + short_number(options.deviation) + " of the surface would have about " +
                               short_number(within) + " vertices; ask for a larger deviation",
                           "too_many_cells");
    if (features.edges.rows() == 0 && without_rims(mesh))
        require_enough(mesh, std::max(expected, within), options.vertices > 0);
}

}  // namespace octafield::surface
