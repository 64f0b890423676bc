// Fields that live elsewhere than at the vertices of a tet mesh.
#include "sampling.hpp"

#include <pybind11/eigen.h>

#include "arrays.hpp"
#include "bind.hpp"
#include "interruptible.hpp"
#include "options.hpp"
#include "octafield/volume/boundary.hpp"
#include "octafield/volume/tet_singularities.hpp"
#include "record.hpp"

namespace octafield::bindings {

using namespace volume;
using py::literals::operator""_a;

namespace {

std::shared_ptr<Sampling> made(const DomainOrMesh& mesh, Sampling (*make)(const TetDomain&)) {
    return std::make_shared<Sampling>(run_interruptible([mesh = mesh, make](Job&) { return make(domain_of(mesh)); }));
}

// Checked here, for functions trust what a Sampling says.
std::shared_ptr<Sampling> from_matrix(SparseMatrix stiffness, const ArrayLike& mass, double body_radius,
                                      double edge_length, double size, const std::string& sites) {
    const auto refuse = [](const std::string& message, const char* kind) { throw InvalidInput(message, kind); };
    Sampling made;
    made.sites = from_word<Sites>(sites, "sites");
    made.stiffness = std::move(stiffness);
    made.mass = from_python<Eigen::VectorXd>(mass, "mass");
    made.body_radius = finite(body_radius, "body_radius");
    made.edge_length = finite(edge_length, "edge_length");
    made.size = finite(size, "size");
    SparseMatrix& matrix = made.stiffness;
    const Eigen::Index n = made.mass.size();
    matrix.makeCompressed();
    if (n == 0 || matrix.rows() != n || matrix.cols() != n)
        refuse("stiffness: expected a matrix of shape (n, n) for the n > 0 entries of mass", "wrong_shape");
    if (!(made.body_radius > 0 && made.edge_length > 0 && made.size > 0))
        refuse("body_radius, edge_length and size must be positive", "bad_option");
    if (!made.mass.allFinite() || !(made.mass.array() >= 0).all() || !(made.mass.sum() > 0))
        refuse("mass: entries must be finite, not negative, and not all 0", "bad_mass");
    const Eigen::Map<const Eigen::ArrayXd> entries(matrix.valuePtr(), matrix.nonZeros());
    if (!entries.allFinite()) refuse("stiffness: an entry is not finite", "non_finite");
    const double largest = entries.size() ? entries.abs().maxCoeff() : 0;
    const SparseMatrix skew = matrix - SparseMatrix(matrix.transpose());
    if (skew.nonZeros() && skew.coeffs().abs().maxCoeff() > 1e-12 * largest)
        refuse("stiffness: the matrix is not symmetric", "not_symmetric");
    if ((matrix * Eigen::VectorXd::Ones(n)).cwiseAbs().maxCoeff() > 1e-9 * largest)
        refuse("stiffness: rows must sum to 0, so that constant fields have no energy", "rows_sum");
    for (Eigen::Index column = 0; column < n; ++column)
        for (SparseMatrix::InnerIterator entry(matrix, column); entry; ++entry)
            if (entry.row() != entry.col() && entry.value() > 0)
                throw InvalidInput("stiffness: entry (" + std::to_string(entry.row()) + ", " + std::to_string(column) +
                                       ") off the diagonal is positive; couplings of sites are minus what they weigh",
                                   "positive_entry", {static_cast<Index>(entry.row()), static_cast<Index>(column)});
    return std::make_shared<Sampling>(std::move(made));
}

// A sampling of linear elements is made again from its mesh, with the same bits.
py::tuple reduced(const py::object& self) {
    const auto sampling = self.cast<std::shared_ptr<Sampling>>();
    if (sampling->elements)
        return py::make_tuple(py::module_::import("octafield._core").attr("vertex_sampling"),
                              py::make_tuple(TetMesh(*sampling->elements)));
    return py::make_tuple(py::type::of(self), py::make_tuple(sampling->stiffness, own(Eigen::VectorXd(sampling->mass)),
                                                             sampling->body_radius, sampling->edge_length,
                                                             sampling->size, to_word(sampling->sites)));
}

void bind_samplings(py::module_& m) {
    m.def(
        "vertex_sampling", [](const DomainOrMesh& mesh) { return made(mesh, vertex_sampling); }, "domain"_a,
        "One frame per vertex, linear elements: the Sampling that functions take a TetDomain or TetMesh for.");
    m.def(
        "tet_sampling", [](const DomainOrMesh& mesh) { return made(mesh, tet_sampling); }, "domain"_a,
        "One frame per tet, coupled across triangles by their area over the distance between the tets' centroids, as "
        "a Sampling. Energies of such two-point fluxes do not tend to those at the vertices (docs/tet_meshes.md).");
    m.def(
        "vertex_frames",
        [](const DomainOrMesh& mesh, const ArrayLike& of_tets, int threads) {
            threads_option(threads);
            return own(run_interruptible(
                [mesh = mesh, threads, rows = from_python<Quaternions>(of_tets, "of_tets")](Job&) mutable {
                    const TetDomain domain = domain_of(mesh);
                    check_unit(rows, domain.tet_count(), "of_tets");
                    return vertex_frames(domain, rows, threads);
                }));
        },
        "domain"_a, "of_tets"_a, py::kw_only(), "threads"_a = 0,
        "(n, 4) quaternions w x y z: the frame nearest to the mean sh4 vector, weighted by volume, of the tets round "
        "each vertex. of_tets: (m, 4). tet_frames goes the other way.");
}

void bind_sampled_boundary(py::module_& m) {
    m.def(
        "tet_boundary_constraints",
        [](const DomainOrMesh& mesh, const ArrayLike& directions, const py::kwargs& given) {
            const auto [options] = options_of<BoundaryOptions>("tet_boundary_constraints", given);
            return run_interruptible(
                [mesh, options = options, rows = from_python<Points>(directions, "directions")](Job&) mutable {
                    const TetDomain domain = domain_of(mesh);
                    check_vectors(rows, domain.surface().mesh.triangles.rows(), "directions", "triangle");
                    return tet_boundary_constraints(domain, rows, options);
                });
        },
        "domain"_a, "directions"_a,
        "Constraints of frames in the tets, as BoundaryConstraints with one row per tet. A tet with one triangle of "
        "the surface has an axis on its normal; with several, on their mean normal where feature_tolerance (radians) "
        "allows, else a whole frame that fits them so well, else it is released and listed. directions: (F, 3) "
        "tangents in its triangles (triangle_directions). mode: as of boundary_constraints.");
    list_options<BoundaryOptions>(m, "tet_boundary_constraints");
    m.def(
        "tet_alignment_angles",
        [](const DomainOrMesh& mesh, const ArrayLike& frames) {
            return own(run_interruptible([=, rows = from_python<Quaternions>(frames, "frames")](Job&) mutable {
                const TetDomain domain = domain_of(mesh);
                check_unit(rows, domain.tet_count(), "frames");
                return tet_alignment_angles(domain, rows);
            }));
        },
        "domain"_a, "frames"_a,
        "Angles (radians) between the normal of each triangle of the surface and the nearest axis of the frame in the "
        "tet behind it, then of an interface's tet ahead of it. frames: (m, 4), one per tet.");
    m.def(
        "singular_edges",
        [](const DomainOrMesh& mesh, const ArrayLike& of_tets, int threads) {
            threads_option(threads);
            return run_interruptible(
                [mesh = mesh, threads, rows = from_python<Quaternions>(of_tets, "of_tets")](Job&) mutable {
                    const TetDomain domain = domain_of(mesh);
                    check_unit(rows, domain.tet_count(), "of_tets");
                    return singular_edges(domain, rows, threads);
                });
        },
        "domain"_a, "of_tets"_a, py::kw_only(), "threads"_a = 0,
        "Singular curves of (m, 4) frames in the tets, from the holonomy round every edge inside, lifted to the binary "
        "octahedral group, as SingularEdges. The same result at any thread count.");
}

}  // namespace

void bind_sampling_types(py::module_& m) {
    py::class_<Sampling, std::shared_ptr<Sampling>>(
        m, "Sampling",
        "Where the frames of a field live and how they are coupled; made by vertex_sampling and tet_sampling, or from "
        "a matrix of your own.")
        .def(py::init(&from_matrix), "stiffness"_a, "mass"_a, "body_radius"_a, "edge_length"_a, "size"_a,
             "sites"_a = "vertices",
             "stiffness: (n, n) scipy.sparse matrix (any format), symmetric, rows sum to 0, entries off the diagonal "
             "not positive; mass: (n,) not negative, cubed input unit; body_radius, edge_length, size: see the "
             "fields; sites: \"vertices\" or \"tets\". Raises InvalidInput.")
        .def_property_readonly(
            "sites", [](const Sampling& s) { return to_word(s.sites); }, "\"vertices\" or \"tets\".")
        .def_property_readonly(
            "stiffness", [](const Sampling& s) { return s.stiffness; },
            "(n, n) scipy.sparse matrix L (a copy): E = 1/2 sum_c a_c^T L a_c; symmetric, rows sum to 0.")
        .def_property_readonly(
            "mass", [](const Sampling& s) { return own(Eigen::VectorXd(s.mass)); },
            "(n,) float64 lumped mass (a copy), cubed input unit.")
        .def_property_readonly(
            "body_radius", [](const Sampling& s) { return s.body_radius; },
            "3 volume / boundary area, input unit: the unit of diffuse's first_time.")
        .def_property_readonly(
            "edge_length", [](const Sampling& s) { return s.edge_length; },
            "Mean edge of the boundary, input unit: the unit of diffuse's last_time.")
        .def_property_readonly(
            "size", [](const Sampling& s) { return s.size; },
            "Of the mesh's bounding box, input unit: the unit that solvers scale by.")
        .def("__reduce__", &reduced)
        .def("__len__", &Sampling::count)
        .def("__repr__", [](const Sampling& s) {
            const std::string sites =
                s.sites == Sites::tets ? count(s.count(), "tet") : count(s.count(), "vertex", "vertices");
            return "Sampling(" + sites + ", " + count(s.stiffness.nonZeros(), "entry", "entries") + ", volume " +
                   number(s.mass.sum()) + ")";
        });

    Record<SingularEdge>(m, "SingularEdge",
                         "An edge inside the mesh round which the matchings of frames in the tets do not multiply to "
                         "the identity.")
        .field("a", &SingularEdge::a, "Tet-mesh vertex id, a < b.")
        .field("b", &SingularEdge::b, "Tet-mesh vertex id.")
        .field("holonomy", &SingularEdge::holonomy,
               "Element number of the octahedral group, in the frame of the lowest tet at the edge.")
        .field("quarter_turns", &SingularEdge::quarter_turns,
               "Quarter turns about the curve, modulo 8: +1 valence 3, -1 valence 5, +2 valence 2, -2 valence 6, -3 valence 7, "
               "-4 valence 8, +3 valence 1, 0 complex (in no hex mesh).")
        .field("valence", &SingularEdge::valence,
               "Hexahedra round the edge, by the turn about the edge itself; -1: complex, or about an axis at right angles "
               "to it.")
        .field("undecided", &SingularEdge::undecided,
               "Whether chance decides: two matchings are equally near, or the axis is at right angles to the curve.")
        .finish([](const SingularEdge& e) {
            return std::to_string(e.a) + ", " + std::to_string(e.b) + ", " + count(e.quarter_turns, "quarter turn");
        });

    Record<SingularEdges>(m, "SingularEdges", "Singular edges of a frame field that lives in the tets.")
        .field("edges", &SingularEdges::edges, "List of SingularEdge in the order of (a, b).")
        .field("complex_edges", &SingularEdges::complex_edges, "Number of edges with a complex singularity.")
        .field("undecided_edges", &SingularEdges::undecided_edges, "Number of edges that are undecided.")
        .field("tied_triangles", &SingularEdges::tied_triangles,
               "Triangles between two tets across which two matchings are equally near.")
        .field(
            "graph", &SingularEdges::graph,
            "SingularGraph of their curves: no triangles, points at vertices, nodes where other than two meet inside.")
        .field("vertices", &SingularEdges::vertices, "(p,) int32 tet-mesh vertex of each point of the graph.")
        .finish([](const SingularEdges& s) {
            return count(static_cast<std::ptrdiff_t>(s.edges.size()), "edge") + ", " + std::to_string(s.complex_edges) +
                   " complex";
        });
}

void bind_sampling(py::module_& m) {
    bind_samplings(m);
    bind_sampled_boundary(m);
}

}  // namespace octafield::bindings
