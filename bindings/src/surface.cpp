// Functions of surface/ on meshes; those on direction fields are in direction_fields.cpp and streamlines.cpp.
#include <pybind11/stl/filesystem.h>

#include "arrays.hpp"
#include "bind.hpp"
#include "checks.hpp"
#include "interruptible.hpp"
#include "options.hpp"
#include "octafield/surface/read_write.hpp"
#include "octafield/surface/remesh.hpp"
#include "octafield/surface/repair.hpp"
#include "octafield/surface/validate.hpp"

namespace octafield::bindings {

using namespace surface;
using py::literals::operator""_a;

namespace {

// Binds f(mesh) -> value or array after the border checks.
template <class Function>
void def_of_mesh(py::module_& m, const char* name, Function function, const char* doc, bool require_elements = false) {
    const auto call = [function, require_elements](const TriangleMesh& mesh) {
        return run_interruptible([mesh = mesh, function, require_elements](Job&) {
            check(mesh, require_elements);
            return function(mesh);
        });
    };
    if constexpr (ArrayType<std::invoke_result_t<Function, const TriangleMesh&>>)
        m.def(
            name, [call](const TriangleMesh& mesh) { return own(call(mesh)); }, "mesh"_a, doc);
    else
        m.def(name, call, "mesh"_a, doc);
}

void bind_elementary(py::module_& m) {
    def_of_mesh(m, "edge_topology", edge_topology,
                "The edges of a mesh and their triangles, as an EdgeTopology. Raises GeometryError (kind "
                "\"non_manifold_edge\" or "
                "\"inconsistent_orientation\") where three triangles share an edge, or two run it alike.");
    def_of_mesh(m, "signed_volume", signed_volume,
                "Enclosed volume of a closed mesh, cubed input unit; negative when the triangles point inward.");
    def_of_mesh(m, "triangle_areas", triangle_areas, "(F,) areas of the triangles, squared input unit.");
    def_of_mesh(m, "triangle_normals", triangle_normals, "(F, 3) unit normals, zero where the area is zero.");
    def_of_mesh(m, "vertex_normals", vertex_normals,
                "(V, 3) unit vertex normals, weighted by the areas of the incident triangles.");
    def_of_mesh(m, "mean_edge_length", mean_edge_length,
                "Mean length of the edges, input unit. Needs at least one triangle.", true);
    def_of_mesh(m, "shape_size", shape_size,
                "The size that default lengths are fractions of, input unit: 3 times the root mean square distance of the "
                "surface from its centroid, about the diagonal of a box, whichever way the surface lies. Needs at least "
                "one triangle.",
                true);
    def_of_mesh(m, "default_edge_length", default_edge_length,
                "The length of octafield.surface.remesh where none is given and the shape asks for no shorter one "
                "(octafield.surface.size_field), input unit: 1/25 of octafield.surface.shape_size. Needs at least one triangle.",
                true);
    def_of_mesh(m, "euler_characteristic", euler_characteristic,
                "V - E + F over the vertices in use. Raises GeometryError where edge_topology does.");
    m.def(
        "bounding_box_diagonal",
        [](const ArrayLike& points) {
            auto rows = from_python<Points>(points, "points");
            if (rows.rows() == 0) throw InvalidInput("points: no rows", "empty");
            return run_interruptible([rows = std::move(rows)](Job&) {
                check_vectors(rows, rows.rows(), "points");
                return bounding_box_diagonal(rows);
            });
        },
        "points"_a, "Length of the bounding box's diagonal of (n, 3) points, n at least 1.");
}

void bind_surface_files(py::module_& m) {
    m.def(
        "read_surface",
        [](const std::filesystem::path& path) {
            return run_interruptible([path](Job&) { return read_surface(path); });
        },
        "path"_a,
        "Read a triangle mesh: STL (ASCII, binary), OBJ, OFF or PLY, each also gzipped, by extension. Equal points are "
        "merged in STL only, "
        "polygons are fan-triangulated, nothing is repaired. Raises IoError naming the file and, where known, the line "
        "or byte.");
    m.def(
        "write_surface",
        [](const TriangleMesh& mesh, const std::filesystem::path& path) {
            run_interruptible([mesh = mesh, path](Job&) {
                check(mesh, false);
                write_surface(mesh, path);
                return true;
            });
        },
        "mesh"_a, "path"_a,
        "Write a triangle mesh by extension: .stl (binary), .obj, .off, .ply. The file appears only when complete. "
        "Raises IoError.");
}

void bind_validation(py::module_& m) {
    const ValidateOptions validate;
    m.def(
        "find_defects",
        [](const TriangleMesh& mesh, bool closed, bool self_intersection) {
            return run_interruptible(
                [=](Job&) { return find_defects(mesh, {.closed = closed, .self_intersection = self_intersection}); });
        },
        "mesh"_a, py::kw_only(), "closed"_a = validate.closed, "self_intersection"_a = validate.self_intersection,
        "All defects of a mesh as a list of Defect, an empty list when it is the sound boundary of a volume. Kinds, in "
        "the order of the tests: empty, "
        "index_out_of_range, non_finite_vertex, degenerate_triangle, soup, duplicate_vertex, non_manifold_edge, "
        "inconsistent_orientation, not_closed, non_manifold_vertex, inside_out, self_intersection. closed: require no "
        "boundary "
        "edges; self_intersection: the slowest test.");
    m.def(
        "require_valid",
        [](const TriangleMesh& mesh, bool closed, bool self_intersection) {
            run_interruptible([=](Job&) {
                require_valid(mesh, {.closed = closed, .self_intersection = self_intersection});
                return true;
            });
        },
        "mesh"_a, py::kw_only(), "closed"_a = validate.closed, "self_intersection"_a = validate.self_intersection,
        "Raise GeometryError with the first defect's kind, elements and message when a mesh has one. Triangle meshes: "
        "see find_defects for kinds "
        "and options. Tet meshes: kinds empty, index_out_of_range, non_finite_vertex, inverted_tet.");

    const RepairOptions defaults;
    const auto options_of = [](const std::string& level, bool closed, double merge_tolerance, int small_hole_edges,
                               int max_hole_edges, double wrap_alpha, double wrap_offset) {
        return RepairOptions{.level = repair_level(level),
                             .closed = closed,
                             .merge_tolerance = merge_tolerance,
                             .small_hole_edges = small_hole_edges,
                             .max_hole_edges = max_hole_edges,
                             .wrap_alpha = wrap_alpha,
                             .wrap_offset = wrap_offset};
    };
    m.def(
        "repair",
        [options_of](const TriangleMesh& mesh, const std::string& level, bool closed, double merge_tolerance,
                     int small_hole_edges, int max_hole_edges, double wrap_alpha, double wrap_offset) {
            const RepairOptions options = options_of(level, closed, merge_tolerance, small_hole_edges, max_hole_edges,
                                                     wrap_alpha, wrap_offset);
            return run_interruptible([=](Job&) {
                check(mesh, false);
                return surface::repair(mesh, options);
            });
        },
        "mesh"_a, py::kw_only(), "level"_a = "safe", "closed"_a = defaults.closed,
        "merge_tolerance"_a = defaults.merge_tolerance, "small_hole_edges"_a = defaults.small_hole_edges,
        "max_hole_edges"_a = defaults.max_hole_edges, "wrap_alpha"_a = defaults.wrap_alpha,
        "wrap_offset"_a = defaults.wrap_offset,
        "Repairs up to a level, each one reported, as a RepairResult; a sound mesh comes back as it is. level: \"none\"; "
        "\"merge\": coinciding points become one, and points of open edges nearer than merge_tolerance (input unit; "
        "negative: twice coordinate_precision of the points; 0: equal points only); \"safe\": also repeated, flat and "
        "dangling triangles, tiny open pieces, T-junctions, orientation, holes of at most small_hole_edges edges, unused "
        "points; \"fill\": also holes of at most max_hole_edges edges (0: any), smoothly; \"resolve\": also triangles that "
        "cross; \"wrap\": what is still unsound is replaced by an alpha wrap (Portaneri et al. 2022) that bridges gaps "
        "narrower than wrap_alpha (0: 1/50 of the bounding box's diagonal) and lies wrap_offset outside (0: 1/20 of "
        "that), input unit. Up to fill no vertex moves, except into another one by merging. closed: False keeps the rims "
        "of an open surface. What is left is for find_defects to name. Raises InvalidInput.");
    m.def(
        "advise_repair",
        [options_of](const TriangleMesh& mesh, const std::string& level, bool closed, double merge_tolerance,
                     int small_hole_edges, int max_hole_edges, double wrap_alpha, double wrap_offset,
                     Index most_triangles) {
            const RepairOptions options = options_of(level, closed, merge_tolerance, small_hole_edges, max_hole_edges,
                                                     wrap_alpha, wrap_offset);
            return run_interruptible([=](Job&) {
                check(mesh, false);
                return surface::advise_repair(mesh, options, most_triangles);
            });
        },
        "mesh"_a, py::kw_only(), "level"_a = "none", "closed"_a = defaults.closed,
        "merge_tolerance"_a = defaults.merge_tolerance, "small_hole_edges"_a = defaults.small_hole_edges,
        "max_hole_edges"_a = defaults.max_hole_edges, "wrap_alpha"_a = defaults.wrap_alpha,
        "wrap_offset"_a = defaults.wrap_offset, "most_triangles"_a = 200000,
        "The first level of repair above level that makes a mesh sound, as a RepairAdvice. The levels are tried in turn on "
        "a copy and validated; resolve and wrap are left out above most_triangles. mesh: what level has made already. "
        "Other options as of repair. Raises InvalidInput.");
    m.def(
        "coordinate_precision",
        [](const ArrayLike& points) {
            auto rows = from_python<Points>(points, "points");
            return run_interruptible([rows = std::move(rows)](Job&) { return coordinate_precision(rows); });
        },
        "points"_a,
        "The precision that (n, 3) points themselves show, input unit: spacing of float32 at the largest magnitude where "
        "all coordinates are such numbers; the last decimal there where all have at most 15 significant digits (6 at "
        "least are assumed); else 8 roundings of doubles. 0 without points.");
}

void bind_surface_features(py::module_& m) {
    const FeatureOptions defaults;
    m.def(
        "detect_features",
        [](const TriangleMesh& mesh, const py::kwargs& given) {
            const auto [options] = options_of<FeatureOptions>("detect_features", given);
            return run_interruptible([mesh, options = options](Job&) {
                check(mesh);
                return detect_features(mesh, options);
            });
        },
        "mesh"_a,
        "Feature edges and corners as a FeatureGraph. angle (radians, in (0, pi)): an edge is a feature when the "
        "normals of its triangles differ "
        "by more; corner_angle (radians): a vertex with two feature edges is a corner when the curve turns by more. "
        "Boundary edges are "
        "always features.");
    list_options<FeatureOptions>(m, "detect_features");
    m.def(
        "feature_graph",
        [](const TriangleMesh& mesh, const ArrayLike& edges, double corner_angle) {
            finite(corner_angle, "corner_angle");
            return run_interruptible([mesh = mesh, corner_angle, edges = from_python<Edges>(edges, "edges")](Job&) {
                check(mesh, false);
                check_edges(edges, mesh, "edges");
                return feature_graph(mesh, edges, corner_angle);
            });
        },
        "mesh"_a, "edges"_a, py::kw_only(), "corner_angle"_a = defaults.corner_angle,
        "FeatureGraph of given feature edges, (n, 2) vertex ids of edges of the mesh: corners are where other than two "
        "of them meet, or where two "
        "turn by more than corner_angle (radians). Raises InvalidInput naming the rows that are no edges.");
}

void bind_remesh(py::module_& m) {
    m.def(
        "remesh",
        [](const TriangleMesh& mesh, const FeatureGraph& features, const std::optional<ProgressCallable>& progress,
           const py::kwargs& given) {
            const auto [options] = options_of<RemeshOptions>("remesh", given);
            return run_interruptible(
                [mesh = mesh, features = features, options = options](Job& job) mutable {
                    check(mesh);
                    features = ordered_features(std::move(features), mesh);
                    return remesh(mesh, features, options, job.progress());
                },
                progress);
        },
        "mesh"_a, "features"_a, py::kw_only(), "progress"_a = py::none(),
        "Isotropic remeshing, features kept (Botsch, Kobbelt 2004), as a RemeshResult. The input must be valid, and the "
        "result is, with the same topology. edge_length: input unit; 0 means lengths that fit the shape "
        "(octafield.surface.size_field, with max_cells), lowered where triangles would cross, or the new surface would leave "
        "the input's by more than 1/400 of octafield.surface.shape_size or change its volume by more than 1 %. A length that "
        "is given is shortened only where the surface would not be sound; the input's triangles are kept where none "
        "is. iterations: rounds, at least 1. max_cells: without a length, triangles (and tets inside) to be expected.");
    list_options<RemeshOptions>(m, "remesh");
    m.def(
        "size_field",
        [](const TriangleMesh& mesh, const FeatureGraph& features, const py::kwargs& given) {
            const auto [options] = options_of<SizeFieldOptions>("size_field", given);
            return run_interruptible([mesh = mesh, features = features, options = options](Job& job) mutable {
                check(mesh);
                features = ordered_features(std::move(features), mesh);
                return size_field(mesh, features, options, job.progress());
            });
        },
        "mesh"_a, "features"_a,
        "Edge lengths that fit a surface, as a SizeField: what octafield.surface.remesh starts from where no length is given. "
        "At each vertex angle (radians, the turn along one edge) over the curvature, twice the width of walls, gaps "
        "and strips between feature curves, within shortest (0: 1/16 of longest) and longest (0: "
        "octafield.surface.default_edge_length), changing by at most growth per distance. Where more than max_cells triangles "
        "or tets would be needed, all lengths are multiplied by one number, and a note says so. The mesh must be "
        "valid. Raises InvalidInput, GeometryError.");
    list_options<SizeFieldOptions>(m, "size_field");
}

}  // namespace

void bind_surface(py::module_& m) {
    bind_elementary(m);
    bind_surface_files(m);
    bind_validation(m);
    bind_surface_features(m);
    bind_remesh(m);
    bind_direction_fields(m);
    bind_non_orthogonal(m);
    bind_streamlines(m);
    bind_imposed_fields(m);
    bind_sized_fields(m);
    bind_size_families(m);
    bind_atlas(m);
    bind_renormalised_energy(m);
}

}  // namespace octafield::bindings
