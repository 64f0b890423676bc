#include "octafield/surface/layout_quads.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "octafield/error.hpp"
#include "patch_map.hpp"
#include "short_number.hpp"

namespace octafield::surface {
namespace {

constexpr double most_quads = 1e8;

void require_quads(const QuadLayout& layout) {
    std::vector<Index> bad;
    Index polygons = 0, annuli = 0;
    for (std::size_t p = 0; p < layout.patches.size(); ++p) {
        if (layout.patches[p].kind == PatchKind::quad) continue;
        bad.push_back(static_cast<Index>(p));
        polygons += layout.patches[p].kind == PatchKind::polygon;
        annuli += layout.patches[p].kind == PatchKind::annulus;
    }
    if (bad.empty()) return;
    throw GeometryError(
        std::to_string(bad.size()) + " of " + std::to_string(layout.patches.size()) + " patches of the layout (" +
            first_few(bad) + ") have no four corners: " + std::to_string(annuli) + " are annuli, " +
            std::to_string(polygons) +
            " are disks with another number of corners, the others neither. An annulus needs a corner "
            "or a singular point on it; for disks change the end tolerance, or move the singular points; "
            "other patches need singular points inside, as a pair of valence 3 and 5",
        "no_quad_layout", bad);
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

class Builder {
public:
    Builder(const QuadLayout& layout, std::vector<int> counts) : layout_(layout) {
        result_.chord_counts = std::move(counts);
        for (const LayoutVertex& vertex : layout.vertices) positions_.push_back(vertex.position);
        for (const LayoutSide& side : layout.sides) add_side(side);
    }

    void add_patch(Index patch) {
        const auto& around = layout_.patches[patch].loops[0];
        const std::vector<Index> bottom = directed(around[0]), right = directed(around[1]), top = directed(around[2]),
                                 left = directed(around[3]);
        const auto n = static_cast<int>(bottom.size()) - 1, m = static_cast<int>(right.size()) - 1;
        const auto inner = static_cast<Index>(positions_.size());
        const detail::PatchMap map = detail::patch_map(layout_, patch);
        if (map.folded) folded_.push_back(patch);
        result_.mean_value_patches += map.mean_value;
        const Points grid = detail::grid_positions(map, n, m);
        if (!map.folded && !grid.allFinite()) folded_.push_back(patch);
        for (Eigen::Index i = 0; i < grid.rows(); ++i) positions_.push_back(grid.row(i));
        const auto at = [&](int i, int j) {
            if (j == 0) return bottom[i];
            if (i == n) return right[j];
            if (j == m) return top[n - i];
            if (i == 0) return left[m - j];
            return inner + static_cast<Index>((j - 1) * (n - 1) + i - 1);
        };
        for (int j = 0; j < m; ++j)
            for (int i = 0; i < n; ++i) {
                quads_.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
                result_.patches.push_back(patch);
            }
        sizes_.push_back({n, m});
    }

    LayoutQuads result() && {
        if (!folded_.empty())
            throw SolverError("the maps of patches " + first_few(folded_) +
                                  " to rectangles are not one to one; refine the mesh, or raise the end tolerance if "
                                  "they are thin",
                              "folded_map", folded_);
        result_.mesh.vertices.resize(static_cast<Eigen::Index>(positions_.size()), 3);
        for (std::size_t v = 0; v < positions_.size(); ++v)
            result_.mesh.vertices.row(static_cast<Eigen::Index>(v)) = positions_[v];
        result_.mesh.quads.resize(static_cast<Eigen::Index>(quads_.size()), 4);
        for (std::size_t q = 0; q < quads_.size(); ++q)
            for (int k = 0; k < 4; ++k) result_.mesh.quads(static_cast<Eigen::Index>(q), k) = quads_[q][k];
        result_.patch_sizes.resize(static_cast<Eigen::Index>(sizes_.size()), 2);
        for (std::size_t p = 0; p < sizes_.size(); ++p)
            result_.patch_sizes.row(static_cast<Eigen::Index>(p)) << sizes_[p][0], sizes_[p][1];
        return std::move(result_);
    }

private:
    // Equal steps in parameters.
    void add_side(const LayoutSide& side) {
        const int count = result_.chord_counts[side.chord];
        std::vector<Index> ids = {side.first};
        Eigen::Index part = 0;
        for (int i = 1; i < count; ++i) {
            const double at = side.length() * i / count;
            while (part + 2 < side.parameters.size() && side.parameters[part + 1] < at) ++part;
            const double step = side.parameters[part + 1] - side.parameters[part];
            const double fraction = step > 0 ? std::clamp((at - side.parameters[part]) / step, 0.0, 1.0) : 0.0;
            ids.push_back(static_cast<Index>(positions_.size()));
            positions_.push_back((1 - fraction) * side.points.row(part) + fraction * side.points.row(part + 1));
        }
        ids.push_back(side.last);
        side_vertices_.push_back(std::move(ids));
    }
    std::vector<Index> directed(const DirectedSide& side) const {
        std::vector<Index> ids = side_vertices_[side.side];
        if (side.reversed) std::reverse(ids.begin(), ids.end());
        return ids;
    }

    const QuadLayout& layout_;
    LayoutQuads result_;
    std::vector<Eigen::Vector3d> positions_;
    std::vector<std::array<Index, 4>> quads_;
    std::vector<std::array<Index, 2>> sizes_;
    std::vector<std::vector<Index>> side_vertices_;
    std::vector<Index> folded_;
};

void require_convex(LayoutQuads& quads) {
    const Eigen::VectorXd jacobians = scaled_jacobians(quads.mesh);
    quads.least_scaled_jacobian = jacobians.minCoeff();
    std::vector<Index> bad;
    for (Eigen::Index q = 0; q < jacobians.size(); ++q)
        if (!(jacobians[q] > 0)) bad.push_back(static_cast<Index>(q));
    if (!bad.empty())
        throw SolverError(std::to_string(bad.size()) + " quads (" + first_few(bad) +
                              ") are not convex or inverted, the worst with scaled Jacobian " +
                              short_number(quads.least_scaled_jacobian) +
                              ": quads are too large for the curves they follow; ask for smaller ones",
                          "inverted_quads", bad);
}

}  // namespace

LayoutQuads layout_quads(const QuadLayout& layout, const LayoutQuadsOptions& options, const Progress& progress) {
    if (!layout.pieces || layout.patches.empty()) throw InvalidInput("the layout has no patches", "bad_option");
    require_quads(layout);
    Builder builder(layout, chord_counts(layout, options));
    for (Index p = 0; p < static_cast<Index>(layout.patches.size()); ++p) {
        report_or_throw(progress, "map", p / static_cast<double>(layout.patches.size()), NAN);
        builder.add_patch(p);
    }
    LayoutQuads result = std::move(builder).result();
    require_convex(result);
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
