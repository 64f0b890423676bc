// What a sized field is to follow: values held at vertices, and a right-hand side.
#pragma once

#include <vector>

#include "octafield/surface/sized_field.hpp"
#include "vertex_charts.hpp"

namespace octafield::surface::detail {

struct GivenDirections {
    std::vector<bool> is_held;   // (V)
    Eigen::VectorXcd held;       // (V) of length 1, 0 where not held
    Eigen::VectorXcd source;     // (V) weight times the value; 0: nothing given, or held
    std::vector<bool> followed;  // (E) edges that the alignment options ask to follow strongly
};

// Throws InvalidInput as sized_field.
GivenDirections given_directions(const SurfaceDomain& domain, const VertexCharts& charts,
                                 const SizedFieldOptions& options);

}  // namespace octafield::surface::detail
