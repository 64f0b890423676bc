// Which faces and edges cells need where. Two cells can stand together if they share no tet, no triangle as parts of
// different faces, and no edge that is a diagonal on one's quad, but for the same quad: a quad that meets two triangles
// gets a pyramid, and the diagonal has to go.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "cell_facets.hpp"
#include "octafield/volume/mixed_mesh.hpp"
#include "potential_cells.hpp"

namespace octafield::volume::detail {

// A quad by its vertices and order, or a triangle.
struct FaceKey {
    std::array<Index, 4> sorted;  // of a triangle the last is -1
    Index across;                 // from the lowest; -1 of a triangle
    // 0, or the quad may be met on one pair of triangles only, as more than a flat tet lies between that and the other
    // pair: 1 on the diagonal of the lowest vertex, 2 on the other.
    Index variant;
    bool operator==(const FaceKey& other) const {
        return sorted[0] == other.sorted[0] && sorted[1] == other.sorted[1] && sorted[2] == other.sorted[2] &&
               sorted[3] == other.sorted[3] && across == other.across && variant == other.variant;
    }
};

// The triangles that must be this face, or nothing.
struct FaceClaim {
    FaceKey key;
    std::array<Index, 4> triangles;
    int count;       // 1, 2, or 4: the pair beyond a flat tet, too
    Index flat;      // the flat tet, -1: none
    Index diagonal;  // the edge between the outermost pair, -1: of a triangle, or closed
};

struct CellClaims {
    std::array<FaceClaim, 6> faces;
    int count;
    std::array<Index, 12> edges;
    int edge_count;
};

// What lies outside the tets: of each triangle of one tet, the boundary or a face of another cell.
class TetSurroundings {
public:
    // kept: edges that become no diagonal of a quad on the boundary. walls: (triangles) 1 between regions; may be
    // empty.
    TetSurroundings(const MixedMesh& mesh, const TetTopology& topology, const Edges& kept,
                    const std::vector<std::uint8_t>& walls, double max_fold);

    // Nothing where the cell cannot stand whatever else does: a quad would lie in part on the boundary, on a wall or on
    // a cell that stays, cross one of its quads, take an edge from a wall, or fold the boundary or a wall.
    std::optional<CellClaims> claims(const CellShape& shape, const Index* ids, unsigned inner_pairs) const;

private:
    enum Outside : Index { wall = -3, tets = -2, boundary = -1 };  // or the number of a fixed face
    enum class Lies { off, half, on };                             // walls
    void add_fixed_faces(const Cell& cell);
    bool add_fixed_face(const std::array<Index, 4>& round, int corners);
    std::optional<FaceClaim> claim(const CellFacet& facet) const;
    bool may_close(const CellFacet& facet, int pair) const;
    bool may_be_quad(const CellFacet& facet, int pair) const;
    Lies on_wall(const CellFacet& facet, int pair) const;
    bool fits_walls(const CellFacet& facet, Index flat) const;

    const MixedMesh& mesh_;
    const TetTopology& topology_;
    const double least_cosine_;
    std::vector<Index> outside_;             // (triangles)
    std::vector<FaceKey> fixed_;             // faces of cells that stay, that lie on tets
    std::vector<std::uint8_t> fixed_edges_;  // (edges) 1: of cells that stay
    std::vector<Index> fixed_diagonals_;     // (edges) the face of a cell that stays on which it lies, -1: none
    std::vector<std::uint8_t> kept_;         // (edges)
    std::vector<Index> walls_at_;            // (edges) triangles of walls; empty without
};

}  // namespace octafield::volume::detail
