// All-hex meshes from seamless maps, in one call or in parts.
#include "bind.hpp"
#include "field_map.hpp"
#include "interruptible.hpp"
#include "octafield/volume/all_hex.hpp"
#include "octafield/volume/motorcycle_complex.hpp"
#include "options.hpp"

namespace octafield::bindings {

using namespace volume;
using py::literals::operator""_a;

void check(const AllHexOptions& options) {
    finite(options.edge_length, "edge_length");
    finite(options.good, "good");
    threads_option(options.threads);
}

namespace {

void bind_map_types(py::module_& m) {
    Record<SeamlessMap>(m, "SeamlessMap",
                        "Parameters of a tet mesh per corner, that go on across triangles by one of the 24 rotations "
                        "of the cube and a translation, and the walls that cut the mesh into blocks.")
        .field("mesh", &SeamlessMap::mesh, "TetMesh.")
        .field("parameters", &SeamlessMap::parameters,
               "(m, 12) float64, column 3 c + i: parameter i of corner c; a length of 1 becomes an edge by the scale.")
        .field("walls", &SeamlessMap::walls,
               "(w, 3) int32 triangles of the motorcycle complex; boundary ones may miss.")
        .field("features", &SeamlessMap::features, "(k, 2) int32 feature edges of the boundary.")
        .field("corners", &SeamlessMap::corners, "int32 feature corners.")
        .finish([](const SeamlessMap& map) {
            return count(map.mesh.tets.rows(), "tet") + ", " + count(map.walls.rows(), "wall triangle");
        });
    Record<SeamlessReport>(m, "SeamlessReport", "Whether parameters are a seamless map without folds.")
        .field("flipped", &SeamlessReport::flipped, "int32 tets whose parameters are turned over or flat.")
        .field("residual", &SeamlessReport::residual, "Largest distance that is left at a vertex after a transition.")
        .field("torn", &SeamlessReport::torn, "int32 tets next to a triangle where that is not rounding.")
        .field("unaligned", &SeamlessReport::unaligned, "Boundary triangles without a constant parameter.")
        .field("volume", &SeamlessReport::volume, "Of the tets in parameters.")
        .field("wound", &SeamlessReport::wound,
               "(k, 2) int32 edges round which parameters turn as in no hex mesh, flipped tets or not.")
        .finish([](const SeamlessReport& r) {
            return count(r.flipped.size(), "flipped tet") + ", residual " + number(r.residual);
        });
}

// The blocks with the map that they are made of again when they are copied.
struct BoundBlocks {
    SeamlessMap map;
    BlockComplex blocks;
};

void bind_block_types(py::module_& m) {
    Record<BlockArc>(m, "BlockArc", "A curve where blocks meet, from node to node.")
        .field("vertices", &BlockArc::vertices, "int32, of the tet mesh, in order.")
        .field("parameters", &BlockArc::parameters, "float64 of these vertices, from 0 to the length in the map.")
        .field("feature", &BlockArc::feature, "Whether all of its edges are features.")
        .field("boundary", &BlockArc::boundary, "Whether all of its edges are on the boundary.")
        .finish([](const BlockArc& arc) { return count(arc.vertices.size(), "vertex", "vertices"); });
    Record<ArcNumbers>(m, "ArcNumbers", "Whole numbers of edges on the arcs of blocks.")
        .field("numbers", &ArcNumbers::numbers, "int32 per arc.")
        .field("deviation", &ArcNumbers::deviation, "Sum of |number - wanted| / max(wanted, 1/2).")
        .field("bound", &ArcNumbers::bound, "That no choice is below.")
        .field("hexahedra", &ArcNumbers::hexahedra, "That these numbers make.")
        .finish([](const ArcNumbers& n) { return count(n.hexahedra, "hexahedron", "hexahedra"); });
    Record<BlockHexahedra>(m, "BlockHexahedra", "Hexahedra of blocks, where the map puts them.")
        .field("mesh", &BlockHexahedra::mesh, "MixedMesh of hexahedra.")
        .field("blocks", &BlockHexahedra::blocks, "int32: the block of each.")
        .field("support", &BlockHexahedra::support,
               "uint8 per vertex: 0 inside, 1 on the boundary, 2 on a feature, 3 a corner.")
        .finish([](const BlockHexahedra& h) { return count(h.mesh.hexahedra.rows(), "hexahedron", "hexahedra"); });
    py::class_<BoundBlocks>(m, "BlockComplex",
                            "Blocks of a SeamlessMap: boxes in its parameters that meet in rectangles, arcs, nodes.")
        .def_property_readonly(
            "tet_block", [](const py::object& self) { return view(self.cast<BoundBlocks&>().blocks.tet_block, self); },
            "(m,) int32: the block of each tet.")
        .def_property_readonly(
            "charts", [](const py::object& self) { return view(self.cast<BoundBlocks&>().blocks.charts, self); },
            "(m, 12) float64 parameters, the same throughout a block.")
        .def_property_readonly(
            "nodes", [](const py::object& self) { return view(self.cast<BoundBlocks&>().blocks.nodes, self); },
            "int32 vertices where arcs meet, and feature corners on arcs.")
        .def_property_readonly(
            "arcs", [](const BoundBlocks& self) { return self.blocks.arcs; }, "A list of BlockArc.")
        .def_property_readonly(
            "sizes", [](const BoundBlocks& self) { return own(Rows<double, 3>(self.blocks.high - self.blocks.low)); },
            "(b, 3) float64 extents of the blocks in parameters.")
        .def_property_readonly(
            "patches", [](const BoundBlocks& self) { return self.blocks.patches.size(); },
            "Number of rectangles between blocks and on the boundary.")
        .def("__repr__",
             [](const BoundBlocks& self) {
                 return "BlockComplex(" + count(self.blocks.block_count(), "block") + ", " +
                        count(self.blocks.arcs.size(), "arc") + ")";
             })
        .def("__reduce__", [](const BoundBlocks& self) {
            return py::make_tuple(py::module_::import("octafield._core").attr("block_complex"),
                                  py::make_tuple(self.map));
        });
}

void bind_result_types(py::module_& m) {
    Record<AllHexOptions>(m, "AllHexOptions", "Options of all_hex: its keyword arguments, with their defaults.")
        .field("cells", &AllHexOptions::cells, "Number of hexahedra wanted; 0: by edge_length.")
        .field("edge_length", &AllHexOptions::edge_length,
               "Wanted, input unit; 0 and no cells: the mean edge of the boundary.")
        .field("most_nodes", &AllHexOptions::most_nodes, "Of the search for whole numbers.")
        .field("most_hexahedra", &AllHexOptions::most_hexahedra, "An edge length that asks for more is refused.")
        .field("good", &AllHexOptions::good, "Scaled Jacobians below are raised.")
        .field("sweeps", &AllHexOptions::sweeps, "Of moving vertices, at most; 0: they stay where the map says.")
        .field("threads", &AllHexOptions::threads, "0: all; the result does not depend on it.")
        .finish([](const AllHexOptions& o) {
            return "cells=" + std::to_string(o.cells) + ", edge_length=" + number(o.edge_length);
        });
    Record<AllHexMesh>(m, "AllHexMesh", "A mesh of hexahedra alone, and what led to it.")
        .field("mesh", &AllHexMesh::mesh, "MixedMesh of hexahedra.")
        .field("blocks", &AllHexMesh::blocks, "int32: the block of each.")
        .field("support", &AllHexMesh::support,
               "uint8 per vertex: 0 inside, 1 on the boundary, 2 on a feature, 3 a corner.")
        .field("numbers", &AllHexMesh::numbers, "ArcNumbers.")
        .field("wanted", &AllHexMesh::wanted, "Number of hexahedra.")
        .field("inverted", &AllHexMesh::inverted,
               "Hexahedra with a scaled Jacobian of 0 or less before vertices moved.")
        .field("block_count", &AllHexMesh::block_count, "Of the map.")
        .field("notes", &AllHexMesh::notes, "Sentences.")
        .finish([](const AllHexMesh& made) {
            return count(made.mesh.hexahedra.rows(), "hexahedron", "hexahedra") + ", " +
                   count(made.block_count, "block");
        });
}

}  // namespace

void bind_hexmesh(py::module_& m) {
    bind_map_types(m);
    bind_block_types(m);
    bind_result_types(m);
    bind_field_map(m);
    m.def(
        "seamless_report",
        [](const SeamlessMap& map) { return run_interruptible([map = map](Job&) { return seamless_report(map); }); },
        "map"_a,
        "Whether a SeamlessMap is seamless, aligned with the boundary and without folds, as a SeamlessReport. Raises "
        "InvalidInput, GeometryError.");
    m.def(
        "map_domain",
        [](const SeamlessMap& map) { return run_interruptible([map = map](Job&) { return map_domain(map); }); },
        "map"_a,
        "The TetDomain of a SeamlessMap: its tets with its features, or, where it has neither edges nor corners, with "
        "edges of 40 degrees. Raises InvalidInput, GeometryError.");
    m.def(
        "motorcycle_complex",
        [](const SeamlessMap& map, const std::optional<ProgressCallable>& progress) {
            return run_interruptible([map = map](Job& job) { return motorcycle_complex(map, job.progress()); },
                                     progress);
        },
        "map"_a, py::kw_only(), "progress"_a = py::none(),
        "The SeamlessMap on tets that are cut along walls of its own, so that block_complex finds boxes; walls of the "
        "given one are not used. Raises InvalidInput, GeometryError (kinds flipped_tet, torn_map, unaligned_boundary, "
        "winding_edge, not_a_box), SolverError (endless_walls, walls_too_near), Cancelled.");
    m.def(
        "block_complex",
        [](const SeamlessMap& map) {
            return run_interruptible([map = map](Job&) { return BoundBlocks{map, block_complex(map)}; });
        },
        "map"_a,
        "The blocks that the walls of a SeamlessMap bound, as a BlockComplex. Raises InvalidInput, GeometryError "
        "(kinds "
        "flipped_tet, torn_map, bent_wall, not_a_box).");
    m.def(
        "arc_numbers",
        [](const BoundBlocks& bound, double scale, const std::optional<ArrayLike>& least, int most_nodes) {
            finite(scale, "scale");
            auto numbers =
                least ? from_python<std::vector<int>>(*least, "least") : std::vector<int>(bound.blocks.arcs.size(), 1);
            return run_interruptible([blocks = bound.blocks, scale, numbers = std::move(numbers), most_nodes](Job&) {
                return arc_numbers(blocks, scale, numbers, most_nodes);
            });
        },
        "blocks"_a, "scale"_a, py::kw_only(), "least"_a = py::none(), "most_nodes"_a = AllHexOptions{}.most_nodes,
        "Whole numbers of edges on the arcs, near their lengths times scale, as ArcNumbers. least: (arcs,) int32, 1 "
        "where none are given. Raises InvalidInput, GeometryError, SolverError.");
    m.def(
        "block_hexahedra",
        [](const SeamlessMap& map, const BoundBlocks& bound, const ArrayLike& numbers) {
            return run_interruptible(
                [map = map, blocks = bound.blocks, numbers = from_python<std::vector<int>>(numbers, "numbers")](Job&) {
                    return block_hexahedra(map, blocks, numbers);
                });
        },
        "map"_a, "blocks"_a, "numbers"_a,
        "The hexahedra of blocks with these numbers of edges on their arcs, where the map puts them, as "
        "BlockHexahedra. "
        "Raises InvalidInput, GeometryError.");
    m.def(
        "all_hex",
        [](const SeamlessMap& map, const std::optional<ProgressCallable>& progress, const py::kwargs& given) {
            const auto [options] = options_of<AllHexOptions>("all_hex", given);
            return run_interruptible(
                [map = map, options = options](Job& job) { return all_hex(map, options, job.progress()); }, progress);
        },
        "map"_a, py::kw_only(), "progress"_a = py::none(),
        "A mesh of hexahedra alone from a SeamlessMap with walls, as an AllHexMesh: whole numbers near the wanted "
        "size, "
        "a grid in each block, vertices moved on the surface and features. Raises InvalidInput, GeometryError, "
        "SolverError, Cancelled.");
    list_options<AllHexOptions>(m, "all_hex");
}

}  // namespace octafield::bindings
