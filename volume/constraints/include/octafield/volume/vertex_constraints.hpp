// Constraints of the user's own, at any vertices of a tet mesh.
#pragma once

#include <vector>

#include "octafield/volume/boundary.hpp"

namespace octafield::volume {

// Row i of each array belongs to vertices[i].
struct VertexConstraints {
    std::vector<Index> vertices;          // tet-mesh ids, each once
    std::vector<VertexConstraint> kinds;  // (k) free: lets a boundary vertex go
    Points axes;                          // (k, 3) of any length above 0 where the kind takes_axis; or no rows
    Quaternions frames;                   // (k, 4) unit w x y z where the kind takes_frame; or no rows
};

// `base` with the given constraints in place of its own at these vertices. Released corners among them that are held
// now are listed no more. Throws InvalidInput naming vertices: kinds "wrong_size", "index_out_of_range",
// "repeated_value", "unknown_word", "zero_axis", "not_unit".
BoundaryConstraints with_constraints(const BoundaryConstraints& base, const VertexConstraints& given);

}  // namespace octafield::volume
