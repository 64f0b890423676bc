// What parameterizations ask of a frame field in the tets: matchings across triangles, and axes that are continuous but
// for a cut.
#pragma once

#include <cstdint>
#include <vector>

#include "octafield/volume/tet_domain.hpp"

namespace octafield::volume {

// Every triangle between two tets.
struct FaceMatchings {
    Triangles triangles;  // (f, 3) vertex ids, ascending in each row, rows in lexicographic order
    Edges tets;           // (f, 2) the tets on its sides, lower first
    // (f) element of the octahedral group (frames/octahedral_group.hpp, in the order AlgoHex uses): q1 o is close to
    // q2, q1 and q2 the frames of the first and second tet. An axis a of the first, its coordinates in that frame, is
    // o^-1 a in the second.
    std::vector<std::uint8_t> matching;
};

// of_tets: (m, 4) unit quaternions w x y z. Near linear; the same result at any thread count. Throws InvalidInput,
// GeometryError (unsound mesh).
FaceMatchings face_matchings(const TetDomain& domain, const Quaternions& of_tets, int threads = 0);

// The field with representatives chosen so that the axes of neighbouring tets correspond by number and sign but across
// the cut: triangles that leave each connected part of the mesh simply connected and touch every singular edge. By
// integers alone, after the matchings: a breadth-first spanning tree of the tets, then triangles that are the only one
// of the cut at a regular edge inside the mesh are taken back until none is (after Nieser, Reitebuch, Polthier 2011).
// In a ball without singular edges nothing is left as a rule, though no theorem says so. The order of a tet's vertices
// does not matter; a field that is combed stays as it is.
struct CombedField {
    Quaternions frames;                 // (m, 4): q o, with signs that agree from parent to child in the tree
    std::vector<std::uint8_t> element;  // (m) o, of the octahedral group; 0 in the lowest tet of each part
    FaceMatchings faces;                // of `frames`; 0 but on the cut, where it may be 0 too
    std::vector<std::uint8_t> cut;      // (f) 1: of the cut
    Index parts = 0;                    // parts of the mesh that triangles connect
};

// As face_matchings.
CombedField comb(const TetDomain& domain, const Quaternions& of_tets, int threads = 0);

// The field at the vertices with representatives chosen so that the axes of neighbouring vertices correspond by number
// and sign but across a cut, which ends at the singular curves that turn them: labels by a breadth-first spanning tree,
// then vertex by vertex those that most neighbours agree with. A field that is combed stays as it is.
struct CombedVertices {
    Quaternions frames;                 // (n, 4): q o, with signs that agree where the axes do
    std::vector<std::uint8_t> element;  // (n) o, of the octahedral group
    std::vector<std::uint8_t> agree;    // (m) axes_agree of `frames`
    Index parts = 0;                    // of the mesh that edges connect
};

// As face_matchings, with (n, 4) frames at the vertices.
CombedVertices comb_vertices(const TetDomain& domain, const Quaternions& of_vertices, int threads = 0);

// Per tet, 1: the axes of its four frames correspond by number and sign, each being nearest to the one of the same
// name, so that they may be interpolated one by one. 0: the tet lies on the cut or at a singular curve.
std::vector<std::uint8_t> axes_agree(const TetDomain& domain, const Quaternions& of_vertices, int threads = 0);

}  // namespace octafield::volume
