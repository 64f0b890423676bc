#include "given_corners.hpp"

#include <algorithm>
#include <utility>

namespace octafield::surface::detail {

std::map<Index, std::vector<int>> given_corners(const QuadMesh& mesh, const Movable& movable) {
    const auto on_seam = [&](Index v) { return v < static_cast<Index>(movable.places.size()); };
    std::map<std::pair<Index, Index>, std::vector<Index>> beside;
    const auto edge = [&](Index q, int k) -> std::pair<Index, Index> {
        return std::minmax(mesh.quads(q, k), mesh.quads(q, (k + 1) % 4));
    };
    for (Index q = 0; q < mesh.quads.rows(); ++q)
        for (int k = 0; k < 4; ++k)
            if (on_seam(mesh.quads(q, k)) && on_seam(mesh.quads(q, (k + 1) % 4))) beside[edge(q, k)].push_back(q);
    const auto along_seam = [&](Index q, int k) {
        const auto found = beside.find(edge(q, k));
        if (found == beside.end()) return false;
        const std::vector<Index>& quads = found->second;
        return quads.size() == 1 || movable.part[quads[0]] != movable.part[quads[1]];
    };
    std::map<Index, std::vector<int>> result;
    for (Index q = 0; q < mesh.quads.rows(); ++q)
        for (int k = 0; k < 4; ++k) {
            const Index v = mesh.quads(q, k);
            if (on_seam(v) && movable.fixed[v] && along_seam(q, k) && along_seam(q, (k + 3) % 4))
                result[q].push_back(k);
        }
    return result;
}

}  // namespace octafield::surface::detail
