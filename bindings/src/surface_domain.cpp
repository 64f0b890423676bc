// SurfaceDomain: arrays are numpy views that cannot be written to and that keep the domain alive.
#include "octafield/surface/surface_domain.hpp"

#include "arrays.hpp"
#include "bind.hpp"
#include "checks.hpp"
#include "interruptible.hpp"
#include "record.hpp"

namespace octafield::bindings {

using namespace surface;
using py::literals::operator""_a;

namespace {

SurfaceDomain made(const std::optional<TriangleMesh>& mesh, const std::optional<FeatureGraph>& features,
                   const std::optional<ArrayLike>& lengths) {
    if (!mesh) return {};
    std::optional<Eigen::VectorXd> own;
    if (lengths) own = from_python<Eigen::VectorXd>(*lengths, "edge_lengths");
    return run_interruptible(
        [mesh = *mesh, features = features.value_or(FeatureGraph{}), own = std::move(own)](Job&) mutable {
            check(mesh, false);
            SurfaceDomain domain(std::move(mesh), std::move(features));
            return own ? domain.with_edge_lengths(std::move(*own)) : domain;
        });
}

void bind_views(py::class_<SurfaceDomain>& type) {
    view_property(
        type, "vertices", [](const SurfaceDomain& d) -> auto& { return d.mesh().vertices; },
        "(V, 3) float64 positions, the input's length unit; cannot be written to, as all arrays here.");
    view_property(
        type, "triangles", [](const SurfaceDomain& d) -> auto& { return d.mesh().triangles; },
        "(F, 3) int32 vertex ids, counter-clockwise seen from outside.");
    view_property(
        type, "edges", [](const SurfaceDomain& d) -> auto& { return d.topology().edges; },
        "(E, 2) int32 vertex ids, lower first, in lexicographic order.");
    view_property(
        type, "triangle_edges", [](const SurfaceDomain& d) -> auto& { return d.topology().triangle_edges; },
        "(F, 3) int32 edge ids; column k is the edge from corner k to corner k+1 (mod 3).");
    view_property(
        type, "edge_triangles", [](const SurfaceDomain& d) -> auto& { return d.topology().edge_triangles; },
        "(E, 2) int32: the triangle that runs the edge low to high, then the other; -1: none.");
    view_property(
        type, "normals", [](const SurfaceDomain& d) -> auto& { return d.normals(); },
        "(F, 3) float64 unit normals of the triangles, outward.");
    view_property(
        type, "edge_lengths", [](const SurfaceDomain& d) -> auto& { return d.edge_lengths(); },
        "(E,) float64, input unit, or the surface's own.");
    view_property(
        type, "corner_angles", [](const SurfaceDomain& d) -> auto& { return d.corner_angles(); },
        "(F, 3) float64 interior angles, radians, by edge_lengths.");
}

}  // namespace

void bind_surface_domain(py::module_& m) {
    py::class_<SurfaceDomain> type(
        m, "SurfaceDomain",
        "A triangle surface with all that is derived from it, made and validated once, then shared and never changed. "
        "Functions that take a SurfaceDomain take a TriangleMesh too, and make a domain without features of it for "
        "that call alone.");
    type.def(py::init(&made), "mesh"_a = py::none(), "features"_a = py::none(), "edge_lengths"_a = py::none(),
             "mesh: TriangleMesh, edge-manifold and consistently oriented, open or closed; none: no triangles. "
             "features: FeatureGraph of it. edge_lengths: (E,) as of with_edge_lengths. Raises InvalidInput, and "
             "GeometryError naming elements where the mesh is "
             "unsound.");
    bind_views(type);
    type.def_property_readonly(
            "mesh", [](const SurfaceDomain& d) { return d.mesh(); }, "TriangleMesh, a copy that may be changed.")
        .def_property_readonly(
            "features", [](const SurfaceDomain& d) { return d.features(); },
            "FeatureGraph, a copy: feature edges and corners.")
        .def_property_readonly("mean_edge_length", &SurfaceDomain::mean_edge_length, "Input unit.")
        .def_property_readonly("size", &SurfaceDomain::size, "octafield.surface.shape_size, input unit.")
        .def(
            "with_features",
            [](const SurfaceDomain& domain, const FeatureGraph& features) {
                return run_interruptible([domain = domain, features = features](Job&) mutable {
                    return domain.with_features(std::move(features));
                });
            },
            "features"_a, "The same surface with other features; nothing is copied. Raises InvalidInput.")
        .def_property_readonly("has_own_lengths", &SurfaceDomain::has_own_lengths,
                               "bool: whether edge_lengths and corner_angles are other than in space.")
        .def_property_readonly(
            "areas", [](const SurfaceDomain& d) { return own(d.areas()); }, "(F,) float64, by edge_lengths.")
        .def(
            "with_edge_lengths",
            [](const SurfaceDomain& domain, const ArrayLike& lengths) {
                return run_interruptible([domain = domain, own = from_python<Eigen::VectorXd>(lengths, "lengths")](
                                             Job&) mutable { return domain.with_edge_lengths(std::move(own)); });
            },
            "lengths"_a,
            "The same surface measured by other edge lengths, (E,) above 0: each triangle is the flat one with these "
            "sides, and angles and areas are theirs; positions stay. Fields with imposed singular points, layouts and "
            "quads on it have their right angles there, not in space. Raises InvalidInput, and GeometryError where "
            "sides make no triangle.")
        .def_static("made", &SurfaceDomain::made, "How many surfaces this process has validated so far.")
        .def("__reduce__",
             [](const py::object& self) {
                 const auto& d = self.cast<const SurfaceDomain&>();
                 py::tuple given = py::make_tuple(d.mesh(), d.features());
                 if (d.has_own_lengths())
                     given = py::make_tuple(d.mesh(), d.features(), own(Eigen::VectorXd(d.edge_lengths())));
                 return py::make_tuple(py::type::of(self), given);
             })
        .def("__repr__", [](const SurfaceDomain& d) {
            return "SurfaceDomain(" + count(d.vertex_count(), "vertex", "vertices") + ", " +
                   count(d.triangle_count(), "triangle") + ", " + count(d.features().edges.rows(), "feature edge") +
                   box(d.mesh().vertices) + ")";
        });
}

}  // namespace octafield::bindings
