// What keeps the matrix of a direction field positive definite to rounding, and what to say where it is not.
#pragma once

#include <functional>

#include "alignment.hpp"
#include "components.hpp"

namespace octafield::surface::detail {

// Where all that pulls at a component is rounding beside its stiffness, the pull is taken away and the component is not
// anchored: its field is as smooth as if nothing were asked.
void release_negligible(Components& components, AlignedEdges& aligned);

// Kind of the SolverError that a failed factorization throws.
inline constexpr const char* not_definite = "not_definite";

// Calls `solve`; an error of kind not_definite it throws is thrown anew with its cause: the thinnest triangles
// (elements), or weights that are too small to count.
void explaining_failure(const SurfaceDomain& domain, const std::function<void()>& solve);

}  // namespace octafield::surface::detail
