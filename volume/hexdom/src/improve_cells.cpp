#include <algorithm>
#include <utility>
#include <vector>

#include "improve_setup.hpp"
#include "octafield/parallel.hpp"
#include "octafield/volume/cell_quality.hpp"
#include "surface_fit.hpp"
#include "vertex_moves.hpp"

namespace octafield::volume {
namespace {

using detail::Incidence;
using detail::Move;
using detail::Slide;
using detail::SurfaceGuide;
using detail::VertexCells;
using detail::VertexStar;
using Kind = VertexSupport::Kind;
using Vector = Eigen::Vector3d;

constexpr double flat = 1e-14;       // qualities up to this are those of flat corners, rounded
constexpr double resting = 1e-3;     // moves shorter than this part of the edges wake no neighbours
constexpr double on_surface = 1e-9;  // distance from the surface, in edges, that is rounding
constexpr int untangling_sweeps = 30;
constexpr int following_sweeps = 5;  // of vertices inside after those of the surface were fitted to it
constexpr int patience = 4;          // sweeps of untangling without fewer inverted cells
constexpr double other_rank = 2.5;   // of tets and pyramids, see ImproveOptions::hexahedra_first
constexpr std::int64_t grain = 64;   // vertices worth a thread

class Improver {
public:
    Improver(MixedMesh& mesh, VertexSupport kinds, const SurfaceGuide* guide, const ImproveOptions& options)
        : mesh_(mesh),
          support_(std::move(kinds)),
          guide_(guide),
          options_(options),
          cells_(mesh),
          colours_(detail::colours(mesh, cells_, support_)),
          place_(mesh.vertices.rows()),
          moved_(mesh.vertices.rows()) {
        parallel_for(mesh.vertices.rows(), options.threads, [&](std::int64_t v) {
            if (support_.kind[v] == Kind::surface) place_[v] = guide->nearest_on_surface(mesh.vertices.row(v));
            if (support_.kind[v] == Kind::curve) place_[v] = guide->nearest_on_curves(mesh.vertices.row(v));
        });
        start_lowest_ = lowest();
        floor_ = std::max(options.good, start_lowest_);
    }

    // Smoothing raises most of the low qualities by itself, and in a better balance: raising comes in the second half
    // of the sweeps. What is left tangled gets further tries once the cells round it are better.
    void run() {
        std::size_t inverted = inverted_cells().size(), before = 0;
        do {
            before = inverted;
            if (inverted > 0) untangle_cells();
            const std::vector<bool> all(mesh_.vertices.rows(), true);
            raising_ = false;
            sweep(all, options_.sweeps - options_.sweeps / 2);
            raising_ = true;
            sweep(all, options_.sweeps / 2);
            inverted = inverted_cells().size();
        } while (inverted > 0 && inverted < before / 2);
        if (options_.fit_surface && guide_ != nullptr && guide_->has_triangles()) fit_surface();
    }

private:
    void sweep(std::vector<bool> awake, int most) {
        for (int k = 0; k < most; ++k) {
            visit_all(awake, [&](Index v) { improve(v); });
            if (!wake(awake)) break;
        }
    }

    // Vertices inside follow; those of the surface would slide back on it.
    void fit_surface() {
        const detail::SurfaceFit fit(mesh_, support_, *guide_, place_, options_.threads);
        const Points before = mesh_.vertices, steps = fit.steps(before);
        for (Index v = 0; v < steps.rows(); ++v)
            if (support_.kind[v] == Kind::surface && !steps.row(v).isZero(0)) offset(v, steps.row(v));
        if (!(fit.misfit(mesh_.vertices) < fit.misfit(before))) {
            mesh_.vertices = before;
            return;
        }
        inside_only_ = true;
        sweep(std::vector<bool>(mesh_.vertices.rows(), true), std::min(options_.sweeps, following_sweeps));
    }

    // As much of the step as the tolerance and the cells allow.
    void offset(Index v, Vector step) {
        VertexStar star;
        star.set(mesh_, cells_, v, options_.hexahedra_first);
        if (step.norm() > options_.tolerance) step *= options_.tolerance / step.norm();
        const double lowest = star.lowest(Vector::Zero());
        const Vector start = mesh_.vertices.row(v);
        const double most = std::max(options_.tolerance, (place_[v].point - start).norm());
        for (int halvings = 0; halvings < 3; ++halvings, step /= 2) {
            const double bound = std::min(lowest, floor_);
            if (star.lowest(step, bound) < bound) continue;
            if ((guide_->nearest_in_patch(start + step, place_[v]).point - start - step).norm() > most) continue;
            mesh_.vertices.row(v) = start + step;
            return;
        }
    }

    double lowest() const { return scaled_jacobians(mesh_).minCoeff(); }

    // visit(v) for those awake, colour by colour: what is written of one is not read for another.
    template <class Visit>
    void visit_all(const std::vector<bool>& awake, const Visit& visit) {
        std::ranges::fill(moved_, 0.0);
        std::vector<Index> turn;
        for (const std::vector<Index>& colour : colours_) {
            turn.clear();
            std::ranges::copy_if(colour, std::back_inserter(turn),
                                 [&](Index v) { return awake[v] && !(inside_only_ && slides(v)); });
            parallel_for(
                static_cast<std::int64_t>(turn.size()), options_.threads, [&](std::int64_t i) { visit(turn[i]); },
                grain);
        }
    }

