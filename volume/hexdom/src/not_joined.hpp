// Tets that are not joined to hexahedra and wedges again.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "octafield/volume/mixed_mesh.hpp"

namespace octafield::volume {

// Vertices of cells joined of tets that led to no mesh: tets on four of them are not joined again, and where a vertex
// is named a second time none at it are. Vertices beyond those of `filled` are none of its tets'.
class NotJoined {
public:
    explicit NotJoined(const MixedMesh& filled) : level_(filled.vertices.rows(), 0) {}

    // at_once: tets at one of them, too.
    void add(const std::vector<Index>& vertices, bool at_once) {
        const std::vector<std::uint8_t> before = level_;
        for (const Index v : vertices)
            if (v < static_cast<Index>(level_.size())) level_[v] = at_once || before[v] ? 2 : 1;
    }
    bool has(const Eigen::Matrix<Index, 1, 4>& tet) const {
        int least = 2, most = 0;
        for (const Index v : tet) {
            least = std::min<int>(least, level_[v]);
            most = std::max<int>(most, level_[v]);
        }
        return least > 0 || most > 1;
    }

private:
    std::vector<std::uint8_t> level_;
};

}  // namespace octafield::volume
