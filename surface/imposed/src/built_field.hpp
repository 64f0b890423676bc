// One try at a field for given places of its singular points: mesh, H, and what the conditions miss.
#pragma once

#include <map>

#include "holonomy.hpp"
#include "ringed_mesh.hpp"

namespace octafield::surface::detail {

// What is imposed on the input.
struct Imposed {
    std::vector<Place> places;     // of the points, then of the corners that get rings
    std::vector<int> indices;      // t of each place
    std::map<Index, int> corners;  // t of vertices of the boundary; 0 at those not named
    RingOptions rings;
};

struct BuiltField {
    RingedMesh ringed;
    SurfaceDomain domain;
    Structure structure;
    Holonomy holonomy;
    Eigen::VectorXd h;          // (V)
    std::vector<double> turns;  // (3F) of the field, against the triangles' planes
    Eigen::VectorXd missed;     // per condition, in (-pi/4, pi/4]
    std::vector<Eigen::VectorXd> forms;
    Eigen::MatrixXd energies;   // (n, n) Dirichlet products of the forms
    Eigen::VectorXd rotations;  // coefficients of the forms that make the conditions hold when taken off the field
};

// Throws InvalidInput (kind "coincident_points"); SolverError (kinds "thin_triangles", "unresolved_turns").
BuiltField built_field(const SurfaceDomain& input, const Imposed& imposed);

// (E) angles with the rotations taken off, and what is left of all misfits.
struct Rotated {
    Eigen::VectorXd angles;
    double closure;
};
Rotated rotated(const BuiltField& built);

}  // namespace octafield::surface::detail
