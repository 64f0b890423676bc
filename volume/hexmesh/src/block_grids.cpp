#include "block_grids.hpp"

#include <string>

#include "octafield/error.hpp"

namespace octafield::volume::detail {
namespace {

struct Step {
    Index to;
    Vector3i by;
};

[[noreturn]] void no_grid(Index block) {
    throw GeometryError(
        "the numbers on the arcs of block " + std::to_string(block) + " make no grid: opposite sides need the same sum",
        "not_a_box", {block});
}

// Along the axis in which two corners of a patch differ in the block's chart.
Vector3i step(const BlockComplex& blocks, Index from, Index to, int number) {
    const Eigen::Vector3d way = blocks.places[to] - blocks.places[from];
    int axis = 0;
    way.cwiseAbs().maxCoeff(&axis);
    Vector3i result = Vector3i::Zero();
    result[axis] = way[axis] > 0 ? number : -number;
    return result;
}

}  // namespace

std::array<int, 2> patch_size(const BlockPatch& patch, const std::vector<int>& numbers) {
    const auto sum = [&](const std::vector<SideArc>& side) {
        int total = 0;
        for (const SideArc& part : side) total += numbers[part.arc];
        return total;
    };
    const std::array<int, 2> size{sum(patch.sides[0]), sum(patch.sides[2])};
    if (size[0] != sum(patch.sides[1]) || size[1] != sum(patch.sides[3])) no_grid(patch.places[0].block);
    return size;
}

BlockGrids block_grids(const BlockComplex& blocks, const std::vector<int>& numbers) {
    std::map<Index, std::vector<Step>> steps;
    std::vector<std::vector<Index>> corners(blocks.block_count());
    for (const BlockPatch& patch : blocks.patches) {
        const auto size = patch_size(patch, numbers);
        for (const PatchPlace& place : patch.places) {
            const auto& c = place.corners;
            for (const auto [from, to, along] : {std::array{0, 1, 0}, {2, 3, 0}, {0, 2, 1}, {1, 3, 1}}) {
                const Vector3i by = step(blocks, c[from], c[to], size[along]);
                steps[c[from]].push_back({c[to], by});
                steps[c[to]].push_back({c[from], -by});
            }
            corners[place.block].insert(corners[place.block].end(), c.begin(), c.end());
        }
    }
    BlockGrids grids;
    for (Index b = 0; b < blocks.block_count(); ++b) {
        if (corners[b].empty()) no_grid(b);
        std::vector<Index> reached{corners[b][0]};
        grids.places[reached[0]] = Vector3i::Zero();
        Vector3i low = Vector3i::Zero(), high = low;
        for (std::size_t next = 0; next < reached.size(); ++next) {
            const Vector3i here = grids.places.at(reached[next]);
            low = low.cwiseMin(here);
            high = high.cwiseMax(here);
            for (const Step& s : steps[reached[next]]) {
                const auto [known, added] = grids.places.insert({s.to, here + s.by});
                if (added) reached.push_back(s.to);
                if (known->second != here + s.by) no_grid(b);
            }
        }
        for (const Index corner : corners[b])
            if (!grids.places.count(corner)) no_grid(b);
        for (const Index corner : reached) grids.places[corner] -= low;
        grids.sizes.push_back(high - low);
    }
    return grids;
}

}  // namespace octafield::volume::detail
