// Two lines per vertex from a linear system: harmonic extension of what the boundary asks for.
#pragma once

#include "linked_vertices.hpp"

namespace octafield::surface::detail {

enum class Extended {
    power_sums,    // p1 and p2
    coefficients,  // u + v and u v, those of the PolyVector
};

// Lines at the vertices that are not `given` (V), the others as they are. Every connected part must have a given
// vertex. Throws SolverError of kind not_definite (definiteness.hpp) where the weights are not.
std::vector<TwoLines> harmonic_lines(const std::vector<VertexLink>& links, const std::vector<bool>& given,
                                     std::vector<TwoLines> lines, Extended extended);

// Links whose weights are all positive: what the others are replaced by is small.
std::vector<VertexLink> with_positive_weights(std::vector<VertexLink> links);

}  // namespace octafield::surface::detail
