#include "octafield/volume/hex_dominant.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "attempts.hpp"
#include "frontal_points.hpp"
#include "mesh_regions.hpp"
#include "octafield/error.hpp"
#include "octafield/volume/integrability.hpp"
#include "octafield/volume/refine_tets.hpp"
#include "octafield/volume/sample_frames.hpp"
#include "octafield/volume/scaling.hpp"
#include "refined_count.hpp"
#include "require_frames.hpp"

namespace octafield::volume {
namespace {

constexpr double enough = 0.98;           // of the volume in hexahedra: a front is not tried
constexpr double most_log_scale = 0.693;  // sizes give way by a factor of two

struct WorkingField {
    TetDomain domain;
    Quaternions frames;     // at the vertices
    Eigen::VectorXd sizes;  // at the vertices
};

Eigen::VectorXd wanted_sizes(const TetDomain& domain, const HexDominantOptions& options) {
    const Eigen::Index n = domain.vertex_count();
    if (options.sizes.size() == 0) {
        const double length =
            options.edge_length > 0 ? options.edge_length : surface::mean_edge_length(domain.surface().mesh);
        return Eigen::VectorXd::Constant(n, length);
    }
    if (options.sizes.size() != n)
        throw InvalidInput(
            "sizes has " + std::to_string(options.sizes.size()) + " entries; give one per vertex, " + std::to_string(n),
            "wrong_size");
    std::vector<Index> bad;
    for (Index v = 0; v < n; ++v)
        if (!(options.sizes[v] > 0) || !std::isfinite(options.sizes[v])) bad.push_back(v);
    if (!bad.empty())
        throw InvalidInput("sizes at vertices " + first_few(bad) + " are not above 0", "edge_length", bad);
    return options.sizes;
}

void require_options(const HexDominantOptions& options) {
    if (!(options.edge_length >= 0) || !std::isfinite(options.edge_length))
        throw InvalidInput("edge_length must be a length above 0, or 0 for the mean edge of the surface",
                           "edge_length");
    if (!(options.min_scaled_jacobian > 0 && options.min_scaled_jacobian < 1))
        throw InvalidInput("min_scaled_jacobian must be between 0 and 1", "min_scaled_jacobian");
    if (!(options.hold_angle >= 0 && options.hold_angle <= std::numbers::pi / 2))
        throw InvalidInput("hold_angle must be from 0 to pi / 2", "hold_angle");
    if (options.refinements < 0 || options.refinements > 6)
        throw InvalidInput("refinements must be from 0 to 6", "refinements");
}

// The tets marked are cut; the frames of new vertices are those of `given`, the field that was handed in.
WorkingField refined(const WorkingField& field, const WorkingField& given, std::vector<std::uint8_t> marked,
                     int threads) {
    RefinedDomain next = refine_tets(field.domain, std::move(marked));
    const Eigen::Index known = field.frames.rows(), added = next.parents.rows() - known;
    SampleOptions sampling;
    sampling.tolerance = std::numeric_limits<double>::infinity();
    sampling.threads = threads;
    Quaternions frames(next.parents.rows(), 4);
    frames.topRows(known) = field.frames;
    frames.bottomRows(added) =
        sample_frames(given.domain, given.frames, next.domain.mesh().vertices.bottomRows(added), sampling).frames;
    Eigen::VectorXd sizes(next.parents.rows());
    for (Eigen::Index v = 0; v < sizes.size(); ++v)
        sizes[v] = (field.sizes[next.parents(v, 0)] + field.sizes[next.parents(v, 1)]) / 2;
    return {std::move(next.domain), std::move(frames), std::move(sizes)};
}

// Tets of no use for the map, and those that share so many vertices with them, where they are not small already.
std::vector<std::uint8_t> tets_to_refine(const WorkingField& field, const PeriodicMap& map, int shared) {
    const TetMesh& mesh = field.domain.mesh();
    std::vector<std::uint8_t> near(mesh.vertices.rows(), 0), marked(mesh.tets.rows(), 0);
    for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t)
        if (!map.usable[t])
            for (const Index v : mesh.tets.row(t)) near[v] = 1;
    for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t) {
        const auto corners = mesh.tets.row(t);
        if (near[corners[0]] + near[corners[1]] + near[corners[2]] + near[corners[3]] < shared) continue;
        double longest = 0;
        for (int a = 0; a < 4; ++a)
            for (int b = a + 1; b < 4; ++b)
                longest = std::max(longest, (mesh.vertices.row(corners[a]) - mesh.vertices.row(corners[b])).norm());
        marked[t] = longest > 0.4 * field.sizes(corners).mean();
    }
    return marked;
}

