// N-direction fields with Crouzeix-Raviart elements, by Ginzburg-Landau (Beaufort et al. 2017, 2020; thesis of
// P.-A. Beaufort 2019, chapter 3), by diffusion and projection (Viertel, Osting 2019) or as an eigenvector (Knoeppel et
// al. 2013). N = 4: cross fields.
//
// Unknown: one complex number f_e = exp(i N theta_e) per edge e, theta_e the angle of the direction from the edge's own
// direction (lower to higher vertex id), counter-clockwise seen from outside, in the plane of either adjacent triangle.
// In a triangle with reference axis x, edge e at angle beta_e from x has the local value F_e = f_e exp(i N beta_e), and
// F is linear in the triangle, continuous at edge midpoints.
//
// Functional (thesis 3.15 and 3.27, with a guide field and user constraints added to the second line):
//   E(f) = 1/2 int |grad f|^2 + 1/4 int (|f|^2 - 1)^2 / eps^2
//        + L / (2 eps^2) int_weak |f - g|^2 ds + 1/2 int w |f - g|^2 + sum_constraints w/2 |f - g|^2,
// all but the first term by edge-midpoint quadrature.
#pragma once

#include <complex>
#include <cstdint>
#include <string>
#include <vector>

#include "octafield/progress.hpp"
#include "octafield/surface/direction_constraints.hpp"
#include "octafield/surface/surface_domain.hpp"

namespace octafield::surface {

// A way to a field: a row of the table at the end of direction_field.cpp, from which options, words and help are taken.
struct DirectionFieldMethod {
    std::string name;     // DirectionFieldOptions::method
    std::string meaning;  // one clause
};
// gl: descent on E to a local minimum, from the eigenvector field, with continuation in epsilon.
// mbo: |f| = 1; implicit diffusion and projection in turn, with a falling time step (Merriman, Bence, Osher 1992;
// Viertel and Osting 2019), then descent on 1/2 int |grad f|^2 and the second line of E by the angles of f to a local
// minimum, with singular points moved to neighbouring places where that lowers the energy (single edges tried).
// eigen: |f| = 1; globally smoothest (Knoeppel et al. 2013) on components that nothing aligns, the harmonic extension
// of what is aligned on the others, scaled to length 1. The start of the other two.
const std::vector<DirectionFieldMethod>& direction_field_methods();

// How the field follows the mesh boundary or the feature edges inside the surface.
enum class Alignment {
    strong,  // f = 1 on the edge
    weak,    // the penalty with L, which singular points may sit on
    none,    // not at all: the natural boundary condition
};

// Of N. Indices and angles are exact far beyond; no mesh has room for more.
inline constexpr int largest_symmetry = 1000;

struct DirectionFieldOptions {
    int symmetry = 4;           // N, 1 to largest_symmetry
    std::string method = "gl";  // of direction_field_methods()
    // Coherence length, eps in the thesis, input unit; 0: 2 mean edge lengths, at most 1/10 of the size
    // (shape_size), also of each connected part that nothing aligns as long as that is at least 1/4 of the mean edge
    // length. Below 1/100 of the mean edge length it is refused: the singular points would stay where they start. Where
    // it is large against a connected part of the surface, f = 0 is the minimum there. Without weak edges the methods
    // mbo and eigen do not depend on it.
    double epsilon = 0;
    // Coherence length per edge, (E) in the order of the domain's topology, input unit, all > 0; overrides `epsilon`.
    // (0): none.
    Eigen::VectorXd edge_epsilon{};
    // Continuation: E is first minimised, to part of the accuracy, with this coherence length, then with equal
    // fractions, down to 1/5, of the one before until the one above: singular points move freely while their cores are
    // wide. 0 or above 1/10 of the size of a connected part: that 1/10; `epsilon` or less: no
    // continuation.
    double first_epsilon = 0;
    int max_iterations = 1000;  // of the descent, or of diffusion and projection
    // Ginzburg-Landau: stop when the residual falls to `tolerance`: the norm of E's gradient over that of the
    // mass-weighted f / eps^2 (for an edge whose stiffness is less, of the stiffness times f); or when a step lowers E
    // by less than 1/8 of `energy_tolerance` of itself near a point that is no saddle. The second is what ends
    // the descent where the singular points move freely (a sphere turned in itself); 0 leaves it out.
    double tolerance = 1e-10;
    double energy_tolerance = 1e-6;
    std::uint64_t seed = 0;  // of the eigenvector's random start where nothing is aligned, and of disturbances

    Alignment boundary_alignment = Alignment::strong;  // edges with one triangle
    Alignment feature_alignment = Alignment::strong;   // feature edges with two
    // L of weak alignment, input unit; 0: eps, which puts the field off by about eps times its slope across the edge.
    // A singular point sits on the boundary rather than inside when L is below some eps^2 / (edge length).
    double alignment_length = 0;
    // Feature edges whose two triangles bend by less than this are ignored (radians; 0: none are).
    double least_feature_angle = 0;
    // Two edges to follow that meet at a vertex are aligned weakly there when no field can follow both: when the
    // directions they ask for in the sector between them differ by more than this part of the worst, pi / N. In [0, 1];
    // 1: never.
    double corner_tolerance = 0.6;

    DirectionConstraints constraints{};
    DirectionGuide guide{};
};

struct DirectionField {
    int symmetry = 4;
    SurfaceDomain domain;
    Eigen::VectorXcd values;      // (E), f per edge in the edge's own frame
    double epsilon = 0;           // the smallest, where it differs from edge to edge
    double energy = 0;            // E(f)
    double dirichlet_energy = 0;  // 1/2 int |grad f|^2
    int iterations = 0;
    bool converged = false;
    double residual = 0;                 // relative, as tolerance
    std::vector<double> energy_history;  // E at the start and after each iteration (of the last epsilon)
};

// Edges of the mesh boundary and of the domain's features have g = 1: one direction along the edge. With odd N the
// direction follows the boundary, surface on its left, and features inside the surface are refused: they have no sense
// to run in. Where nothing aligns a component, the methods gl and mbo also descend from the principal directions (even
// N) and give the field of lower E. Cancelling through progress keeps the best state (converged = false). On a domain
// with edge lengths of its own the field, its energy and its coherence length are in that metric; constraints and
// guides, directions in space, are refused there (InvalidInput, kind "own_lengths"). Throws InvalidInput; GeometryError
// (kind "empty") without triangles; SolverError when the descent ends with |f| < 0.1 on all free edges of a component
// (kind "epsilon_too_large", elements its triangles): such a field has no directions; SolverError where triangles are
// too thin for double precision (kind "thin_triangles", elements; angles far below 1e-6 radians) or weights too small
// to count (kind "bad_weights").
DirectionField direction_field(const SurfaceDomain& domain, const DirectionFieldOptions& options = {},
                               const Progress& progress = {});

}  // namespace octafield::surface
