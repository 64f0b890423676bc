// TetDomain: arrays are numpy views that cannot be written to and that keep the domain alive.
#include "domain.hpp"

#include "arrays.hpp"
#include "bind.hpp"
#include "interruptible.hpp"
#include "record.hpp"

namespace octafield::bindings {

using namespace volume;
using py::literals::operator""_a;
using surface::FeatureGraph;

namespace {

TetDomain made(const TetMesh& mesh, const ArrayLike& regions, const std::optional<FeatureGraph>& features) {
    return run_interruptible(
        [mesh = mesh, ids = from_python<std::vector<Index>>(regions, "regions"), features](Job&) mutable {
            const TetDomain domain(std::move(mesh), std::move(ids));
            return features ? domain.with_features(std::move(*features)) : domain;
        });
}

void bind_views(py::class_<TetDomain>& type) {
    view_property(
        type, "vertices", [](const TetDomain& d) -> auto& { return d.mesh().vertices; },
        "(n, 3) float64 positions, the input's length unit; cannot be written to, as all arrays here.");
    view_property(
        type, "tets", [](const TetDomain& d) -> auto& { return d.mesh().tets; },
        "(m, 4) int32 vertex ids, positively oriented.");
    view_property(
        type, "regions", [](const TetDomain& d) -> auto& { return d.regions(); },
        "(m,) int32 an id per tet, or none where all are one region.");
    view_property(
        type, "triangles", [](const TetDomain& d) -> auto& { return d.triangles().triangles; },
        "(t, 3) int32: every triangle once, ids ascending in each row, rows in lexicographic order.");
    view_property(
        type, "triangle_sides", [](const TetDomain& d) -> auto& { return d.triangles().sides; },
        "(t, 2) int32: 4 tet + corner opposite, for the tets on both sides, lower first; -1 none.");
    view_property(
        type, "tet_triangles", [](const TetDomain& d) -> auto& { return d.triangles().tet_triangles; },
        "(m, 4) int32, column k: the triangle opposite corner k.");
    view_property(
        type, "sides", [](const TetDomain& d) -> auto& { return d.sides(); },
        "(F, 2) int32, per triangle of the surface: tet behind it, and tet ahead of it or -1.");
    view_property(
        type, "surface_rows", [](const TetDomain& d) -> auto& { return d.surface_rows(); },
        "(F,) int32, per triangle of the surface: its row in triangles.");
}

void bind_domain_parts(py::class_<TetDomain>& type) {
    type.def_property_readonly(
            "mesh", [](const TetDomain& d) { return d.mesh(); }, "TetMesh, a copy that may be changed.")
        .def_property_readonly(
            "surface", [](const TetDomain& d) { return d.surface(); },
            "BoundarySurface that a field follows, a copy: the boundary's triangles outward, then the interfaces, out "
            "of the region of the lower id.")
        .def_property_readonly(
            "boundary", [](const TetDomain& d) { return d.boundary(); },
            "BoundarySurface without the interfaces, a copy.")
        .def_property_readonly("interface_triangles", &TetDomain::interface_triangles,
                               "How many of the surface's last triangles are interfaces.")
        .def_property_readonly(
            "sheets", [](const TetDomain& d) { return d.sheets(); },
            "Sheets, a copy: the surface cut open along edges that do not have exactly two triangles.")
        .def_property_readonly(
            "features", [](const TetDomain& d) { return d.features(); },
            "FeatureGraph, a copy: feature edges and corners, vertex ids of surface.mesh.")
        .def_property_readonly("vertex_count", &TetDomain::vertex_count, "Vertices of the mesh.")
        .def_property_readonly("tet_count", &TetDomain::tet_count, "Tets of the mesh.");
}

}  // namespace

void bind_domain(py::module_& m) {
    py::class_<TetDomain> type(
        m, "TetDomain",
        "A tet mesh with all that is derived from it, made and validated once, then shared and never changed. "
        "Functions that take a TetDomain take a TetMesh too, and make a domain of it for that call alone.");
    type.def(py::init(&made), "mesh"_a, py::kw_only(), "regions"_a = py::tuple(), "features"_a = py::none(),
             "mesh: TetMesh; regions: (m,) an id per tet, or none; features: FeatureGraph of the surface. Raises "
             "InvalidInput, and GeometryError naming tets where the mesh is unsound.");
    bind_views(type);
    bind_domain_parts(type);
    type.def(
            "with_features",
            [](const TetDomain& domain, const FeatureGraph& features) {
                return run_interruptible([domain = domain, features = features](Job&) mutable {
                    return domain.with_features(std::move(features));
                });
            },
            "features"_a, "The same mesh with other feature edges; nothing is copied. Raises InvalidInput.")
        .def_static("made", &TetDomain::made, "How many meshes this process has validated so far.")
        .def("__reduce__",
             [](const py::object& self) {
                 const auto& d = self.cast<const TetDomain&>();
                 const py::dict named("regions"_a = self.attr("regions"), "features"_a = d.features());
                 return py::make_tuple(
                     py::module_::import("functools").attr("partial")(py::type::of(self), d.mesh(), **named),
                     py::tuple());
             })
        .def("__repr__", [](const TetDomain& d) {
            return "TetDomain(" + count(d.vertex_count(), "vertex", "vertices") + ", " + count(d.tet_count(), "tet") +
                   ", " + count(d.surface().mesh.triangles.rows(), "surface triangle") + ", " +
                   count(d.features().edges.rows(), "feature edge") + box(d.mesh().vertices) + ")";
        });
    m.def(
        "features_on_sheets",
        [](const FeatureGraph& features, const Sheets& sheets) {
            return run_interruptible([features = features, sheets = sheets](Job&) {
                check(sheets.mesh, false);
                if (sheets.vertex_map.size() != static_cast<std::size_t>(sheets.mesh.vertices.rows()))
                    throw InvalidInput("sheets.vertex_map: one id per vertex of sheets.mesh is needed", "wrong_shape");
                return features_on_sheets(features, sheets);
            });
        },
        "features"_a, "sheets"_a,
        "The edges of Sheets that are copies of feature edges of their surface, and the corners between them, as a "
        "FeatureGraph.");
}

}  // namespace octafield::bindings