TetAxes tet_axes(const WorkingField& field, const HexDominantOptions& options) {
    const TetMesh& mesh = field.domain.mesh();
    TetAxes result;
    Points log_scales = Points::Zero(mesh.tets.rows(), 3);
    if (options.correction == SizeCorrection::axes) {
        AxisScaleOptions scaling;
        scaling.threads = options.threads;
        AxisScales scales = axis_scales(field.domain, field.frames, scaling);
        result.frames = std::move(scales.of_tets);
        log_scales = std::move(scales.log_scales);
    } else {
        result.frames = tet_frames(field.domain, field.frames, options.threads);
        if (options.correction == SizeCorrection::isotropic) {
            const IsotropicScale scale = isotropic_scale(field.domain, field.frames, options.threads);
            for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t)
                log_scales.row(t).setConstant(scale.log_scale(mesh.tets.row(t)).mean());
        }
    }
    result.lengths.resize(mesh.tets.rows(), 3);
    for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t)
        result.lengths.row(t) = field.sizes(mesh.tets.row(t)).mean() *
                                (-log_scales.row(t).array()).max(-most_log_scale).min(most_log_scale).exp();
    return result;
}

PeriodicMap map_of(const WorkingField& field, const HexDominantOptions& options, const Progress& progress) {
    const TetAxes axes = tet_axes(field, options);
    PeriodicMapOptions map_options;
    map_options.hold_angle = options.hold_angle;
    map_options.threads = options.threads;
    return periodic_map(field.domain, axes.frames, axes.lengths, map_options, progress);
}

// Before anything is made of it that would not end or not fit.
void require_count(const WorkingField& field, Index most) {
    const Eigen::VectorXd volumes = tet_volumes(field.domain.mesh());
    double count = 0;
    for (Eigen::Index t = 0; t < volumes.size(); ++t)
        count += volumes[t] / std::pow(field.sizes(field.domain.mesh().tets.row(t)).mean(), 3);
    if (count <= most) return;
    char text[32];
    std::snprintf(text, sizeof text, "%.2g", count);
    throw InvalidInput("the edge length asks for about " + std::string(text) + " cells, and at most " +
                           std::to_string(most) + " are made; give a larger edge length, or more most_hexahedra",
                       "too_many_cells");
}

// Vertices whose cells have been joined or split away: a solver would have unknowns that nothing determines.
void drop_unused_vertices(HexDominantMesh& result) {
    MixedMesh& mesh = result.mesh;
    std::vector<Index> number(mesh.vertices.rows(), -1);
    const auto for_each_kind = [&](const auto& visit) {
        visit(mesh.tets);
        visit(mesh.hexahedra);
        visit(mesh.wedges);
        visit(mesh.pyramids);
    };
    for_each_kind([&](const auto& cells) {
        for (const Index v : cells.reshaped()) number[v] = 0;
    });
    Index count = 0;
    for (std::size_t v = 0; v < number.size(); ++v) {
        if (number[v] < 0) continue;
        number[v] = count;
        mesh.vertices.row(count) = mesh.vertices.row(static_cast<Eigen::Index>(v));
        result.support[count++] = result.support[v];
    }
    mesh.vertices.conservativeResize(count, 3);
    result.support.resize(count);
    for_each_kind([&](auto& cells) {
        for (Index& v : cells.reshaped()) v = number[v];
    });
}

