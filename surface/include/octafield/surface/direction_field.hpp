// N-direction fields by Ginzburg-Landau with Crouzeix-Raviart elements
// (Beaufort et al. 2017, 2020; thesis of P.-A. Beaufort 2019, chapter 3; N = 4: cross fields).
//
// Unknown: one complex number f_e = exp(i N theta_e) per edge e, theta_e the angle of the direction from the edge's own
// direction (lower to higher vertex id), counter-clockwise seen from outside, in the plane of either adjacent triangle.
// In a triangle with reference axis x, edge e at angle beta_e from x has the local value F_e = f_e exp(i N beta_e), and
// F is linear in the triangle, continuous at edge midpoints.
//
// Functional: E(f) = 1/2 int |grad f|^2 + 1/(4 eps^2) int (|f|^2 - 1)^2 (thesis 3.15), the penalty by edge-midpoint
// quadrature.
#pragma once

#include <complex>
#include <cstdint>
#include <string>
#include <vector>

#include "octafield/progress.hpp"
#include "octafield/surface/features.hpp"
#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::surface {

enum class DirectionFieldMethod {
    // Descent on E to a local minimum, from the start below.
    ginzburg_landau,
    // The start itself, |f| = 1: the globally smoothest field (Knoeppel et al. 2013) on components without features,
    // the harmonic extension of the features on the others.
    eigenvector,
};

struct DirectionFieldOptions {
    int symmetry = 4;  // N >= 1
    DirectionFieldMethod method = DirectionFieldMethod::ginzburg_landau;
    // Coherence length, input unit; 0: 2 mean edge lengths, at most 1/10 of the bounding-box diagonal, also of each
    // connected part without features as long as that is at least 1/4 of the mean edge length. Below 1/100 of
    // the mean edge length it is refused: the singular points would stay where they start. Where it is large against a
    // connected part of the surface, f = 0 is the minimum there. The eigenvector method does not depend on it.
    double epsilon = 0;
    int max_iterations = 1000;
    // Stop when the residual falls to `tolerance`: the norm of E's gradient over that of the mass-weighted f / eps^2
    // (for an edge whose stiffness is less, of the stiffness times f); or when a round of 15 steps lowers E by less
    // than `energy_tolerance` of itself at a point that is no saddle. The second is what ends the descent where the
    // singular points move freely (a sphere turned in itself); 0 leaves it out.
    double tolerance = 1e-10;
    double energy_tolerance = 1e-6;
    std::uint64_t seed = 0;  // of the eigenvector's random start; only matters without features
};

struct DirectionField {
    int symmetry = 4;
    EdgeTopology topology;
    Eigen::VectorXcd values;  // (E), f per edge in the edge's own frame
    double epsilon = 0;
    double energy = 0;            // E(f)
    double dirichlet_energy = 0;  // 1/2 int |grad f|^2
    int iterations = 0;
    bool converged = false;
    double residual = 0;                 // relative, as tolerance
    std::vector<double> energy_history;  // E at the start and after each iteration
};

// Edges of `features` and of the mesh boundary hold f = 1: one direction along the edge. With odd N the direction
// follows the boundary, surface on its left, and features inside the surface are refused: they have no sense to run in.
// Requires an edge-manifold, consistently oriented mesh without degenerate triangles, closed or not, any number of
// components. Cancelling through progress keeps the best state (converged = false). Throws InvalidInput, GeometryError;
// SolverError when the descent ends with |f| < 0.1 on all free edges of a component (kind "epsilon_too_large", elements
// its triangles): such a field has no directions.
DirectionField direction_field(const TriangleMesh& mesh, const FeatureGraph& features,
                               const DirectionFieldOptions& options = {}, const Progress& progress = {});

// One representative direction per vertex, from the mean of f over the incident edge midpoints, corner-angle weighted,
// parallel transported to the vertex's tangent plane (the polar map with angles scaled to 2 pi, Knoeppel et al. 2013).
// Unit rows, orthogonal to vertex_normals(mesh); at a vertex of one feature edge the direction follows it; at a vertex
// of a feature curve, the curve's tangent; at a corner, the mean of its feature edges' crosses or, where they
// contradict each other, its first feature edge. Mesh boundary edges count as features. At a vertex in no triangle the
// row is zero.
Points vertex_directions(const TriangleMesh& mesh, const FeatureGraph& features, const DirectionField& field);

// One representative direction per triangle: (F, 3) unit rows in the triangle's plane, from the value at the centroid.
Points triangle_directions(const TriangleMesh& mesh, const DirectionField& field);

struct SurfaceSingularity {
    Eigen::Vector3d position;  // zero of the linear interpolant inside a triangle, or the vertex
    int index_times_symmetry;  // N * index: +1 is index +1/N
    double index;              // turns of the direction round the point: +1/4 for valence 3 when N = 4
    Index triangle;            // -1 when at a vertex
    Index vertex;              // -1 when inside a triangle
    bool boundary;             // at a vertex of the mesh boundary
};

// All triangles, then all vertices, with non-zero index; along mesh boundaries the field must be aligned for boundary
// indices to be multiples of 1/N. A triangle and one of its vertices with opposite indices cancel: the field is not
// continuous at vertices, and the mesh cannot tell such a pair from none. The sum of all indices is the Euler
// characteristic (a vertex where parts of the surface only touch counts once per part).
std::vector<SurfaceSingularity> surface_singularities(const TriangleMesh& mesh, const DirectionField& field);

}  // namespace octafield::surface
