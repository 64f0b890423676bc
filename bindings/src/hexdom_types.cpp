// Structs of hex-dominant meshes as Python classes.
#include <algorithm>

#include "bind.hpp"
#include "octafield/volume/cell_quality.hpp"
#include "octafield/volume/hex_dominant.hpp"
#include "options.hpp"

namespace octafield::bindings {

using namespace volume;

void check(const PeriodicMapOptions& options) {
    finite(options.hold_angle, "hold_angle");
    threads_option(options.threads);
}

void check(const RecombineOptions& options) {
    finite(options.min_scaled_jacobian, "min_scaled_jacobian");
    finite(options.max_boundary_fold, "max_boundary_fold");
    threads_option(options.threads);
}

void check(const ImproveOptions& options) {
    finite(options.good, "good");
    finite(options.tolerance, "tolerance");
    threads_option(options.threads);
}

void check(const HexDominantOptions& options) {
    finite(options.edge_length, "edge_length");
    finite(options.min_scaled_jacobian, "min_scaled_jacobian");
    finite(options.hold_angle, "hold_angle");
    threads_option(options.threads);
}

namespace {

void bind_hexdom_options(py::module_& m) {
    Record<PeriodicMapOptions>(m, "PeriodicMapOptions",
                               "Options of periodic_map: its keyword arguments, with their defaults.")
        .field("hold_angle", &PeriodicMapOptions::hold_angle,
               "Radians: triangles of the surface and feature edges are held on integers where an axis is so near.")
        .field("rounds", &PeriodicMapOptions::rounds, "Of diffusion and normalization, from far to near.")
        .field("threads", &PeriodicMapOptions::threads, "0: all; the result does not depend on it.")
        .finish([](const PeriodicMapOptions& o) { return "hold_angle=" + number(o.hold_angle); });
    Record<RecombineOptions>(m, "RecombineOptions", "Options of recombine: its keyword arguments, with their defaults.")
        .field("min_scaled_jacobian", &RecombineOptions::min_scaled_jacobian,
               "Of a hexahedron or wedge that is made, in (0, 1).")
        .field("wedges", &RecombineOptions::wedges, "Whether wedges are made of the tets that hexahedra left.")
        .field("max_boundary_fold", &RecombineOptions::max_boundary_fold,
               "Radians: turn between two triangles of the boundary that become a quad.")
        .field("kept_edges", &RecombineOptions::kept_edges,
               "(k, 2) int32 edges of the boundary whose two triangles no quad replaces (feature curves).")
        .field("walls", &RecombineOptions::walls,
               "(w, 3) int32 triangles, as between regions, through which no cell reaches; two may become one quad.")
        .field("threads", &RecombineOptions::threads, "0: all; the result does not depend on it.")
        .finish([](const RecombineOptions& o) { return "min_scaled_jacobian=" + number(o.min_scaled_jacobian); });
    Record<ImproveOptions>(m, "ImproveOptions", "Options of improve_cells: its keyword arguments, with their defaults.")
        .field("sweeps", &ImproveOptions::sweeps, "At most.")
        .field("good", &ImproveOptions::good,
               "Scaled Jacobians below are raised first, and smoothing lets none fall below.")
        .field("tolerance", &ImproveOptions::tolerance, "How far surface vertices may leave the surface, input unit.")
        .field("fit_surface", &ImproveOptions::fit_surface,
               "Moves surface vertices within the tolerance so that the faces between them fit the surface.")
        .field("hexahedra_first", &ImproveOptions::hexahedra_first,
               "Other cells count less, so that hexahedra keep their shape where they meet them.")
        .field("threads", &ImproveOptions::threads, "0: all; the result does not depend on it.")
        .finish([](const ImproveOptions& o) { return "sweeps=" + std::to_string(o.sweeps); });
    Record<HexDominantOptions>(m, "HexDominantOptions",
                               "Options of hex_dominant: its keyword arguments, with their defaults.")
        .field("edge_length", &HexDominantOptions::edge_length,
               "Wanted of the cells, input unit; 0: the mean edge of the surface.")
        .field("sizes", &HexDominantOptions::sizes, "(n,) wanted at the vertices, in its place, or none.")
        .field("correction", &HexDominantOptions::correction,
               "How sizes give way to the turning of the field, within a factor of two: \"none\", \"isotropic\" (all "
               "axes alike) or \"axes\" (each for itself).")
        .field(
            "points", &HexDominantOptions::points,
            "Where vertices come from: \"periodic\", the integers of a periodic_map, or \"frontal\", a front from the "
            "surface inside along the axes.")
        .field("refinements", &HexDominantOptions::refinements,
               "Times that tets on which the map is of no use are cut into eight, and the map is made anew.")
        .field("most_tets", &HexDominantOptions::most_tets, "None are cut where the mesh would have more.")
        .field("most_hexahedra", &HexDominantOptions::most_hexahedra, "An edge length that asks for more is refused.")
        .field("min_scaled_jacobian", &HexDominantOptions::min_scaled_jacobian,
               "Of hexahedra of the lattice, and of cells made of tets; in (0, 1).")
        .field("hold_angle", &HexDominantOptions::hold_angle, "Of PeriodicMapOptions, radians.")
        .field("recombine", &HexDominantOptions::recombine, "Tets between are joined to hexahedra and wedges.")
        .field("improve", &HexDominantOptions::improve, "Vertices are moved at the end.")
        .field("threads", &HexDominantOptions::threads, "0: all; the result does not depend on it.")
        .finish([](const HexDominantOptions& o) {
            return "edge_length=" + number(o.edge_length) + ", correction='" + to_word(o.correction) + "', points='" +
                   to_word(o.points) + "'";
        });
}

void bind_map(py::module_& m) {
    Record<PeriodicMap>(m, "PeriodicMap", "Coordinates tet by tet whose integer points are the vertices of hexahedra.")
        .field("frames", &PeriodicMap::frames, "(m, 4) float64 quaternions w x y z whose axes the coordinates follow.")
        .field("coordinates", &PeriodicMap::coordinates,
               "(m, 12) int32, column 3 c + i: coordinate i of corner c, in 1/65536 of a cell.")
        .field("usable", &PeriodicMap::usable,
               "(m,) uint8, 1: the jumps of its edges sum to 0, and it is positively oriented.")
        .field("faces", &PeriodicMap::faces, "FaceMatchings: x of the first tet is o^-1 x + translation in the second.")
        .field("translation", &PeriodicMap::translation, "(f, 3) int32, in cells.")
        .field("joined", &PeriodicMap::joined, "(f,) uint8, 1: both tets are usable and agree on the triangle.")
        .field("inconsistent", &PeriodicMap::inconsistent, "Tets whose jumps do not sum to 0.")
        .field("turned_over", &PeriodicMap::turned_over, "Tets whose orientation is not positive.")
        .finish([](const PeriodicMap& map) {
            return count(map.coordinates.rows(), "tet") + ", " + std::to_string(map.inconsistent) + " inconsistent, " +
                   std::to_string(map.turned_over) + " turned over";
        });
    Record<LostCells>(m, "LostCells",
                      "Cells of the lattice whose middle is in the map and that are no hexahedra, by the first reason.")
        .field("outside", &LostCells::outside, "A corner lies beyond the surface.")
        .field("unusable", &LostCells::unusable, "On the way to a corner are tets without coordinates.")
        .field("degenerate", &LostCells::degenerate, "Two corners are one point.")
        .field("poor", &LostCells::poor, "A scaled Jacobian is below the least.")
        .finish([](const LostCells& lost) {
            return std::to_string(lost.outside) + " outside, " + std::to_string(lost.unusable) + " unusable, " +
                   std::to_string(lost.degenerate) + " degenerate, " + std::to_string(lost.poor) + " poor";
        });
    Record<LatticeCells>(m, "LatticeCells", "Hexahedra of the integer lattice of a periodic map.")
        .field("points", &LatticeCells::points, "(p, 3) float64 positions, the input's length unit.")
        .field("tet", &LatticeCells::tet, "(p,) int32: the lowest tet each is in.")
        .field("weights", &LatticeCells::weights,
               "(p, 4) float64 barycentric in it; exactly 0 on triangles, edges and at vertices.")
        .field("hexahedra", &LatticeCells::hexahedra, "(k, 8) int32 of points.")
        .field("on_surface", &LatticeCells::on_surface,
               "(k,) uint8, bit f: face f lies on the surface; corners of faces 0 to 5: 0321, 4567, 0154, 1265, 2376, "
               "3047.")
        .field("lost", &LatticeCells::lost, "LostCells.")
        .field("apart", &LatticeCells::apart,
               "Whether points are as far from each other as they should be; lattice_cells does not say so.")
        .finish([](const LatticeCells& cells) { return count(cells.hexahedra.rows(), "hexahedron", "hexahedra"); });
}

void bind_hexdom_results(py::module_& m) {
    Record<RecombineReport>(m, "RecombineReport", "What recombine found and made.")
        .field("potential_hexahedra", &RecombineReport::potential_hexahedra, "Found.")
        .field("potential_wedges", &RecombineReport::potential_wedges, "Found among the tets that hexahedra left.")
        .field("hexahedra", &RecombineReport::hexahedra, "Made.")
        .field("wedges", &RecombineReport::wedges, "Made.")
        .field("flat_tets", &RecombineReport::flat_tets,
               "That lay between two quads of their four vertices, or a quad and the boundary, and are gone.")
        .finish([](const RecombineReport& r) {
            return count(r.hexahedra, "hexahedron", "hexahedra") + " of " + std::to_string(r.potential_hexahedra) +
                   ", " + count(r.wedges, "wedge") + " of " + std::to_string(r.potential_wedges);
        });
    Record<ConformReport>(m, "ConformReport", "How conform made faces match.")
        .field("combined", &ConformReport::combined, "Pyramids of two tets.")
        .field("raised", &ConformReport::raised, "Pyramids with a new apex in the tets round a diagonal.")
        .field("split", &ConformReport::split, "Hexahedra and wedges given up.")
        .finish([](const ConformReport& r) {
            return std::to_string(r.combined) + " combined, " + std::to_string(r.raised) + " raised, " +
                   std::to_string(r.split) + " split";
        });
    Record<HexDominantCounts>(m, "HexDominantCounts", "Cells at every step of hex_dominant.")
        .field("tets", &HexDominantCounts::tets, "Of the mesh that the map is on.")
        .field("inconsistent", &HexDominantCounts::inconsistent,
               "Of them, without coordinates: jumps of edges do not sum to 0.")
        .field("turned_over", &HexDominantCounts::turned_over, "Of them, coordinates turned over or flat.")
        .field("lost", &HexDominantCounts::lost, "LostCells of the lattice.")
        .field("lattice_hexahedra", &HexDominantCounts::lattice_hexahedra, "Taken from the lattice.")
        .field("crossing", &HexDominantCounts::crossing,
               "Of these, left out as their faces cross others or are not in the surface.")
        .field("recombined_hexahedra", &HexDominantCounts::recombined_hexahedra, "Made of tets.")
        .field("recombined_wedges", &HexDominantCounts::recombined_wedges, "Made of tets.")
        .field("pyramids", &HexDominantCounts::pyramids, "ConformReport.")
        .finish([](const HexDominantCounts& c) {
            return count(c.lattice_hexahedra, "lattice hexahedron", "lattice hexahedra") + ", " +
                   std::to_string(c.recombined_hexahedra) + " recombined";
        });
    Record<HexDominantMesh>(m, "HexDominantMesh", "A hex-dominant mesh and how it came about.")
        .field("mesh", &HexDominantMesh::mesh, "MixedMesh.")
        .field("regions", &HexDominantMesh::regions, "(cells,) int32, or none where the domain has none.")
        .field("support", &HexDominantMesh::support,
               "(n,) uint8 per vertex: 0 inside, 1 on the surface, 2 on a feature curve, 3 a corner.")
        .field("points", &HexDominantMesh::points, "What they were made by: 'periodic' or 'frontal'.")
        .field("counts", &HexDominantMesh::counts, "HexDominantCounts.")
        .finish([](const HexDominantMesh& result) {
            const MixedMesh& mesh = result.mesh;
            return count(mesh.hexahedra.rows(), "hexahedron", "hexahedra") + ", " + count(mesh.tets.rows(), "tet") +
                   ", " + count(mesh.wedges.rows(), "wedge") + ", " + count(mesh.pyramids.rows(), "pyramid");
        });
}

}  // namespace

void bind_hexdom_types(py::module_& m) {
    bind_hexdom_options(m);
    bind_map(m);
    bind_hexdom_results(m);
}

}  // namespace octafield::bindings
