#include "octafield/surface/remesh.hpp"

#include <CGAL/Polygon_mesh_processing/remesh.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "deviation.hpp"
#include "graded_remesh.hpp"
#include "octafield/error.hpp"
#include "octafield/surface/validate.hpp"
#include "remesh_checks.hpp"
#include "short_number.hpp"

namespace octafield::surface {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kShortest = 1. / 16;  // of the wanted length
constexpr double kTurnTold = 15 * std::numbers::pi / 180, kFlattenedTold = 0.05;  // of triangles; a share of the area

// `protect`: feature edges are split once before and then left alone, instead of being split and merged in every round.
void run_rounds(Marked& marked, const PatchTrees& input, double length, int rounds, bool protect,
                const Progress& progress) {
    if (protect) {
        std::vector<Edge> edges;
        for (const Edge edge : marked.mesh.edges())
            if (marked.feature[edge]) edges.push_back(edge);
        pmp::split_long_edges(edges, length, marked.mesh, CGAL::parameters::edge_is_constrained_map(marked.feature));
        number_patches(marked);
    }
    int calls = 0;
    const auto project = [&](Vertex v) {
        if (++calls % 1000 == 0) report_or_throw(progress, "remesh", -1, kNone);
        return input.closest(patch_at(marked, v), marked.mesh.point(v));
    };
    for (int round = 0; round < rounds; ++round) {
        report_or_throw(progress, "remesh", static_cast<double>(round) / rounds, kNone);
        pmp::isotropic_remeshing(marked.mesh.faces(), length, marked.mesh,
                                 CGAL::parameters::number_of_iterations(1)
                                     .edge_is_constrained_map(marked.feature)
                                     .vertex_is_constrained_map(marked.corner)
                                     .face_patch_map(marked.patch)
                                     .protect_constraints(protect)
                                     .projection_functor(project));
    }
}

double expected_triangles(const TriangleMesh& mesh, double length) {
    return triangle_areas(mesh).sum() / (std::numbers::sqrt3 / 4 * length * length);
}

// At which there are so many triangles, or tets inside (12.5 in a cube of one edge length, measured).
double length_for(const TriangleMesh& mesh, double cells, bool closed) {
    const double tets = closed ? 12.5 * std::abs(signed_volume(mesh)) : 0;
    return std::max(std::sqrt(expected_triangles(mesh, 1) / cells), std::cbrt(tets / cells));
}

void require_options(const TriangleMesh& mesh, const RemeshOptions& options) {
    if (options.iterations < 1) throw InvalidInput("remeshing needs at least 1 iteration", "invalid_option");
    if (!(options.edge_length >= 0 && std::isfinite(options.edge_length)))
        throw InvalidInput("the target edge length must be positive, or 0 for lengths that fit the shape",
                           "invalid_option");
    if (!(options.max_cells >= 1 && std::isfinite(options.max_cells)))
        throw InvalidInput("max_cells must be at least 1", "invalid_option");
    if (options.edge_length == 0) return;
    const double expected = expected_triangles(mesh, options.edge_length), most = 5e7;
    if (expected > most)
        throw InvalidInput("a target edge length of " + short_number(options.edge_length) + " would give about " +
                               short_number(expected) + " triangles; choose a larger one",
                           "invalid_option");
}

// A surface between the input and the user.
class Remesher {
public:
    Remesher(const TriangleMesh& mesh, const FeatureGraph& features, const RemeshOptions& options,
             const Progress& progress)
        : mesh_(mesh), features_(features), options_(options), judge_(mesh, features), progress_(progress) {}

    RemeshResult run() {
        RemeshResult result = remeshed();
        const double flattened = turned_share(mesh_, result.mesh, kTurnTold);
        if (flattened > kFlattenedTold)
            result.notes.push_back("on " + short_number(100 * flattened) +
                                   " % of the surface the triangles of the input are turned by more than 15 degrees "
                                   "from those taken: details finer than the edges were flattened");
        return result;
    }

private:
    RemeshResult remeshed() {
        if (options_.edge_length > 0) return of_one_length(options_.edge_length, true);
        const auto alive = [this](double fraction) { report_or_throw(forward(), "remesh", fraction, kNone); };
        GradedResult graded =
            graded_remesh(mesh_, features_, judge_, options_.max_cells, options_.iterations, alive);
        if (!graded.best) {
            RemeshResult result = of_one_length(graded.field.longest, false);
            if (graded.field.scale > 1.05) result.notes.push_back(graded.field.notes.back());
            return result;
        }
        RemeshResult result = std::move(graded.best->result);
        result.notes = std::move(graded.field.notes);
        result.notes.front() = std::move(graded.range);
        result.inner_length = graded.field.longest;
        tell_departure(*graded.best, result, "a shorter edge length or more cells follow it more closely");
        return result;
    }

