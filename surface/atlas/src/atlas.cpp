#include "octafield/surface/atlas.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "chart_maker.hpp"
#include "chart_paths.hpp"
#include "octafield/error.hpp"
#include "octafield/surface/bisected_edges.hpp"

namespace octafield::surface {
namespace {

using detail::ChartMaker;
using detail::ChartMesh;
using detail::MappedChart;

constexpr Index inner_per_boundary = 2;  // coarse faces have fewer vertices inside for each one of the boundary
constexpr Index few_triangles = 5000;    // faces of more are not bisected
constexpr int bisection_rounds = 5;      // each halves the longest edges

void require_options(const SurfaceDomain& domain, const AtlasOptions& options) {
    if (domain.triangle_count() == 0) throw GeometryError("the surface has no triangles", "empty");
    if (!(options.conformity >= 0 && options.conformity < 1))
        throw InvalidInput("conformity must be at least 0 and below 1", "bad_option");
    if (options.max_triangles < 1) throw InvalidInput("max_triangles must be at least 1", "bad_option");
}

// Features that bound something: those that end inside a face are left out.
std::vector<bool> barriers(const SurfaceDomain& domain) {
    std::vector<Index> edges;
    for (Index e = 0; e < domain.edge_count(); ++e)
        if (domain.is_feature()[e]) edges.push_back(e);
    std::vector<bool> result(domain.edge_count(), false);
    for (const Index e : detail::without_dead_ends(domain, std::move(edges))) result[e] = true;
    return result;
}

bool is_coarse(const ChartMesh& face) {
    Index boundary = 0;
    for (const auto& loop : face.loops) boundary += static_cast<Index>(loop.size());
    return face.vertex_count() - boundary < inner_per_boundary * std::max<Index>(boundary, 1);
}

// Bounds for the edges of coarse faces that do not become one chart as asked; infinite elsewhere. coarse: by triangle
// of the input, found in the first round.
Eigen::VectorXd coarse_bounds(const Atlas& atlas, const AtlasOptions& options, const Progress& progress,
                              std::vector<bool>& coarse) {
    const SurfaceDomain& domain = atlas.domain;
    ChartMaker maker(domain, barriers(domain), options, progress, "bisecting");
    const bool first = coarse.empty();
    if (first) coarse.assign(domain.triangle_count(), false);
    Eigen::VectorXd bounds =
        Eigen::VectorXd::Constant(domain.triangle_count(), std::numeric_limits<double>::infinity());
    for (const std::vector<Index>& face : maker.faces()) {
        if (static_cast<Index>(face.size()) > few_triangles || (!first && !coarse[atlas.parents[face.front()]]))
            continue;
        const ChartMesh whole = maker.uncut(face);
        if (first && !is_coarse(whole)) continue;
        const std::vector<MappedChart> charts = maker.charts(face);
        if (charts.size() == 1 && charts[0].figures.as_asked) continue;
        for (const Index t : face) bounds[t] = whole.lengths.maxCoeff() / 2;
        for (const Index t : face) coarse[atlas.parents[t]] = true;
    }
    return bounds;
}

// Appends a chart's vertices and those of its triangles.
void append(MappedChart chart, Atlas& atlas, std::vector<bool>& is_cut) {
    const auto number = static_cast<Index>(atlas.chart_list.size());
    const auto first = static_cast<Index>(atlas.origins.size());
    atlas.chart_list.push_back(chart.figures);
    atlas.origins.insert(atlas.origins.end(), chart.mesh.origins.begin(), chart.mesh.origins.end());
    atlas.uv.conservativeResize(first + chart.uv.rows(), 2);
    atlas.uv.bottomRows(chart.uv.rows()) = chart.uv;
    for (Index i = 0; i < chart.mesh.triangle_count(); ++i) {
        const Index t = chart.mesh.parents[i];
        atlas.charts[t] = number;
        atlas.uv_triangles.row(t) = chart.mesh.triangles.row(i).array() + first;
        atlas.conformity[t] = chart.conformity[i];
        for (int k = 0; k < 3; ++k)
            if (chart.mesh.neighbours(i, k) < 0) is_cut[atlas.domain.topology().triangle_edges(t, k)] = true;
    }
}

}  // namespace

Atlas atlas(const SurfaceDomain& input, const AtlasOptions& options, const Progress& progress) {
    require_options(input, options);
    Atlas result;
    result.domain = input;
    result.parents.resize(input.triangle_count());
    std::iota(result.parents.begin(), result.parents.end(), 0);
    std::vector<bool> coarse;
    for (int round = 0; options.bisect && round < bisection_rounds; ++round) {
        const Eigen::VectorXd bounds = coarse_bounds(result, options, progress, coarse);
        if (!std::isfinite(bounds.minCoeff())) break;
        BisectedEdges finer = bisected_edges(result.domain, bounds);
        for (Index& parent : finer.parents) parent = result.parents[parent];
        result.parents = std::move(finer.parents);
        result.domain = std::move(finer.domain);
    }
    const SurfaceDomain& domain = result.domain;
    const Index count = domain.triangle_count();
    result.faces.resize(count);
    result.charts.resize(count);
    result.uv_triangles.resize(count, 3);
    result.conformity.resize(count);
    std::vector<bool> is_cut(domain.edge_count(), false);
    ChartMaker maker(domain, barriers(domain), options, progress, "mapping");
    std::vector<MappedChart> charts;
    for (const std::vector<Index>& face : maker.faces()) {
        const ChartMesh whole = maker.uncut(face);
        for (const Index t : face) result.faces[t] = static_cast<Index>(result.face_list.size());
        result.face_list.push_back({whole.genus(), static_cast<int>(whole.loops.size()), whole.triangle_count()});
        for (MappedChart& chart : maker.charts(face)) charts.push_back(std::move(chart));
    }
    std::sort(charts.begin(), charts.end(), [](const MappedChart& a, const MappedChart& b) {
        return a.mesh.parents.front() < b.mesh.parents.front();
    });
    for (MappedChart& chart : charts) append(std::move(chart), result, is_cut);
    std::vector<Index> cuts;
    for (Index e = 0; e < domain.edge_count(); ++e)
        if (is_cut[e] && !domain.is_feature()[e]) cuts.push_back(e);
    result.cuts = domain.topology().edges(cuts, Eigen::all);
    return result;
}

}  // namespace octafield::surface
