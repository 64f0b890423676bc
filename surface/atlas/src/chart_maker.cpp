#include "chart_maker.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "chart_paths.hpp"
#include "octafield/disjoint_sets.hpp"
#include "split_region.hpp"

namespace octafield::surface::detail {
namespace {

constexpr int relief_rounds = 8, paths_per_round = 4;
constexpr double relieved_scale = 0.2;   // cuts go to where the map is smaller than this, against its mean
constexpr double least_evenness = 0.01;  // charts more uneven than this are cut or split
constexpr Index least_split = 16;        // triangles; fewer are not split for the sake of conformity
constexpr double least_success = 0.5;    // of the area of a chart split for its sake, that it must be reached for

// The triangles of each connected part.
std::vector<std::vector<Index>> parts_of(const ChartMesh& chart) {
    DisjointSets sets(chart.triangle_count());
    for (Index t = 0; t < chart.triangle_count(); ++t)
        for (int k = 0; k < 3; ++k)
            if (chart.neighbours(t, k) >= 0) sets.join(t, chart.neighbours(t, k));
    Index count = 0;
    const std::vector<Index> part = std::move(sets).numbers(count);
    std::vector<std::vector<Index>> parts(count);
    for (Index t = 0; t < chart.triangle_count(); ++t) parts[part[t]].push_back(chart.parents[t]);
    return parts;
}

// So that both parts can be split into as few of at most `most` triangles as the whole, with half the room on either
// side of even parts left to later splits.
SplitBounds bounds_of(Index count, Index most) {
    const std::int64_t parts = (static_cast<std::int64_t>(count) + most - 1) / most, first = parts / 2;
    const auto even = static_cast<Index>(count * first / parts);
    const auto least = static_cast<Index>(std::max<std::int64_t>(0, count - (parts - first) * most));
    const auto largest = static_cast<Index>(std::min<std::int64_t>(count, first * most));
    return {even - (even - least) / 2, even + (largest - even) / 2};
}

}  // namespace

ChartMaker::ChartMaker(const SurfaceDomain& domain, std::vector<bool> barrier, const AtlasOptions& options,
                       const Progress& progress, const char* phase)
    : domain_(domain),
      barrier_(std::move(barrier)),
      slit_(domain.edge_count(), false),
      costs_(cut_costs(domain)),
      options_(options),
      progress_(progress),
      phase_(phase) {}

void ChartMaker::tell() const {
    report_or_throw(progress_, phase_, std::min(1.0, done_ / domain_.triangle_count()), std::nan(""));
}

ChartMesh ChartMaker::uncut(const std::vector<Index>& region) const {
    return chart_mesh(domain_, region, [&](Index e) { return barrier_[e]; });
}

std::vector<std::vector<Index>> ChartMaker::faces() const {
    std::vector<Index> all(domain_.triangle_count());
    std::iota(all.begin(), all.end(), 0);
    return parts_of(uncut(all));
}

double ChartMaker::merit(const MappedChart& chart) const {
    if (!chart.one_to_one) return -1;
    const double even = chart.figures.evenness / least_evenness;
    return std::min({1.0, even, options_.conformity > 0 ? chart.figures.conformity / options_.conformity : 1.0});
}

bool ChartMaker::as_asked(const MappedChart& chart) const { return merit(chart) >= 1; }

void ChartMaker::cut(const std::vector<Index>& edges, std::vector<Index>& all) {
    for (const Index e : edges) slit_[e] = true;
    all.insert(all.end(), edges.begin(), edges.end());
}

// With the fewest cuts that make it as asked, or those with which it is best.
MappedChart ChartMaker::best_map(const std::vector<Index>& region, const ChartMesh& whole) {
    std::vector<Index> slits;
    cut(opening_cuts(domain_, ChartPaths(domain_, whole, costs_), whole, costs_), slits);
    MappedChart best;
    for (int round = 0; round < relief_rounds; ++round) {
        tell();
        ChartMesh mesh = chart_mesh(domain_, region, [&](Index e) { return barrier_[e] || slit_[e]; });
        if (mesh.components > 1 || mesh.loops.empty() || mesh.genus() > 0) break;
        MappedChart chart = mapped_chart(std::move(mesh));
        const std::vector<Index> more = as_asked(chart)
                                            ? std::vector<Index>{}
                                            : relieving_cuts(ChartPaths(domain_, chart.mesh, costs_), chart.mesh,
                                                             chart.scale, relieved_scale, paths_per_round);
        if (round == 0 || merit(chart) > merit(best)) best = std::move(chart);
        if (more.empty()) break;
        cut(more, slits);
    }
    for (const Index e : slits) slit_[e] = false;
    return best;
}

std::vector<MappedChart> ChartMaker::charts(const std::vector<Index>& region) {
    const ChartMesh whole = uncut(region);
    std::vector<MappedChart> made;
    const auto add = [&](const std::vector<Index>& part) {
        for (MappedChart& chart : charts(part)) made.push_back(std::move(chart));
    };
    if (whole.components > 1) {
        for (const auto& part : parts_of(whole)) add(part);
        return made;
    }
    const Index count = whole.triangle_count();
    const bool fits = count <= options_.max_triangles;
    MappedChart chart;
    if (fits) chart = best_map(region, whole);
    chart.figures.as_asked = as_asked(chart);
    if (fits && (chart.figures.as_asked || count == 1 || (chart.one_to_one && count < least_split))) {
        made.push_back(std::move(chart));
        done_ += count;
        return made;
    }
    const SplitBounds bounds =
        fits ? SplitBounds{count / 4, count - count / 4} : bounds_of(count, options_.max_triangles);
    const std::vector<bool> second = split_in_two(domain_, whole, costs_, bounds);
    std::vector<Index> parts[2];
    for (Index t = 0; t < count; ++t) parts[second[t]].push_back(region[t]);
    for (const auto& part : parts) add(part);
    if (!chart.one_to_one) return made;
    double well = 0;  // area of charts that are as asked
    for (const MappedChart& part : made)
        if (part.figures.as_asked) well += part.figures.area;
    if (well < least_success * chart.figures.area) made.assign(1, std::move(chart));
    return made;
}

}  // namespace octafield::surface::detail
