// Cross fields with imposed singular points: Jezdimirovic, Chemin, Reberol, Henrotte, Remacle, "Quad layouts with high
// valence singularities for flexible quad meshing" (2021, arXiv 2103.02939), extended to surfaces of any genus, with
// its equations (11) to (14) corrected.
//
// With f = exp(H + i theta) the derivative of the map from quad coordinates to the surface, theta is conjugate to H and
//     Laplace H = 2 pi sum_j (t_j / 4) delta(x_j) - K,    dH/dn = geodesic curvature on the boundary,
// K the Gauss curvature. H is discretised with P1 elements; the right-hand side is the angle defect at each vertex less
// 2 pi t / 4. The conjugate theta is then exact at edge midpoints (Crouzeix-Raviart): it turns by pi t / 2 round every
// point and follows the boundary to rounding, without a second linear system.
//
// Beside the sum of the indices, a field needs 2 g + b - 1 further conditions on a connected surface of genus g with b
// boundary curves (2 g if closed): that it comes back to itself round each generator, and that it follows each boundary
// curve when it follows the first. They depend on where the points are.
#pragma once

#include "octafield/progress.hpp"
#include "octafield/surface/singular_pattern.hpp"

namespace octafield::surface {

// What to do with a pattern that misses a condition by more than the tolerance.
enum class Inadmissible {
    fail,    // throw
    move,    // move the points inside by as little as possible (Newton's method, minimum norm)
    rotate,  // turn the field by harmonic functions (trivial connections; Crane, Desbrun, Schroeder 2010)
};

struct ImposedFieldOptions {
    Inadmissible inadmissible = Inadmissible::fail;
    double tolerance = 0.017453292519943295;  // radians, > 0; what is below is always removed by rotation
    // Boundary vertices without quads, t = 2: the field is fine, but its corner is infinitely long in quad coordinates.
    bool allow_zero_quads = false;
    // Equal sectors round a point, at least, and 4 |t| of them; >= 6. Rings of triangles round it, >= 1, each
    // `ring_ratio` > 1 times as wide as the next inner one.
    int sectors = 12;
    int rings = 6;
    double ring_ratio = 1.4;
    int max_steps = 30;  // of Newton's method
};

struct HolonomyCondition {
    bool boundary;       // a boundary curve against the first of its component; otherwise a generator
    Index vertex;        // of the input: the lowest of the curve, or one beside the generator
    double angle;        // radians in (-pi/4, pi/4]: what the pattern misses, before `rotate`
    double rotation;     // radians: coefficient of the harmonic function that was taken off theta
    double size_factor;  // >= 1: by what sizes disagree after one turn round the curve or along the generator; 1: H
                         // holds as it is
};

struct ImposedField {
    // Symmetry 4, |f| = 1, on the input refined round the points: vertices of the input keep their numbers, triangles
    // are parts of the input's. Its features are carried over, but only the boundary is followed.
    DirectionField field;
    // (V) H: exp(H) is the edge length that quads have there, up to one factor per component, chosen so that quads of
    // unit size are as many as the area. Finite at singular points, where the true value is not: there it depends on
    // the mesh. 0 at vertices in no triangle.
    Eigen::VectorXd log_size;
    SingularPattern pattern;  // as imposed, on the input: points where they were moved to, all corners but those of 2
    std::vector<Index> point_vertices;          // (n) vertex of field.domain at each point
    std::vector<Index> vertex_triangles;        // (V) triangle of the input that holds the vertex; -1: none
    Points vertex_weights;                      // (V, 3) barycentric there
    std::vector<Index> triangle_origins;        // (F) triangle of the input
    std::vector<HolonomyCondition> conditions;  // by component: its boundary curves, then its generators
    double closure = 0;                         // largest misfit modulo a quarter turn left anywhere, radians
    int steps = 0;                              // of Newton's method
    double largest_move = 0;                    // of a point, input unit, along the surface
};

// Points closer to an edge or vertex than 1e-4 of the triangle there are put on it.
//
// Throws GeometryError (kinds "empty", "non_manifold_vertex", and those of SurfaceDomain); InvalidInput with kind
// - "index_sum": the sum of t is not 4 chi on a component (elements: its lowest triangle);
// - "bad_valence": valence below 1 inside, quads below 1 at a corner (elements: places of points, or vertices);
// - "outside_surface": no such triangle, weights below 0 or not of sum 1 (elements: places);
// - "not_on_boundary": corners that are no vertices of the boundary (elements: vertices);
// - "repeated_corner": a corner given twice, also by a point there (elements: vertices);
// - "coincident_points": points too near to one another to tell apart; merge them (elements: places);
// - "inadmissible_pattern": a condition is missed by more than the tolerance (elements: vertices of the conditions);
// SolverError (kinds "move_failed", "thin_triangles", "unresolved_turns"); Cancelled.
ImposedField impose_singular_points(const SurfaceDomain& domain, const SingularPattern& pattern,
                                    const ImposedFieldOptions& options = {}, const Progress& progress = {});

}  // namespace octafield::surface
