// What is done to a tet mesh before a field is computed on it: regions, locking tets, constraints of the user's own.
#include "arrays.hpp"
#include "bind.hpp"
#include "constraint_kinds.hpp"
#include "domain.hpp"
#include "interruptible.hpp"
#include "octafield/volume/locking.hpp"
#include "octafield/volume/singular_split.hpp"
#include "octafield/volume/vertex_constraints.hpp"
#include "record.hpp"

namespace octafield::bindings {

using namespace volume;
using py::literals::operator""_a;
using surface::TriangleMesh;

void bind_volume_input_types(py::module_& m) {
    Record<Sheets>(m, "Sheets", "A surface cut open along the edges that do not have exactly two triangles.")
        .field("mesh", &Sheets::mesh, "TriangleMesh: manifold sheets with rims, triangles in the surface's order.")
        .field("vertex_map", &Sheets::vertex_map, "(n,) int32: vertex of the surface that each is a copy of.")
        .field("cuts", &Sheets::cuts, "(c, 2) int32: edges of the surface with three triangles or more.")
        .finish([](const Sheets& s) {
            return count(s.mesh.vertices.rows(), "vertex", "vertices") + ", " +
                   count(s.mesh.triangles.rows(), "triangle") + ", " + count(s.cuts.rows(), "cut edge");
        });

    Record<LockingElements>(m, "LockingElements",
                            "Tets, edges and triangles inside a mesh whose vertices are all on its surface.")
        .field("tets", &LockingElements::tets, "int32 ids of tets with all four vertices on the surface.")
        .field("edges", &LockingElements::edges, "(e, 2) int32: both ends on the surface, but not its edges.")
        .field("triangles", &LockingElements::triangles,
               "(t, 3) int32: all edges on the surface, but not its triangles.")
        .finish([](const LockingElements& l) {
            return count(static_cast<std::ptrdiff_t>(l.tets.size()), "tet") + ", " + count(l.edges.rows(), "edge") +
                   ", " + count(l.triangles.rows(), "triangle");
        });

    Record<LockingSplit>(m, "LockingSplit", "A tet mesh whose locking tets were split, and how.")
        .field("mesh", &LockingSplit::mesh, "TetMesh, old vertices first, with their ids.")
        .field("parent", &LockingSplit::parent, "(m,) int32: old tet that each tet is part of.")
        .field("found", &LockingSplit::found, "LockingElements of the old mesh.")
        .field("added_vertices", &LockingSplit::added_vertices, "Number of new vertices.")
        .field("left", &LockingSplit::left, "int32 ids of tets that are too flat to split.")
        .finish([](const LockingSplit& s) {
            return count(s.mesh.tets.rows(), "tet") + ", " + count(s.added_vertices, "new vertex", "new vertices") +
                   ", " + count(static_cast<std::ptrdiff_t>(s.left.size()), "tet") + " left";
        });

    Record<SingularSplit>(m, "SingularSplit",
                          "A tet mesh whose edges between singular vertices were split, and how.")
        .field("mesh", &SingularSplit::mesh, "TetMesh, old vertices first, with their ids.")
        .field("parent", &SingularSplit::parent, "(m,) int32: old tet that each tet is part of, whose frame it keeps.")
        .field("edges", &SingularSplit::edges, "(e, 2) int32 edges of the old mesh that were to be split.")
        .field("left", &SingularSplit::left, "(l, 2) int32 edges of these that are still there: the tets are too flat.")
        .field("added_vertices", &SingularSplit::added_vertices, "Number of new vertices.")
        .finish([](const SingularSplit& s) {
            return count(s.mesh.tets.rows(), "tet") + ", " + count(s.added_vertices, "new vertex", "new vertices") +
                   ", " + count(s.left.rows(), "edge") + " left";
        });

    Record<VertexConstraints>(m, "VertexConstraints",
                              "Constraints of the user's own; row i of each array belongs to vertices[i].")
        .field("vertices", &VertexConstraints::vertices, "(k,) int32 tet-mesh ids, each once.")
        .field("kinds", &VertexConstraints::kinds, ("(k,) uint8: " + described_kinds() + "; can be given by name.").c_str())
        .field("axes", &VertexConstraints::axes, "(k, 3) float64, of any length, where the kind takes an axis; or no rows.")
        .field("frames", &VertexConstraints::frames,
               "(k, 4) float64 quaternions w x y z where the kind takes a frame; or no rows.")
        .finish([](const VertexConstraints& c) {
            return count(static_cast<std::ptrdiff_t>(c.vertices.size()), "vertex", "vertices") + ": " +
                   count_kinds(c.kinds);
        });
}

void bind_volume_input(py::module_& m) {
    m.def(
        "cut_into_sheets",
        [](const TriangleMesh& surface) {
            return run_interruptible([surface = surface](Job&) {
                check(surface, false);
                return cut_into_sheets(surface);
            });
        },
        "surface"_a,
        "The surface cut open along the edges that do not have exactly two triangles, as Sheets: what direction_field "
        "can work on where interfaces meet the boundary or each other.");
    m.def(
        "find_locking",
        [](const DomainOrMesh& mesh) {
            return run_interruptible([mesh = mesh](Job&) {
                const TetDomain domain = domain_of(mesh);
                return find_locking(domain);
            });
        },
        "domain"_a,
        "Tets, edges and triangles inside the mesh that join its surface to itself, as LockingElements.");
    m.def(
        "split_locking",
        [](const DomainOrMesh& mesh) {
            return run_interruptible([mesh = mesh](Job&) {
                const TetDomain domain = domain_of(mesh);
                return split_locking(domain);
            });
        },
        "domain"_a,
        "Splits those edges at their midpoints, triangles and tets at their centres, as a LockingSplit. The surface "
        "keeps its vertices and triangles; every tet of the result has a vertex inside, but for those too flat.");
    m.def(
        "split_between_singular",
        [](const DomainOrMesh& mesh, const ArrayLike& of_tets, int threads) {
            threads_option(threads);
            return run_interruptible(
                [mesh = mesh, threads, rows = from_python<Quaternions>(of_tets, "of_tets")](Job&) mutable {
                    const TetDomain domain = domain_of(mesh);
                    check_unit(rows, domain.tet_count(), "of_tets");
                    return split_between_singular(domain, rows, threads);
                });
        },
        "domain"_a, "of_tets"_a, py::kw_only(), "threads"_a = 0,
        "Splits edges inside that join two vertices of singular edges without being singular, at their midpoints, as a "
        "SingularSplit; of_tets[split.parent] are the frames of its tets. Singular edges and surface stay as they are.");
    py::list kinds;
    for (const ConstraintKindInfo& kind : ConstraintKinds::info) kinds.append(std::string(kind.name));
    m.attr("constraint_kinds") = py::tuple(kinds);
    m.def(
        "with_constraints",
        [](const BoundaryConstraints& base, const VertexConstraints& given) {
            return run_interruptible([base = base, given = given](Job&) mutable {
                check(base, static_cast<Index>(base.kind.size()));
                check(given);
                return with_constraints(base, given);
            });
        },
        "base"_a, "given"_a,
        "BoundaryConstraints with the given VertexConstraints in place of their own at these vertices, inside or on "
        "the boundary. Raises InvalidInput naming vertices.");
}

}  // namespace octafield::bindings
