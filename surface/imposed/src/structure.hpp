// Connected components and boundary curves of a surface whose vertices have one fan each.
#pragma once

#include <vector>

#include "octafield/surface/surface_domain.hpp"

namespace octafield::surface::detail {

struct Structure {
    struct Curve {
        Index edge;     // its lowest
        Index vertex;   // its lowest
        double length;  // input unit
    };
    struct Component {
        Index triangle;  // its lowest
        int euler_characteristic;
        std::vector<Curve> curves;  // the longest first, then by edge
    };
    std::vector<Component> components;   // by lowest triangle
    std::vector<Index> of_triangle;      // (F)
    std::vector<Index> of_vertex;        // (V), -1: in no triangle
    std::vector<bool> on_boundary;       // (V)
    Eigen::VectorXd angles;              // (V) sum of the corner angles
    std::vector<Index> curve_of_vertex;  // (V) place in the component's curves; -1: inside

    // Throws GeometryError: kinds "empty", "non_manifold_vertex" (elements: vertices).
    explicit Structure(const SurfaceDomain& domain);

private:
    void add_curves(const SurfaceDomain& domain);
};

}  // namespace octafield::surface::detail