    RemeshResult of_one_length(double wanted, bool given) {
        std::optional<Attempt> best;
        std::string why;  // lengths longer than the last are worse
        double length = wanted;
        while (true) {
            double next = length / 2;
            if (auto attempt = at_length(length)) {
                best = std::move(attempt);
                const double excess = judge_.excess_of(*best);
                if (given || excess <= 1) break;
                if (why.empty()) why = "follow the surface poorly (" + judge_.departure(*best) + ")";
                next = length * std::clamp(std::sqrt(0.8 / excess), 0.5, 0.9);  // the departure is quadratic in it
            } else if (why.empty()) {
                why = "spoil the surface (" + fault_ + ")";
            }
            next = std::max({next, kShortest * wanted,
                             length_for(mesh_, (best ? 1 : 2) * options_.max_cells, judge_.closed())});
            if (next > 0.95 * length) break;
            length = next;
        }
        if (!best) return kept(wanted, why);
        RemeshResult result = std::move(best->result);
        if (best->length < wanted)
            result.notes.push_back("edges of " + short_number(wanted) + " would " + why + ": those of " +
                                   short_number(best->length) + " were taken");
        tell_departure(*best, result, "a shorter edge length follows it more closely");
        return result;
    }

    void tell_departure(const Attempt& attempt, RemeshResult& result, const std::string& remedy) const {
        if (judge_.excess_of(attempt) > 1)
            result.notes.push_back("the remeshed surface is not quite that of the input: " +
                                   judge_.departure(attempt) + "; " + remedy);
    }

    // None where no sound surface comes of it; fault_ says why.
    std::optional<Attempt> at_length(double length) {
        fault_.clear();
        if (!trees_) trees_.emplace(judge_.input());
        for (const bool protect : {false, true}) {
            try {
                Marked marked = mark(mesh_, features_);
                run_rounds(marked, *trees_, length, options_.iterations, protect, forward());
                if (auto attempt = judge_.judge(marked, length)) return attempt;
                if (fault_.empty()) fault_ = judge_.fault;
            } catch (const CGAL::Failure_exception& failure) {
                if (fault_.empty()) fault_ = failure.what();
            }
        }
        return std::nullopt;
    }

    RemeshResult kept(double wanted, const std::string& why) const {
        return {mesh_,
                features_,
                {"edges of " + short_number(wanted) + " would " + why +
                 ", and so would shorter ones: the triangles of the input were kept"},
                0};
    }

    // Fractions never fall, however many attempts there are.
    Progress forward() {
        if (!progress_) return {};
        return [this](std::string_view phase, double fraction, double merit) {
            if (fraction >= 0) fraction = furthest_ = std::max(furthest_, fraction);
            return progress_(phase, fraction, merit);
        };
    }

    const TriangleMesh& mesh_;
    const FeatureGraph& features_;
    const RemeshOptions& options_;
    RemeshJudge judge_;
    const Progress& progress_;
    std::optional<PatchTrees> trees_;
    std::string fault_;
    double furthest_ = 0;
};

}  // namespace

void require_remeshable(const TriangleMesh& mesh, const FeatureGraph& features) {
    require_valid(mesh, {.closed = false});
    feature_graph(mesh, features.edges);  // throws where they are no edges of the mesh
    for (const Index v : features.corners)
        if (v < 0 || v >= mesh.vertices.rows())
            throw InvalidInput("corner " + std::to_string(v) + " is no vertex of the mesh", "index_out_of_range", {v});
}

double default_edge_length(const TriangleMesh& mesh) { return shape_size(mesh) / 25; }

RemeshResult remesh(const TriangleMesh& mesh, const FeatureGraph& features, const RemeshOptions& options,
                    const Progress& progress) {
    report_or_throw(progress, "remesh", 0, kNone);
    require_remeshable(mesh, features);
    require_options(mesh, options);
    return Remesher(mesh, features, options, progress).run();
}

}  // namespace octafield::surface
