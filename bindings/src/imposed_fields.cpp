// Cross fields with imposed singular points, and the patterns of such points.
#include "arrays.hpp"
#include "bind.hpp"
#include "checks.hpp"
#include "domain.hpp"
#include "interruptible.hpp"
#include "octafield/surface/imposed_field.hpp"
#include "options.hpp"

namespace octafield::bindings {

using namespace surface;
using py::literals::operator""_a;

void check(const ImposedFieldOptions& options) {
    finite(options.tolerance, "tolerance");
    finite(options.ring_ratio, "ring_ratio");
}

namespace {

Eigen::Vector3d place_of(const ArrayLike& position, const char* name) {
    const auto row = from_python<Eigen::Vector3d>(position, name);
    if (!row.allFinite()) throw InvalidInput(std::string(name) + " is not finite", "not_finite");
    return row;
}

void bind_pattern_types(py::module_& m) {
    Record<ImposedPoint>(m, "ImposedPoint",
                         "A singular point of a pattern: in a triangle, on an edge (one weight 0) or at a vertex (one "
                         "weight 1).")
        .field("triangle", &ImposedPoint::triangle, "Triangle id.")
        .field("weights", &ImposedPoint::weights, "(3,) float64 barycentric coordinates, at least 0, of sum 1.")
        .field("index_times_four", &ImposedPoint::index_times_four,
               "t: the valence inside is 4 - t (1 for valence 3, -1 for 5, -4 for 8); 2 - t quads on the boundary.")
        .finish([](const ImposedPoint& p) {
            return "index " + std::to_string(p.index_times_four) + "/4, triangle " + std::to_string(p.triangle);
        });
    Record<CornerQuads>(m, "CornerQuads", "How many quads meet at a vertex of the boundary.")
        .field("vertex", &CornerQuads::vertex, "Vertex id.")
        .field("quads", &CornerQuads::quads, "Number of quads, at least 1: index (2 - quads) / 4.")
        .finish(
            [](const CornerQuads& c) { return "vertex " + std::to_string(c.vertex) + ", " + count(c.quads, "quad"); });
    Record<SingularPattern>(m, "SingularPattern",
                            "Singular points to be imposed on a cross field, and the quads at corners of the boundary.")
        .field("points", &SingularPattern::points,
               "List of ImposedPoint; one on the boundary says how many quads meet there.")
        .field("corners", &SingularPattern::corners,
               "List of CornerQuads; vertices not listed have what default_corner_quads gives.")
        .finish([](const SingularPattern& p) {
            return count(static_cast<std::ptrdiff_t>(p.points.size()), "point") + ", " +
                   count(static_cast<std::ptrdiff_t>(p.corners.size()), "corner");
        });
    Record<CornerChoice>(m, "CornerChoice", "Quads at corners such that the fewest singular points are needed inside.")
        .field("corners", &CornerChoice::corners, "List of CornerQuads, those of 2 quads left out.")
        .field("changed", &CornerChoice::changed, "int32 ids of the vertices whose quads are not the default.")
        .field("inner_index_before", &CornerChoice::inner_index_before,
               "int32 per connected component: sum of t that the default leaves for points inside.")
        .field("inner_index", &CornerChoice::inner_index, "int32 likewise: what this choice leaves.")
        .finish([](const CornerChoice& c) {
            return count(static_cast<std::ptrdiff_t>(c.corners.size()), "corner") + ", " +
                   std::to_string(c.changed.size()) + " changed";
        });
}

void bind_field_types(py::module_& m) {
    Record<ImposedFieldOptions>(m, "ImposedFieldOptions",
                                "Options of impose_singular_points: its keyword arguments, with their defaults.")
        .field("inadmissible", &ImposedFieldOptions::inadmissible,
               "What to do with a pattern that no field has: \"fail\", \"move\" its points, \"rotate\" the field.")
        .field("tolerance", &ImposedFieldOptions::tolerance, "Radians, above 0: what is below is rotated away.")
        .field("allow_zero_quads", &ImposedFieldOptions::allow_zero_quads, "Whether corners may have no quads.")
        .field("sectors", &ImposedFieldOptions::sectors, "Equal sectors round a point, at least; 6 or more.")
        .field("rings", &ImposedFieldOptions::rings, "Rings of triangles round a point, at least 1.")
        .field("ring_ratio", &ImposedFieldOptions::ring_ratio, "Above 1: how much wider each ring is.")
        .field("max_steps", &ImposedFieldOptions::max_steps, "Of Newton's method, where points move.")
        .finish([](const ImposedFieldOptions& o) {
            return "inadmissible='" + to_word(o.inadmissible) + "', tolerance=" + number(o.tolerance);
        });
    Record<HolonomyCondition>(m, "HolonomyCondition",
                              "A condition on the places of singular points, beside the sum of their indices.")
        .field("boundary", &HolonomyCondition::boundary,
               "Whether it is that a boundary curve is followed when the longest one is; otherwise, that the field "
               "comes back to itself along a generator of the surface.")
        .field("vertex", &HolonomyCondition::vertex, "Vertex id: the lowest of the curve, or one beside the generator.")
        .field("angle", &HolonomyCondition::angle, "Radians in (-pi/4, pi/4]: by what the pattern misses it.")
        .field("rotation", &HolonomyCondition::rotation,
               "Radians: coefficient of the harmonic function that was taken off the field.")
        .field("size_factor", &HolonomyCondition::size_factor,
               "At least 1: by what sizes disagree after a turn round the curve or along the generator.")
        .finish([](const HolonomyCondition& c) {
            return std::string(c.boundary ? "boundary curve" : "generator") + " at vertex " + std::to_string(c.vertex) +
                   ", angle " + number(c.angle);
        });
    Record<ImposedField>(m, "ImposedField", "A cross field with imposed singular points, and the size of its quads.")
        .field("field", &ImposedField::field,
               "DirectionField of symmetry 4 on the surface refined round the points: vertices of the input keep their "
               "numbers, triangles are parts of the input's.")
        .field(
            "log_size", &ImposedField::log_size,
            "(V,) float64, H: exp(H) is the edge length of quads, up to one factor; such that quads of unit size are "
            "as many as the area.")
        .field("pattern", &ImposedField::pattern,
               "SingularPattern as imposed, on the input; points where they moved to.")
        .field("point_vertices", &ImposedField::point_vertices, "(n,) int32: the vertex at each point.")
        .field("vertex_triangles", &ImposedField::vertex_triangles,
               "(V,) int32: the triangle of the input that holds each vertex; -1: none.")
        .field("vertex_weights", &ImposedField::vertex_weights, "(V, 3) float64 barycentric coordinates there.")
        .field("triangle_origins", &ImposedField::triangle_origins, "(F,) int32: the input's triangle of each.")
        .field("conditions", &ImposedField::conditions, "List of HolonomyCondition.")
        .field("closure", &ImposedField::closure, "Radians: largest misfit left anywhere; rounding.")
        .field("steps", &ImposedField::steps, "Of Newton's method.")
        .field("largest_move", &ImposedField::largest_move, "Of a point, input unit.")
        .finish([](const ImposedField& f) {
            return count(static_cast<std::ptrdiff_t>(f.point_vertices.size()), "point") + ", " +
                   count(f.log_size.size(), "vertex", "vertices") + ", " +
                   count(static_cast<std::ptrdiff_t>(f.conditions.size()), "condition");
        });
}

void bind_impose(py::module_& m) {
    m.def(
        "impose_singular_points",
        [](const SurfaceOrMesh& surface, const SingularPattern& pattern,
           const std::optional<ProgressCallable>& progress, const py::kwargs& given) {
            const auto [options] = options_of<ImposedFieldOptions>("impose_singular_points", given);
            return run_interruptible(
                [surface, pattern, options = options](Job& job) {
                    return impose_singular_points(domain_of(surface), pattern, options, job.progress());
                },
                progress);
        },
        "surface"_a, "pattern"_a, py::kw_only(), "progress"_a = py::none(),
        "The cross field that has just these singular points and follows the boundary, with the size of its quads, as "
        "an ImposedField (Jezdimirovic et al. 2021): size and angle are conjugate, from one linear system.\n\n"
        "The indices, corners included, must sum to the Euler characteristic. On surfaces with several boundary "
        "curves, or of higher genus, the places of the points must satisfy further conditions; a pattern that misses "
        "one by more than `tolerance` (radians) is refused (inadmissible \"fail\"), has its points moved as little as "
        "possible (\"move\"), or has the field rotated, so that sizes disagree after a turn (\"rotate\"). "
        "allow_zero_quads: corners of no quads, which no finite quad mesh has. sectors, rings, ring_ratio: the "
        "refinement round each point. max_steps: of Newton's method. Raises InvalidInput, GeometryError, SolverError, "
        "Cancelled.");
    list_options<ImposedFieldOptions>(m, "impose_singular_points");
}

void bind_corners(py::module_& m) {
    m.def(
        "default_corner_quads",
        [](const SurfaceOrMesh& surface) {
            return run_interruptible([surface](Job&) { return default_corner_quads(domain_of(surface)); });
        },
        "surface"_a,
        "Vertices of the boundary where, by the angle of the surface, other than 2 quads meet: the angle over 90 "
        "degrees "
        "rounded, halves down, as a list of CornerQuads. Raises GeometryError where parts of the surface only touch.");
    m.def(
        "fewest_points_corner_quads",
        [](const SurfaceOrMesh& surface) {
            return run_interruptible([surface](Job&) { return fewest_points_corner_quads(domain_of(surface)); });
        },
        "surface"_a,
        "The same, as a CornerChoice, with some corners rounded to the other side where that leaves fewer singular "
        "points to be imposed inside, at the least cost of angle.");
}

void bind_places(py::module_& m) {
    m.def(
        "imposed_point",
        [](const SurfaceOrMesh& surface, const ArrayLike& position, int index_times_four) {
            return run_interruptible([surface, place = place_of(position, "position"), index_times_four](Job&) {
                return imposed_point(domain_of(surface), place, index_times_four);
            });
        },
        "surface"_a, "position"_a, "index_times_four"_a,
        "The ImposedPoint at the place of the surface nearest to a position, (3,). Raises InvalidInput for positions "
        "off the surface.");
    m.def(
        "imposed_at_vertex",
        [](const SurfaceOrMesh& surface, Index vertex, int index_times_four) {
            return run_interruptible([surface, vertex, index_times_four](Job&) {
                return imposed_at_vertex(domain_of(surface), vertex, index_times_four);
            });
        },
        "surface"_a, "vertex"_a, "index_times_four"_a, "The ImposedPoint at a vertex of the surface, by its id.");
    m.def(
        "imposed_position",
        [](const SurfaceOrMesh& surface, const ImposedPoint& point) {
            return own(
                run_interruptible([surface, point](Job&) { return imposed_position(domain_of(surface), point); }));
        },
        "surface"_a, "point"_a, "(3,) float64: where on the surface an ImposedPoint is.");
}

void bind_edits(py::module_& m) {
    m.def(
        "singular_pattern",
        [](const DirectionField& field, const SurfaceSingularities& singularities) {
            return run_interruptible([field, singularities](Job&) {
                check(field);
                check(singularities, field.domain.mesh());
                return singular_pattern(field, singularities);
            });
        },
        "field"_a, "singularities"_a,
        "The singular points of a cross field, as found by surface_singularities, as a SingularPattern; every corner "
        "that the field does not have has 2 quads. Raises InvalidInput for other symmetries than 4.");
    m.def(
        "singular_pattern",
        [](const SurfaceDomain& surface, const SurfaceSingularities& singularities) {
            return run_interruptible([surface, singularities](Job&) {
                check(singularities, surface.mesh());
                return singular_pattern(surface, singularities);
            });
        },
        "surface"_a, "singularities"_a,
        "The same of points found by any field of symmetry 4 on a SurfaceDomain, which may be measured by other "
        "lengths.");
    m.def(
        "move_singular_point",
        [](const SurfaceOrMesh& surface, const SingularPattern& pattern, Index place, const ArrayLike& to) {
            return run_interruptible([surface, pattern, place, to = place_of(to, "to")](Job&) {
                return move_singular_point(domain_of(surface), pattern, place, to);
            });
        },
        "surface"_a, "pattern"_a, "place"_a, "to"_a,
        "The pattern with the point at `place` in its list of points moved to the position `to`, (3,).");
    m.def(
        "add_singular_pair",
        [](const SurfaceOrMesh& surface, const SingularPattern& pattern, const ArrayLike& valence_3,
           const ArrayLike& valence_5) {
            return run_interruptible([surface, pattern, three = place_of(valence_3, "valence_3"),
                                      five = place_of(valence_5, "valence_5")](Job&) {
                return add_singular_pair(domain_of(surface), pattern, three, five);
            });
        },
        "surface"_a, "pattern"_a, "valence_3"_a, "valence_5"_a,
        "The pattern with a point of valence 3 and one of valence 5 more, at these positions, (3,): the sum of the "
        "indices stays.");
    m.def(
        "remove_singular_points",
        [](const SingularPattern& pattern, const ArrayLike& places) {
            return remove_singular_points(pattern, from_python<std::vector<Index>>(places, "places"));
        },
        "pattern"_a, "places"_a, "The pattern without the points at these places in its list of points.");
    m.def(
        "merge_singular_points",
        [](const SurfaceOrMesh& surface, const SingularPattern& pattern, const ArrayLike& places, const ArrayLike& to) {
            return run_interruptible([surface, pattern, places = from_python<std::vector<Index>>(places, "places"),
                                      to = place_of(to, "to")](Job&) {
                return merge_singular_points(domain_of(surface), pattern, places, to);
            });
        },
        "surface"_a, "pattern"_a, "places"_a, "to"_a,
        "The pattern with the points at these places replaced by one of the summed index at the position `to`, (3,), "
        "last in its list; by none where the sum is 0. Raises InvalidInput where no quad would be left round it.");
}

}  // namespace

void bind_imposed_field_types(py::module_& m) {
    bind_pattern_types(m);
    bind_field_types(m);
}

void bind_imposed_fields(py::module_& m) {
    bind_impose(m);
    bind_corners(m);
    bind_places(m);
    bind_edits(m);
}

}  // namespace octafield::bindings
