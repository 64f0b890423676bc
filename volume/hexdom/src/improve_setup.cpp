#include "improve_setup.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "octafield/error.hpp"
#include "octafield/parallel.hpp"

namespace octafield::volume::detail {
namespace {

using Kind = VertexSupport::Kind;

bool any_of_kind(const VertexSupport& support, Kind kind) {
    return std::ranges::find(support.kind, kind) != support.kind.end();
}

}  // namespace

void require_options(const ImproveOptions& options) {
    const auto require = [](bool good, const std::string& what) {
        if (!good) throw InvalidInput(what, "option_out_of_range");
    };
    require(options.sweeps >= 0, "sweeps is " + std::to_string(options.sweeps) + "; give 0 or more");
    require(options.good >= 0 && options.good <= 1, "good is " + std::to_string(options.good) + "; give 0 to 1");
    require(options.tolerance >= 0 && std::isfinite(options.tolerance),
            "tolerance is " + std::to_string(options.tolerance) + "; give a length of 0 or more");
}

void require_vertices(const MixedMesh& mesh, const VertexSupport& support) {
    if (static_cast<Eigen::Index>(support.kind.size()) != mesh.vertices.rows())
        throw InvalidInput("support has " + std::to_string(support.kind.size()) + " kinds for " +
                               std::to_string(mesh.vertices.rows()) + " vertices; give one for each",
                           "wrong_size");
    std::vector<Index> lost;
    for (Index v = 0; v < mesh.vertices.rows(); ++v)
        if (!mesh.vertices.row(v).allFinite()) lost.push_back(v);
    if (!lost.empty())
        throw InvalidInput("vertices are not finite (" + first_few(lost) + "); correct or remove them",
                           "non_finite_vertex", lost);
}

std::unique_ptr<SurfaceGuide> guide_for(const VertexSupport& support, const surface::TriangleMesh& surface,
                                        const surface::FeatureGraph& features) {
    const bool on_patches = any_of_kind(support, Kind::surface), on_curves = any_of_kind(support, Kind::curve);
    if (!on_patches && !on_curves) return nullptr;
    auto guide = std::make_unique<SurfaceGuide>(surface, features);
    if (on_patches && !guide->has_triangles())
        throw InvalidInput("vertices shall stay on a surface without area; give the surface, or none of kind surface",
                           "no_surface");
    if (on_curves && !guide->has_edges())
        throw InvalidInput(
            "vertices shall stay on feature curves where there are none; give them, or none of kind curve",
            "no_features");
    return guide;
}

VertexSupport settled(VertexSupport support, const Points& vertices, const SurfaceGuide& guide, double tolerance,
                      int threads) {
    parallel_for(vertices.rows(), threads, [&](std::int64_t v) {
        Kind& kind = support.kind[v];
        if (!guide.has_edges() || (kind != Kind::surface && kind != Kind::curve)) return;
        const Eigen::Vector3d at = vertices.row(v);
        const SurfaceGuide::Place place = guide.nearest_on_curves(at);
        if ((place.point - at).norm() > tolerance) return;
        kind = guide.at_corner(place, tolerance) ? Kind::fixed : Kind::curve;
    });
    return support;
}

std::vector<std::vector<Index>> colours(const MixedMesh& mesh, const VertexCells& cells, const VertexSupport& support) {
    std::vector<std::vector<Index>> of_colour;
    std::vector<int> colour(mesh.vertices.rows(), -1);
    std::vector<Index> seen;
    for (Index v = 0; v < mesh.vertices.rows(); ++v) {
        if (support.kind[v] == Kind::fixed || cells.of(v).empty()) continue;
        for (const Incidence& at : cells.of(v))
            for (const Index other : cell_vertices(mesh, at.cell))
                if (colour[other] >= 0) seen[colour[other]] = v;
        const auto free = std::ranges::find_if(seen, [&](Index last) { return last != v; }) - seen.begin();
        if (free == static_cast<std::ptrdiff_t>(seen.size())) {
            seen.push_back(-1);
            of_colour.emplace_back();
        }
        colour[v] = static_cast<int>(free);
        of_colour[free].push_back(v);
    }
    return of_colour;
}

}  // namespace octafield::volume::detail
