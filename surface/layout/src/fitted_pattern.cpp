#include "octafield/surface/fitted_pattern.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "face_layouts.hpp"
#include "far_triangles.hpp"
#include "layout_input.hpp"
#include "octafield/error.hpp"

namespace octafield::surface {
namespace {

using detail::Face;

constexpr int most_steps = 6;        // of Newton's method, for points that are tried
constexpr double nothing = 1e-6;     // of quads
constexpr double short_part = 0.25;  // of the length curves may have: those that run round and round are no help
const Eigen::Vector3d middle = Eigen::Vector3d::Constant(1.0 / 3);

// Points on the boundary stay: a corner is there.
bool on_boundary(const SurfaceDomain& domain, const ImposedPoint& point) {
    for (int k = 0; k < 3; ++k) {
        const Index edge = domain.topology().triangle_edges(point.triangle, k);
        if (point.weights[(k + 2) % 3] == 0 && domain.topology().edge_triangles.row(edge).minCoeff() < 0) return true;
    }
    return false;
}

struct Candidate {
    SingularPattern pattern;
    bool added;
    std::size_t point;  // moved, or the first of the pair
};

class Fitter {
public:
    Fitter(std::vector<Face>& faces, const detail::FaceTracing& tracing, const FittingOptions& options,
           const Progress& progress)
        : faces_(faces), tracing_(tracing), options_(options), progress_(progress) {}

    void run(FittedPattern& result) {
        constexpr double infinite = std::numeric_limits<double>::infinity();
        bool broken = false;
        for (std::size_t f = 0; f < faces_.size(); ++f) {
            if (faces_[f].layout || (faces_[f].layout = as_given(faces_[f]))) continue;
            result.before = infinite;
            broken = true;
        }
        for (std::size_t f = 0; f < faces_.size() && broken; ++f) {
            if (faces_[f].layout) continue;
            now_.missing = result.left = infinite;
            if (!improve_face(f, 0, result)) return;
        }
        now_ = detail::fit_of(faces_, options_.edge_length);
        if (!broken) result.before = now_.missing;
        while (now_.missing > 0 && improve(result)) now_ = detail::fit_of(faces_, options_.edge_length);
        result.left = now_.missing;
    }

private:
    bool improve(FittedPattern& result);
    bool improve_face(std::size_t f, double share, FittedPattern& result);
    std::vector<Candidate> candidates(const Face& face) const;
    std::optional<QuadLayout> as_given(Face& face) const { return layout_of(face, face.pattern, 1); }
    std::optional<QuadLayout> layout_of(const Face& face, SingularPattern& pattern, double part) const;
    bool enough() const { return tried_ >= options_.most_tried || triangles_ > options_.most_triangles; }

