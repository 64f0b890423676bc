#include "moved_points.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "charts.hpp"
#include "octafield/error.hpp"

namespace octafield::surface::detail {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double done = 1e-10, good_enough = 1e-3;  // radians; what is left of it is rotated away
constexpr double longest_step = 0.1;                // of the surface's size
constexpr double most_approach = 0.02;              // of two points, as part of their distance
constexpr int most_halvings = 8;
constexpr int most_crossed = 100000;
constexpr const char* move_remedy =
    "place them nearer to a symmetric pattern, add a pair of valence 3 and 5, or let the field be rotated";

// n x gradient of the form at vertex `centre`: mean over the triangles there, weighted by area.
std::vector<Vector> turned_gradients(const BuiltField& built, const Eigen::VectorXd& form) {
    const TriangleMesh& mesh = built.domain.mesh();
    const EdgeTopology& topology = built.domain.topology();
    std::vector<Vector> sums(built.ringed.centres.size(), Vector::Zero());
    std::vector<double> areas(sums.size(), 0);
    std::map<Index, std::size_t> place_of;
    for (std::size_t i = 0; i < sums.size(); ++i) place_of[built.ringed.centres[i]] = i;
    for (const auto& fan : built.domain.fans().fans) {
        const auto place = place_of.find(fan.vertex);
        if (place == place_of.end()) continue;
        for (Index i = fan.first; i < fan.last; ++i) {
            const Index t = built.domain.fans().corners[i] / 3;
            const Vector a = mesh.vertices.row(mesh.triangles(t, 0)), b = mesh.vertices.row(mesh.triangles(t, 1)),
                         c = mesh.vertices.row(mesh.triangles(t, 2));
            const auto along = [&](int k) {
                const Index e = topology.triangle_edges(t, k);
                return (topology.edge_triangles(e, 0) == t ? 1 : -1) * form[e];
            };
            // grad u = n x (u_b (a - c) + u_c (b - a)) / (2 area), u_a = 0; turned once more, n x n x v = -v.
            sums[place->second] -= (along(0) * (a - c) - along(2) * (b - a)) / 2;
            areas[place->second] += (b - a).cross(c - a).norm() / 2;
        }
    }
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] /= areas[i];
    return sums;
}

// Straight on from the place, by `step` laid in its triangle; up to nine tenths of the way to the boundary.
Place walked(const Charts& charts, const Place& place, const Vector& step) {
    Index t = place.triangle;
    Vector position = Vector::Zero();
    for (int k = 0; k < 3; ++k)
        position += place.weights[k] * charts.mesh().vertices.row(charts.mesh().triangles(t, k)).transpose();
    Complex at = charts.lower(t, position);
    at += 1e-9 * (charts.centroid(t) - at);  // so that the line from it passes no vertex
    Complex heading = charts.lower_vector(t, step);
    double length = step.norm();
    int entry = -1;
    if (length > 0 && std::abs(heading) > 0) {
        heading /= std::abs(heading);
        for (int crossed = 0; crossed < most_crossed; ++crossed) {
            const auto out = charts.exit(t, at, heading, entry);
            if (out.side < 0) break;
            if (out.distance >= length) {
                at += length * heading;
                break;
            }
            const Charts::Side here{t, out.side}, there = charts.across(here);
            if (there.triangle < 0) {
                at += 0.9 * out.distance * heading;
                break;
            }
            at += out.distance * heading;
            length -= out.distance;
            const Complex along = charts.side(t, out.side);
            const double fraction = dot(along, at - charts.corners(t)[out.side]) / std::norm(along);
            heading = charts.carried(heading, here, there);
            t = there.triangle;
            at = charts.on_side(t, there.side, 1 - fraction);
            entry = there.side;
        }
    }
    Vector weights;
    for (int k = 0; k < 3; ++k)
        weights[k] = std::max(0.0, cross(charts.side(t, (k + 1) % 3), at - charts.corners(t)[(k + 1) % 3])) /
                     charts.twice_area(t);
    return {t, weights / weights.sum()};
}

