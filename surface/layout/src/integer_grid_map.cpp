#include "octafield/surface/integer_grid_map.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "grid_map.hpp"
#include "merged_vertices.hpp"
#include "octafield/error.hpp"
#include "quad_builder.hpp"
#include "quad_rows.hpp"

namespace octafield::surface {
namespace {

using detail::ChartedMesh;
using detail::GridMap;
using detail::Vector2;

void require_counts(const QuadLayout& layout, const QuantizedQuads& quads, const detail::Seams& seams) {
    const auto none_below_0 = [](const std::vector<int>& counts) {
        return std::all_of(counts.begin(), counts.end(), [](int n) { return n >= 0; });
    };
    bool fit = quads.arc_counts.size() == layout.sides.size() && quads.part_counts.size() == seams.parts.size() &&
               none_below_0(quads.arc_counts) && none_below_0(quads.part_counts) && quads.size > 0 &&
               std::isfinite(quads.size);
    const auto on = [&](const std::vector<DirectedSide>& sides) {
        long sum = 0;
        for (const DirectedSide& s : sides) sum += quads.arc_counts[s.side];
        return sum;
    };
    for (std::size_t p = 0; fit && p < layout.patches.size(); ++p) {
        const auto sides = detail::four_sides(layout.patches[p]);
        fit = on(sides[0]) == on(sides[2]) && on(sides[1]) == on(sides[3]);
    }
    for (std::size_t s = 0; fit && s < seams.uses.size(); ++s) {
        long sum = 0;
        for (const detail::SeamUse& use : seams.uses[s]) sum += quads.part_counts[use.part];
        fit = seams.uses[s].empty() || sum == quads.arc_counts[s];
    }
    if (!fit)
        throw InvalidInput("the quads' whole numbers are not those of this layout and these origins", "bad_option");
}

void require_unfolded(const GridMap& map) {
    if (map.found.folded == 0) return;
    std::vector<Index> bad;
    for (std::size_t t = 0; t < map.mesh.triangles.size(); ++t) {
        const auto first = static_cast<Index>(3 * t);
        Eigen::Matrix2d edges;
        for (int k = 0; k < 2; ++k) edges.col(k) = map.place(first + k + 1) - map.place(first);
        if (!(edges.determinant() > 0)) bad.push_back(map.mesh.origins[t]);
    }
    std::sort(bad.begin(), bad.end());
    bad.erase(std::unique(bad.begin(), bad.end()), bad.end());
    throw SolverError(
        std::to_string(map.found.folded) + " triangles stay folded (in " + first_few(bad) +
            " of the surface): whole numbers are too far from the lengths; ask for smaller quads, or fine "
            "blocks",
        "folded_map", bad);
}

// From the coordinates alone.
double residual(const IntegerGridMap& map, const ChartedMesh& mesh) {
    double result = 0;
    const auto place = [&](Index corner) -> Vector2 { return map.coordinates.row(corner); };
    for (Index s = 0; s < mesh.side_count(); ++s) {
        const Index mate = mesh.mates[s];
        if (mate < s) continue;
        const Vector2 a = place(s), b = place(ChartedMesh::next(s)), c = place(ChartedMesh::next(mate)),
                      d = place(mate);
        double least = std::numeric_limits<double>::infinity();
        for (int k = 0; k < 4; ++k) {
            const Vector2 shift = c - detail::turned(a, k);
            const double off = (d - detail::turned(b, k) - shift).cwiseAbs().maxCoeff();
            least = std::min(least, std::max(off, (shift - shift.array().round().matrix()).cwiseAbs().maxCoeff()));
        }
        result = std::max(result, least);
    }
    return result;
}

void measure(const GridMap& map, IntegerGridMap& result) {
    double sum = 0, areas = 0;
    for (std::size_t t = 0; t < map.mesh.triangles.size(); ++t) {
        const auto& corners = map.mesh.triangles[t];
        const auto first = static_cast<Index>(3 * t);
        const Eigen::Vector3d u = map.mesh.positions[corners[1]] - map.mesh.positions[corners[0]],
                              v = map.mesh.positions[corners[2]] - map.mesh.positions[corners[0]];
        Eigen::Matrix2d edges, flat;
        for (int k = 0; k < 2; ++k) edges.col(k) = map.place(first + k + 1) - map.place(first);
        const double length = u.norm(), along = u.dot(v) / length;
        flat << length, along, 0, std::sqrt(std::max(0.0, v.squaredNorm() - along * along));
        const Eigen::Matrix2d by = edges * flat.inverse();
        const double found = by.squaredNorm() / (2 * by.determinant()), area = edges.determinant() / 2;
        sum += area * found;
        areas += area;
        result.largest_distortion = std::max(result.largest_distortion, found);
    }
    result.mean_distortion = sum / areas;
}

}  // namespace

IntegerGridMap integer_grid_map(const QuadLayout& layout, const QuantizedQuads& quads,
                                const std::vector<Index>& origins, const Progress& progress) {
    if (!layout.pieces || layout.patches.empty()) throw InvalidInput("the layout has no patches", "bad_option");
    detail::require_quads(layout);
    std::vector<Index> own(layout.domain.vertex_count());
    std::iota(own.begin(), own.end(), 0);
    const detail::Seams seams = detail::find_seams(layout, origins.empty() ? own : origins);
    require_counts(layout, quads, seams);
    const detail::SideGrids grids = detail::seamed_grids(layout, seams, quads.arc_counts, quads.part_counts);
    const GridMap map =
        detail::grid_map(layout, seams, {quads.arc_counts, quads.part_counts, grids.along}, quads.size, progress);
    require_unfolded(map);
    IntegerGridMap result;
    const auto count = static_cast<Eigen::Index>(map.mesh.triangles.size());
    result.positions.resize(static_cast<Eigen::Index>(map.mesh.positions.size()), 3);
    for (Eigen::Index v = 0; v < result.positions.rows(); ++v) result.positions.row(v) = map.mesh.positions[v];
    result.triangles.resize(count, 3);
    result.coordinates.resize(3 * count, 2);
    for (Eigen::Index t = 0; t < count; ++t)
        for (int k = 0; k < 3; ++k) {
            result.triangles(t, k) = map.mesh.triangles[t][k];
            result.coordinates.row(3 * t + k) = map.place(static_cast<Index>(3 * t + k));
        }
    result.triangle_origins = map.mesh.origins;
    for (const auto& f : map.mesh.fixed)
        if (f.singular) result.singular.push_back(map.mesh.from(f.corner));
    std::sort(result.singular.begin(), result.singular.end());
    result.largest_residual = residual(result, map.mesh);
    result.steps = map.found.steps;
    measure(map, result);
    return result;
}

}  // namespace octafield::surface