    std::vector<Face>& faces_;
    const detail::FaceTracing& tracing_;
    const FittingOptions& options_;
    const Progress& progress_;
    detail::Fit now_;
    int tried_ = 0;
    double triangles_ = 0;  // of faces that were tried
};

// A change of the first face that has one, by part of the shortage.
bool Fitter::improve(FittedPattern& result) {
    std::vector<std::pair<double, std::size_t>> order;
    auto at = now_.shortages.begin();
    for (std::size_t f = 0; f < faces_.size(); ++f) {
        const auto end = at + static_cast<std::ptrdiff_t>(faces_[f].layout->sides.size());
        const double share = std::accumulate(at, end, 0.0);
        if (share > nothing) order.emplace_back(-share, f);
        at = end;
    }
    std::sort(order.begin(), order.end());
    return std::any_of(order.begin(), order.end(),
                       [&](const auto& next) { return improve_face(next.second, -next.first, result); });
}

// The change that leaves least missing and then deviates least, up to a few after the first one that ends the face's
// own part of the shortage.
bool Fitter::improve_face(std::size_t f, double share, FittedPattern& result) {
    Face& face = faces_[f];
    double missing = now_.missing - 2 * nothing, deviation = 0;
    std::optional<QuadLayout> best;
    Candidate taken;
    int more = options_.more_tried;
    for (Candidate& candidate : candidates(face)) {
        const bool ended = best && (!face.layout || missing <= now_.missing - share + nothing);
        if (enough() || (ended && more-- == 0)) break;
        report_or_throw(progress_, "fit", -1, missing);
        result.tried = ++tried_;
        triangles_ += face.domain.triangle_count();
        std::optional<QuadLayout> layout = layout_of(face, candidate.pattern, short_part);
        if (!layout) continue;
        const detail::Fit fit = detail::fit_of(faces_, options_.edge_length, &*layout, f);
        if (fit.missing > missing + nothing) continue;
        if (best && fit.missing > missing - nothing && fit.deviation >= deviation) continue;
        missing = fit.missing;
        deviation = fit.deviation;
        best = std::move(layout);
        taken = std::move(candidate);
    }
    if (!best) return false;
    face.layout = std::move(best);
    face.pattern = std::move(taken.pattern);
    const auto at = face.pattern.points.begin() + static_cast<std::ptrdiff_t>(taken.point);
    const int count = taken.added ? 2 : 1;
    PatternChange change{face.triangles[0], taken.added, Points(count, 3)};
    for (int i = 0; i < count; ++i) change.positions.row(i) = imposed_position(face.domain, at[i]);
    result.changes.push_back(std::move(change));
    return true;
}

std::vector<Candidate> Fitter::candidates(const Face& face) const {
    const std::vector<Index> places = detail::far_triangles(face.domain, options_.places);
    const auto& points = face.pattern.points;
    std::vector<Candidate> result;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (points[i].index_times_four == 0 || on_boundary(face.domain, points[i])) continue;
        for (const Index place : places) {
            result.push_back({face.pattern, false, i});
            result.back().pattern.points[i] = {place, middle, points[i].index_times_four};
        }
    }
    for (const Index first : places)
        for (const Index second : places) {
            if (first == second) continue;
            result.push_back({face.pattern, true, points.size()});
            result.back().pattern.points.push_back({first, middle, 1});
            result.back().pattern.points.push_back({second, middle, -1});
        }
    return result;
}

// None where no field has the points there, or its curves make no quads.
std::optional<QuadLayout> Fitter::layout_of(const Face& face, SingularPattern& pattern, double part) const {
    detail::FaceTracing quick = tracing_;
    quick.curves.max_length *= part;
    const auto made = [&]() -> std::optional<QuadLayout> {
        try {
            return detail::traced(face, pattern, quick, {});
        } catch (const InvalidInput&) {
        } catch (const GeometryError&) {
        } catch (const SolverError&) {
        }
        return {};
    };
    if (part == 1) return made();
    quick.imposing.max_steps = std::min(quick.imposing.max_steps, most_steps);
    if (tracing_.imposing.inadmissible != Inadmissible::rotate) return made();
    // Curves of fields that are rotated far run into one another.
    quick.imposing.inadmissible = Inadmissible::move;
    if (auto moved = made()) return moved;
    quick.imposing.inadmissible = Inadmissible::rotate;
    return made();
}

// Of the whole surface.
SingularPattern pattern_of(const std::vector<Face>& faces, const std::vector<CornerQuads>& corners) {
    SingularPattern result{{}, corners};
    for (const Face& face : faces)
        for (ImposedPoint point : face.pattern.points) {
            point.triangle = face.triangles[point.triangle];
            result.points.push_back(point);
        }
    return result;
}

}  // namespace

FittedPattern fitted_pattern(const SurfaceDomain& domain, const SingularPattern& pattern,
                             const std::vector<Index>& origins, const ImposedFieldOptions& imposing,
                             const LayoutCurveOptions& curves, const FittingOptions& options,
                             const Progress& progress) {
    if (static_cast<Index>(origins.size()) != domain.vertex_count())
        throw InvalidInput("each vertex of the surface needs an origin", "bad_option");
    if (!curves.cut_vertices.empty()) throw InvalidInput("fitting takes no cuts of its own", "bad_option");
    if (!(options.edge_length > 0) || options.places < 1 || options.most_tried < 0 || options.more_tried < 0 ||
        !(options.most_triangles >= 0))
        throw InvalidInput(
            "fitting needs an edge length above 0, a place at least, and numbers to be tried of at least 0",
            "bad_option");
    // Refuses points and corners that are not on the surface; sizes as of the whole.
    const ImposedField whole = impose_singular_points(domain, pattern, imposing, progress);
    std::vector<Face> faces = detail::faces_of(domain, {whole.pattern.points, pattern.corners}, origins);
    detail::FaceTracing tracing{imposing, curves};
    const detail::LayoutInput sizes(whole, curves, true);
    tracing.curves.end_tolerance = sizes.end_tolerance;
    tracing.curves.max_length = sizes.max_length;
    FittedPattern result;
    Fitter(faces, tracing, options, progress).run(result);
    result.pattern = pattern_of(faces, pattern.corners);
    return result;
}

SingularPattern moved_by_faces(const SurfaceDomain& domain, const SingularPattern& pattern,
                               const ImposedFieldOptions& options, const Progress& progress) {
    std::vector<Index> own(domain.vertex_count());
    std::iota(own.begin(), own.end(), 0);
    ImposedFieldOptions moving = options;
    moving.inadmissible = Inadmissible::rotate;  // refuses points and corners that are not on the surface
    std::vector<Face> faces = detail::faces_of(
        domain, {impose_singular_points(domain, pattern, moving, progress).pattern.points, pattern.corners}, own);
    moving.inadmissible = Inadmissible::move;
    for (Face& face : faces) {
        report_or_throw(progress, "move", -1, NAN);
        if (face.pattern.points.empty()) continue;
        try {
            face.pattern.points = impose_singular_points(face.domain, face.pattern, moving).pattern.points;
        } catch (const SolverError&) {
        }
    }
    return pattern_of(faces, pattern.corners);
}

}  // namespace octafield::surface
