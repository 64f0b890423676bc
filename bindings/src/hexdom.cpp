// Hex-dominant meshes along frame fields, in one call or in parts.
#include <algorithm>

#include "bind.hpp"
#include "domain.hpp"
#include "interruptible.hpp"
#include "octafield/volume/cell_quality.hpp"
#include "octafield/volume/hex_dominant.hpp"
#include "octafield/volume/refine_tets.hpp"
#include "options.hpp"

namespace octafield::bindings {

using namespace volume;
using py::literals::operator""_a;
using surface::FeatureGraph;
using surface::TriangleMesh;

namespace {

// As many rows as the domain has tets and inner triangles, and ids in range.
void check_map(const PeriodicMap& map, const TetDomain& domain) {
    const auto rows = [](Eigen::Index given, Eigen::Index wanted, const char* name) {
        if (given != wanted)
            throw InvalidInput(std::string("map.") + name + ": " + std::to_string(given) + " rows, " +
                                   std::to_string(wanted) + " are needed; give what periodic_map made on this domain",
                               "wrong_shape");
    };
    const auto size = [](const auto& vector) { return static_cast<Eigen::Index>(vector.size()); };
    rows(map.frames.rows(), domain.tet_count(), "frames");
    rows(map.coordinates.rows(), domain.tet_count(), "coordinates");
    rows(size(map.usable), domain.tet_count(), "usable");
    const Eigen::Index faces = map.faces.tets.rows();
    rows(map.faces.triangles.rows(), faces, "faces.triangles");
    rows(size(map.faces.matching), faces, "faces.matching");
    rows(map.translation.rows(), faces, "translation");
    rows(size(map.joined), faces, "joined");
    const bool known =
        faces == 0 || (map.faces.tets.minCoeff() >= 0 && map.faces.tets.maxCoeff() < domain.tet_count() &&
                       map.faces.triangles.minCoeff() >= 0 && map.faces.triangles.maxCoeff() < domain.vertex_count() &&
                       std::all_of(map.faces.matching.begin(), map.faces.matching.end(), [](int o) { return o < 24; }));
    if (!known)
        throw InvalidInput("map.faces: ids out of range; give what periodic_map made on this domain",
                           "index_out_of_range");
}

VertexSupport support_of(const ArrayLike& given) {
    auto kinds = from_python<std::vector<std::uint8_t>>(given, "support");
    VertexSupport support;
    support.kind.reserve(kinds.size());
    for (std::size_t v = 0; v < kinds.size(); ++v) {
        if (kinds[v] > 3)
            throw InvalidInput("support: vertex " + std::to_string(v) + " has " + std::to_string(kinds[v]) +
                                   "; 0 is inside, 1 on the surface, 2 on a curve, 3 fixed",
                               "index_out_of_range", {static_cast<Index>(v)});
        support.kind.push_back(static_cast<VertexSupport::Kind>(kinds[v]));
    }
    return support;
}

void bind_whole(py::module_& m) {
    m.def(
        "hex_dominant",
        [](const DomainOrMesh& mesh, const ArrayLike& frames, const std::optional<ProgressCallable>& progress,
           const py::kwargs& given) {
            const auto [options] = options_of<HexDominantOptions>("hex_dominant", given);
            return run_interruptible(
                [mesh, options = options, rows = from_python<Quaternions>(frames, "frames")](Job& job) mutable {
                    const TetDomain domain = domain_of(mesh);
                    check_unit(rows, domain.vertex_count(), "frames");
                    return hex_dominant(domain, rows, options, job.progress());
                },
                progress);
        },
        "domain"_a, "frames"_a, py::kw_only(), "progress"_a = py::none(),
        "A hex-dominant mesh along (n, 4) frames at the vertices, as a HexDominantMesh: hexahedra of the lattice of a "
        "periodic_map, tets between them joined to hexahedra and wedges, pyramids where quads meet triangles. Faces "
        "all match, Jacobians are positive at all corners; surface, interfaces, features and corners are kept. "
        "Raises InvalidInput, GeometryError, SolverError, Cancelled.");
    list_options<HexDominantOptions>(m, "hex_dominant");
}

void bind_lattice(py::module_& m) {
    m.def(
        "refine_tets",
        [](const DomainOrMesh& mesh, const ArrayLike& marked) {
            RefinedDomain refined =
                run_interruptible([mesh, marks = from_python<std::vector<std::uint8_t>>(marked, "marked")](Job&) {
                    return refine_tets(domain_of(mesh), marks);
                });
            return std::tuple<TetDomain, py::array_t<Index>, py::array_t<Index>>(
                std::move(refined.domain), own(std::move(refined.parents)), own(std::move(refined.parent)));
        },
        "domain"_a, "marked"_a,
        "Tets marked with 1 in (m,) cut into eight (Bey 1995), and their neighbours so that they still meet, as three: "
        "the TetDomain, old vertices first; (n, 2) int32 the two old vertices that each vertex lies half-way between; "
        "(m,) int32 the old tet that each is part of. Raises InvalidInput.");
    m.def(
        "periodic_map",
        [](const DomainOrMesh& mesh, const ArrayLike& of_tets, const ArrayLike& lengths,
           const std::optional<ProgressCallable>& progress, const py::kwargs& given) {
            const auto [options] = options_of<PeriodicMapOptions>("periodic_map", given);
            return run_interruptible(
                [mesh, options = options, rows = from_python<Quaternions>(of_tets, "of_tets"),
                 wanted = from_python<Points>(lengths, "lengths")](Job& job) mutable {
                    const TetDomain domain = domain_of(mesh);
                    check_unit(rows, domain.tet_count(), "of_tets");
                    check_vectors(wanted, domain.tet_count(), "lengths", "tet");
                    return periodic_map(domain, rows, wanted, options, job.progress());
                },
                progress);
        },
        "domain"_a, "of_tets"_a, "lengths"_a, py::kw_only(), "progress"_a = py::none(),
        "Coordinates along the axes of (m, 4) frames in the tets whose integer points are the vertices of hexahedra "
        "(Ray, Sokolov, Lévy 2006), as a PeriodicMap. lengths: (m, 3) of a cell along each axis, input unit. Raises "
        "InvalidInput, Cancelled.");
    list_options<PeriodicMapOptions>(m, "periodic_map");
    m.def(
        "lattice_cells",
        [](const DomainOrMesh& mesh, const PeriodicMap& map, double min_scaled_jacobian, int threads) {
            threads_option(threads);
            finite(min_scaled_jacobian, "min_scaled_jacobian");
            return run_interruptible([=](Job&) {
                const TetDomain domain = domain_of(mesh);
                check_map(map, domain);
                return lattice_cells(domain, map, min_scaled_jacobian, threads);
            });
        },
        "domain"_a, "map"_a, py::kw_only(), "min_scaled_jacobian"_a = HexDominantOptions{}.min_scaled_jacobian,
        "threads"_a = 0,
        "Hexahedra of the integer lattice of a PeriodicMap on this domain, as LatticeCells. min_scaled_jacobian: of "
        "the hexahedra taken. Raises InvalidInput.");
}

void bind_cells_between(py::module_& m) {
    m.def(
        "recombine",
        [](const MixedMesh& mesh, const py::kwargs& given) {
            const auto [options] = options_of<RecombineOptions>("recombine", given);
            return run_interruptible([mesh = mesh, options = options](Job&) {
                RecombineReport report;
                MixedMesh joined = recombine(mesh, options, &report);
                return std::pair(std::move(joined), report);
            });
        },
        "mesh"_a,
        "Tets joined to hexahedra and wedges where that is possible (Pellerin, Johnen, Verhetsel, Remacle 2018), as a "
        "pair of MixedMesh and RecombineReport. Vertices and other cells stay. Quads may meet two triangles: conform "
        "mends that. Raises InvalidInput, GeometryError.");
    list_options<RecombineOptions>(m, "recombine");
    m.def(
        "conform",
        [](const MixedMesh& mesh) {
            return run_interruptible([mesh = mesh](Job&) {
                ConformReport report;
                MixedMesh made = conform(mesh, &report);
                return std::pair(std::move(made), report);
            });
        },
        "mesh"_a,
        "The same region with faces that all match: pyramids on quads that met triangles, as a pair of MixedMesh and "
        "ConformReport. New vertices come last. Raises GeometryError.");
    m.def(
        "proven_positive",
        [](const MixedMesh& mesh, int depth, int threads) {
            threads_option(threads);
            return own(run_interruptible(
                [mesh = mesh, depth, threads](Job&) { return proven_positive(mesh, depth, threads); }));
        },
        "mesh"_a, py::kw_only(), "depth"_a = 8, "threads"_a = 0,
        "(cells,) uint8, 1: the Jacobian is above 0 everywhere in the cell, proven (Johnen, Remacle, Geuzaine 2013); "
        "0: it is not, or nothing was proven within `depth` halvings. Raises GeometryError, InvalidInput.");
    m.def(
        "improve_cells",
        [](const MixedMesh& mesh, const ArrayLike& support, const TriangleMesh& surface, const FeatureGraph& features,
           const py::kwargs& given) {
            const auto [options] = options_of<ImproveOptions>("improve_cells", given);
            return run_interruptible([mesh = mesh, held = support_of(support), surface = surface, features = features,
                                      options = options](Job&) mutable {
                check(surface, false);
                check_edges(features.edges, surface, "features.edges");
                return improve_cells(std::move(mesh), held, surface, features, options);
            });
        },
        "mesh"_a, "support"_a, "surface"_a, "features"_a,
        "A MixedMesh with vertices moved for better cells: the lowest scaled Jacobians are raised, then the whole is "
        "smoothed; positive cells stay so. support: (n,) as in HexDominantMesh, 0 may go anywhere, 1 along the "
        "surface, 2 along the feature curve, 3 stays. Raises InvalidInput, GeometryError.");
    list_options<ImproveOptions>(m, "improve_cells");
}

}  // namespace

void bind_hexdom(py::module_& m) {
    bind_whole(m);
    bind_lattice(m);
    bind_cells_between(m);
}

}  // namespace octafield::bindings
