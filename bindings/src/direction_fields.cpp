// Direction fields on surfaces: the solver, directions and singular points of its result, principal directions.
#include "arrays.hpp"
#include "bind.hpp"
#include "checks.hpp"
#include "domain.hpp"
#include "interruptible.hpp"
#include "octafield/surface/directions.hpp"
#include "octafield/surface/principal_directions.hpp"
#include "octafield/surface/surface_singularities.hpp"
#include "options.hpp"

namespace octafield::bindings {

using namespace surface;
using py::literals::operator""_a;

namespace {

DirectionField solve(const SurfaceOrMesh& surface, DirectionFieldOptions options,
                     const std::optional<ProgressCallable>& progress) {
    return run_interruptible(
        [surface, options = std::move(options)](Job& job) {
            const SurfaceDomain domain = domain_of(surface);
            check(options.constraints, domain.mesh());
            check(options.guide, domain.mesh());
            return direction_field(domain, options, job.progress());
        },
        progress);
}

void bind_direction_field(py::module_& m) {
    m.def(
        "direction_field",
        [](const SurfaceOrMesh& surface, const std::optional<DirectionConstraints>& constraints,
           const std::optional<DirectionGuide>& guide, const std::optional<ProgressCallable>& progress,
           const py::kwargs& given) {
            auto [options] = options_of<DirectionFieldOptions>("direction_field", given);
            if (constraints) options.constraints = *constraints;
            if (guide) options.guide = *guide;
            return solve(surface, std::move(options), progress);
        },
        "surface"_a, py::kw_only(), "constraints"_a = py::none(), "guide"_a = py::none(), "progress"_a = py::none(),
        "N-direction field on Crouzeix-Raviart elements (Beaufort et al. 2017), aligned to the surface's boundary and "
        "its feature edges, as a DirectionField.\n\n"
        "symmetry: N, 4 for crosses. method: \"gl\", a local minimum of the Ginzburg-Landau functional; "
        "\"mbo\", diffusion and projection (Viertel and Osting 2019), close to it at a fraction of the time; "
        "\"eigen\", the globally smoothest (Knoeppel et al. 2013), the start of both. epsilon: coherence length, "
        "input unit, 0 means 2 mean edge lengths, at most a tenth of octafield.surface.shape_size; edge_epsilon: (E,) "
        "one per edge instead, in the order of SurfaceDomain.edges; first_epsilon: where the continuation in epsilon "
        "starts, "
        "0 means a tenth of the size. max_iterations: of the descent, or of diffusion and projection; tolerance: "
        "on the residual; energy_tolerance: relative decrease of a round of steps at which to stop; seed: of the "
        "random start where nothing is aligned, and of mbo's disturbance.\n\n"
        "boundary_alignment, feature_alignment: \"strong\", the field follows the edges; \"weak\", a penalty that "
        "singular "
        "points may sit on; \"none\". alignment_length: of the weak penalty, input unit, 0 means epsilon; "
        "least_feature_angle: feature edges that bend by less (radians) are ignored; corner_tolerance: in [0, 1], two "
        "edges are followed weakly at a vertex where their directions differ by more than this part of pi / N. "
        "constraints: DirectionConstraints; guide: DirectionGuide.\n\n"
        "Cancelled by progress, the best state is returned with converged False. Raises InvalidInput, GeometryError, "
        "SolverError.");
    py::dict methods;
    for (const auto& [name, meaning] : direction_field_methods()) methods[py::str(name)] = meaning;
    m.attr("direction_field_methods") = methods;
    list_options<DirectionFieldOptions>(m, "direction_field");
}

void bind_directions(py::module_& m) {
    m.def(
        "vertex_directions",
        [](const DirectionField& field) {
            return own(run_interruptible([field](Job&) {
                check(field);
                return vertex_directions(field);
            }));
        },
        "field"_a,
        "(V, 3) unit rows: one representative direction per vertex, orthogonal to vertex_normals of the mesh, "
        "following the features of field.domain and the mesh's boundary.");
    m.def(
        "triangle_directions",
        [](const DirectionField& field) {
            return own(run_interruptible([field](Job&) {
                check(field);
                return triangle_directions(field);
            }));
        },
        "field"_a, "(F, 3) unit rows: one representative direction per triangle, in its plane, at the centroid.");
    m.def(
        "surface_singularities",
        [](const DirectionField& field) {
            return run_interruptible([field](Job&) {
                check(field);
                return surface_singularities(field);
            });
        },
        "field"_a,
        "All triangles and vertices where the field has an index other than 0, as SurfaceSingularities: the points, "
        "the sum of their indices, and whether it is the Euler characteristic. On the mesh's boundary the index counts "
        "how often another of the N directions becomes the one that follows the boundary.");
    m.def(
        "principal_directions",
        [](const SurfaceOrMesh& surface) {
            return run_interruptible([surface](Job&) { return principal_directions(domain_of(surface)); });
        },
        "surface"_a,
        "Principal curvatures and directions of each triangle, from the change of the vertex normals (Rusinkiewicz "
        "2004), as PrincipalDirections. Nothing is averaged across features. As a guide field: "
        "DirectionGuide(p.directions, p.anisotropy). Raises GeometryError where SurfaceDomain does.");
}

}  // namespace

void bind_direction_fields(py::module_& m) {
    bind_direction_field(m);
    bind_directions(m);
}

}  // namespace octafield::bindings
