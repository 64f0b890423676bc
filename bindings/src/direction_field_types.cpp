// Structs of direction fields on surfaces as Python classes.
#include "bind.hpp"
#include "octafield/surface/principal_directions.hpp"
#include "octafield/surface/streamlines.hpp"
#include "record.hpp"

namespace octafield::bindings {

using namespace surface;

namespace {

void bind_requests(py::module_& m) {
    Record<DirectionConstraints>(
        m, "DirectionConstraints",
        "Directions that a direction field is to follow at single edges and vertices. They go before features and the "
        "mesh boundary. Their part in the tangent plane counts, which must be at least 1e-3 of them. A weight w adds "
        "w/2 |f - g|^2 to the functional (1 weighs as much as the stiffness of about a quarter of an edge); infinity "
        "holds the direction; no weights at all means infinity everywhere.")
        .field("edges", &DirectionConstraints::edges, "(n, 2) int32 vertex ids of mesh edges, in any order.")
        .field("edge_directions", &DirectionConstraints::edge_directions, "(n, 3) float64, of any length.")
        .field("edge_weights", &DirectionConstraints::edge_weights, "(n,) float64 in (0, inf], or empty.")
        .field("vertices", &DirectionConstraints::vertices,
               "(m,) int32 vertex ids; the edges that meet there get the direction, parallel transported.")
        .field("vertex_directions", &DirectionConstraints::vertex_directions, "(m, 3) float64, of any length.")
        .field("vertex_weights", &DirectionConstraints::vertex_weights, "(m,) float64 in (0, inf], or empty.")
        .finish([](const DirectionConstraints& c) {
            return count(c.edges.rows(), "edge") + ", " +
                   count(static_cast<std::ptrdiff_t>(c.vertices.size()), "vertex", "vertices");
        });

    Record<DirectionGuide>(
        m, "DirectionGuide",
        "A direction in every triangle that a direction field follows as far as smoothness lets it: adds "
        "1/2 int w |f - g|^2, w = weight / length^2 (Knoeppel et al. 2013). Features of the guide larger than the "
        "length are followed, smaller ones smoothed away.")
        .field("directions", &DirectionGuide::directions,
               "(F, 3) float64, projected into the triangles; empty: no guide.")
        .field("weights", &DirectionGuide::weights, "(F,) float64, 0 leaves a triangle alone; empty: 1 everywhere.")
        .field("length", &DirectionGuide::length, "Input unit; 0: a tenth of octafield.surface.shape_size.")
        .finish([](const DirectionGuide& g) {
            return count(g.directions.rows(), "direction") + ", length " + number(g.length);
        });
}

void bind_direction_field_type(py::module_& m) {
    Record<DirectionField>(
        m, "DirectionField",
        "An N-direction field with one complex value exp(i N theta) per edge, theta the angle of the direction "
        "from the edge (lower to higher vertex id).")
        .field("symmetry", &DirectionField::symmetry, "N: 4 for a cross field.")
        .field("domain", &DirectionField::domain, "SurfaceDomain the field lives on.")
        .field("values", &DirectionField::values, "(E,) complex128, one value per edge in the edge's own frame.")
        .field("epsilon", &DirectionField::epsilon,
               "Coherence length used, input unit; the smallest where it differs from edge to edge.")
        .field("energy", &DirectionField::energy, "Ginzburg-Landau energy, dimensionless.")
        .field("dirichlet_energy", &DirectionField::dirichlet_energy, "Its Dirichlet part, 1/2 int |grad f|^2.")
        .field("iterations", &DirectionField::iterations, "Steps of descent, or of diffusion and projection, done.")
        .field("converged", &DirectionField::converged, "Whether the solver's tolerance was met.")
        .field("residual", &DirectionField::residual, "Relative residual at the end.")
        .field("energy_history", &DirectionField::energy_history,
               "float64 energies at the start and after each iteration (of the last epsilon).")
        .finish([](const DirectionField& f) {
            return "symmetry " + std::to_string(f.symmetry) + ", " + count(f.values.rows(), "edge") + ", energy " +
                   number(f.energy) + ", " + (f.converged ? "converged" : "not converged");
        });

    Record<PrincipalDirections>(m, "PrincipalDirections", "Principal curvatures and directions, per triangle.")
        .field("directions", &PrincipalDirections::directions,
               "(F, 3) float64 unit rows in the triangles' planes: of the curvature that is larger in size.")
        .field("curvatures", &PrincipalDirections::curvatures,
               "(F, 2) float64, the larger in size first, 1 / input unit; positive where the surface bends away from "
               "its normal (a sphere seen from outside).")
        .field("anisotropy", &PrincipalDirections::anisotropy,
               "(F,) float64 in [0, 1]: 0 where the direction means nothing (flat, or bent alike in all directions).")
        .finish([](const PrincipalDirections& p) {
            const std::string range = p.curvatures.rows() == 0 ? ""
                                                               : ", curvatures " + number(p.curvatures.minCoeff()) +
                                                                     " to " + number(p.curvatures.maxCoeff());
            return count(p.directions.rows(), "triangle") + range;
        });
}

void bind_singularities(py::module_& m) {
    Record<SurfaceSingularity>(m, "SurfaceSingularity", "A singular point of a direction field.")
        .field("position", &SurfaceSingularity::position,
               "(3,) float64: the zero of the interpolant in a triangle, or the vertex.")
        .field("index_times_symmetry", &SurfaceSingularity::index_times_symmetry, "N times the index, an integer.")
        .field("index", &SurfaceSingularity::index,
               "Turns of the direction round the point: +1/4 is valence 3 when N = 4.")
        .field("triangle", &SurfaceSingularity::triangle, "Triangle id; -1 when at a vertex.")
        .field("vertex", &SurfaceSingularity::vertex, "Vertex id; -1 when inside a triangle.")
        .field("boundary", &SurfaceSingularity::boundary, "Whether it is a vertex of the mesh's boundary.")
        .finish([](const SurfaceSingularity& s) {
            return "index " + number(s.index) + ", " +
                   (s.vertex >= 0 ? "vertex " + std::to_string(s.vertex) : "triangle " + std::to_string(s.triangle));
        });

    Record<SurfaceSingularities>(m, "SurfaceSingularities",
                                 "The singular points of a direction field and the check of their indices.")
        .field("points", &SurfaceSingularities::points,
               "List of SurfaceSingularity: those in triangles by triangle, then those at vertices by vertex.")
        .field("index_sum", &SurfaceSingularities::index_sum, "Sum of all indices.")
        .field("euler_characteristic", &SurfaceSingularities::euler_characteristic,
               "Of the surface; where parts of it only touch, each has its own vertex.")
        .field("agree", &SurfaceSingularities::agree,
               "Whether the index sum is the Euler characteristic (Poincare, Hopf).")
        .field("boundary_deviation", &SurfaceSingularities::boundary_deviation,
               "Largest angle between an edge of the mesh's boundary and the field, radians in [0, pi/N]; 0 for closed "
               "surfaces.")
        .finish([](const SurfaceSingularities& s) {
            return count(static_cast<std::ptrdiff_t>(s.points.size()), "point") + ", index sum " + number(s.index_sum) +
                   ", Euler characteristic " + std::to_string(s.euler_characteristic);
        });
}

void bind_streamline(py::module_& m) {
    Record<Streamline>(m, "Streamline", "A curve along a direction field on its surface.")
        .field("points", &Streamline::points, "(n, 3) float64 points of the polyline.")
        .field("triangles", &Streamline::triangles,
               "(n - 1,) int32: the triangle that the segment from point i to point i + 1 lies in.")
        .field("length", &Streamline::length, "Input unit.")
        .field("first_end", &Streamline::first_end,
               "Why it begins there, a word as last_end; \"seed\": that is its seed.")
        .field("last_end", &Streamline::last_end,
               "Why it ends there: \"singularity\", \"boundary\", \"feature\", \"closed\" (first and last point are "
               "the same), \"length\" (max_length reached), \"near_line\" (too near to another curve) or \"stuck\".")
        .field("first_singularity", &Streamline::first_singularity,
               "Place of the singular point at the first end in SurfaceSingularities.points; -1: none.")
        .field("last_singularity", &Streamline::last_singularity,
               "Place of the singular point at the last end in SurfaceSingularities.points; -1: none.")
        .finish([](const Streamline& s) {
            return count(s.points.rows(), "point") + ", length " + number(s.length) + ", " + to_word(s.first_end) +
                   " to " + to_word(s.last_end);
        });
}

}  // namespace

void bind_direction_field_types(py::module_& m) {
    bind_requests(m);
    bind_direction_field_type(m);
    bind_singularities(m);
    bind_streamline(m);
}

}  // namespace octafield::bindings
