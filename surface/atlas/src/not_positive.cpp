// CGAL stays in this source.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include "octafield/surface/disk_parameterization.hpp"

namespace octafield::surface {

std::vector<Index> not_positive(const PlanePoints& uv, const Triangles& triangles) {
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    const auto at = [&](Index v) { return Kernel::Point_2(uv(v, 0), uv(v, 1)); };
    std::vector<Index> found;
    for (Index t = 0; t < triangles.rows(); ++t)
        if (CGAL::orientation(at(triangles(t, 0)), at(triangles(t, 1)), at(triangles(t, 2))) != CGAL::LEFT_TURN)
            found.push_back(t);
    return found;
}

}  // namespace octafield::surface
