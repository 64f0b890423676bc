#include "octafield/volume/field_map.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "map_room.hpp"
#include "map_unknowns.hpp"
#include "matched_combing.hpp"
#include "octafield/error.hpp"
#include "octafield/frames/octahedral_group.hpp"
#include "octafield/volume/refine_tets.hpp"
#include "require_frames.hpp"
#include "unfolded_tets.hpp"
#include "unzipped_curves.hpp"

namespace octafield::volume {
namespace {

using namespace detail;

constexpr int bits = 40;                                       // of the parameters
constexpr int most_rounds = 4;                                 // of splitting tets that stay flat
constexpr double coarsest_grid = 0.25, finest_grid = 0x1p-12;  // of coordinates that curves and patches have, units
constexpr double least_left = 0.05;                            // of a tet's volume in the map, by rounding to the grid
constexpr double most_crushed = 0.05;  // of the tets: where more are flat the whole map has no room

double mean_edge(const TetMesh& mesh) {
    double sum = 0;
    for (const auto tet : mesh.tets.rowwise())
        for (int k = 0; k < 4; ++k)
            for (int l = 0; l < k; ++l) sum += (mesh.vertices.row(tet[k]) - mesh.vertices.row(tet[l])).norm();
    return sum / (6 * static_cast<double>(mesh.tets.rows()));
}

// The combed field, and the same as a field with matchings.
std::pair<CombedField, MatchedField> combed_field(MatchedField field, int threads) {
    CombedField combed = comb_matched(field.domain, field.frames, field.matching, threads);
    const TriangleTable& table = field.domain.triangles();
    field.frames = combed.frames;
    std::size_t f = 0;
    for (Index row = 0; row < table.triangles.rows(); ++row)
        if (table.sides(row, 1) >= 0) field.matching[row] = combed.faces.matching[f++];
    return {std::move(combed), std::move(field)};
}

Eigen::Matrix3d axes_of(const MatchedField& field, Index tet) {
    return frames::from_wxyz(field.frames.row(tet)).toRotationMatrix();
}

Eigen::Matrix3d edges_of(const TetMesh& mesh, Index tet) {
    Eigen::Matrix3d edges;
    for (int k = 0; k < 3; ++k)
        edges.col(k) = (mesh.vertices.row(mesh.tets(tet, k + 1)) - mesh.vertices.row(mesh.tets(tet, 0))).transpose();
    return edges;
}

TetProblem problem_of(const MatchedField& field, const MapUnknowns& unknowns, double size, int threads) {
    TetProblem problem{unknowns.free, unknowns.corners, {}, {}, threads};
    for (Index t = 0; t < field.domain.tet_count(); ++t) {
        const Eigen::Matrix3d target = axes_of(field, t).transpose() * edges_of(field.domain.mesh(), t) / size;
        problem.to_unit.push_back(target.inverse());
        problem.volumes.push_back(target.determinant() / 6);
    }
    return problem;
}

// Mean over axes and tets, by volume, of the angle between the gradient of a parameter and its axis.
double mean_angle(const TetProblem& problem, const Eigen::VectorXd& values) {
    double sum = 0, volume = 0;
    for (Index t = 0; t < problem.corners.rows(); ++t) {
        const Eigen::Matrix3d j = mapped_edges(problem, values, t) * problem.to_unit[t];  // row i: gradient i
        for (int i = 0; i < 3; ++i) {
            const Eigen::Vector3d gradient = j.row(i);
            const double along = gradient[i];
            sum += problem.volumes[t] / 3 *
                   std::atan2(std::sqrt(std::max(0.0, gradient.squaredNorm() - along * along)), along);
        }
        volume += problem.volumes[t];
    }
    return volume > 0 ? sum / volume : 0;
}

// The numbers of all corners, whole multiples of one power of two, so that all equations hold exactly.
Eigen::VectorXd exact_numbers(const MapUnknowns& unknowns, const Eigen::VectorXd& values) {
    const auto& free = unknowns.free;
    const Index numbers = 3 * (unknowns.corners.maxCoeff() + 1);
    double largest = 0;
    for (Index r = 0; r < numbers; ++r) {
        double number = 0;
        for (const auto& [unknown, c] : free.rows[r]) number += c * values[unknown];
        largest = std::max(largest, std::abs(number));
    }
    const double unit = std::exp2(std::ceil(std::log2(std::max(largest, 1e-300))) - bits) / free.multiple;
    const double grid = std::exp2(std::ceil(std::log2(unit)));
    const auto whole = [&](Index unknown) {
        return std::round(values[unknown] / (grid * free.multiple)) * free.multiple;
    };
    Eigen::VectorXd result = Eigen::VectorXd::Zero(numbers);
    for (Index r = 0; r < numbers; ++r) {
        for (const auto& [unknown, c] : free.rows[r]) result[r] += std::round(c * whole(unknown));
        result[r] *= grid;
    }
    return result;
}

SeamlessMap map_of(const MatchedField& field, const MapUnknowns& unknowns, const Eigen::VectorXd& values) {
    const TetMesh& mesh = field.domain.mesh();
    SeamlessMap map{mesh, Rows<double, 12>(mesh.tets.rows(), 12)};
    const Eigen::VectorXd numbers = exact_numbers(unknowns, values);
    for (Index t = 0; t < mesh.tets.rows(); ++t)
        for (int k = 0; k < 4; ++k)
            for (int i = 0; i < 3; ++i) map.parameters(t, 3 * k + i) = numbers[3 * unknowns.corners(t, k) + i];
    const std::vector<Index>& vertices = field.domain.surface().vertex_map;
    map.features.resize(field.domain.features().edges.rows(), 2);
    for (Index e = 0; e < map.features.rows(); ++e)
        for (int k = 0; k < 2; ++k) map.features(e, k) = vertices[field.domain.features().edges(e, k)];
    for (const Index corner : field.domain.features().corners) map.corners.push_back(vertices[corner]);
    return map;
}

// Unknowns that several vertices depend on: coordinates of curves, of patches of the surface, translations.
std::vector<Index> shared_unknowns(const TetMesh& mesh, const MapUnknowns& unknowns) {
    std::vector<std::set<Index>> vertices(unknowns.free.count);
    for (Index t = 0; t < mesh.tets.rows(); ++t)
        for (int k = 0; k < 4; ++k)
            for (int i = 0; i < 3; ++i)
                for (const auto& entry : unknowns.free.rows[3 * unknowns.corners(t, k) + i])
                    if (auto& known = vertices[entry.first]; known.size() < 2) known.insert(mesh.tets(t, k));
    std::vector<Index> shared;
    for (Index u = 0; u < unknowns.free.count; ++u)
        if (vertices[u].size() > 1) shared.push_back(u);
    return shared;
}

// Shared unknowns as multiples of the coarsest grid that folds no tet: planes of walls are then the same or apart.
Eigen::VectorXd on_grid(const TetProblem& problem, const std::vector<Index>& shared, const Eigen::VectorXd& values) {
    for (double grid = coarsest_grid; grid >= finest_grid; grid /= 2) {
        Eigen::VectorXd rounded = values;
        for (const Index u : shared) rounded[u] = std::round(values[u] / grid) * grid;
        bool sound = true;
        for (Index t = 0; t < problem.corners.rows() && sound; ++t)
            sound = mapped_edges(problem, rounded, t).determinant() >
                    least_left * mapped_edges(problem, values, t).determinant();
        if (sound) return rounded;
    }
    return values;
}

struct Attempt {
    FieldMap made;
    std::vector<Index> crushed;
    Index faults = 0;
};

// Tets with a vertex of one of the edges.
std::vector<Index> tets_round(const TetMesh& mesh, const Edges& edges) {
    const std::set<Index> ends(edges.reshaped().begin(), edges.reshaped().end());
    std::vector<Index> found;
    for (Index t = 0; t < mesh.tets.rows(); ++t)
        if (std::any_of(mesh.tets.row(t).begin(), mesh.tets.row(t).end(), [&](Index v) { return ends.contains(v); }))
            found.push_back(t);
    return found;
}

Attempt attempt(const MatchedField& uncombed, double size, int threads, const Progress& progress) {
    report_or_throw(progress, "unknowns", 0, std::nan(""));
    const auto [combed, field] = combed_field(uncombed, threads);
    MapUnknowns unknowns = map_unknowns(field, combed);
    const TetProblem problem = problem_of(field, unknowns, size, threads);
    Attempt result;
    FieldMap& made = result.made;
    const Eigen::VectorXd start = nearest_map(problem);
    made.angle_at_first = mean_angle(problem, start);
    for (Index t = 0; t < problem.corners.rows(); ++t)
        made.flipped_at_first += !(mapped_edges(problem, start, t).determinant() > 0);
    UnfoldedTets found{start};
    if (unknowns.locked.empty()) found = unfolded_tets(problem, start, progress);
    if (!found.folded.empty()) result.crushed = std::move(found.crushed);
    if (static_cast<Index>(found.folded.size()) > made.flipped_at_first) found.values = start;
    if (found.folded.empty())
        found.values = on_grid(problem, shared_unknowns(field.domain.mesh(), unknowns), found.values);
    made.steps = found.steps;
    made.angle = mean_angle(problem, found.values);
    made.map = map_of(field, unknowns, found.values);
    SeamlessReport report = seamless_report(made.map);
    made.flipped = std::move(report.flipped);
    if (made.flipped.empty()) result.crushed = tets_round(made.map.mesh, report.wound);
    result.faults = static_cast<Index>(made.flipped.size()) + report.wound.rows();
    made.parent = field.parent;
    made.curves = field.curves;
    made.unknowns = unknowns.free.count;
    made.locked = std::move(unknowns.locked);
    return result;
}

// Frames half-way between those of two vertices.
Quaternions refined_frames(const Quaternions& frames, const Edges& parents) {
    Quaternions result(parents.rows(), 4);
    for (Index v = 0; v < parents.rows(); ++v) {
        const Eigen::Vector4d one = frames.row(parents(v, 0)).transpose();
        const Eigen::Vector4d other = frames::to_wxyz(frames::closest_representative(
            frames::from_wxyz(frames.row(parents(v, 1))), frames::from_wxyz(frames.row(parents(v, 0)))));
        result.row(v) = (one + other).normalized().transpose();
    }
    return result;
}

// With curves as edges, of one type each where that can be. Where a ribbon for that has no room, tets near it are cut
// into eight first.
std::pair<MatchedField, UnzippedCurves> matched_field(const TetDomain& domain, const Quaternions& frames) {
    const auto made = [](const TetDomain& on, Quaternions given) {
        EdgeMatchings matchings(on, given);
        matchings.shorten_curves();
        UnzippedCurves told = unzip_curves(on, given, matchings);
        MatchedField field = split_along_curves(on, given, matchings);
        return std::pair(std::move(field), std::move(told));
    };
    auto first = made(domain, frames);
    const UnzippedCurves& told = first.second;
    if (told.mended == told.turns) return first;
    RefinedDomain finer = refine_tets(domain, told.near);
    auto second = made(finer.domain, refined_frames(frames, finer.parents));
    if (second.second.turns - second.second.mended >= told.turns - told.mended) return first;
    for (Index& tet : second.first.parent) tet = finer.parent[tet];
    return second;
}

}  // namespace

FieldMap field_map(const TetDomain& domain, const Quaternions& frames, const FieldMapOptions& options,
                   const Progress& progress) {
    if (!(options.edge_length >= 0) || !std::isfinite(options.edge_length))
        throw InvalidInput("edge_length is 0 or a positive length", "option_out_of_range");
    require_frames(frames, domain.vertex_count());
    if (domain.interface_triangles() > 0)
        throw InvalidInput("seamless maps are made of one region so far; give the mesh without region ids",
                           "several_regions");
    report_or_throw(progress, "comb", 0, std::nan(""));
    const auto [matched, unzipped] = matched_field(domain, frames);
    MatchedField field = make_room(matched);
    const double size = options.edge_length > 0 ? options.edge_length : mean_edge(domain.mesh());
    Attempt best = attempt(field, size, options.threads, progress), last = best;
    int steps = best.made.steps;
    const auto is_local = [](const Attempt& a) {
        return !a.crushed.empty() &&
               static_cast<double>(a.crushed.size()) < most_crushed * static_cast<double>(a.made.parent.size());
    };
    for (int round = 0; round < most_rounds && is_local(last); ++round) {
        field = split_round(field, last.crushed);
        last = attempt(field, size, options.threads, progress);
        steps += last.made.steps;
        if (last.faults >= best.faults) break;
        best = last;
    }
    best.made.steps = steps;
    best.made.turns = unzipped.turns;
    best.made.unzipped = unzipped.mended;
    best.made.added_vertices = static_cast<Index>(best.made.map.mesh.vertices.rows()) - domain.vertex_count();
    return std::move(best.made);
}

}  // namespace octafield::volume
