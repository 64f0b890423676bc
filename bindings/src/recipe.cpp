// From a domain to a frame field with its analysis, in one call or in parts.
#include "bind.hpp"
#include "interruptible.hpp"
#include "octafield/volume/computed_field.hpp"
#include "options.hpp"
#include "sampling.hpp"
#include "stretch.hpp"

namespace octafield::bindings {

using namespace volume;
using py::literals::operator""_a;

namespace {

void bind_analyses(py::module_& m) {
    Record<FieldAnalysis>(m, "FieldAnalysis", "All that a field of frames at the vertices is judged by.")
        .field("energy", &FieldAnalysis::energy, "dirichlet_energy, input unit.")
        .field("singular_graph", &FieldAnalysis::singular_graph, "SingularGraph.")
        .field("meshability", &FieldAnalysis::meshability, "Meshability, of local_meshability.")
        .field("boundary_meshability", &FieldAnalysis::boundary_meshability, "BoundaryMeshability.")
        .field("integrability", &FieldAnalysis::integrability, "Integrability.")
        .field("alignment", &FieldAnalysis::alignment,
               "(k,) float64 radians, per sector of sector_normals: to the nearest axis.")
        .field("feature_alignment", &FieldAnalysis::feature_alignment,
               "(k,) float64 radians, per tangent of a feature curve.")
        .finish([](const FieldAnalysis& a) {
            return "energy " + number(a.energy) + ", " +
                   count(static_cast<std::ptrdiff_t>(a.singular_graph.triangles.size()), "singular edge");
        });

    Record<TetFieldAnalysis>(m, "TetFieldAnalysis", "All that a field of frames in the tets is judged by.")
        .field("energy", &TetFieldAnalysis::energy, "dirichlet_energy of the tet_sampling, input unit.")
        .field("energy_at_vertices", &TetFieldAnalysis::energy_at_vertices, "dirichlet_energy of vertex_frames.")
        .field("vertex_frames", &TetFieldAnalysis::vertex_frames,
               "(n, 4) float64 unit quaternions w x y z: the field taken to the vertices.")
        .field("singular_edges", &TetFieldAnalysis::singular_edges, "SingularEdges.")
        .field("meshability", &TetFieldAnalysis::meshability, "Meshability, of tet_meshability.")
        .field("boundary_meshability", &TetFieldAnalysis::boundary_meshability, "BoundaryMeshability.")
        .field("alignment", &TetFieldAnalysis::alignment, "(k,) float64 radians, as tet_alignment_angles.")
        .field("feature_alignment", &TetFieldAnalysis::feature_alignment,
               "(k,) float64 radians, per tangent of a feature curve, of vertex_frames.")
        .finish([](const TetFieldAnalysis& a) {
            return "energy " + number(a.energy) + ", " +
                   count(static_cast<std::ptrdiff_t>(a.singular_edges.edges.size()), "singular edge");
        });
}

template <class Result>
void bind_computed(py::module_& m, const char* name, const char* doc) {
    Record<Result> record(m, name, doc);
    record.field("cross_field", &Result::cross_field, "DirectionField on sheet_domain(domain).");
    if constexpr (std::is_same_v<Result, ComputedField>)
        record.field("stretch", &Result::stretch,
                     "AxesStretch, with free axes; its values have no rows where axes are at right angles.");
    record.field("constraints", &Result::constraints, "BoundaryConstraints.")
        .field("solved", &Result::solved, "FrameFieldResult: frames and lengths as the solver leaves them.")
        .field("combed", &Result::combed,
               "CombedVertices: the frames at the vertices, named so that neighbours agree but across a cut.")
        .field("analysis", &Result::analysis, "What it is judged by.")
        .finish([](const Result& r) { return "energy " + number(r.analysis.energy); });
}

// Binds `function` (computed_field, computed_tet_field) under `name`.
template <class Function>
void bind_compute(py::module_& m, const char* name, Function function, const char* doc) {
    m.def(
        name,
        [name, function](const DomainOrMesh& mesh, const std::optional<VertexConstraints>& constraints,
                         const std::string& axes, const std::optional<ProgressCallable>& progress,
                         const py::kwargs& given) {
            auto [boundary, solve, diffuse, smooth, stretch] =
                options_of<BoundaryOptions, FrameFieldOptions, DiffuseOptions, SmoothOptions, AxesStretchOptions>(
                    name, given);
            solve.diffuse = diffuse;
            solve.smooth = smooth;
            return run_interruptible(
                [mesh, function,
                 options = FieldOptions{boundary, constraints.value_or(VertexConstraints{}), solve,
                                        from_word<Axes>(axes, "axes"), stretch}](Job& job) {
                    check(options.given);
                    return function(domain_of(mesh), options, job.progress());
                },
                progress);
        },
        "domain"_a, py::kw_only(), "constraints"_a = py::none(), "axes"_a = to_word(Axes::orthogonal),
        "progress"_a = py::none(), doc);
    list_options<BoundaryOptions, FrameFieldOptions, DiffuseOptions, SmoothOptions, AxesStretchOptions>(m, name);
}

void bind_recipe_parts(py::module_& m) {
    m.def(
        "sheet_domain",
        [](const DomainOrMesh& mesh) {
            return run_interruptible([mesh](Job&) { return sheet_domain(domain_of(mesh)); });
        },
        "domain"_a,
        "The surface that a field follows, cut into sheets where it is not manifold, with the features on them, as a "
        "SurfaceDomain: where the cross field lives. Raises GeometryError.");
    m.def(
        "surface_constraints",
        [](const DomainOrMesh& mesh, const surface::DirectionField& cross, const std::string& sites,
           const std::optional<ArrayLike>& stretch, const py::kwargs& given) {
            const auto [options] = options_of<BoundaryOptions>("surface_constraints", given);
            return run_interruptible([mesh, cross, where = from_word<Sites>(sites, "sites"), options = options,
                                      stretched = stretch_rows(stretch)](Job&) {
                check(cross);
                return surface_constraints(domain_of(mesh), cross, where, options, stretched);
            });
        },
        "domain"_a, "cross"_a, py::kw_only(), "sites"_a = to_word(Sites::vertices), "stretch"_a = py::none(),
        "What the surface asks of the frames, as BoundaryConstraints: boundary_constraints, or with sites \"tets\" "
        "tet_boundary_constraints, with the directions of a cross field on sheet_domain(domain). stretch: (n, 6) as "
        "AxesStretch has it, of frames with axes S Q at the vertices. Raises InvalidInput.");
    list_options<BoundaryOptions>(m, "surface_constraints");
    m.def(
        "analyse_field",
        [](const DomainOrMesh& mesh, const ArrayLike& frames, const std::optional<ArrayLike>& stretch, int threads) {
            threads_option(threads);
            return run_interruptible([=, rows = from_python<Quaternions>(frames, "frames"),
                                      stretched = stretch_rows(stretch)](Job&) mutable {
                const TetDomain domain = domain_of(mesh);
                check_unit(rows, domain.vertex_count(), "frames");
                return analyse_field(domain, rows, threads, stretched);
            });
        },
        "domain"_a, "frames"_a, py::kw_only(), "stretch"_a = py::none(), "threads"_a = 0,
        "All that (n, 4) frames at the vertices are judged by, as a FieldAnalysis. stretch: (n, 6) as AxesStretch has "
        "it, of axes S Q: energy and singular graph are those of Q, alignment and meshability of S Q, and "
        "integrability, "
        "which is defined for axes at right angles, is left out. Raises InvalidInput.");
    m.def(
        "analyse_tet_field",
        [](const DomainOrMesh& mesh, const std::shared_ptr<Sampling>& sampling, const ArrayLike& of_tets, int threads) {
            threads_option(threads);
            return run_interruptible([=, rows = from_python<Quaternions>(of_tets, "of_tets")](Job&) mutable {
                const TetDomain domain = domain_of(mesh);
                check_unit(rows, domain.tet_count(), "of_tets");
                if (sampling->count() != domain.tet_count())
                    throw InvalidInput(
                        "sampling: " + std::to_string(sampling->count()) + " sites; give tet_sampling(domain)",
                        "wrong_shape");
                return analyse_tet_field(domain, *sampling, rows, threads);
            });
        },
        "domain"_a, "sampling"_a, "of_tets"_a, py::kw_only(), "threads"_a = 0,
        "All that (m, 4) frames in the tets are judged by, as a TetFieldAnalysis. sampling: tet_sampling(domain). "
        "Raises InvalidInput.");
}

}  // namespace

void bind_recipe(py::module_& m) {
    bind_analyses(m);
    bind_computed<ComputedField>(m, "ComputedField", "A frame field at the vertices, and what led to it.");
    bind_computed<ComputedTetField>(m, "ComputedTetField", "A frame field in the tets, and what led to it.");
    bind_recipe_parts(m);
    bind_compute(
        m, "computed_field", &computed_field,
        "From a domain to a frame field with its analysis, as a ComputedField: cross field on the surface, "
        "surface_constraints, frame_field, comb_vertices, analyse_field. constraints: the user's own, in place "
        "of the surface's. seed: of the cross field and of frame_field; where mode is \"none\", the cross field "
        "is the start. axes: \"orthogonal\", or \"free\": along both faces of sharp edges, as axes_stretch has them. "
        "The other options are those of the parts. octafield.compute_field does the same from a "
        "file on. Raises InvalidInput, GeometryError, SolverError, Cancelled.");
    bind_compute(
        m, "computed_tet_field", &computed_tet_field,
        "computed_field with frames in the tets, as a ComputedTetField. Its axes are at right angles: InvalidInput "
        "for \"free\".");
}

}  // namespace octafield::bindings
