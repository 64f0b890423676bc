// All hexahedra and wedges that tets of a mesh can be joined to.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cell_shapes.hpp"
#include "tet_topology.hpp"

namespace octafield::volume::detail {

// Each once, in the order of the lowest vertex, which comes first.
struct PotentialCells {
    std::vector<std::array<Index, 8>> ids;  // of wedges the first six
    std::vector<double> quality;            // scaled Jacobian as scaled_jacobians has it
    std::vector<std::uint8_t> inner_pairs;  // bit f: CellFacet::inner of face f
    std::vector<Index> tet_start{0}, tets;  // cell c is made of the tets [tet_start[c], tet_start[c + 1])

    Index count() const { return static_cast<Index>(ids.size()); }
    std::span<const Index> tets_of(Index cell) const {
        return {tets.data() + tet_start[cell], tets.data() + tet_start[cell + 1]};
    }
};

struct TetSearch {
    const TetTopology& topology;
    const Points& vertices;
    const Tets& tets;
    double min_quality;                      // scaled Jacobian, > 0
    const std::vector<std::uint8_t>& taken;  // (m) not 0: tets not to be used; may be empty
    int threads;
    const std::vector<std::uint8_t>& walls;  // (triangles) not 0: between no two tets of a cell; may be empty
};

// Vertex by vertex, not by patterns (Pellerin, Johnen, Verhetsel, Remacle 2018, "Identifying combinations of tetrahedra
// into hexahedra: a vertex based strategy"): twelve edges of the mesh, six quads of two triangles each, positive
// corners. A quad's two triangles are those next to the inside where both diagonals are there.
PotentialCells potential_hexahedra(const TetSearch& search);
PotentialCells potential_wedges(const TetSearch& search);

}  // namespace octafield::volume::detail
