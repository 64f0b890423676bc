// Non-orthogonal cross fields: two lines per point of a surface whose angle is free, so that they can follow both sides
// of a corner that is not right (Desobry, Coudert-Osmont, Corman, Ray, Sokolov 2021; L. Dermine, master thesis,
// UCLouvain 2024, "Dermine" below).
//
// Unknown: the angles a, b of the two lines at each vertex, in the vertex's tangent plane. Functional (Dermine (3.14)):
//   E_s = sum over edges ij of w_ij (lambda |c2_i - c2_j|^2 + |c4_i - c4_j|^2),
//   c2 = 4 (u + v), c4 = u^2 + v^2, u = exp(2 i a), v = exp(2 i b),
// parallel transported along the edge (two_lines.hpp). With cotangent weights it is int lambda |grad c2|^2 + |grad
// c4|^2, whatever the triangles; it does not change when the surface is turned.
//
// At the boundary one line follows it; at a corner with an odd number of quads both follow its two edges. So a corner
// of any angle is met exactly, and singular points appear only where the numbers of quads do not add up: the index of a
// boundary vertex with v quads is (2 - v) / 4, all indices add up to the Euler characteristic.
#pragma once

#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "octafield/progress.hpp"
#include "octafield/surface/corner_quads.hpp"
#include "octafield/surface/surface_domain.hpp"
#include "octafield/surface/surface_singularities.hpp"
#include "octafield/surface/two_lines.hpp"

namespace octafield::surface {

struct NonOrthogonalFieldMethod {
    std::string name;     // NonOrthogonalFieldOptions::method
    std::string meaning;  // one clause
};
// angles: descent on E_s by the angles themselves to a local minimum, from the harmonic extension of p1 and p2.
// projected: the loop of Dermine (3.16), minimise over u, v of any length, then scale them to length 1, in turn. It
// does not minimise E_s over unit vectors. With c4 = u^2 + v^2 in place of (3.12), which depends on how the domain is
// turned. poly_vector: linear; harmonic extension of the coefficients of PolyVectors (Diamanti, Vaxman, Panozzo,
// Sorkine-Hornung 2014), then the roots, scaled to length 1.
const std::vector<NonOrthogonalFieldMethod>& non_orthogonal_field_methods();

// The second line of boundary vertices whose corner does not give it.
enum class SecondLine {
    fixed,  // its angle from the boundary goes linearly from corner to corner along the side (Dermine (3.9))
    free,   // found with the field
};

enum class EdgeWeights {
    cotangent,
    unit,  // 1 (Dermine): depends on the triangles
};

struct NonOrthogonalFieldOptions {
    std::string method = "angles";  // of non_orthogonal_field_methods()
    double lambda = 1.5;            // of E_s, > 0: what a change of the angle between the lines costs
    EdgeWeights weights = EdgeWeights::cotangent;
    SecondLine second_line = SecondLine::fixed;  // fixed only with poly_vector
    // A boundary vertex with interior angle phi (radians) has, unless `corners` names it,
    //   1 quad for phi <= pi - corner_angle,              both lines along its edges,
    //   2 quads up to pi + corner_angle,                  one line along the mean of the edges (a smooth boundary),
    //   3 quads up to 2 pi - corner_angle,                both along its edges,
    //   4 quads beyond,                                   one along the bisector,
    // and so on where there is more than 2 pi (Dermine: gamma; his table, bounds going to the smaller number). In (0,
    // pi / 2). A parallelogram with an acute angle below corner_angle gets two singular points by this rule; give it
    // `corners`.
    double corner_angle = std::numbers::pi / 4;
    std::vector<CornerQuads> corners{};
    // Free lines stay farther than this from the boundary (radians, in (0, pi / 4)), or half as far as the angle of the
    // line that goes linearly along the side, if that is less; by a change of variable. Method angles.
    double least_angle = 0.05;
    // Of the descent: steps, at least 1; projected: rounds.
    int max_iterations = 1000;
    std::uint64_t seed = 0;  // of the disturbance that leaves saddle points, and of fields where nothing is aligned
    // projected: tau, the weight of the change in a round; b, of (|v|^2 - 1)^2 for free lines on the boundary; and the
    // largest change of u and v at which rounds stop. Dermine's values, meant for unit weights.
    double inertia = 0.5;
    double penalty = 10;
    double tolerance = 1e-5;
};

struct NonOrthogonalField {
    SurfaceDomain domain;
    // (V, 2) radians: the two lines in the chart of each vertex (first in [0, pi), second in [first, first + pi)).
    // Angle 0 is the edge that begins the vertex's fan in domain.fans(): at the boundary, the boundary edge that leaves
    // the vertex with the surface on its left. Inside, angles round the vertex are scaled to 2 pi. 0 in no triangle.
    Rows<double, 2> angles;
    // (V, 3) unit vectors along the lines, orthogonal to vertex_normals; 0 in no triangle.
    Points first, second;
    std::vector<int> quads;   // (V) at vertices of the boundary; 0 elsewhere
    double energy = 0;        // E_s
    double start_energy = 0;  // of the field that descent, or the loop, started from
    int iterations = 0;
    bool converged = false;
    double smallest_angle = 0;  // between the two lines of a vertex, radians
    // Of free lines, of the range of angles they may take, what they had: less than 1 where one passed through the
    // boundary's direction between two vertices, so that they were held nearer to the angle that goes linearly along
    // the side (1/2, 1/4, at last 0); 0 where lines are fixed.
    double freedom = 0;
    // Vertices of the boundary where a line has passed through the boundary's direction since the vertex before: such a
    // field has a singular point on the boundary that `quads` does not tell. Method projected with free lines only.
    std::vector<Index> inverted;
};

// Near-linear in the number of vertices; the same bits on every run and any number of threads. Cancelling through
// progress keeps the best state (converged = false). Throws InvalidInput: kinds "bad_option"; "not_on_boundary",
// "given_twice" and "bad_corner" (elements: vertices of `corners`; the last where no two lines of the interior angle
// have that number of quads between them); "features_inside" (elements: edges) for feature edges within the surface,
// which are not followed; "own_lengths" where the domain has edge lengths of its own. GeometryError: "empty",
// "non_manifold_vertex". SolverError: "thin_triangles".
NonOrthogonalField non_orthogonal_field(const SurfaceDomain& domain, const NonOrthogonalFieldOptions& options = {},
                                        const Progress& progress = {});

// Singular points: triangles round which the lines, matched from vertex to vertex in cyclic order (the shift with the
// least sum of squared angles), do not come back to themselves, and boundary vertices with other than 2 quads. N = 4:
// index_times_symmetry counts branches, 4 times the index; a triangle with 2 or -2 is too coarse to tell. A point lies
// where (u - v)^2, linear in the triangle, is zero. agree: the indices inside and those that the quads of the boundary
// ask for add up to the Euler characteristic. Throws InvalidInput where the arrays of the field do not fit its domain.
SurfaceSingularities surface_singularities(const NonOrthogonalField& field);

}  // namespace octafield::surface