// (conditions, 3 points)
Eigen::MatrixXd jacobian(const BuiltField& built, const std::vector<int>& indices, const std::vector<bool>& moves) {
    const auto count = static_cast<Eigen::Index>(built.forms.size());
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(count, 3 * static_cast<Eigen::Index>(moves.size()));
    for (Eigen::Index l = 0; l < count; ++l) {
        const std::vector<Vector> gradients = turned_gradients(built, built.forms[l]);
        for (std::size_t j = 0; j < moves.size(); ++j)
            if (moves[j])
                result.block<1, 3>(l, 3 * static_cast<Eigen::Index>(j)) =
                    -pi / 2 * indices[j] * gradients[j].transpose();
    }
    return built.energies.partialPivLu().solve(result);
}

double size_of(const Eigen::VectorXd& rotations) { return rotations.size() ? rotations.cwiseAbs().maxCoeff() : 0; }

// Two points of opposite index that have nearly cancelled each other are no solution.
void require_apart(const BuiltField& before, const BuiltField& after, std::size_t count) {
    const auto distance = [&](const BuiltField& built, std::size_t i, std::size_t j) {
        return (built.domain.mesh().vertices.row(built.ringed.centres[i]) -
                built.domain.mesh().vertices.row(built.ringed.centres[j]))
            .norm();
    };
    for (std::size_t j = 0; j < count; ++j)
        for (std::size_t i = 0; i < j; ++i)
            if (distance(after, i, j) < most_approach * distance(before, i, j))
                throw SolverError("moving the singular points to make the pattern admissible runs points " +
                                      std::to_string(i) + " and " + std::to_string(j) + " into one another; " +
                                      move_remedy,
                                  "move_failed", {static_cast<Index>(i), static_cast<Index>(j)});
}

}  // namespace

MovedPoints moved_points(const SurfaceDomain& input, Imposed& imposed, std::size_t count, BuiltField built,
                         const ImposedFieldOptions& options, const Progress& progress) {
    const Charts charts(input);
    std::vector<bool> moves(count);
    for (std::size_t j = 0; j < count; ++j)
        moves[j] = imposed.indices[j] != 0 && !built.structure.on_boundary[built.ringed.centres[j]];
    const BuiltField first = built;
    std::vector<double> moved(count, 0);
    int steps = 0;
    while (size_of(built.rotations) > done && steps < options.max_steps) {
        report_or_throw(progress, "move", -1, size_of(built.rotations));
        const Eigen::MatrixXd slope = jacobian(built, imposed.indices, moves);
        Eigen::VectorXd step = -slope.completeOrthogonalDecomposition().solve(built.rotations);
        if (!step.allFinite()) break;
        double longest = 0;
        for (std::size_t j = 0; j < count; ++j)
            longest = std::max(longest, step.segment<3>(3 * static_cast<Eigen::Index>(j)).norm());
        if (longest == 0) break;
        step *= std::min(1.0, longest_step * input.size() / longest);
        bool better = false;
        for (int halving = 0; halving < most_halvings && !better; ++halving, step /= 2) {
            Imposed next = imposed;
            for (std::size_t j = 0; j < count; ++j)
                if (moves[j])
                    next.places[j] =
                        walked(charts, imposed.places[j], step.segment<3>(3 * static_cast<Eigen::Index>(j)));
            try {
                BuiltField tried = built_field(input, next);
                if (size_of(tried.rotations) >= size_of(built.rotations)) continue;
                for (std::size_t j = 0; j < count; ++j)
                    moved[j] += step.segment<3>(3 * static_cast<Eigen::Index>(j)).norm();
                built = std::move(tried);
                imposed = std::move(next);
                better = true;
            } catch (const InvalidInput& error) {
                if (error.kind() != "coincident_points") throw;
            }
        }
        if (!better) break;
        ++steps;
    }
    const double rest = size_of(built.rotations);
    if (rest > std::min(good_enough, options.tolerance)) {
        throw SolverError("moving the singular points did not make the pattern admissible: after " +
                              std::to_string(steps) + " steps " + std::to_string(rest * 180 / pi) +
                              " degrees are left; " + move_remedy,
                          "move_failed");
    }
    require_apart(first, built, count);
    return {std::move(built), steps, moved.empty() ? 0 : *std::max_element(moved.begin(), moved.end())};
}

}  // namespace octafield::surface::detail
