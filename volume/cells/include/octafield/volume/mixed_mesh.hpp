// Meshes of tets, hexahedra, wedges and pyramids that meet face to face: hex-dominant meshes.
#pragma once

#include <string>
#include <vector>

#include "octafield/cell_arrays.hpp"
#include "octafield/surface/quad_mesh.hpp"

namespace octafield::volume {

// Cells are numbered: the tets, then the hexahedra, the wedges, the pyramids.
struct MixedMesh {
    Points vertices;  // (n, 3), the input's length unit
    Tets tets{0, 4};
    Hexahedra hexahedra{0, 8};
    Wedges wedges{0, 6};
    Pyramids pyramids{0, 5};

    Index cell_count() const {
        return static_cast<Index>(tets.rows() + hexahedra.rows() + wedges.rows() + pyramids.rows());
    }
};

// One thing wrong with a mesh. Kinds, in the order in which they are tested:
//   "empty"; "index_out_of_range"; "non_finite_vertex" (cells at such vertices); "repeated_vertex" (in one cell);
//   "inverted_cell": the Jacobian at a corner is not above 0;
//   "crowded_face": more than two cells share a face;
//   "twisted_face": two cells have a quad of the same vertices in another order round it;
//   "folded_cell": two cells lie on the same side of a face they share, so they overlap;
//   "mismatched_face": a triangle between three corners of another cell's quad, so that faces meet in part.
// Where the last four are absent, every inner face belongs to two cells and the others close up.
struct CellDefect {
    std::string kind;
    std::vector<Index> cells;  // all of them, ascending
    std::string message;       // one sentence: what, where (first few), and the remedy
};

// All defects found; faces are not looked at where ids are out of range, vertices lost or repeated. O(m log m).
std::vector<CellDefect> find_cell_defects(const MixedMesh& mesh);

// Throws GeometryError with the first defect's kind, cells and message.
void require_valid(const MixedMesh& mesh);

// Faces of one cell only.
struct CellBoundary {
    surface::QuadMesh mesh;         // compact numbering, faces outward
    std::vector<Index> vertex_map;  // boundary vertex -> vertex of the mesh, ascending
    std::vector<Index> cells;       // (mesh.face_count()) the cell behind each face
};

// Where faces do not match, both sides are boundary. Throws GeometryError (kind "index_out_of_range"), as do the
// functions below.
CellBoundary cell_boundary(const MixedMesh& mesh);

// Of each cell, least over its corners, as Verdict defines it (Knupp et al. 2006; Verdict 1.4): in [-1, 1], of pyramids
// in [0, 1]; 1 for the regular tet, the cube, the right wedge over an equilateral triangle, of any height, and the
// pyramid of equal edges; 0 and less where a corner is flat or inverted. (cell_count). Of hexahedra the middle counts
// as a corner, too; of pyramids the corners are those of four tets, each of a base corner, its neighbours and the apex.
Eigen::VectorXd scaled_jacobians(const MixedMesh& mesh);

// (cell_count), signed, input unit^3: of the cells with bilinear faces, exactly.
Eigen::VectorXd cell_volumes(const MixedMesh& mesh);

}  // namespace octafield::volume
