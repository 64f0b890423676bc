// Separatrices of an imposed field, from singular points and corners to one another or to the boundary: the curves of
// a quad layout (Jezdimirovic, Chemin, Reberol, Henrotte, Remacle 2021, arXiv 2103.02939, section 5).
//
// With f = exp(H + i theta), log f = a + b z is linear in each triangle, z its plane coordinate, so a curve along
// direction d is P(s) = P0 - log(1 - b f(P0) d s) / b, s its length in quad coordinates (parameters): no step size, one
// root per side. In the triangles at a singular point the curve is the straight line that the local model r^p has
// there. Over edges, where theta jumps a little off the midpoint, the branch nearest to the heading is taken.
//
// Curves that come to a point nearer than a tolerance, in parameters and across the curve, to its own separatrix back
// are joined with that: the straight line in parameters from one point to the other, found by turning the start.
#pragma once

#include <vector>

#include "octafield/progress.hpp"
#include "octafield/surface/imposed_field.hpp"

namespace octafield::surface {

// Where a curve crosses an edge, or its first or last point at a vertex.
struct LayoutCurvePoint {
    Index vertex = -1;
    Index edge = -1;      // of LayoutCurves::domain, where vertex is -1
    double fraction = 0;  // of the edge, from lower to higher vertex id, strictly between 0 and 1
    double length = 0;    // from the start, in parameters
};

struct LayoutCurve {
    std::vector<LayoutCurvePoint>
        points;                    // n + 1: the first at a vertex, the last at one or on an edge of the boundary
    std::vector<Index> triangles;  // n: that hold the parts between the points
    Index first_vertex = -1;       // singular point or corner, of the field's domain
    Index last_vertex = -1;        // the same; -1: ends at the boundary
    double offset = 0;             // by which the exact separatrix misses last_vertex, parameters, signed
};

struct LayoutCurveOptions {
    // How far from a point, across the curve and in parameters, a separatrix is joined with one of that point. 0: a
    // hundredth of the square root of the surface's area in parameters.
    double end_tolerance = 0;
    double max_length = 0;  // of a curve, in parameters; 0: 40 times that square root
    // Vertices of the boundary, with two quads, from which a curve starts at right angles as well: cuts.
    std::vector<Index> cut_vertices = {};
};

struct LayoutCurves {
    std::vector<LayoutCurve> curves;  // each joined pair once
    Index traced = 0;                 // separatrices, before any were joined
    double end_tolerance = 0;         // as used
    double parameter_area = 0;        // int exp(-2 H)
    // That edges and triangles belong to: the field's, with edges between two singular points or corners halved, if
    // there are any; vertices keep their numbers.
    SurfaceDomain domain;
};

// Throws InvalidInput: kinds "bad_option" (elements: cut_vertices that are not on the boundary), "bad_field",
// "infinite_corner" (points and corners without quads; elements: vertices), "rotated_field" (sizes disagree by more
// than 5 % round some loop, so that there are no parameters; see ImposedField::conditions); GeometryError:
// "long_separatrix" (elements: vertices where those start that are longer than max_length); SolverError: "stuck",
// "unclear_directions" (elements: vertices); Cancelled.
LayoutCurves layout_curves(const ImposedField& field, const LayoutCurveOptions& options = {},
                           const Progress& progress = {});

// On closed parts of the surface nothing aligns the field: turned by any one angle it has the same singular points and
// sizes, but other separatrices. The field with each closed part turned so that separatrices join and are short in all,
// out of those angles at which one runs straight from a point to another one nearby; parts without points (tori) so
// that the lines through their lowest vertex come back to it, if they can. Parts with a boundary stay. Throws as
// layout_curves; GeometryError (kind "no_short_turn", elements: vertices of the points of a part) where no angle tried
// gives separatrices of finite length.
ImposedField turned_for_layout(const ImposedField& field, const LayoutCurveOptions& options = {},
                               const Progress& progress = {});

}  // namespace octafield::surface
