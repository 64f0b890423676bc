// The loop of Dermine 2024, (3.16): minimise over u and v of any length, scale them to length 1, in turn.
#pragma once

#include <functional>

#include "boundary_lines.hpp"
#include "linked_vertices.hpp"

namespace octafield::surface::detail {

struct LoopResult {
    int rounds = 0;
    bool converged = false;
};

// Changes `lines` in place, those that are given excepted. `told` hears E_s after each round; false from it stops.
LoopResult projected_loop(const std::vector<VertexLink>& links, const BoundaryLines& boundary,
                          const VertexCharts& charts, const NonOrthogonalFieldOptions& options,
                          std::vector<TwoLines>& lines, const std::function<bool(double energy)>& told);

}  // namespace octafield::surface::detail
