// Functions of volume/.
#include "octafield/volume/operators.hpp"

#include <pybind11/eigen.h>
#include <pybind11/stl/filesystem.h>

#include "arrays.hpp"
#include "bind.hpp"
#include "domain.hpp"
#include "interruptible.hpp"
#include "octafield/volume/boundary.hpp"
#include "octafield/volume/singularities.hpp"
#include "octafield/volume/tetrahedralize.hpp"
#include "octafield/volume/write_vtk.hpp"
#include "options.hpp"
#include "sampling.hpp"
#include "stretch.hpp"
#include "words.hpp"

namespace octafield::bindings {

using namespace volume;
using py::literals::operator""_a;
using surface::TriangleMesh;

namespace {

using NamedArrayLikes = std::map<std::string, ArrayLike>;

std::map<std::string, Rows<double, Eigen::Dynamic>> named_arrays(const NamedArrayLikes& given) {
    std::map<std::string, Rows<double, Eigen::Dynamic>> result;
    for (const auto& [name, value] : given) {
        const auto array = numbers<double>(value, name);
        if (array.ndim() != 1 && (array.ndim() != 2 || array.shape(1) < 1)) throw_shape(name, "(n,) or (n, k)", array);
        const py::ssize_t columns = array.ndim() == 1 ? 1 : array.shape(1);
        result[name] = Eigen::Map<const Rows<double, Eigen::Dynamic>>(array.data(), array.shape(0), columns);
    }
    return result;
}

// Binds f(domain) -> array or matrix; with Plain, f(mesh), which validates nothing.
template <bool Plain = false, class Function>
void def_of_domain(py::module_& m, const char* name, Function function, const char* doc) {
    const auto call = [function](const DomainOrMesh& where) {
        return run_interruptible([where = where, function](Job&) {
            if constexpr (Plain) {
                if (const auto* mesh = std::get_if<TetMesh>(&where)) {
                    check(*mesh, false);
                    return function(*mesh);
                }
                return function(std::get<TetDomain>(where).mesh());
            } else {
                return function(domain_of(where));
            }
        });
    };
    if constexpr (std::is_same_v<decltype(call(std::declval<const DomainOrMesh&>())), Eigen::VectorXd>)
        m.def(
            name, [call](const DomainOrMesh& where) { return own(call(where)); }, "domain"_a, doc);
    else
        m.def(name, call, "domain"_a, doc);
}

void bind_tet_meshes(py::module_& m) {
    const TetrahedralizeOptions defaults;
    m.def(
        "tetrahedralize",
        [](const TriangleMesh& mesh, double radius_edge_ratio, double min_dihedral, double edge_length,
           std::optional<py::list> notes, const std::optional<ProgressCallable>& progress) {
            const TetrahedralizeOptions options{.radius_edge_ratio = finite(radius_edge_ratio, "radius_edge_ratio"),
                                                .min_dihedral = finite(min_dihedral, "min_dihedral"),
                                                .edge_length = finite(edge_length, "edge_length")};
            auto [tets, said] = run_interruptible(
                [mesh = mesh, options](Job& job) {
                    check(mesh);
                    std::vector<std::string> said;
                    TetMesh tets = tetrahedralize(mesh, options, job.progress(), &said);
                    return std::pair(std::move(tets), std::move(said));
                },
                progress);
            if (notes)
                for (const std::string& note : said) notes->append(note);
            return tets;
        },
        "mesh"_a, py::kw_only(), "radius_edge_ratio"_a = defaults.radius_edge_ratio,
        "min_dihedral"_a = defaults.min_dihedral, "edge_length"_a = defaults.edge_length, "notes"_a = py::none(),
        "progress"_a = py::none(),
        "Tetrahedra inside a valid closed surface by TetGen (Si 2015), as a TetMesh whose first vertices are the "
        "surface's and whose boundary "
        "is exactly its triangles. radius_edge_ratio: bound on circumradius over shortest edge, at least 1; "
        "min_dihedral: radians, 0 "
        "means TetGen's default; edge_length: interior target, input unit, 0 means the surface's mean. Raises "
        "GeometryError where TetGen fails in several ways (kind tetgen_failed); where one of the later ways helped, a "
        "sentence on it is appended to notes, a list.");
    m.def(
        "require_valid",
        [](const TetMesh& mesh) {
            run_interruptible([mesh = mesh](Job&) {
                require_valid(mesh);
                return true;
            });
        },
        "mesh"_a);
    def_of_domain<true>(m, "tet_volumes", tet_volumes, "(m,) signed volumes of the tets, cubed input unit.");
    def_of_domain<true>(m, "boundary_surface", boundary_surface,
                        "The triangles that belong to one tet only, as a BoundarySurface. Raises GeometryError (kind "
                        "\"non_manifold_face\") where "
                        "three tets share a triangle.");
}

void bind_operators(py::module_& m) {
    def_of_domain(
        m, "stiffness", stiffness,
        "(n, n) scipy.sparse matrix of int grad phi_i . grad phi_j over P1 elements; symmetric, rows sum to 0.");
    def_of_domain(m, "mass", mass, "(n, n) scipy.sparse matrix of int phi_i phi_j over P1 elements.");
    def_of_domain(m, "lumped_mass", lumped_mass, "(n,): a quarter of the volume of the tets at each vertex.");
    m.def(
        "dirichlet_energy",
        [](const MeshOrSampling& mesh, const ArrayLike& frames, int threads) {
            threads_option(threads);
            return run_interruptible(
                [mesh = mesh, threads, rows = from_python<Quaternions>(frames, "frames")](Job&) mutable {
                    if (const auto* sampling = std::get_if<std::shared_ptr<Sampling>>(&mesh)) {
                        check_unit(rows, (*sampling)->count(), "frames");
                        return dirichlet_energy(**sampling, rows, threads);
                    }
                    const TetDomain domain = domain_of(mesh);
                    check_unit(rows, domain.vertex_count(), "frames");
                    return dirichlet_energy(domain, rows, threads);
                });
        },
        "domain"_a, "frames"_a, py::kw_only(), "threads"_a = 0,
        "E = 1/2 sum_c a_c^T L a_c of (n, 4) frames, a their sh4 vectors and L the stiffness matrix, in the input's "
        "length unit; times "
        "unit_speed_factor for frames moving at unit speed. domain: a TetDomain, a TetMesh or a Sampling. The same "
        "bits at any thread "
        "count.");
}

void bind_tet_boundary(py::module_& m) {
    def_of_domain(m, "sector_normals", sector_normals,
                  "One unit normal per vertex of the domain's surface and smooth sector, the triangles round it "
                  "between feature edges, weighted by area, as SectorNormals.");

    m.def(
        "boundary_constraints",
        [](const DomainOrMesh& mesh, const ArrayLike& directions, const std::optional<ArrayLike>& stretch,
           const py::kwargs& given) {
            const auto [options] = options_of<BoundaryOptions>("boundary_constraints", given);
            return run_interruptible([mesh, options = options, rows = from_python<Points>(directions, "directions"),
                                      stretches = stretches_of(stretch)](Job&) {
                const TetDomain domain = domain_of(mesh);
                check_vectors(rows, domain.surface().mesh.vertices.rows(), "directions");
                return stretches ? boundary_constraints(domain, rows, *stretches, options)
                                 : boundary_constraints(domain, rows, options);
            });
        },
        "domain"_a, "directions"_a, py::kw_only(), "stretch"_a = py::none(),
        "Frames and constraints on the surface of a TetDomain, as BoundaryConstraints with one row per vertex of its "
        "mesh. directions: (B, 3) unit tangents at the surface's vertices (vertex_directions). mode: \"aligned\" (one "
        "axis on the normal, twist free), \"fixed\" (whole frame) or \"none\"; feature_tolerance (radians): how well "
        "one frame must fit a feature vertex to be kept whole. stretch: (n, 6) as AxesStretch has it, for the "
        "rotations of "
        "frames whose axes are not at right angles.");
    list_options<BoundaryOptions>(m, "boundary_constraints");
    m.def(
        "alignment_angles",
        [](const DomainOrMesh& mesh, const ArrayLike& frames, const std::optional<ArrayLike>& stretch) {
            return own(run_interruptible([=, rows = from_python<Quaternions>(frames, "frames"),
                                          stretches = stretches_of(stretch)](Job&) mutable {
                const TetDomain domain = domain_of(mesh);
                check_unit(rows, domain.vertex_count(), "frames");
                return stretches ? alignment_angles(domain, rows, *stretches) : alignment_angles(domain, rows);
            }));
        },
        "domain"_a, "frames"_a, py::kw_only(), "stretch"_a = py::none(),
        "(k,) angles (radians) between each sector normal and the nearest axis of its vertex's frame, in the order of "
        "sector_normals. frames: (n, 4), one per vertex of the mesh. stretch: (n, 6) as AxesStretch has it; of axes "
        "that are not at right angles, to the normal of the nearest pair of them.");
}

void bind_analysis(py::module_& m) {
    m.def(
        "singular_graph",
        [](const DomainOrMesh& mesh, const ArrayLike& frames, int threads) {
            threads_option(threads);
            return run_interruptible(
                [mesh = mesh, threads, rows = from_python<Quaternions>(frames, "frames")](Job&) mutable {
                    const TetDomain domain = domain_of(mesh);
                    check_unit(rows, domain.vertex_count(), "frames");
                    return singular_graph(domain, rows, threads);
                });
        },
        "domain"_a, "frames"_a, py::kw_only(), "threads"_a = 0,
        "Singular curves of (n, 4) frames at the vertices, from the holonomy round every triangle, as a SingularGraph. "
        "The same result at any "
        "thread count.");
}

void bind_tet_files(py::module_& m) {
    m.def(
        "write_field",
        [](const std::filesystem::path& path, const DomainOrMesh& mesh, const ArrayLike& frames,
           const Metadata& metadata, const ArrayLike& tet_frames, const ArrayLike& lengths,
           const ArrayLike& tet_lengths, const NamedArrayLikes& point_data, const NamedArrayLikes& cell_data,
           const ArrayLike& features, const std::optional<ArrayLike>& stretch) {
            run_interruptible(
                [path, mesh = mesh, metadata, rows = from_python<Quaternions>(frames, "frames"),
                 more = FieldArrays{
                     from_python<Quaternions>(tet_frames, "tet_frames"), from_python<Points>(lengths, "lengths"),
                     from_python<Points>(tet_lengths, "tet_lengths"), stretch_rows(stretch), named_arrays(point_data),
                     named_arrays(cell_data), from_python<Edges>(features, "features")}](Job&) mutable {
                    const TetDomain domain = domain_of(mesh);
                    check_unit(rows, domain.vertex_count(), "frames");
                    if (more.tet_frames.rows() > 0) check_unit(more.tet_frames, domain.tet_count(), "tet_frames");
                    if (more.lengths.rows() > 0) check_vectors(more.lengths, domain.vertex_count(), "lengths");
                    if (more.tet_lengths.rows() > 0)
                        check_vectors(more.tet_lengths, domain.tet_count(), "tet_lengths", "tet");
                    write_field(path, domain, rows, metadata, more);
                    return true;
                });
        },
        "path"_a, "domain"_a, "frames"_a, "metadata"_a = Metadata{}, py::kw_only(), "tet_frames"_a = py::tuple(),
        "lengths"_a = py::tuple(), "tet_lengths"_a = py::tuple(), "point_data"_a = NamedArrayLikes{},
        "cell_data"_a = NamedArrayLikes{}, "features"_a = py::tuple(), "stretch"_a = py::none(),
        "Write a .vtu file with point data frame_u, frame_v, frame_w (unit axes), quaternion (w x y z), sh4 (9) and "
        "boundary (0/1). frames: (n, 4); "
        "metadata: words written as field data; the domain's regions are cell data region; "
        "tet_frames: (m, 4) frames written as cell data under the same names, or none; lengths: (n, 3) point data "
        "frame_lengths, or none, and tet_lengths: (m, 3) cell data; point_data, cell_data: other arrays by name, (n,) "
        "or "
        "(n, k), a row per vertex or tet; features: (k, 2) feature edges, written as field data feature_edges; "
        "stretch: "
        "(n, 6) as AxesStretch has it: frame_u, frame_v, frame_w are unit vectors along the axes S Q then, "
        "frame_lengths "
        "their lengths, and stretch and rotation (Q) take the place of quaternion and sh4. Raises IoError.");
    m.def(
        "write_singular_graph",
        [](const std::filesystem::path& path, const SingularGraph& graph, const Metadata& metadata,
           const std::optional<Meshability>& meshability) {
            run_interruptible([=](Job&) {
                check(graph);
                write_singular_graph(path, graph, metadata, meshability ? &*meshability : nullptr);
                return true;
            });
        },
        "path"_a, "graph"_a, "metadata"_a = Metadata{}, "meshability"_a = py::none(),
        "Write a .vtp file of the singular curves with cell data quarter_turns, index and curve, and point data node; "
        "with meshability also meshable (1 or 0 where curves end, -1 elsewhere) and junction. Raises IoError.");
    m.def(
        "write_surface_field",
        [](const std::filesystem::path& path, const TriangleMesh& mesh, const ArrayLike& directions,
           const Metadata& metadata) {
            run_interruptible(
                [path, mesh = mesh, metadata, rows = from_python<Points>(directions, "directions")](Job&) {
                    check(mesh, false);
                    check_vectors(rows, mesh.vertices.rows(), "directions");
                    write_surface_field(path, mesh, rows, metadata);
                    return true;
                });
        },
        "path"_a, "mesh"_a, "directions"_a, "metadata"_a = Metadata{},
        "Write a .vtp file of the triangles with (V, 3) directions as point data direction. Raises IoError.");
}

}  // namespace

void bind_volume(py::module_& m) {
    bind_tet_meshes(m);
    bind_operators(m);
    bind_tet_boundary(m);
    bind_analysis(m);
    bind_tet_files(m);
}

}  // namespace octafield::bindings
