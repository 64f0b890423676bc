#include "octafield/surface/disk_parameterization.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "disk_map.hpp"
#include "octafield/disjoint_sets.hpp"
#include "octafield/error.hpp"

namespace octafield::surface {
namespace {

using detail::ChartMesh;

std::vector<Index> all_triangles(const SurfaceDomain& domain) {
    std::vector<Index> result(domain.triangle_count());
    std::iota(result.begin(), result.end(), 0);
    return result;
}

ChartMesh whole_chart(const SurfaceDomain& domain) {
    ChartMesh chart = detail::chart_mesh(domain, all_triangles(domain), [](Index) { return false; });
    std::vector<Index> sectors(domain.vertex_count(), 0), touching;
    for (const Index v : chart.origins)
        if (++sectors[v] == 2) touching.push_back(v);
    if (!touching.empty())
        throw GeometryError("parts of the surface touch at vertices " + first_few(touching) +
                                " only; split these vertices (repair, level \"safe\")",
                            "non_manifold_vertex", touching);
    return chart;
}

void require_disk(const ChartMesh& chart) {
    if (chart.triangle_count() == 0) throw GeometryError("the surface has no triangles", "empty");
    if (chart.components > 1) {
        DisjointSets sets(chart.triangle_count());
        for (Index t = 0; t < chart.triangle_count(); ++t)
            for (int k = 0; k < 3; ++k)
                if (chart.neighbours(t, k) >= 0) sets.join(t, chart.neighbours(t, k));
        std::vector<Index> firsts;
        for (Index t = 0; t < chart.triangle_count(); ++t)
            if (sets.lowest(t) == t) firsts.push_back(t);
        throw GeometryError("the surface has " + std::to_string(chart.components) + " parts (with triangles " +
                                first_few(firsts) + "); map each of them on its own, or make an atlas",
                            "not_connected", firsts);
    }
    if (chart.loops.empty())
        throw GeometryError("a closed surface has no boundary to go to the circle; cut it open, or make an atlas",
                            "closed");
    if (const int genus = chart.genus(); genus > 0)
        throw GeometryError("the surface has " + std::to_string(genus) + (genus == 1 ? " handle" : " handles") +
                                "; cut it open, or make an atlas",
                            "not_planar");
}

void require_map(const SurfaceDomain& domain, const PlanePoints& uv, const Triangles& uv_triangles) {
    if (uv_triangles.rows() != domain.triangle_count())
        throw InvalidInput("uv_triangles has " + std::to_string(uv_triangles.rows()) + " rows for " +
                               std::to_string(domain.triangle_count()) + " triangles",
                           "bad_shape");
    if (uv_triangles.rows() > 0 && (uv_triangles.minCoeff() < 0 || uv_triangles.maxCoeff() >= uv.rows()))
        throw InvalidInput("uv_triangles names rows of uv that do not exist; there are " + std::to_string(uv.rows()) +
                               ", numbered from 0",
                           "index_out_of_range");
}

}  // namespace

Eigen::SparseMatrix<double, Eigen::RowMajor> mean_value_weights(const SurfaceDomain& domain) {
    const ChartMesh chart = detail::chart_mesh(domain, all_triangles(domain), [](Index) { return false; });
    std::vector<Eigen::Triplet<double>> entries;
    detail::for_each_weight(chart, [&](Index i, Index j, double weight) {
        entries.emplace_back(chart.origins[i], chart.origins[j], weight);
    });
    Eigen::SparseMatrix<double, Eigen::RowMajor> weights(domain.vertex_count(), domain.vertex_count());
    weights.setFromTriplets(entries.begin(), entries.end());
    return weights;
}

std::vector<std::vector<Index>> boundary_loops(const SurfaceDomain& domain) {
    const ChartMesh chart = whole_chart(domain);
    std::vector<std::vector<Index>> loops = chart.loops;
    for (auto& loop : loops)
        for (Index& v : loop) v = chart.origins[v];
    for (auto& loop : loops) std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
    return loops;
}

DiskParameterization parameterize_disk(const SurfaceDomain& domain, const DiskOptions& options) {
    ChartMesh chart = whole_chart(domain);
    require_disk(chart);
    for (auto& loop : chart.loops)
        std::rotate(loop.begin(),
                    std::min_element(loop.begin(), loop.end(),
                                     [&](Index a, Index b) { return chart.origins[a] < chart.origins[b]; }),
                    loop.end());
    const PlanePoints found = detail::disk_map(chart, options.fill_holes);
    if (const std::vector<Index> bad = not_positive(found, chart.triangles); !bad.empty())
        throw GeometryError(std::to_string(bad.size()) + " triangles (" + first_few(bad) +
                                ") are not positive in the plane as doubles show them: the map is too uneven there" +
                                (options.fill_holes ? "" : ", or flat between free holes") +
                                "; cut or split the surface, or make an atlas",
                            "not_one_to_one", bad);
    DiskParameterization result;
    result.uv = PlanePoints::Zero(domain.vertex_count(), 2);
    for (Index v = 0; v < chart.vertex_count(); ++v) result.uv.row(chart.origins[v]) = found.row(v);
    result.loops = std::move(chart.loops);
    for (auto& loop : result.loops)
        for (Index& v : loop) v = chart.origins[v];
    return result;
}

MapDistortion map_distortion(const SurfaceDomain& domain, const PlanePoints& uv, const Triangles& uv_triangles) {
    require_map(domain, uv, uv_triangles);
    const ChartMesh chart = detail::chart_mesh(domain, all_triangles(domain), [](Index) { return false; });
    MapDistortion result{PlanePoints(domain.triangle_count(), 2), Eigen::VectorXd(domain.triangle_count())};
    for (Index t = 0; t < domain.triangle_count(); ++t) {
        const Eigen::Vector2d values = detail::stretches(chart, t, detail::corners_of(uv, uv_triangles, t)).cwiseAbs();
        result.singular_values.row(t) = values;
        result.conformity[t] = values[1] / values[0];
    }
    return result;
}

Rows<double, 3> plane_metric(const SurfaceDomain& domain, const PlanePoints& uv, const Triangles& uv_triangles,
                             double h) {
    require_map(domain, uv, uv_triangles);
    if (!(h > 0 && std::isfinite(h))) throw InvalidInput("h must be a number above 0", "bad_option");
    const ChartMesh chart = detail::chart_mesh(domain, all_triangles(domain), [](Index) { return false; });
    Rows<double, 3> result(domain.triangle_count(), 3);
    for (Index t = 0; t < domain.triangle_count(); ++t)
        result.row(t) = detail::pulled_metric(chart, t, detail::corners_of(uv, uv_triangles, t)) / (h * h);
    return result;
}

}  // namespace octafield::surface
