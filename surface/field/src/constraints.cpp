// Directions that the user gives, as values of f in the edges' frames.
#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "alignment.hpp"
#include "octafield/error.hpp"
#include "short_number.hpp"

namespace octafield::surface::detail {
namespace {

// A direction whose tangential part is a smaller part of it than this says nothing.
constexpr double least_tangential = 1e-3;

void require_rows(const char* what, Eigen::Index places, const Points& directions, const Eigen::VectorXd& weights) {
    const std::string name(what);
    if (directions.rows() != places || (weights.size() != 0 && weights.size() != places))
        throw InvalidInput("there are " + std::to_string(places) + " " + name + " with constraints but " +
                               std::to_string(directions.rows()) + " directions and " + std::to_string(weights.size()) +
                               " weights; give one of each per place, or no weights",
                           "wrong_size");
    std::vector<Index> bad;
    for (Eigen::Index i = 0; i < places; ++i)
        if (!directions.row(i).allFinite() || (weights.size() != 0 && !(weights[i] > 0))) bad.push_back(Index(i));
    if (!bad.empty())
        throw InvalidInput("constraints of " + name + " need finite directions and weights above 0 (constraint " +
                               first_few(bad) + ")",
                           "bad_constraint", bad);
}

double weight_of(const Eigen::VectorXd& weights, Eigen::Index i) {
    return weights.size() == 0 ? std::numeric_limits<double>::infinity() : weights[i];
}

// Angle of a direction in the plane normal to `normal` from the part of `axis` there, counter-clockwise.
double tangential_angle(const Eigen::Vector3d& direction, const Eigen::Vector3d& axis, const Eigen::Vector3d& normal,
                        const char* what, Index i) {
    const Eigen::Vector3d x = (axis - normal * normal.dot(axis)).normalized(), d = direction.stableNormalized();
    const double along = d.dot(x), across = d.dot(normal.cross(x));
    if (!(std::hypot(along, across) >= least_tangential))
        throw InvalidInput("the direction given at " + std::string(what) + " " + std::to_string(i) +
                               " is zero or normal to the surface there",
                           "bad_constraint", {i});
    return std::atan2(across, along);
}

void follow(AlignedEdges& edges, Index e, Complex value, double weight) {
    if (std::isfinite(weight)) {
        if (!edges.is_held[e]) edges.pull.add(e, weight, value);
    } else {
        edges.is_held[e] = true;
        edges.held[e] = value;
    }
}

void constrain_edges(const SurfaceDomain& domain, int symmetry, const DirectionConstraints& constraints,
                     AlignedEdges& edges) {
    const TriangleMesh& mesh = domain.mesh();
    const EdgeTopology& topology = domain.topology();
    require_rows("edges", constraints.edges.rows(), constraints.edge_directions, constraints.edge_weights);
    if (constraints.edges.rows() == 0) return;
    const Points& normals = domain.normals();
    for (Index i = 0; i < constraints.edges.rows(); ++i) {
        const Index a = constraints.edges(i, 0), b = constraints.edges(i, 1), e = find_edge(topology, a, b);
        if (e < 0)
            throw InvalidInput("constraint " + std::to_string(i) + ": " + std::to_string(a) + "-" + std::to_string(b) +
                                   " is no edge of the mesh",
                               "unknown_edge", {a, b});
        const Eigen::Vector3d along = mesh.vertices.row(topology.edges(e, 1)) - mesh.vertices.row(topology.edges(e, 0));
        Eigen::Vector3d normal = Eigen::Vector3d::Zero();
        for (const Index t : topology.edge_triangles.row(e))
            if (t >= 0) normal += normals.row(t);
        if (!(normal.norm() > least_tangential))
            throw InvalidInput("constraint " + std::to_string(i) + ": the surface folds back on itself at edge " +
                                   std::to_string(a) + "-" + std::to_string(b) + ", no direction is tangent there",
                               "bad_constraint", {i});
        const double angle =
            tangential_angle(constraints.edge_directions.row(i), along, normal.normalized(), "edge constraint", i);
        const Complex value = std::polar(1.0, symmetry * angle);
        const bool twice = edges.is_held[e] && !std::isfinite(weight_of(constraints.edge_weights, i));
        if (twice && std::abs(value - edges.held[e]) > 1e-6)
            throw InvalidInput("edge " + std::to_string(a) + "-" + std::to_string(b) +
                                   " has two hard constraints that contradict each other",
                               "contradiction", {a, b});
        follow(edges, e, value, weight_of(constraints.edge_weights, i));
    }
}

// The direction at a vertex, on the edges that meet there.
void constrain_vertex(const SurfaceDomain& domain, const std::vector<CornerLink>& links, int symmetry,
                      const VertexFans::Fan& fan, const Eigen::Vector3d& direction, const Eigen::Vector3d& normal,
                      double weight, const std::vector<bool>& taken, AlignedEdges& edges) {
    const TriangleMesh& mesh = domain.mesh();
    const EdgeTopology& topology = domain.topology();
    const VertexFans& fans = domain.fans();
    double total = 0;
    for (Index i = fan.first; i < fan.last; ++i) total += links[fans.corners[i]].angle;
    const double scale = fan.closed ? 2 * std::numbers::pi / total : 1;
    const auto outward = [&](Index e) -> Eigen::Vector3d {
        const int low = topology.edges(e, 0) == fan.vertex ? 0 : 1;
        return mesh.vertices.row(topology.edges(e, 1 - low)) - mesh.vertices.row(fan.vertex);
    };
    // Tangent-plane angle minus polar-map angle, of the edges; their mean places the direction in the map.
    const Eigen::Vector3d x = normal.unitOrthogonal(), y = normal.cross(x);
    const double given = tangential_angle(direction, x, normal, "vertex", fan.vertex);
    Complex offset = 0;
    double map_angle = 0;
    for (Index i = fan.first; i < fan.last; ++i) {
        const CornerLink& link = links[fans.corners[i]];
        const Eigen::Vector3d along = outward(link.first);
        const double seen = std::atan2(along.dot(y), along.dot(x));
        offset += link.angle * std::polar(1.0, seen - map_angle);
        map_angle += scale * link.angle;
    }
    const double in_map = given - std::arg(offset);
    const auto set = [&](Index e, double angle) {
        if (taken[e]) return;
        const double reversed = topology.edges(e, 0) == fan.vertex || symmetry % 2 == 0 ? 1 : -1;
        follow(edges, e, reversed * std::polar(1.0, symmetry * (in_map - angle)), weight);
    };
    map_angle = 0;
    for (Index i = fan.first; i < fan.last; ++i) {
        set(links[fans.corners[i]].first, map_angle);
        map_angle += scale * links[fans.corners[i]].angle;
    }
    if (!fan.closed) set(links[fans.corners[fan.last - 1]].second, map_angle);
}

}  // namespace

void add_constraints(const SurfaceDomain& domain, const std::vector<CornerLink>& links, int symmetry,
                     const DirectionConstraints& constraints, const std::vector<bool>& follows_feature,
                     AlignedEdges& edges) {
    const TriangleMesh& mesh = domain.mesh();
    constrain_edges(domain, symmetry, constraints, edges);
    require_rows("vertices", static_cast<Eigen::Index>(constraints.vertices.size()), constraints.vertex_directions,
                 constraints.vertex_weights);
    if (constraints.vertices.empty()) return;
    const Points normals = vertex_normals(mesh);
    std::vector<std::vector<Index>> asked(mesh.vertices.rows());  // constraints by vertex
    for (std::size_t i = 0; i < constraints.vertices.size(); ++i) {
        const Index v = constraints.vertices[i];
        if (v < 0 || v >= mesh.vertices.rows() || normals.row(v).isZero(0))
            throw InvalidInput("constraint " + std::to_string(i) + " names vertex " + std::to_string(v) +
                                   ", which is no vertex of a triangle; vertices are numbered from 0",
                               "index_out_of_range", {v});
        asked[v].push_back(static_cast<Index>(i));
    }
    std::vector<bool> taken = follows_feature;
    for (Index e = 0; e < domain.edge_count(); ++e) taken[e] = taken[e] || edges.is_held[e];
    for (const auto& fan : domain.fans().fans)
        for (const Index i : asked[fan.vertex])
            constrain_vertex(domain, links, symmetry, fan, constraints.vertex_directions.row(i),
                             normals.row(fan.vertex), weight_of(constraints.vertex_weights, i), taken, edges);
}

void add_guide(const SurfaceDomain& domain, int symmetry, const DirectionGuide& guide, AlignedEdges& edges) {
    const TriangleMesh& mesh = domain.mesh();
    const EdgeTopology& topology = domain.topology();
    const Eigen::Index triangles = mesh.triangles.rows();
    if (!(guide.length >= 0) || !std::isfinite(guide.length))
        throw InvalidInput("the length of a guide field must be a length, or 0 for the default");
    if (guide.directions.rows() == 0 && guide.weights.size() == 0) return;
    if (guide.directions.rows() != triangles || (guide.weights.size() != 0 && guide.weights.size() != triangles))
        throw InvalidInput("a guide field needs one direction per triangle, " + std::to_string(triangles) +
                               ", and as many weights or none; there are " + std::to_string(guide.directions.rows()) +
                               " and " + std::to_string(guide.weights.size()),
                           "wrong_size");
    const Points& normals = domain.normals();
    const Eigen::VectorXd areas = triangle_areas(mesh);
    const double length = guide.length > 0 ? guide.length : domain.size() / 10;
    if (!std::isnormal(length * length))
        throw InvalidInput("the length of a guide field, " + short_number(length) +
                               ", is beyond double precision when squared; choose one between the edge length and the "
                               "size of the surface",
                           "option_out_of_range");
    std::vector<Index> bad;
    for (Index t = 0; t < triangles; ++t) {
        const double weight = guide.weights.size() == 0 ? 1 : guide.weights[t];
        if (weight == 0) continue;
        const Eigen::Vector3d normal = normals.row(t), given = guide.directions.row(t);
        const Eigen::Vector3d d = given.stableNormalized(), tangent = d - normal * normal.dot(d);
        if (!(weight > 0) || !std::isfinite(weight) || !given.allFinite() || !(tangent.norm() >= least_tangential)) {
            bad.push_back(t);
            continue;
        }
        for (const Index e : topology.triangle_edges.row(t)) {
            if (edges.is_held[e]) continue;
            const Eigen::Vector3d x =
                (mesh.vertices.row(topology.edges(e, 1)) - mesh.vertices.row(topology.edges(e, 0))).normalized();
            const double angle = std::atan2(normal.cross(x).dot(tangent), x.dot(tangent));
            edges.pull.add(e, weight * areas[t] / 3 / (length * length), std::polar(1.0, symmetry * angle));
        }
    }
    if (!bad.empty())
        throw InvalidInput(
            "the guide field has a direction that is zero, not finite or normal to the surface, or a "
            "weight that is negative or not finite, in " +
                std::to_string(bad.size()) + " triangles (" + first_few(bad) +
                "); give a triangle without direction the weight 0",
            "bad_guide", bad);
}

}  // namespace octafield::surface::detail