    // Those that moved and all that share a cell with them. False if none.
    bool wake(std::vector<bool>& awake) const {
        awake.assign(awake.size(), false);
        bool any = false;
        for (Index v = 0; v < mesh_.vertices.rows(); ++v) {
            if (!(moved_[v] > resting)) continue;
            any = true;
            for (const Incidence& at : cells_.of(v))
                for (const Index other : detail::cell_vertices(mesh_, at.cell)) awake[other] = true;
        }
        return any;
    }

    std::vector<Index> inverted_cells() const {
        const Eigen::VectorXd qualities = scaled_jacobians(mesh_);
        std::vector<Index> found;
        for (Index c = 0; c < qualities.size(); ++c)
            if (!(qualities[c] > flat)) found.push_back(c);
        return found;
    }

    // Single moves until no fewer cells get inverted; the best there was.
    void untangle_cells() {
        std::vector<Index> bad = inverted_cells();
        Points best = mesh_.vertices;
        std::size_t fewest = bad.size();
        std::vector<SurfaceGuide::Place> best_places = place_;
        for (int sweep = 0, idle = 0; sweep < untangling_sweeps && idle < patience && !bad.empty(); ++sweep) {
            std::vector<bool> awake(mesh_.vertices.rows());
            for (const Index c : bad)
                for (const Index v : detail::cell_vertices(mesh_, c)) awake[v] = true;
            visit_all(awake, [&](Index v) { untangle_vertex(v); });
            bad = inverted_cells();
            ++idle;
            if (bad.size() >= fewest) continue;
            fewest = bad.size(), best = mesh_.vertices, best_places = place_, idle = 0;
        }
        mesh_.vertices = best;
        place_ = best_places;
    }

    Slide slide(Index v) const {
        const Slide::Along along = support_.kind[v] == Kind::surface ? Slide::Along::patch
                                   : support_.kind[v] == Kind::curve ? Slide::Along::curve
                                                                     : Slide::Along::space;
        return {guide_, along, mesh_.vertices.row(v), place_[v]};
    }
    bool slides(Index v) const { return support_.kind[v] != Kind::inside; }

    void accept(Index v, const Move& move, double size) {
        if (move.x.isZero(0)) return;
        const Vector start = mesh_.vertices.row(v);
        // To the bit where it is of the piece: sums of differences are rounded.
        const bool on_piece = slides(v) && move.place.point - start == move.x;
        mesh_.vertices.row(v) = on_piece ? move.place.point : Vector(start + move.x);
        place_[v] = move.place;
        moved_[v] = move.x.norm() / size;
    }

    void untangle_vertex(Index v) {
        static thread_local VertexStar star;
        star.set(mesh_, cells_, v, options_.hexahedra_first);
        const Slide way = slide(v);
        Move move{Vector::Zero(), place_[v]};
        if (!(star.size() > 0) || star.lowest(move.x) > flat) return;
        detail::untangle(star, way, move);
        if (star.lowest(move.x) > 0) detail::raise_lowest(star, way, move);
        accept(v, move, star.size());
    }

    void improve(Index v) {
        static thread_local VertexStar star;
        star.set(mesh_, cells_, v, options_.hexahedra_first);
        if (!(star.size() > 0)) return;
        Slide way = slide(v);
        Move move{Vector::Zero(), place_[v]};
        if (way.distance() > std::max(options_.tolerance, on_surface * star.size()))
            detail::snap(star, way, move, std::max(start_lowest_, options_.good / 2));
        const double lowest = star.lowest(move.x);
        if (lowest <= flat || (raising_ && lowest < options_.good)) detail::raise_lowest(star, way, move);
        // At the floor itself smoothing may be barred for ever.
        const auto result = detail::smooth(star, way, move, floor_);
        if (raising_ && result == detail::Smoothed::barred) detail::raise_lowest(star, way, move);
        accept(v, move, star.size());
    }

    MixedMesh& mesh_;
    VertexSupport support_;
    const SurfaceGuide* guide_;
    const ImproveOptions& options_;
    VertexCells cells_;
    std::vector<std::vector<Index>> colours_;
    std::vector<SurfaceGuide::Place> place_;  // of vertices that slide
    std::vector<double> moved_;               // in the last sweep, in edges at the vertex
    bool inside_only_ = false;                // those on the surface rest
    bool raising_ = false;                    // of qualities below options_.good
    double start_lowest_, floor_;             // quality: least at the start; smoothing lets none fall below this
};

}  // namespace

MixedMesh improve_cells(MixedMesh mesh, const VertexSupport& support, const surface::TriangleMesh& surface,
                        const surface::FeatureGraph& features, const ImproveOptions& options) {
    detail::require_options(options);
    detail::require_vertices(mesh, support);
    const Eigen::VectorXd before = scaled_jacobians(mesh);
    const auto guide = detail::guide_for(support, surface, features);
    if (mesh.cell_count() == 0) return mesh;
    MixedMesh better = mesh;
    const double rounding = on_surface * surface::bounding_box_diagonal(surface.vertices);
    Improver(better, guide ? detail::settled(support, mesh.vertices, *guide, rounding, options.threads) : support,
             guide.get(), options)
        .run();
    // Steps are guarded corner by corner; a pyramid's quality folds back above 1, which they do not see.
    const double lowest = before.minCoeff();
    // What may fall: nothing, or with hexahedra first other cells down to what counts as good.
    const double least = options.hexahedra_first ? std::min(lowest, options.good / other_rank) : lowest;
    return lowest > flat && scaled_jacobians(better).minCoeff() < least - 1e-12 ? mesh : better;
}

}  // namespace octafield::volume
