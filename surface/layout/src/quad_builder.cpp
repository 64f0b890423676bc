#include "quad_builder.hpp"

#include <algorithm>
#include <cmath>

#include "octafield/error.hpp"
#include "patch_map.hpp"
#include "short_number.hpp"

namespace octafield::surface::detail {

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

QuadBuilder::QuadBuilder(const QuadLayout& layout, SideGrids grids)
    : layout_(layout), grids_(std::move(grids)), positions_(std::move(grids_.positions)) {}

std::vector<Index> QuadBuilder::along(const LayoutPatch& patch, int k) const {
    const auto& loop = patch.loops[0];
    const Index end = k < 3 ? patch.corner_sides[k + 1] : static_cast<Index>(loop.size());
    std::vector<Index> ids;
    for (Index i = patch.corner_sides[k]; i < end; ++i) {
        std::vector<Index> part = grids_.vertices[loop[i].side];
        if (loop[i].reversed) std::reverse(part.begin(), part.end());
        ids.insert(ids.end(), part.begin() + (ids.empty() ? 0 : 1), part.end());
    }
    return ids;
}

void QuadBuilder::add_patch(Index patch) {
    const auto inner = static_cast<Eigen::Index>(positions_.size());
    add_grid(patch);
    if (sizes_.back()[0] == 0 || sizes_.back()[1] == 0) return;
    const PatchMap map = patch_map(layout_, patch, grids_.along);
    result_.mean_value_patches += map.mean_value;
    const Points grid = grid_positions(map, sizes_.back()[0], sizes_.back()[1]);
    if (map.folded || !grid.allFinite()) folded_.push_back(patch);
    for (Eigen::Index i = 0; i < grid.rows(); ++i) positions_[inner + i] = grid.row(i);
}

void QuadBuilder::add_grid(Index patch) {
    const LayoutPatch& around = layout_.patches[patch];
    const std::vector<Index> bottom = along(around, 0), right = along(around, 1), top = along(around, 2),
                             left = along(around, 3);
    const auto n = static_cast<int>(bottom.size()) - 1, m = static_cast<int>(right.size()) - 1;
    sizes_.push_back({n, m});
    for (int j = 0; n == 0 && j <= m; ++j) grids_.same.emplace_back(right[j], left[m - j]);
    for (int i = 0; m == 0 && i <= n; ++i) grids_.same.emplace_back(bottom[i], top[n - i]);
    if (n == 0 || m == 0) return;
    const auto inner = static_cast<Index>(positions_.size());
    positions_.resize(inner + static_cast<std::size_t>(n - 1) * (m - 1), Eigen::Vector3d::Zero());
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
}

LayoutQuads QuadBuilder::result() && {
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

}  // namespace octafield::surface::detail
