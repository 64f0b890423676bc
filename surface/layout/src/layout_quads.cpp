#include "octafield/surface/layout_quads.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "octafield/error.hpp"
#include "quad_builder.hpp"

namespace octafield::surface {
namespace {

constexpr double most_quads = 1e8;

void require_no_joints(const QuadLayout& layout) {
    std::vector<Index> bad;
    for (std::size_t v = 0; v < layout.vertices.size(); ++v)
        if (layout.vertices[v].kind == LayoutVertexKind::t_joint) bad.push_back(static_cast<Index>(v));
    if (!bad.empty())
        throw InvalidInput("the layout has T-joints at vertices " + first_few(bad) + "; quantized_quads takes those",
                           "t_joints", bad);
}

std::vector<int> counts_for(const QuadLayout& layout, double size) {
    std::vector<int> counts;
    for (const LayoutChord& chord : layout.chords) {
        // A side from a vertex to itself is a polygon of three edges at least.
        const bool loops = std::any_of(chord.sides.begin(), chord.sides.end(),
                                       [&](Index s) { return layout.sides[s].first == layout.sides[s].last; });
        counts.push_back(static_cast<int>(std::clamp(std::round(chord.length / size), loops ? 3.0 : 1.0, 1e6)));
    }
    return counts;
}

double total(const QuadLayout& layout, const std::vector<int>& counts) {
    double sum = 0;
    for (const LayoutPatch& patch : layout.patches) {
        const auto& loop = patch.loops[0];
        sum += static_cast<double>(counts[layout.sides[loop[0].side].chord]) * counts[layout.sides[loop[1].side].chord];
    }
    return sum;
}

// The number of quads falls with the size; bisected between sizes with too many and too few.
std::vector<int> counts_for_total(const QuadLayout& layout, double wanted) {
    double low = 0, high = 0;
    for (const LayoutChord& chord : layout.chords) high = std::max(high, 3 * chord.length);
    low = std::sqrt(layout.curves.parameter_area / wanted) / 16;
    for (int i = 0; i < 60; ++i) {
        const double middle = std::sqrt(low * high);
        (total(layout, counts_for(layout, middle)) >= wanted ? low : high) = middle;
    }
    const auto more = counts_for(layout, low), fewer = counts_for(layout, high);
    return total(layout, more) - wanted < wanted - total(layout, fewer) ? more : fewer;
}

std::vector<int> chord_counts(const QuadLayout& layout, const LayoutQuadsOptions& options) {
    const bool by_length = options.edge_length > 0 && std::isfinite(options.edge_length);
    if (by_length == (options.quad_count > 0) || !(options.edge_length >= 0) || options.quad_count < 0)
        throw InvalidInput("give either an edge length or a number of quads for a layout, > 0", "bad_option");
    std::vector<int> counts = by_length ? counts_for(layout, options.edge_length)
                                        : counts_for_total(layout, static_cast<double>(options.quad_count));
    if (total(layout, counts) > most_quads)
        throw InvalidInput("the edge length would give more than 1e8 quads", "bad_option");
    return counts;
}

}  // namespace

LayoutQuads layout_quads(const QuadLayout& layout, const LayoutQuadsOptions& options, const Progress& progress) {
    if (!layout.pieces || layout.patches.empty()) throw InvalidInput("the layout has no patches", "bad_option");
    detail::require_quads(layout);
    require_no_joints(layout);
    const std::vector<int> counts = chord_counts(layout, options);
    std::vector<int> side_counts;
    for (const LayoutSide& side : layout.sides) side_counts.push_back(counts[side.chord]);
    detail::QuadBuilder builder(layout, detail::side_grids(layout, side_counts));
    for (Index p = 0; p < static_cast<Index>(layout.patches.size()); ++p) {
        report_or_throw(progress, "map", p / static_cast<double>(layout.patches.size()), NAN);
        builder.add_patch(p);
    }
    LayoutQuads result = std::move(builder).result();
    result.chord_counts = counts;
    detail::require_convex(result);
    require_valid(result.mesh, false);
    return result;
}

Eigen::VectorXd quad_angle_quality(const QuadMesh& mesh) {
    Eigen::VectorXd result(mesh.quads.rows());
    for (Eigen::Index q = 0; q < result.size(); ++q) {
        double worst = 0;
        for (int k = 0; k < 4; ++k) {
            const Eigen::Vector3d at = mesh.vertices.row(mesh.quads(q, k));
            const Eigen::Vector3d u = mesh.vertices.row(mesh.quads(q, (k + 1) % 4)).transpose() - at;
            const Eigen::Vector3d v = mesh.vertices.row(mesh.quads(q, (k + 3) % 4)).transpose() - at;
            worst = std::max(worst, std::abs(std::numbers::pi / 2 - std::atan2(u.cross(v).norm(), u.dot(v))));
        }
        result[q] = std::max(0.0, 1 - 2 / std::numbers::pi * worst);
    }
    return result;
}

}  // namespace octafield::surface
