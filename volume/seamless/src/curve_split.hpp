// A field at the vertices as one in tets whose singular curves are edges: the mesh is cut along them.
#pragma once

#include <cstdint>
#include <vector>

#include "edge_matchings.hpp"

namespace octafield::volume::detail {

// Frames in tets with matchings across triangles that are given, not the nearest.
struct MatchedField {
    TetDomain domain;
    Quaternions frames;                  // (m, 4)
    std::vector<std::uint8_t> matching;  // per row of domain.triangles(), as FaceMatchings; 0 on the boundary
    std::vector<Index> parent;           // (m) tet of the mesh at first
    Edges curves;                        // (e, 2) singular edges, lower vertex first, in order
};

// Every singular triangle gets a vertex in its middle, each tet next to one a vertex inside, and the tet becomes the
// cone of its cut faces; so curves run along edges from triangle to tet to triangle, as in singular_graph
// (singularities.hpp). Tets with complex triangles between them become one cone where a point sees all its faces: their
// nodes are then one. A tet has the mean frame of those of its vertices that the old mesh had, by the labels of one of
// them; matchings go by the vertices that two tets share. So round each new edge the frames turn as round its triangle,
// and round no other edge. Near linear.
MatchedField split_along_curves(const TetDomain& domain, const Quaternions& frames, const EdgeMatchings& matchings);

// The mesh, which has the vertices of the old one first and more inside and on the surface but for features, with the
// old one's features.
TetDomain with_features_of(const TetDomain& old, TetMesh mesh);

// The field on a mesh of parts of its tets.
MatchedField of_parts(const MatchedField& field, TetDomain domain, const std::vector<Index>& parent);

}  // namespace octafield::volume::detail
