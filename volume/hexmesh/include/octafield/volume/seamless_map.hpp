// Seamless maps of tet meshes: parameters whose whole numbers can become the lines of a hex mesh.
#pragma once

#include <vector>

#include "octafield/arrays.hpp"
#include "octafield/volume/tet_domain.hpp"

namespace octafield::volume {

// Parameters per corner of a tet. Over a triangle of two tets they go on after one of the 24 rotations of the cube and
// a translation (Nieser, Reitebuch, Polthier 2011). walls: triangles that cut the mesh into blocks, each a box in its
// parameters, the boundary among them (the motorcycle complex; Brueckler, Gupta, Mandad, Campen 2022).
struct SeamlessMap {
    TetMesh mesh;
    Rows<double, 12> parameters;   // (m, 12), column 3 c + i: parameter i of corner c
    Triangles walls{0, 3};         // vertex ids in any order
    Edges features{0, 2};          // feature edges of the boundary, vertex ids
    std::vector<Index> corners{};  // feature corners, vertex ids
};

struct SeamlessReport {
    std::vector<Index> flipped;  // tets whose parameters are turned over or flat
    double residual = 0;  // largest distance between the two parameters of a vertex of a triangle after the transition
    std::vector<Index> torn;  // tets next to a triangle where that is above 1e-6 of the tets' parameters
    Index unaligned = 0;      // boundary triangles without a constant parameter
    double volume = 0;        // of the tets in parameters
    Edges wound{0, 2};        // edges round which parameters turn as in no hex mesh, though no tet may be flipped
};

// Throws what require_valid and triangle_table throw, and InvalidInput: kinds "wrong_size", "non_finite_parameter",
// "index_out_of_range" (walls, features, corners), all naming rows.
SeamlessReport seamless_report(const SeamlessMap& map);

// The tets with the map's features, or where it has neither edges nor corners, with edges of 40 degrees. Throws what
// TetDomain throws, and InvalidInput ("index_out_of_range": features beyond the mesh or inside it).
TetDomain map_domain(const SeamlessMap& map);

}  // namespace octafield::volume
