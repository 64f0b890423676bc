// Cross fields for quads of given sizes, and the sizes of cross fields.
#include "bind.hpp"
#include "checks.hpp"
#include "domain.hpp"
#include "interruptible.hpp"
#include "octafield/surface/extended_region.hpp"
#include "octafield/surface/reached_sizes.hpp"
#include "octafield/surface/sized_field.hpp"
#include "options.hpp"

namespace octafield::bindings {

using namespace surface;
using py::literals::operator""_a;

void check(const SizedFieldOptions& options) {
    finite(options.s, "s");
    finite(options.corner_tolerance, "corner_tolerance");
    finite(options.shift, "shift");
    finite(options.tolerance, "tolerance");
}

namespace {

// What a function of (n, 3) points says of the sizes there.
Eigen::VectorXd called(const py::object& function, const Points& points) {
    return from_python<Eigen::VectorXd>(function(own(Points(points))), "sizes");
}

// Of a WantedSizes, an array per vertex or a function of points.
WantedSizes sizes_of(const SurfaceDomain& domain, const py::object& sizes, const py::object& middles) {
    if (py::isinstance<WantedSizes>(sizes)) return sizes.cast<WantedSizes>();
    if (PyCallable_Check(sizes.ptr()) == 1)
        return wanted_sizes(domain, called(sizes, domain.mesh().vertices), called(sizes, edge_midpoints(domain)));
    const auto lengths = from_python<Eigen::VectorXd>(sizes, "sizes");
    return middles.is_none() ? wanted_sizes(domain, lengths)
                             : wanted_sizes(domain, lengths, from_python<Eigen::VectorXd>(middles, "middles"));
}

void bind_types(py::module_& m) {
    Record<WantedSizes>(m, "WantedSizes", "Sizes that quads are to have, and how they turn a cross field.")
        .field("lengths", &WantedSizes::lengths, "(V,) float64, above 0: edges of quads, input unit.")
        .field("turns", &WantedSizes::turns,
               "(E,) float64 radians: by what a field with these sizes turns along each edge, from its lower to its "
               "higher vertex, against parallel transport.")
        .finish([](const WantedSizes& s) {
            return count(s.lengths.size(), "vertex", "vertices") + ", " + count(s.turns.size(), "edge");
        });
    Record<SizedField>(m, "SizedField", "A direction field for quads of given sizes.")
        .field("field", &SizedField::field, "DirectionField: on the edges, for all that takes one.")
        .field("values", &SizedField::values,
               "(V,) complex128: r exp(i N theta) from the first edge round each vertex, angles scaled to 2 pi.")
        .field("directions", &SizedField::directions,
               "(V, 3) float64 unit vectors, one of the N, orthogonal to vertex_normals.")
        .field("eigenvalue", &SizedField::eigenvalue,
               "u* A u / u* M u, 1 / input unit^2: the least eigenvalue where nothing is given.")
        .field("iterations", &SizedField::iterations, "Of the inverse iteration.")
        .field("converged", &SizedField::converged, "Whether it came to rest.")
        .field("holonomy", &SizedField::holonomy,
               "(F,) float64 radians: N times what a direction carried round each triangle turns by in the metric of "
               "the sizes.")
        .field("unresolved", &SizedField::unresolved,
               "int32 ids of triangles where that is pi or more: too large for the sizes.")
        .field("triangle_indices", &SizedField::triangle_indices, "(F,) int32: N times the index in each triangle.")
        .field("least_length", &SizedField::least_length, "The least |values| over the largest.")
        .finish([](const SizedField& f) {
            return count(f.values.size(), "vertex", "vertices") + ", eigenvalue " + number(f.eigenvalue) + ", " +
                   std::to_string(f.unresolved.size()) + " unresolved";
        });
    Record<ReachedSizes>(m, "ReachedSizes", "The sizes that a direction field's quads can have.")
        .field("log_sizes", &ReachedSizes::log_sizes,
               "(V,) float64: the logarithm of the edges of quads, of mean 0 over each connected part.")
        .field("misfit", &ReachedSizes::misfit,
               "In [0, 1]: the part of the field's rotation that no size explains; 0: quads can be squares "
               "everywhere.")
        .finish([](const ReachedSizes& r) {
            return count(r.log_sizes.size(), "vertex", "vertices") + ", misfit " + number(r.misfit);
        });
    Record<ExtendedRegion>(m, "ExtendedRegion", "A plane region within a larger one.")
        .field("mesh", &ExtendedRegion::mesh, "TriangleMesh: the region's vertices and triangles first.")
        .field("vertices", &ExtendedRegion::vertices, "How many vertices are the region's.")
        .field("triangles", &ExtendedRegion::triangles, "How many triangles are the region's.")
        .finish([](const ExtendedRegion& r) {
            return count(r.triangles, "triangle") + " of " + std::to_string(r.mesh.triangles.rows());
        });
}

void bind_options(py::module_& m) {
    Record<SizedFieldOptions>(m, "SizedFieldOptions",
                              "Options of sized_field: its keyword arguments, with their defaults.")
        .field("symmetry", &SizedFieldOptions::symmetry, "N, 4: crosses.")
        .field("s", &SizedFieldOptions::s, "In [-1, 1]: -1 antiholomorphic, 0 Dirichlet, 1 holomorphic energy.")
        .field("boundary_alignment", &SizedFieldOptions::boundary_alignment, "\"strong\", \"weak\" or \"none\".")
        .field("feature_alignment", &SizedFieldOptions::feature_alignment, "The same for features inside.")
        .field("corner_tolerance", &SizedFieldOptions::corner_tolerance,
               "In [0, 1]: vertices whose edges contradict each other by more, of the worst, are left free.")
        .field("directions", &SizedFieldOptions::directions, "(V, 3) directions to follow; or none.")
        .field("weights", &SizedFieldOptions::weights, "(V,) of them: 0 none there, inf held; left out: 1.")
        .field("shift", &SizedFieldOptions::shift,
               "Where something is given: the lower, the nearer to it; below the least eigenvalue.")
        .field("max_iterations", &SizedFieldOptions::max_iterations, "Of the inverse iteration.")
        .field("tolerance", &SizedFieldOptions::tolerance, "Relative change of the eigenvalue at which it stops.")
        .field("seed", &SizedFieldOptions::seed, "Of its start.")
        .finish([](const SizedFieldOptions& o) {
            return "symmetry=" + std::to_string(o.symmetry) + ", s=" + number(o.s) + ", shift=" + number(o.shift);
        });
}

void bind_solver(py::module_& m) {
    m.def(
        "wanted_sizes",
        [](const SurfaceOrMesh& surface, const py::object& sizes, const py::object& middles) {
            return sizes_of(domain_of(surface), sizes, middles);
        },
        "surface"_a, "sizes"_a, "middles"_a = py::none(),
        "Edge lengths that quads are to have, with how they turn a cross field, as WantedSizes. sizes: (V,), above 0, "
        "with `middles`, (E,), also those at edge_midpoints; or a function of (n, 3) points that returns (n,), which "
        "is "
        "called for both. With middles, ln sizes is quadratic in each triangle, linear without. Raises InvalidInput.");
    m.def(
        "edge_midpoints", [](const SurfaceOrMesh& surface) { return own(edge_midpoints(domain_of(surface))); },
        "surface"_a, "(E, 3) float64: the middles of the edges of edge_topology.");
    m.def(
        "sized_field",
        [](const SurfaceOrMesh& surface, const py::object& sizes, const std::optional<ProgressCallable>& progress,
           const py::kwargs& given) {
            auto [options] = options_of<SizedFieldOptions>("sized_field", given);
            SurfaceDomain domain = domain_of(surface);
            WantedSizes wanted = sizes_of(domain, sizes, py::none());
            return run_interruptible(
                [domain = std::move(domain), wanted = std::move(wanted), options = std::move(options)](Job& job) {
                    return sized_field(domain, wanted, options, job.progress());
                },
                progress);
        },
        "surface"_a, "sizes"_a, py::kw_only(), "progress"_a = py::none(),
        "The smoothest direction field for quads of given sizes, as a SizedField: globally optimal direction fields "
        "(Knoeppel et al. 2013) with the connection of the metric sizes^-2 g (Simons 2024). sizes: WantedSizes, or "
        "what "
        "wanted_sizes takes.\n\n"
        "boundary_alignment, feature_alignment: \"strong\", held at vertices; \"weak\", given; \"none\". directions: "
        "(V, 3), given with `weights` (0: none there, inf: held), before boundary and features. Where anything is "
        "given, it is one linear system, and `shift` says how near the field keeps to it; elsewhere the field is the "
        "eigenvector of the least eigenvalue, by inverse iteration.\n\n"
        "Its singular points: surface_singularities of its `field`. Raises InvalidInput, GeometryError, SolverError.");
    list_options<SizedFieldOptions>(m, "sized_field");
    m.def(
        "sized_domain",
        [](const SurfaceOrMesh& surface, const ArrayLike& lengths) {
            return sized_domain(domain_of(surface), from_python<Eigen::VectorXd>(lengths, "lengths"));
        },
        "surface"_a, "lengths"_a,
        "The surface measured by unit edges of quads with these lengths, (V,): direction_field on it makes fields for "
        "them, too, by its own methods; restricted_field takes these back to the surface. Raises GeometryError where "
        "sizes change too fast for the triangles.");
}

void bind_sizes(py::module_& m) {
    m.def(
        "boundary_sizes",
        [](const SurfaceOrMesh& surface, double growth, double largest) {
            const BoundarySizeOptions options{finite(growth, "growth"), finite(largest, "largest")};
            return own(
                run_interruptible([surface, options](Job&) { return boundary_sizes(domain_of(surface), options); }));
        },
        "surface"_a, py::kw_only(), "growth"_a = BoundarySizeOptions{}.growth,
        "largest"_a = BoundarySizeOptions{}.largest,
        "(V,) float64: the length of boundary edges at the nearest place of the boundary plus growth times the "
        "distance "
        "to it, straight through space; at most `largest`, 0: no limit. Raises InvalidInput for closed surfaces.");
    m.def(
        "reached_sizes",
        [](const DirectionField& field) {
            return run_interruptible([field](Job&) {
                check(field);
                return reached_sizes(field);
            });
        },
        "field"_a,
        "The sizes that the quads of a direction field can have, as ReachedSizes: the least squares solution of one "
        "Poisson problem. On a domain with its own edge lengths, in its metric.");
    m.def(
        "size_ratios",
        [](const SurfaceOrMesh& surface, const ReachedSizes& reached, const ArrayLike& wanted) {
            return own(size_ratios(domain_of(surface), reached, from_python<Eigen::VectorXd>(wanted, "wanted")));
        },
        "surface"_a, "reached"_a, "wanted"_a,
        "(V,) float64: reached over wanted lengths after one factor per connected part that makes their geometric mean "
        "1; above 1 quads are too large.");
}

void bind_regions(py::module_& m) {
    m.def(
        "extended_region",
        [](const SurfaceOrMesh& region, double margin, double longest) {
            finite(margin, "margin");
            finite(longest, "longest");
            return run_interruptible(
                [region, margin, longest](Job&) { return extended_region(domain_of(region), margin, longest); });
        },
        "region"_a, py::kw_only(), "margin"_a = 0.0, "longest"_a = 0.0,
        "A plane region within the rectangle that is `margin` (0: half its shape_size) larger on each side, holes "
        "filled, as an ExtendedRegion. Edges outside are no longer than `longest` (0: a quarter of the margin). Raises "
        "InvalidInput for surfaces that are not plane.");
    m.def(
        "extended_sizes",
        [](const ExtendedRegion& region, const ArrayLike& lengths) {
            check(region.mesh);
            return own(run_interruptible([region, sizes = from_python<Eigen::VectorXd>(lengths, "lengths")](Job&) {
                return extended_sizes(region, sizes);
            }));
        },
        "region"_a, "lengths"_a,
        "(V,) float64 lengths on the extended mesh: the region's, and outside those whose logarithm is harmonic, "
        "constant where they are constant along its boundary.");
    m.def(
        "restricted_field",
        [](const DirectionField& field, const SurfaceOrMesh& region) {
            check(field);
            return run_interruptible([field, region](Job&) { return restricted_field(field, domain_of(region)); });
        },
        "field"_a, "region"_a,
        "A DirectionField of an extended mesh on the region alone; also one of a sized_domain on its surface in space. "
        "Raises InvalidInput where edges of the region are not edges of the field's mesh.");
}

}  // namespace

void bind_sized_field_types(py::module_& m) { bind_types(m); }

void bind_sized_fields(py::module_& m) {
    bind_options(m);
    bind_solver(m);
    bind_sizes(m);
    bind_regions(m);
}

}  // namespace octafield::bindings
