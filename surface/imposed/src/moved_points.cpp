#include "moved_points.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "charts.hpp"
#include "octafield/error.hpp"

namespace octafield::surface::detail {
namespace {

using std::numbers::pi;
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
    const Eigen::VectorXd triangle_areas = built.domain.areas();
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
            areas[place->second] += triangle_areas[t];
        }
    }
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] /= areas[i];
    return sums;
}

// Goes straight on in the charts: up to nine tenths of the way to the boundary.
void walk(const Charts& charts, Index& t, Complex& at, Complex heading, double length) {
    int entry = -1;
    for (int crossed = 0; crossed < most_crossed; ++crossed) {
        const auto out = charts.exit(t, at, heading, entry);
        if (out.side < 0) return;
        const Charts::Side here{t, out.side}, there = charts.across(here);
        if (out.distance >= length || there.triangle < 0) {
            at += (there.triangle < 0 ? std::min(length, 0.9 * out.distance) : length) * heading;
            return;
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

// From the place by `step`, laid into its triangle.
Place walked(const Charts& charts, const Place& place, const Vector& step) {
    Index t = place.triangle;
    Complex at = 0;
    for (int k = 0; k < 3; ++k) at += place.weights[k] * charts.corners(t)[k];
    at += 1e-9 * (charts.centroid(t) - at);  // so that the line from it passes no vertex
    const Complex heading = charts.lower_vector(t, step);
    const double length = charts.domain().has_own_lengths() ? std::abs(heading) : step.norm();
    if (std::abs(heading) > 0) walk(charts, t, at, heading / std::abs(heading), length);
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

// The field with the points there; none where points meet, reach the boundary, or turn crosses too fast for the mesh.
std::optional<BuiltField> tried(const SurfaceDomain& input, const Imposed& imposed, const std::vector<bool>& moves) {
    try {
        BuiltField built = built_field(input, imposed);
        for (std::size_t j = 0; j < moves.size(); ++j)
            if (moves[j] && built.structure.on_boundary[built.ringed.centres[j]]) return {};
        return built;
    } catch (const InvalidInput& error) {
        if (error.kind() != "coincident_points") throw;
    } catch (const SolverError& error) {
        if (error.kind() != "unresolved_turns") throw;
    }
    return {};
}

// (3 points) the step of least norm, cut where it is long.
Eigen::VectorXd newton_step(const BuiltField& built, const std::vector<int>& indices, const std::vector<bool>& moves,
                            double longest) {
    Eigen::VectorXd step = -jacobian(built, indices, moves).completeOrthogonalDecomposition().solve(built.rotations);
    double most = 0;
    for (Eigen::Index j = 0; j < step.size(); j += 3) most = std::max(most, step.segment<3>(j).norm());
    return most > longest ? Eigen::VectorXd(step * (longest / most)) : step;
}

}  // namespace

MovedPoints moved_points(const SurfaceDomain& input, Imposed& imposed, std::size_t count, BuiltField built,
                         const ImposedFieldOptions& options, const Progress& progress) {
    const Charts charts(input);
    std::vector<bool> moves(count);
    for (std::size_t j = 0; j < count; ++j)
        moves[j] = imposed.indices[j] != 0 && !built.structure.on_boundary[built.ringed.centres[j]];
    if (std::find(moves.begin(), moves.end(), true) == moves.end())
        throw SolverError(
            "the pattern is not admissible and has no singular points inside that could be moved; add a "
            "pair of valence 3 and 5, or let the field be rotated",
            "move_failed");
    const BuiltField first = built;
    std::vector<double> moved(count, 0);
    int steps = 0;
    for (bool better = true; better && size_of(built.rotations) > done && steps < options.max_steps;) {
        report_or_throw(progress, "move", -1, size_of(built.rotations));
        Eigen::VectorXd step = newton_step(built, imposed.indices, moves, longest_step * input.size());
        better = false;
        if (!step.allFinite() || step.isZero(0)) break;
        for (int halving = 0; halving < most_halvings && !better; ++halving, step /= 2) {
            const auto of_point = [&](std::size_t j) { return step.segment<3>(3 * static_cast<Eigen::Index>(j)); };
            Imposed next = imposed;
            for (std::size_t j = 0; j < count; ++j)
                if (moves[j]) next.places[j] = walked(charts, imposed.places[j], of_point(j));
            std::optional<BuiltField> there = tried(input, next, moves);
            if (!there || size_of(there->rotations) >= size_of(built.rotations)) continue;
            for (std::size_t j = 0; j < count; ++j) moved[j] += of_point(j).norm();
            built = std::move(*there);
            imposed = std::move(next);
            better = true;
        }
        if (better) ++steps;
    }
    const double rest = size_of(built.rotations);
    if (rest > std::min(good_enough, options.tolerance))
        throw SolverError("moving the singular points did not make the pattern admissible: after " +
                              std::to_string(steps) + " steps " + std::to_string(rest * 180 / pi) +
                              " degrees are left; " + move_remedy,
                          "move_failed");
    require_apart(first, built, count);
    return {std::move(built), steps, moved.empty() ? 0 : *std::max_element(moved.begin(), moved.end())};
}

}  // namespace octafield::surface::detail
