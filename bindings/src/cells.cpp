// Meshes of mixed cells and surfaces of quads.
#include <pybind11/stl/filesystem.h>

#include "arrays.hpp"
#include "bind.hpp"
#include "checks.hpp"
#include "interruptible.hpp"
#include "octafield/volume/write_mixed_mesh.hpp"
#include "record.hpp"

namespace octafield::bindings {

using namespace volume;
using surface::QuadMesh;
using py::literals::operator""_a;

namespace {

void bind_types(py::module_& m) {
    Record<QuadMesh>(m, "QuadMesh",
                     "A surface of quads and triangles. Faces are numbered: the triangles, then the quads.")
        .field("vertices", &QuadMesh::vertices, "(V, 3) float64 positions, the input's length unit.")
        .field("triangles", &QuadMesh::triangles, "(F, 3) int32 vertex ids, counter-clockwise seen from outside.")
        .field("quads", &QuadMesh::quads, "(Q, 4) int32 vertex ids, likewise.")
        .finish([](const QuadMesh& mesh) {
            return count(mesh.vertices.rows(), "vertex", "vertices") + ", " + count(mesh.triangles.rows(), "triangle") +
                   ", " + count(mesh.quads.rows(), "quad") + box(mesh.vertices);
        });
    Record<MixedMesh>(m, "MixedMesh",
                      "A mesh of tets, hexahedra, wedges and pyramids, in the numbering of VTK and Gmsh. Cells are "
                      "numbered in this order of kinds.")
        .field("vertices", &MixedMesh::vertices, "(n, 3) float64 positions, the input's length unit.")
        .field("tets", &MixedMesh::tets, "(t, 4) int32 vertex ids, positively oriented.")
        .field("hexahedra", &MixedMesh::hexahedra, "(h, 8) int32: a quad, then the one across.")
        .field("wedges", &MixedMesh::wedges,
               "(w, 6) int32: a triangle, counter-clockwise seen from the other one, then that.")
        .field("pyramids", &MixedMesh::pyramids, "(p, 5) int32: the base, then the apex.")
        .finish([](const MixedMesh& mesh) {
            return count(mesh.vertices.rows(), "vertex", "vertices") + ", " + count(mesh.tets.rows(), "tet") + ", " +
                   count(mesh.hexahedra.rows(), "hexahedron", "hexahedra") + ", " + count(mesh.wedges.rows(), "wedge") +
                   ", " + count(mesh.pyramids.rows(), "pyramid") + box(mesh.vertices);
        });
    Record<CellDefect>(m, "CellDefect", "One thing wrong with a mesh of mixed cells.")
        .field("kind", &CellDefect::kind, "Stable word, for example \"mismatched_face\".")
        .field("cells", &CellDefect::cells, "int32 ids of all cells concerned, ascending.")
        .field("message", &CellDefect::message, "One sentence: what, where (the first few), and the remedy.")
        .finish([](const CellDefect& d) { return d.kind + ": " + d.message; });
    Record<CellBoundary>(m, "CellBoundary", "The faces of one cell only, of a mesh of mixed cells.")
        .field("mesh", &CellBoundary::mesh, "QuadMesh in compact numbering, faces outward.")
        .field("vertex_map", &CellBoundary::vertex_map, "(B,) int32: vertex of the mesh, ascending.")
        .field("cells", &CellBoundary::cells, "int32 per face: the cell behind it.")
        .finish([](const CellBoundary& b) {
            return count(b.mesh.triangles.rows(), "triangle") + ", " + count(b.mesh.quads.rows(), "quad");
        });
}

template <class Mesh, class Write>
void bind_write(py::module_& m, const char* name, Write write, const char* doc) {
    m.def(
        name,
        [write](const std::filesystem::path& path, const Mesh& mesh, const Metadata& metadata) {
            run_interruptible([write, path, mesh = mesh, metadata](Job&) {
                write(path, mesh, metadata);
                return true;
            });
        },
        "path"_a, "mesh"_a, "metadata"_a = Metadata{}, doc);
}

void bind_validity(py::module_& m) {
    m.def(
        "find_cell_defects",
        [](const MixedMesh& mesh) {
            return run_interruptible([mesh = mesh](Job&) { return find_cell_defects(mesh); });
        },
        "mesh"_a,
        "All that is wrong with a MixedMesh, as a list of CellDefect. Kinds: empty, index_out_of_range, "
        "non_finite_vertex, repeated_vertex, inverted_cell (a corner whose Jacobian is not above 0), crowded_face (of "
        "three cells), twisted_face (the same quad in another order), folded_cell (two cells on one side of a face), "
        "mismatched_face (a quad against triangles). An empty list: the mesh conforms.");
    m.def(
        "require_valid",
        [](const MixedMesh& mesh) {
            run_interruptible([mesh = mesh](Job&) {
                require_valid(mesh);
                return true;
            });
        },
        "mesh"_a);
    m.def(
        "require_valid",
        [](const QuadMesh& mesh, bool closed) {
            run_interruptible([mesh = mesh, closed](Job&) {
                require_valid(mesh, closed);
                return true;
            });
        },
        "mesh"_a, py::kw_only(), "closed"_a = true);
}

void bind_measures(py::module_& m) {
    m.def(
        "scaled_jacobians",
        [](const MixedMesh& mesh) {
            return own(run_interruptible([mesh = mesh](Job&) { return scaled_jacobians(mesh); }));
        },
        "mesh"_a,
        "The least scaled Jacobian of each cell of a MixedMesh or face of a QuadMesh, in the order of their numbers, "
        "as "
        "Verdict defines it (Knupp et al. 2006): 1 for the best shape of its kind, 0 and less where a corner is flat "
        "or "
        "inverted.");
    m.def(
        "scaled_jacobians",
        [](const QuadMesh& mesh) {
            return own(run_interruptible([mesh = mesh](Job&) { return scaled_jacobians(mesh); }));
        },
        "mesh"_a);
    m.def(
        "cell_volumes",
        [](const MixedMesh& mesh) {
            return own(run_interruptible([mesh = mesh](Job&) { return cell_volumes(mesh); }));
        },
        "mesh"_a, "Signed volume of each cell, cubed input unit: exact for faces that are bilinear.");
    m.def(
        "cell_boundary",
        [](const MixedMesh& mesh) { return run_interruptible([mesh = mesh](Job&) { return cell_boundary(mesh); }); },
        "mesh"_a,
        "The faces that belong to one cell only, as a CellBoundary; where faces do not match, both sides are there.");
    m.def(
        "split_quads",
        [](const QuadMesh& mesh) { return run_interruptible([mesh = mesh](Job&) { return split_quads(mesh); }); },
        "mesh"_a, "TriangleMesh of the triangles, then two for each quad, split along its shorter diagonal.");
}

}  // namespace

void bind_cells(py::module_& m) {
    bind_types(m);
    bind_validity(m);
    bind_measures(m);
    bind_write<MixedMesh>(m, "write_mixed_mesh", &write_mixed_mesh,
                          "Write a MixedMesh as .vtu with cell data scaled_jacobian; metadata: words written as field "
                          "data. octafield.write_cells writes other formats, too. Raises GeometryError for ids out of "
                          "range, IoError.");
    bind_write<QuadMesh>(m, "write_quad_mesh", &write_quad_mesh, "The same of a QuadMesh.");
}

}  // namespace octafield::bindings
