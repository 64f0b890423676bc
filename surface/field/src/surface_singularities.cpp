#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <unordered_map>
#include <utility>

#include "boundary_indices.hpp"
#include "charted_field.hpp"
#include "crouzeix_raviart.hpp"
#include "octafield/error.hpp"
#include "octafield/surface/surface_singularities.hpp"
#include "singular_place.hpp"

namespace octafield::surface {
namespace {

using std::numbers::pi;
constexpr double crease_angle = 40 * pi / 180;
constexpr double most_defect = 0.15;  // radians

// The integer that `turns` is but for rounding.
int whole(double turns) {
    const double nearest = std::round(turns);
    assert(std::abs(turns - nearest) < 1e-6);
    return static_cast<int>(nearest);
}

// Zero of the linear function through the values at the edge midpoints; inside the triangle of the midpoints, as they
// wind round 0.
Eigen::Vector3d zero_position(const TriangleMesh& mesh, Index t, const std::array<detail::Complex, 3>& values) {
    const auto cross = [](detail::Complex a, detail::Complex b) { return (std::conj(a) * b).imag(); };
    Eigen::Vector3d weights;
    for (int k = 0; k < 3; ++k) weights[k] = cross(values[(k + 1) % 3], values[(k + 2) % 3]);
    if (weights.sum() == 0 || !weights.allFinite()) weights.setOnes();
    weights /= weights.sum();
    Eigen::RowVector3d position = Eigen::RowVector3d::Zero();
    for (int k = 0; k < 3; ++k) {
        const auto start = mesh.vertices.row(mesh.triangles(t, k)),
                   end = mesh.vertices.row(mesh.triangles(t, (k + 1) % 3));
        position += weights[k] * (start + end) / 2;
    }
    return position;
}

// The field is continuous at edge midpoints only, so a vertex and a triangle at it may carry opposite indices where the
// field does not turn at all on any path the mesh can tell apart from one round both. Such pairs are left out; the sum
// stays as it is.
void cancel_pairs(const TriangleMesh& mesh, std::vector<SurfaceSingularity>& found) {
    std::unordered_map<Index, std::size_t> at_vertex;
    for (std::size_t i = 0; i < found.size(); ++i)
        if (found[i].vertex >= 0) at_vertex.try_emplace(found[i].vertex, i);
    for (SurfaceSingularity& inner : found) {
        if (inner.triangle < 0) continue;
        for (const Index v : mesh.triangles.row(inner.triangle)) {
            const auto place = at_vertex.find(v);
            if (place == at_vertex.end()) continue;
            SurfaceSingularity& outer = found[place->second];
            if (inner.index_times_symmetry + outer.index_times_symmetry != 0) continue;
            inner.index_times_symmetry = outer.index_times_symmetry = 0;
            at_vertex.erase(place);
            break;
        }
    }
    std::erase_if(found, [](const SurfaceSingularity& singularity) { return singularity.index_times_symmetry == 0; });
}

void require_fit(const DirectionField& field) {
    if (field.values.size() != field.domain.edge_count())
        throw InvalidInput("the direction field has " + std::to_string(field.values.size()) +
                               " values; give one per edge, " + std::to_string(field.domain.edge_count()),
                           "wrong_size");
    std::vector<Index> bad;
    for (Index e = 0; e < field.values.size(); ++e)
        if (!std::isfinite(field.values[e].real()) || !std::isfinite(field.values[e].imag())) bad.push_back(e);
    if (!bad.empty())
        throw InvalidInput(
            "the direction field is not finite at " + std::to_string(bad.size()) + " edges (" + first_few(bad) + ")",
            "not_finite", bad);
}

// (E), 0 at edges inside.
Eigen::VectorXd boundary_deviations(const DirectionField& field, const Eigen::VectorXcd& values) {
    Eigen::VectorXd deviations = Eigen::VectorXd::Zero(values.size());
    for (Index e = 0; e < values.size(); ++e)
        if (field.domain.topology().edge_triangles.row(e).minCoeff() < 0)
            deviations[e] = detail::boundary_deviation(field.domain.topology(), field.symmetry, e, values[e]);
    return deviations;
}

// N times the index of a vertex: the turns of the N-fold angle against the planes of the triangles round it, plus N
// times its angle defect in turns (from a straight line at the boundary). Each corner's turn enters its triangle's sum
// with the opposite sign, so the total is N times the sum of the angle defects: N times the Euler characteristic
// (Gauss-Bonnet). On the boundary the deviations from it before and behind the vertex make the sum whole; those of one
// boundary curve add up to nothing.
int vertex_index(int symmetry, const std::vector<detail::CornerLink>& links, const std::vector<double>& turns,
                 const Eigen::VectorXd& deviations, const VertexFans& fans, const VertexFans::Fan& fan) {
    double sum = symmetry * (fan.closed ? 2 * pi : pi);
    for (Index i = fan.first; i < fan.last; ++i)
        sum += turns[fans.corners[i]] - symmetry * links[fans.corners[i]].angle;
    if (!fan.closed)
        sum += deviations[links[fans.corners[fan.first]].first] - deviations[links[fans.corners[fan.last - 1]].second];
    return whole(sum / (2 * pi));
}

// Edges that the plane of the triangles round a point must not go over: creases, where the surface has no plane, and
// edges that the field follows exactly, as along features, on whose other side it is another field.
std::vector<bool> barriers(const DirectionField& field) {
    const Points& normals = field.domain.normals();
    std::vector<bool> result(field.values.size());
    for (Index e = 0; e < field.values.size(); ++e) {
        const auto beside = field.domain.topology().edge_triangles.row(e);
        const bool held = field.values[e].imag() == 0 && std::abs(field.values[e].real()) == 1;
        result[e] = held || beside.minCoeff() < 0 ||
                    normals.row(beside[0]).dot(normals.row(beside[1])) < std::cos(crease_angle);
    }
    return result;
}

// Vertices where a point may be near rather than at the vertex: inside, smooth, of no feature. At the tip of a cone the
// angle defect holds the point.
std::vector<Index> smooth_corners(const std::vector<detail::CornerLink>& links, const VertexFans& fans,
                                  const std::vector<bool>& is_barrier, Index vertices) {
    std::vector<Index> first(vertices, -1);
    for (const auto& fan : fans.fans) {
        double sum = 0;
        bool smooth = fan.closed;
        for (Index i = fan.first; i < fan.last; ++i) {
            sum += links[fans.corners[i]].angle;
            smooth = smooth && !is_barrier[links[fans.corners[i]].first];
        }
        if (smooth && std::abs(2 * pi - sum) < most_defect) first[fan.vertex] = fans.corners[fan.first];
    }
    return first;
}

// Moves the points inside to where the field round them says; they keep their places where it does not tell.
void place_points(const DirectionField& field, const std::vector<detail::CornerLink>& links,
                  std::vector<SurfaceSingularity>& points) {
    if (std::all_of(points.begin(), points.end(), [](const auto& point) { return point.boundary; })) return;
    const detail::ChartedField charted(field, links);
    const std::vector<bool> is_barrier = barriers(field);
    const std::vector<Index> corners =
        smooth_corners(links, field.domain.fans(), is_barrier, field.domain.vertex_count());
    for (SurfaceSingularity& point : points) {
        const Index corner = point.vertex >= 0 ? corners[point.vertex] : 3 * point.triangle;
        if (corner < 0) continue;
        const Index t = corner / 3;
        const detail::Complex at = charted.lower(t, point.position);
        // A little inside, so that a straight line from it passes no vertex.
        const detail::Complex inside = at + 1e-3 * (charted.centroid(t) - at);
        const auto place = detail::fitted_place(
            charted, [&](Index e) { return is_barrier[e]; }, {t, inside}, point.index_times_symmetry);
        if (!place) continue;
        point.position = charted.lift(place->triangle, place->at);
        point.triangle = place->triangle;
        point.vertex = -1;
    }
    std::stable_sort(points.begin(), points.end(), [](const auto& a, const auto& b) {
        return std::pair(a.vertex, a.triangle) < std::pair(b.vertex, b.triangle);
    });
}

}  // namespace

SurfaceSingularities surface_singularities(const DirectionField& field) {
    require_fit(field);
    const TriangleMesh& mesh = field.domain.mesh();
    const std::vector<detail::CornerLink> links = detail::corner_links(field.domain, field.symmetry);
    const Eigen::VectorXcd values = detail::unit_values(field.values);
    const Eigen::VectorXd deviations = boundary_deviations(field, values);
    std::vector<double> turns(links.size());
    for (std::size_t c = 0; c < links.size(); ++c) turns[c] = detail::turn(links[c], values);

    SurfaceSingularities found;
    const auto add = [&](const Eigen::Vector3d& position, int index, Index triangle, Index vertex, bool boundary) {
        const double turned = static_cast<double>(index) / field.symmetry;
        if (index != 0) found.points.push_back({position, index, turned, triangle, vertex, boundary});
    };
    for (Index t = 0; t < mesh.triangles.rows(); ++t) {
        const int index = whole(-(turns[3 * t] + turns[3 * t + 1] + turns[3 * t + 2]) / (2 * pi));
        if (index != 0) add(zero_position(mesh, t, detail::local_values(links, field.values, t)), index, t, -1, false);
    }
    const VertexFans& fans = field.domain.fans();
    std::vector<int> indices;
    for (const auto& fan : fans.fans)
        indices.push_back(vertex_index(field.symmetry, links, turns, deviations, fans, fan));
    detail::cancel_boundary_pairs(links, fans, deviations, indices);
    for (std::size_t f = 0; f < fans.fans.size(); ++f)
        add(mesh.vertices.row(fans.fans[f].vertex), indices[f], -1, fans.fans[f].vertex, !fans.fans[f].closed);
    cancel_pairs(mesh, found.points);
    place_points(field, links, found.points);

    int sum = 0;
    for (const SurfaceSingularity& point : found.points) sum += point.index_times_symmetry;
    found.index_sum = static_cast<double>(sum) / field.symmetry;
    found.euler_characteristic =
        static_cast<int>(static_cast<Index>(fans.fans.size()) - field.values.size() + mesh.triangles.rows());
    found.agree = sum == field.symmetry * found.euler_characteristic;
    found.boundary_deviation = deviations.size() > 0 ? deviations.cwiseAbs().maxCoeff() / field.symmetry : 0;
    return found;
}

}  // namespace octafield::surface