// Along a periodic map; the tets are cut where it is of no use.
LatticeCells periodic_points(WorkingField& field, const WorkingField& given, const HexDominantOptions& options,
                             HexDominantCounts& counts, const Progress& progress) {
    for (int level = 0;; ++level) {
        report_or_throw(progress, "sizes", 0, 0);
        const PeriodicMap map = map_of(field, options, progress);
        std::vector<std::uint8_t> marked = tets_to_refine(field, map, level == 0 ? 1 : 2);
        const bool any = std::find(marked.begin(), marked.end(), 1) != marked.end();
        if (any && level < options.refinements && refined_count(field.domain, marked) <= options.most_tets) {
            field = refined(field, given, std::move(marked), options.threads);
            continue;
        }
        counts.inconsistent = map.inconsistent;
        counts.turned_over = map.turned_over;
        report_or_throw(progress, "lattice", 0, 0);
        return lattice_cells(field.domain, map, options.min_scaled_jacobian, options.threads);
    }
}

LatticeCells points_of(WorkingField& field, const WorkingField& given, const HexDominantOptions& options,
                       HexDominantCounts& counts, const Progress& progress) {
    if (options.points == CellPoints::periodic) return periodic_points(field, given, options, counts, progress);
    report_or_throw(progress, "sizes", 0, 0);
    return frontal_points(field.domain, field.frames, tet_axes(field, options), options.threads, progress);
}

HexDominantMesh mesh_along(const WorkingField& given, const HexDominantOptions& options, const Progress& progress) {
    HexDominantMesh result;
    result.points = options.points;
    HexDominantCounts& counts = result.counts;
    WorkingField field = given;
    std::optional<LatticeCells> cells = points_of(field, given, options, counts, progress);
    counts.tets = field.domain.tet_count();
    counts.lost = cells->lost;
    counts.lattice_hexahedra = static_cast<Index>(cells->hexahedra.rows());
    const EdgeLengths lengths(field.sizes);
    FilledCells filled = filled_cells(field.domain, *cells, lengths, progress);
    cells.reset();
    MixedMesh mesh = conforming(filled, options, counts, progress);
    counts.crossing = filled.cells.crossing;
    const PointSurface& surface = filled.cells.surface;
    result.support = vertex_support(surface, static_cast<Index>(mesh.vertices.rows()));
    if (!given.domain.regions().empty()) result.regions = cell_regions(field.domain, surface, mesh);
    if (options.improve) {
        report_or_throw(progress, "improve", 0, 0);
        mesh = improved(mesh, field.domain, result.support, result.regions, lengths.shortest(), options.threads);
    }
    require_valid(mesh);
    result.mesh = std::move(mesh);
    drop_unused_vertices(result);
    return result;
}

double hexahedra_of_volume(const MixedMesh& mesh) {
    const Eigen::VectorXd volumes = cell_volumes(mesh);
    return volumes.segment(mesh.tets.rows(), mesh.hexahedra.rows()).sum() / volumes.sum();
}

// The mesh, or why there is none.
struct Attempt {
    std::optional<HexDominantMesh> mesh;
    double share = -1;
    std::exception_ptr error;
};

Attempt attempt(const WorkingField& given, HexDominantOptions options, CellPoints points, const Progress& progress) {
    options.points = points;
    Attempt result;
    try {
        result.mesh = mesh_along(given, options, progress);
        result.share = hexahedra_of_volume(result.mesh->mesh);
    } catch (const GeometryError&) {
        result.error = std::current_exception();
    } catch (const SolverError&) {
        result.error = std::current_exception();
    }
    return result;
}

HexDominantMesh best_mesh(const WorkingField& given, const HexDominantOptions& options, const Progress& progress) {
    Attempt map = attempt(given, options, CellPoints::periodic, progress);
    if (map.share >= enough) return std::move(*map.mesh);
    Attempt front = attempt(given, options, CellPoints::frontal, progress);
    if (!map.mesh && !front.mesh) std::rethrow_exception(map.error);
    return std::move(front.share > map.share ? *front.mesh : *map.mesh);
}

}  // namespace

HexDominantMesh hex_dominant(const TetDomain& domain, const Quaternions& frames, const HexDominantOptions& options,
                             const Progress& progress) {
    require_options(options);
    require_frames(frames, domain.vertex_count());
    const WorkingField given{domain, frames, wanted_sizes(domain, options)};
    require_count(given, options.most_hexahedra);
    return options.points == CellPoints::best ? best_mesh(given, options, progress)
                                              : mesh_along(given, options, progress);
}

}  // namespace octafield::volume
