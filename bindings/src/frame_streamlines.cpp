// Curves along the axes of frame fields in tet meshes, and where they begin.
#include "octafield/volume/locate_points.hpp"
#include "octafield/volume/streamlines.hpp"

#include <algorithm>
#include <cmath>

#include "arrays.hpp"
#include "bind.hpp"
#include "domain.hpp"
#include "interruptible.hpp"
#include "octafield/volume/sample_frames.hpp"
#include "record.hpp"
#include "stretch.hpp"

namespace octafield::bindings {

using namespace volume;
using py::literals::operator""_a;

namespace {

void bind_streamline_points(py::module_& m) {
    m.def(
        "locate_points",
        [](const DomainOrMesh& mesh, const ArrayLike& points, int threads) {
            threads_option(threads);
            return run_interruptible([=, rows = from_python<Points>(points, "points")](Job&) {
                const TetDomain domain = domain_of(mesh);
                check_vectors(rows, rows.rows(), "points", "point");
                return locate_points(domain, rows, threads);
            });
        },
        "domain"_a, "points"_a, py::kw_only(), "threads"_a = 0,
        "The tet that holds each of (n, 3) points and its barycentric coordinates there, as "
        "LocatedPoints. Of several tets the one it lies deepest in.");
    m.def(
        "interpolate_frames",
        [](const DomainOrMesh& mesh, const ArrayLike& frames, const ArrayLike& points, double tolerance, int threads) {
            threads_option(threads);
            if (std::isnan(tolerance)) throw InvalidInput("tolerance is not a number", "option_out_of_range");
            return run_interruptible([=, rows = from_python<Quaternions>(frames, "frames"),
                                      at = from_python<Points>(points, "points")](Job&) mutable {
                const TetDomain domain = domain_of(mesh);
                check_unit(rows, domain.vertex_count(), "frames");
                check_vectors(at, at.rows(), "points", "point");
                return sample_frames(domain, rows, at, {.tolerance = tolerance, .threads = threads});
            });
        },
        "domain"_a, "frames"_a, "points"_a, py::kw_only(), "tolerance"_a = SampleOptions{}.tolerance, "threads"_a = 0,
        "What octafield.sample_frames does, on (n, 4) frames at the vertices of a tet mesh and (k, 3) points: their "
        "sh4 "
        "vectors are interpolated linearly in the tet that holds a point, and projected to the nearest frame, as "
        "SampledFrames. tolerance: points no farther outside have the frame of the mesh's nearest point (input unit; "
        "below 0: a millionth of the bounding-box diagonal; infinity: all points).");
    m.def(
        "spread_points",
        [](const DomainOrMesh& mesh, int count) {
            return own(run_interruptible([=](Job&) {
                const TetDomain domain = domain_of(mesh);
                return spread_points(domain, count);
            }));
        },
        "domain"_a, "count"_a,
        "(n, 3): centres of at most `count` tets that fill the mesh evenly, the same at every call "
        "(Poisson disk sampling).");
}

void bind_lines(py::module_& m) {
    const FrameStreamlineOptions defaults;
    m.def(
        "frame_streamlines",
        [](const DomainOrMesh& mesh, const ArrayLike& frames, const ArrayLike& points,
           const std::optional<ArrayLike>& directions, const std::optional<ArrayLike>& stretch, double max_length,
           bool both_ways, double closing_distance, int threads) {
            threads_option(threads);
            const FrameStreamlineOptions options{.max_length = finite(max_length, "max_length"),
                                                 .both_ways = both_ways,
                                                 .closing_distance = finite(closing_distance, "closing_distance")};
            std::optional<Points> along;
            if (directions) along = from_python<Points>(*directions, "directions");
            return run_interruptible([=, rows = from_python<Quaternions>(frames, "frames"),
                                      seeds = from_python<Points>(points, "points"),
                                      stretched = stretch_rows(stretch)](Job&) mutable {
                const TetDomain domain = domain_of(mesh);
                check_unit(rows, domain.vertex_count(), "frames");
                check_vectors(seeds, seeds.rows(), "points", "point");
                if (along) check_vectors(*along, seeds.rows(), "directions", "point");
                return frame_streamlines(
                    domain, rows,
                    along ? seeds_at(domain, seeds, *along) : axis_seeds_at(domain, rows, seeds, stretched), options,
                    threads, stretched);
            });
        },
        "domain"_a, "frames"_a, "points"_a, "directions"_a = py::none(), py::kw_only(), "stretch"_a = py::none(),
        "max_length"_a = defaults.max_length, "both_ways"_a = defaults.both_ways,
        "closing_distance"_a = defaults.closing_distance, "threads"_a = 0,
        "Curves along the axes of (n, 4) frames at the vertices of a tet mesh, as a list of FrameStreamline: one per "
        "point along the axis nearest to its direction, or three, one per axis, where no directions are given. "
        "max_length: input unit, from the seed each way, 0 means 4 times octafield.surface.shape_size; both_ways: "
        "against "
        "the direction as well; closing_distance: a curve that comes back to its seed so near is closed, 0 means a "
        "tenth of an edge. A curve ends at the boundary and a tet before a singular curve that turns its axis. The "
        "same bits at any thread count. stretch: (n, 6) as AxesStretch has it: curves follow the axes S Q. Raises "
        "InvalidInput naming the points outside the mesh.");
}

}  // namespace

void bind_frame_streamline_types(py::module_& m) {
    Record<FrameStreamline>(m, "FrameStreamline", "A curve along an axis of a frame field in its tet mesh.")
        .field("points", &FrameStreamline::points, "(n, 3) float64 points of the polyline.")
        .field("tets", &FrameStreamline::tets,
               "(n - 1,) int32: the tet that the segment from point i to point i + 1 lies in.")
        .field("length", &FrameStreamline::length, "Input unit.")
        .field("first_end", &FrameStreamline::first_end,
               "Why it begins there, a word as last_end; \"seed\": that is its seed.")
        .field("last_end", &FrameStreamline::last_end,
               "Why it ends there: \"boundary\", \"singular\" (the tet ahead is singular for this axis), \"closed\" "
               "(first and last point are the same), \"length\" (max_length reached) or \"stuck\".")
        .finish([](const FrameStreamline& s) {
            return count(s.points.rows(), "point") + ", length " + number(s.length) + ", " + to_word(s.first_end) +
                   " to " + to_word(s.last_end);
        });

    Record<LocatedPoints>(m, "LocatedPoints", "Points and the tets of a mesh that hold them.")
        .field("tet", &LocatedPoints::tet, "(n,) int32; -1: outside the mesh.")
        .field("weights", &LocatedPoints::weights, "(n, 4) float64 barycentric coordinates in the tet; 0 outside.")
        .finish([](const LocatedPoints& p) {
            return count(p.weights.rows(), "point") + ", " +
                   std::to_string(std::count(p.tet.begin(), p.tet.end(), -1)) + " outside";
        });

    Record<SampledFrames>(m, "SampledFrames", "A frame field at points.")
        .field("frames", &SampledFrames::frames,
               "(k, 4) float64 unit quaternions w x y z, NaN outside; of the 24 the nearest to the frame of the tet's "
               "vertex of largest weight.")
        .field("confidence", &SampledFrames::confidence,
               "(k,) float64: norm of the interpolated sh4 vector, 1 where the tet's frames are equal, near 0 at "
               "singular curves, where the frame means little; 0 outside.")
        .field("tet", &SampledFrames::tet, "(k,) int32; -1: outside the mesh.")
        .field("distance", &SampledFrames::distance,
               "(k,) float64, input unit: from the point to the mesh, 0 inside; infinity: outside.")
        .finish([](const SampledFrames& s) {
            return count(s.frames.rows(), "frame") + ", " + std::to_string(std::count(s.tet.begin(), s.tet.end(), -1)) +
                   " outside";
        });
}

void bind_frame_streamlines(py::module_& m) {
    bind_streamline_points(m);
    bind_lines(m);
}

}  // namespace octafield::bindings
