// Triangles of given lengths on a surface, and how good triangles are.
#include "arrays.hpp"
#include "bind.hpp"
#include "checks.hpp"
#include "interruptible.hpp"
#include "octafield/surface/close_remesh.hpp"
#include "octafield/surface/triangle_quality.hpp"
#include "octafield/surface/winslow.hpp"
#include "options.hpp"

namespace octafield::bindings {

using namespace surface;
using py::literals::operator""_a;

void check(const CloseRemeshOptions& options) {
    finite(options.vertices, "vertices");
    finite(options.deviation, "deviation");
    finite(options.quality, "quality");
    finite(options.max_vertices, "max_vertices");
}

void check(const WinslowOptions& options) { finite(options.tolerance, "tolerance"); }

namespace {

void bind_remeshing_types(py::module_& m) {
    Record<CloseRemeshOptions>(m, "CloseRemeshOptions", "Options of close_remesh: its keyword arguments.")
        .field("vertices", &CloseRemeshOptions::vertices,
               "Wanted number: lengths are multiplied until it is met; 0: lengths as they are.")
        .field("deviation", &CloseRemeshOptions::deviation,
               "Input unit: lengths become shorter where either surface is farther from the other; 0: any.")
        .field("quality", &CloseRemeshOptions::quality, "That every triangle is to have, in [0, 0.5].")
        .field("max_vertices", &CloseRemeshOptions::max_vertices, "A deviation that would take more is refused.")
        .field("keep_stubs", &CloseRemeshOptions::keep_stubs,
               "Feature curves that end inside the surface and are shorter than two edges, as noise makes.")
        .field("iterations", &CloseRemeshOptions::iterations, "Rounds before anything is measured, at least 1.")
        .finish([](const CloseRemeshOptions& o) {
            return "vertices=" + number(o.vertices) + ", deviation=" + number(o.deviation) +
                   ", quality=" + number(o.quality);
        });
    Record<CloseRemeshResult>(m, "CloseRemeshResult", "A surface remeshed by close_remesh, its features and how far it departs.")
        .field("mesh", &CloseRemeshResult::mesh, "The new TriangleMesh.")
        .field("stubs", &CloseRemeshResult::stubs,
               "(k, 2) int32: feature edges of the input that were not followed (keep_stubs).")
        .field("features", &CloseRemeshResult::features,
               "FeatureGraph of the new mesh: pieces of the old curves, corners at the old places.")
        .field("notes", &CloseRemeshResult::notes, "What a user should know, one sentence each.")
        .field("deviation", &CloseRemeshResult::deviation,
               "Input unit: no vertex of the input is farther from the new triangles.")
        .field("own_deviation", &CloseRemeshResult::own_deviation,
               "Input unit: no middle of a new triangle, or of a side of one, is farther from the input.")
        .field("off_surface", &CloseRemeshResult::off_surface,
               "Input unit: no new vertex is farther from the input; rounding.")
        .field("poor", &CloseRemeshResult::poor, "Triangles below the quality asked for.")
        .field("forced", &CloseRemeshResult::forced, "Of these, those between two feature edges.")
        .field("kept", &CloseRemeshResult::kept, "No sound mesh was found: these are the input's triangles.")
        .finish([](const CloseRemeshResult& r) {
            return count(r.mesh.triangles.rows(), "triangle") +
                   ", deviation=" + number(std::max(r.deviation, r.own_deviation)) + ", poor=" + std::to_string(r.poor);
        });
    Record<WinslowOptions>(m, "WinslowOptions", "Options of winslow_smooth: its keyword arguments.")
        .field("rounds", &WinslowOptions::rounds, "In which each vertex is moved once, at most.")
        .field("tolerance", &WinslowOptions::tolerance,
               "Relative decrease of the functional in a round, at which it stops.")
        .finish([](const WinslowOptions& o) { return "rounds=" + std::to_string(o.rounds); });
    Record<WinslowResult>(m, "WinslowResult", "Points moved by winslow_smooth, and what became of its functional.")
        .field("points", &WinslowResult::points, "(n, 3) float64.")
        .field("before", &WinslowResult::before,
               "Mean of the functional over triangles and corners of quads; 1 is best.")
        .field("after", &WinslowResult::after, "The same, of these points.")
        .field("rounds", &WinslowResult::rounds, "That it took.")
        .field("moved", &WinslowResult::moved, "Vertices that are not where they were.")
        .finish([](const WinslowResult& r) {
            return count(r.points.rows(), "point") + ", " + number(r.before) + " before, " + number(r.after) + " after";
        });
}

}  // namespace

void bind_remeshing(py::module_& m) {
    bind_remeshing_types(m);
    m.def(
        "close_remesh",
        [](const TriangleMesh& mesh, const FeatureGraph& features, const ArrayLike& lengths,
           const std::optional<ProgressCallable>& progress, const py::kwargs& given) {
            const auto [options] = options_of<CloseRemeshOptions>("close_remesh", given);
            return run_interruptible(
                [mesh = mesh, features = features, options = options,
                 lengths = from_python<Eigen::VectorXd>(lengths, "lengths")](Job& job) mutable {
                    check(mesh);
                    features = ordered_features(std::move(features), mesh);
                    return close_remesh(mesh, features, lengths, options, job.progress());
                },
                progress);
        },
        "mesh"_a, "features"_a, "lengths"_a, py::kw_only(), "progress"_a = py::none(),
        "Triangles with edges of given lengths, all of good shape, whose vertices lie on the input, as a "
        "CloseRemeshResult. lengths: (V,) wanted at the vertices of the input, input unit, positive. Steps walk on the "
        "input's triangles from where a vertex was, so that near sheets (thin walls, rolls) are never mistaken for "
        "each "
        "other; feature curves are followed, their corners kept. The input must be valid; the result is as sound, with "
        "its topology. Lengths become shorter where feature curves lie near one another and where triangles would "
        "cross. Raises InvalidInput, GeometryError, Cancelled.");
    list_options<CloseRemeshOptions>(m, "close_remesh");
    m.def(
        "triangle_qualities",
        [](const TriangleMesh& mesh) {
            return own(run_interruptible([mesh = mesh](Job&) {
                check(mesh);
                return triangle_qualities(mesh);
            }));
        },
        "mesh"_a,
        "(F,) twice the inscribed over the circumscribed radius of each triangle (Gmsh's gamma), in [0, 1]: 1 for "
        "equilateral ones, 0 without area.");
    m.def(
        "winslow_smooth",
        [](const TriangleMesh& surface, const FeatureGraph& features, const ArrayLike& points,
           const ArrayLike& triangles, const ArrayLike& quads, const std::vector<Index>& fixed,
           const std::optional<ProgressCallable>& progress, const py::kwargs& given) {
            const auto [options] = options_of<WinslowOptions>("winslow_smooth", given);
            return run_interruptible(
                [surface = surface, features = features, points = from_python<Points>(points, "points"),
                 triangles = from_python<Triangles>(triangles, "triangles"), quads = from_python<Quads>(quads, "quads"),
                 fixed = fixed, options = options](Job& job) mutable {
                    check(surface);
                    features = ordered_features(std::move(features), surface);
                    return winslow_smooth(surface, features, points, triangles, quads, fixed, options, job.progress());
                },
                progress);
        },
        "surface"_a, "features"_a, "points"_a, py::kw_only(), "triangles"_a = py::list(), "quads"_a = py::list(),
        "fixed"_a = std::vector<Index>(), "progress"_a = py::none(),
        "Moves points, the corners of triangles (t, 3) and quads (q, 4), on a surface so that the integral of (|x_u|^2 "
        "+ "
        "|x_v|^2) / J over cells becomes least, as a WinslowResult (Winslow 1966; without structure: Knupp 1999): "
        "cells "
        "near equilateral triangles and squares, none turned over. Vertices of the cells' boundary, on features and of "
        "fixed stay. Raises InvalidInput, GeometryError, Cancelled.");
    list_options<WinslowOptions>(m, "winslow_smooth");
}

}  // namespace octafield::bindings
