// T-meshes of imposed fields, whole numbers on their arcs, and what surfaces with features need for them.
#include "arrays.hpp"
#include "bind.hpp"
#include "bound_layout.hpp"
#include "checks.hpp"
#include "domain.hpp"
#include "interruptible.hpp"
#include "octafield/surface/corner_pattern.hpp"
#include "octafield/surface/feature_cut.hpp"
#include "octafield/surface/feature_needles.hpp"
#include "octafield/surface/fitted_pattern.hpp"
#include "octafield/surface/integer_grid_map.hpp"
#include "octafield/surface/quantized_quads.hpp"
#include "options.hpp"

namespace octafield::bindings {

using namespace surface;
using py::literals::operator""_a;

void check(const QuantizedQuadsOptions& options) {
    finite(options.edge_length, "edge_length");
    finite(options.least_jacobian, "least_jacobian");
}
void check(const FittingOptions& options) {
    finite(options.edge_length, "edge_length");
    finite(options.most_triangles, "most_triangles");
}

namespace {

void bind_t_mesh_options(py::module_& m) {
    Record<QuantizedQuadsOptions>(
        m, "QuantizedQuadsOptions",
        "Options of quantized_quads: its keyword arguments. One of edge_length and quad_count "
        "is to be given.")
        .field("edge_length", &QuantizedQuadsOptions::edge_length, "As of LayoutQuadsOptions.")
        .field("quad_count", &QuantizedQuadsOptions::quad_count, "Wanted; sizes are tried until the number is near.")
        .field("blocks", &QuantizedQuadsOptions::blocks,
               "\"few\": whole numbers for large quads, whose rows are split; or \"fine\": for quads of the size "
               "wanted, nearer to the lengths, in blocks that may be as small as quads.")
        .field("least_jacobian", &QuantizedQuadsOptions::least_jacobian,
               "Of \"few\": more blocks are tried until all quads have this scaled Jacobian; if none has, the fewest "
               "with 0.3 are taken, or with 0.8 of the best one's where that is below 0.3. 0: the fewest.")
        .field("weights", &QuantizedQuadsOptions::weights,
               "Of |n - length / size| in the sum: \"equal\", or \"relative\", over length / size, 1 at least.")
        .field("measure", &QuantizedQuadsOptions::measure,
               "What is divided by the size, and spreads quads along sides: \"parameters\", quad coordinates, so that "
               "quads are as square as the field has them and as large as its sizes; or \"lengths\" on the surface, so "
               "that they are about as large as one another.")
        .field("origins", &QuantizedQuadsOptions::origins,
               "Of a surface cut open (FeatureCut.origins): boundaries of the same origins get the same vertices.")
        .field("smoothing", &QuantizedQuadsOptions::smoothing,
               "Rounds in which vertices are moved for a larger least scaled Jacobian round them; 0: none.")
        .field("release_points", &QuantizedQuadsOptions::release_points,
               "Let singular points inside move where quads of a scaled Jacobian below 0.3 are left.")
        .field("follow", &QuantizedQuadsOptions::follow,
               "A cross field on the layout's surface (DirectionField.values) that edges of quads are drawn to, with "
               "measure \"lengths\". None: quads are as square as can be.")
        .field("most_nodes", &QuantizedQuadsOptions::most_nodes, "Of branch and bound, for each connected part.")
        .finish([](const QuantizedQuadsOptions& o) {
            return "edge_length=" + number(o.edge_length) + ", quad_count=" + std::to_string(o.quad_count);
        });
    Record<FittingOptions>(m, "FittingOptions",
                           "Options of fitted_pattern: its keyword arguments, beside those of ImposedFieldOptions and "
                           "LayoutCurveOptions. edge_length is to be given.")
        .field("edge_length", &FittingOptions::edge_length, "Of the quads wanted, as of QuantizedQuadsOptions.")
        .field("places", &FittingOptions::places, "Tried in a face, all over it.")
        .field("more_tried", &FittingOptions::more_tried,
               "Patterns after the first that ends a face's shortage, for less deviation.")
        .field("most_tried", &FittingOptions::most_tried, "Patterns in all.")
        .field("most_triangles", &FittingOptions::most_triangles, "Of the faces of all patterns tried.")
        .finish([](const FittingOptions& o) { return "edge_length=" + number(o.edge_length); });
}

// A member of the base as one of the class.
template <class Member>
constexpr Member QuantizedQuads::*own_member(Member LayoutQuads::*member) {
    return member;
}

void bind_t_mesh_results(py::module_& m) {
    Record<QuantizedQuads>(m, "QuantizedQuads", "Block-structured quads of a T-mesh, as quantized_quads makes them.")
        .field("mesh", own_member(&LayoutQuads::mesh), "QuadMesh.")
        .field("patches", own_member(&LayoutQuads::patches), "(Q,) int32: block of each quad (base_complex).")
        .field("chord_counts", own_member(&LayoutQuads::chord_counts), "int32: quads across each chord of the blocks.")
        .field("patch_sizes", own_member(&LayoutQuads::patch_sizes),
               "(blocks, 2) int32: quads along the first and second direction of each.")
        .field("patch_chords", &QuantizedQuads::patch_chords, "(blocks, 2) int32: the chord across each of them.")
        .field("tiles", &QuantizedQuads::tiles, "(Q,) int32: patch of the T-mesh of each quad.")
        .field("arc_counts", &QuantizedQuads::arc_counts,
               "int32, quads along each side of the T-mesh; 0 where its ends became one.")
        .field("part_counts", &QuantizedQuads::part_counts,
               "int32, quads along each part of the seams and the boundary; integer_grid_map needs them.")
        .field("fewest_blocks", &QuantizedQuads::fewest_blocks,
               "That meshes with these faces and irregular vertices can have (octafield.surface.fewest_blocks).")
        .field(
            "coarsest_blocks", &QuantizedQuads::coarsest_blocks,
            "Of blocks=\"few\": the fewest that whole numbers on the T-mesh were found to make, whatever the shapes of "
            "the quads; else as many as there are.")
        .field("t_joints", &QuantizedQuads::t_joints, "Of the T-mesh; the quads have none.")
        .field("irregular", &QuantizedQuads::irregular,
               "int32 vertices inside with other than four quads, of the boundary with other than two.")
        .field("size", &QuantizedQuads::size, "That lengths in quad coordinates were divided by.")
        .field("deviation", &QuantizedQuads::deviation, "Sum of the weights times |n - length / size|.")
        .field("bound", &QuantizedQuads::bound, "What that sum cannot be below.")
        .field("optimal", &QuantizedQuads::optimal, "Whether the two are the same.")
        .field("mean_value_patches", own_member(&LayoutQuads::mean_value_patches),
               "Mapped with mean value weights, as the harmonic map folded.")
        .field("least_scaled_jacobian", own_member(&LayoutQuads::least_scaled_jacobian), "Of the quads.")
        .finish([](const QuantizedQuads& q) {
            return count(q.mesh.quads.rows(), "quad") + " in " +
                   count(static_cast<std::ptrdiff_t>(q.patch_sizes.rows()), "block") + ", least scaled Jacobian " +
                   number(q.least_scaled_jacobian);
        });
    Record<IntegerGridMap>(m, "IntegerGridMap", "A surface mapped to the integer grid, as integer_grid_map makes it.")
        .field("positions", &IntegerGridMap::positions, "(n, 3) float64, input unit, on the surface.")
        .field("triangles", &IntegerGridMap::triangles, "(m, 3) int32, parts of the surface's.")
        .field("coordinates", &IntegerGridMap::coordinates,
               "(3 m, 2) float64: u, v of corner k of triangle t in row 3 t + k.")
        .field("triangle_origins", &IntegerGridMap::triangle_origins, "(m,) int32: triangle of the layout's surface.")
        .field("singular", &IntegerGridMap::singular,
               "int32 vertices inside with another number of quads than four, ascending.")
        .field("mean_distortion", &IntegerGridMap::mean_distortion,
               "Of (s + 1 / s) / 2, s the ratio of the two stretches; 1 where squares stay squares.")
        .field("largest_distortion", &IntegerGridMap::largest_distortion, "Of the same.")
        .field("largest_residual", &IntegerGridMap::largest_residual,
               "How far u, v over an edge are from a turn by quarters and a shift by whole numbers.")
        .field("steps", &IntegerGridMap::steps, "Of Newton's method.")
        .finish([](const IntegerGridMap& g) {
            return count(static_cast<std::ptrdiff_t>(g.triangles.rows()), "triangle") + ", mean distortion " +
                   number(g.mean_distortion);
        });
    Record<BaseComplex>(m, "BaseComplex", "The coarsest block structure of a quad mesh, as base_complex finds it.")
        .field("blocks", &BaseComplex::blocks, "(Q,) int32: block of each quad.")
        .field("block_sizes", &BaseComplex::block_sizes, "(B, 2) int32: quads along both directions.")
        .field("block_chords", &BaseComplex::block_chords, "(B, 2) int32: the chord across each of them.")
        .field("chord_counts", &BaseComplex::chord_counts, "int32: quads across each chord.")
        .field("irregular", &BaseComplex::irregular, "int32 vertices, ascending.")
        .field("cut_vertices", &BaseComplex::cut_vertices,
               "Regular ones from which lines were added, where blocks were no disks.")
        .finish([](const BaseComplex& b) {
            return count(static_cast<std::ptrdiff_t>(b.block_sizes.rows()), "block") + ", " +
                   count(static_cast<std::ptrdiff_t>(b.irregular.size()), "irregular vertex", "irregular vertices");
        });
    Record<FeatureCut>(m, "FeatureCut", "A surface cut open along its feature edges.")
        .field("domain", &FeatureCut::domain, "SurfaceDomain: triangles as before, a vertex per sector of features.")
        .field("origins", &FeatureCut::origins, "(V,) int32: vertex of the whole surface of each.")
        .finish([](const FeatureCut& c) { return count(c.domain.vertex_count(), "vertex", "vertices"); });
    Record<PatternChange>(m, "PatternChange", "What fitted_pattern changed in a face, and where.")
        .field("triangle", &PatternChange::triangle, "The lowest of the face, a connected part of the surface.")
        .field("added", &PatternChange::added, "A pair of points of valence 3 and 5. If not, a point was moved.")
        .field("positions", &PatternChange::positions, "(1, 3) or (2, 3) float64: where the point or the pair is now.")
        .finish([](const PatternChange& c) {
            return std::string(c.added ? "pair added" : "point moved") + " in the face of triangle " +
                   std::to_string(c.triangle);
        });
    Record<FittedPattern>(m, "FittedPattern", "Singular points that whole numbers fit, as fitted_pattern makes them.")
        .field("pattern", &FittedPattern::pattern, "SingularPattern.")
        .field("changes", &FittedPattern::changes, "List of PatternChange.")
        .field("before", &FittedPattern::before, "Sum of arc_shortages of the pattern that was given.")
        .field("left", &FittedPattern::left, "Of this one: 0 where whole numbers fit.")
        .field("tried", &FittedPattern::tried, "How many patterns of a face were tried.")
        .finish([](const FittedPattern& f) {
            return count(static_cast<std::ptrdiff_t>(f.changes.size()), "change") + ", shortage " + number(f.left);
        });
}

void bind_quantized_quads(py::module_& m) {
    m.def(
        "motorcycle_graph",
        [](const ImposedField& field, const std::optional<ProgressCallable>& progress, const py::kwargs& given) {
            const auto [options] = options_of<LayoutCurveOptions>("motorcycle_graph", given);
            return run_interruptible([field, options = options](
                                         Job& job) { return bound_layout(field, options, true, true, job.progress()); },
                                     progress);
        },
        "field"_a, py::kw_only(), "progress"_a = py::none(),
        "The T-mesh of an ImposedField, as a QuadLayout: separatrices run at the same time and stop where they meet a "
        "track that was there before (Eppstein et al. 2008; Campen, Bommes, Kobbelt 2015), so all are finite. Patches "
        "are rectangles in quad coordinates, with T-joints on their sides. Closed surfaces need no turn, and fields "
        "may "
        "be rotated. Raises as quad_layout.");
    list_options<LayoutCurveOptions>(m, "motorcycle_graph");
    m.def(
        "quantized_quads",
        [](const BoundLayout& layout, const std::optional<ProgressCallable>& progress, const py::kwargs& given) {
            const auto [options] = options_of<QuantizedQuadsOptions>("quantized_quads", given);
            return run_interruptible([made = layout.layout, options = options](
                                         Job& job) { return quantized_quads(*made, options, job.progress()); },
                                     progress);
        },
        "layout"_a, py::kw_only(), "progress"_a = py::none(),
        "Quads of a T-mesh or layout, as QuantizedQuads: opposite sides of each patch get equal whole numbers, every "
        "arc 1 at least, with the least sum of deviations, by a mixed integer programme that is stopped by its nodes "
        "and "
        "never by time; each patch is mapped to a rectangle one to one. Raises InvalidInput; GeometryError (kind "
        "\"no_integers\": no whole numbers fit); SolverError (\"node_limit\", \"solver_failed\", \"folded_map\", "
        "\"inverted_quads\"), Cancelled.");
    list_options<QuantizedQuadsOptions>(m, "quantized_quads");
    m.def(
        "integer_grid_map",
        [](const BoundLayout& layout, const QuantizedQuads& quads, const std::vector<Index>& origins,
           const std::optional<ProgressCallable>& progress) {
            return run_interruptible([made = layout.layout, quads, origins](
                                         Job& job) { return integer_grid_map(*made, quads, origins, job.progress()); },
                                     progress);
        },
        "layout"_a, "quads"_a, "origins"_a = std::vector<Index>(), py::kw_only(), "progress"_a = py::none(),
        "The whole surface of a T-mesh mapped to the integer grid at once, one to one, as an IntegerGridMap: the lines "
        "of whole u and v are those of the quads, of which the QuantizedQuads of this layout say how many there are on "
        "each arc. Over an edge u, v go on after a turn by quarters and a shift by whole numbers; singular points are "
        "at "
        "whole numbers, the boundary and seams on lines of them. origins: as of quantized_quads. Raises InvalidInput; "
        "SolverError (kind \"folded_map\"), Cancelled.");
    m.def(
        "arc_shortages",
        [](const BoundLayout& layout, const std::vector<Index>& origins) {
            return run_interruptible([made = layout.layout, origins](Job&) { return arc_shortages(*made, origins); });
        },
        "layout"_a, "origins"_a = std::vector<Index>(),
        "Of each side of a T-mesh that no whole numbers fit, by how much it is below the least number that it has to "
        "have where these shortages sum to the least; all 0 where numbers fit. origins: as of quantized_quads.");
    m.def(
        "fewest_blocks",
        [](const QuadMesh& mesh, const std::vector<Index>& faces) {
            return run_interruptible([mesh = mesh, faces](Job&) {
                scaled_jacobians(mesh);  // refuses ids out of range
                return fewest_blocks(mesh, faces);
            });
        },
        "mesh"_a, "faces"_a = std::vector<Index>(),
        "A bound from below of the blocks without T-joints for the irregular vertices of the mesh: every quad there, "
        "and where lines have to cross, is in a corner of a block, and a block has four; one at least for each "
        "connected part. faces: of each quad, between features that layouts follow; none: the mesh is one. Raises as "
        "base_complex, and InvalidInput (kind \"bad_option\").");
    m.def(
        "base_complex",
        [](const QuadMesh& mesh) {
            return run_interruptible([mesh = mesh](Job&) {
                scaled_jacobians(mesh);  // refuses ids out of range
                return base_complex(mesh);
            });
        },
        "mesh"_a,
        "The BaseComplex of a QuadMesh without triangles: blocks cut out by the lines straight over the quads from its "
        "irregular vertices. Raises InvalidInput (kind \"not_quads\"), GeometryError.");
}

void bind_cut_features(py::module_& m) {
    m.def(
        "cut_along_features",
        [](const SurfaceOrMesh& surface) {
            return run_interruptible([surface](Job&) { return cut_along_features(domain_of(surface)); });
        },
        "surface"_a,
        "The surface cut open along its feature edges, as a FeatureCut, so that a field that follows the boundary "
        "follows features as well.");
    m.def(
        "blunted_features",
        [](const SurfaceOrMesh& surface, double least_angle) {
            finite(least_angle, "least_angle");
            return run_interruptible([=](Job&) {
                BluntedFeatures made = blunted_features(domain_of(surface), least_angle);
                return std::pair(std::move(made.domain), std::move(made.tips));
            });
        },
        "surface"_a, "least_angle"_a = 10 * std::numbers::pi / 180,
        "The SurfaceDomain with needles between features blunted, and their tips, int32 vertex ids: where two feature "
        "edges leave a vertex at less than the angle (radians), the opposite sides of the triangles between them are "
        "features in place of the shorter one.");
    m.def(
        "with_corner_quads",
        [](const SurfaceOrMesh& surface, const SingularPattern& pattern, const std::vector<CornerQuads>& corners) {
            return run_interruptible([=](Job&) { return with_corner_quads(domain_of(surface), pattern, corners); });
        },
        "surface"_a, "pattern"_a, "corners"_a,
        "The SingularPattern with these CornerQuads and no others; points inside are taken away or added, near the "
        "corners, so that the sum of indices stays. Raises InvalidInput, GeometryError (kind \"no_room\").");
    m.def(
        "moved_by_faces",
        [](const SurfaceOrMesh& surface, const SingularPattern& pattern,
           const std::optional<ProgressCallable>& progress, const py::kwargs& given) {
            const auto [options] = options_of<ImposedFieldOptions>("moved_by_faces", given);
            return run_interruptible(
                [=, options = options](Job& job) {
                    return moved_by_faces(domain_of(surface), pattern, options, job.progress());
                },
                progress);
        },
        "surface"_a, "pattern"_a, py::kw_only(), "progress"_a = py::none(),
        "The SingularPattern with points moved, connected part by part, where that makes it admissible there; the "
        "others keep theirs, so that one part does not have the field of all others rotated. Raises as "
        "impose_singular_points for what moving does not mend.");
    list_options<ImposedFieldOptions>(m, "moved_by_faces");
    m.def(
        "fitted_pattern",
        [](const SurfaceOrMesh& surface, const SingularPattern& pattern, const std::vector<Index>& origins,
           const std::optional<ProgressCallable>& progress, const py::kwargs& given) {
            const auto [imposing, curves, fitting] =
                options_of<ImposedFieldOptions, LayoutCurveOptions, FittingOptions>("fitted_pattern", given);
            return run_interruptible(
                [=, imposing = imposing, curves = curves, fitting = fitting](Job& job) {
                    return fitted_pattern(domain_of(surface), pattern, origins, imposing, curves, fitting,
                                          job.progress());
                },
                progress);
        },
        "surface"_a, "pattern"_a, "origins"_a, py::kw_only(), "progress"_a = py::none(),
        "The SingularPattern of a surface cut along features (FeatureCut: domain, origins), changed face by face until "
        "whole numbers fit its T-mesh, as a FittedPattern: a point is moved, or a pair of valence 3 and 5 added, in "
        "one of a few places all over the face. Of those that fit, one is taken that deviates little for quads of this "
        "edge length. Raises as impose_singular_points and motorcycle_graph.");
    list_options<ImposedFieldOptions, LayoutCurveOptions, FittingOptions>(m, "fitted_pattern");
    m.def(
        "finite_corner_quads",
        [](const SurfaceOrMesh& surface, const SingularPattern& pattern) {
            return run_interruptible([=](Job&) { return finite_corner_quads(domain_of(surface), pattern); });
        },
        "surface"_a, "pattern"_a,
        "The CornerQuads of a computed field's SingularPattern, 1 at least: a corner without quads is infinitely long "
        "in quad coordinates. A corner nearby that made up for it gets its quads by the angle.");
}

}  // namespace

void bind_t_mesh_types(py::module_& m) {
    bind_t_mesh_options(m);
    bind_t_mesh_results(m);
}

void bind_t_meshes(py::module_& m) {
    bind_quantized_quads(m);
    bind_cut_features(m);
}

}  // namespace octafield::bindings
