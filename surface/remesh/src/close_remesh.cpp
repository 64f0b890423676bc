#include "octafield/surface/close_remesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>

#include "better_triangles.hpp"
#include "departure.hpp"
#include "expected_vertices.hpp"
#include "local_moves.hpp"
#include "narrow_corners.hpp"
#include "octafield/error.hpp"
#include "octafield/surface/remesh.hpp"
#include "octafield/surface/validate.hpp"
#include "remesh_checks.hpp"
#include "remesh_judge.hpp"
#include "short_number.hpp"
#include "stubs.hpp"

namespace octafield::surface {
namespace {

using Vector = Eigen::Vector3d;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr int kTries = 15, kMoreTries = 6, kCounts = 8, kMendings = 20;
constexpr double kLess = 0.8;  // of what was wrong in the attempt before: it becomes better
constexpr int kPursued = 3;    // attempts that crossed: no more vertices are saved elsewhere for those that it takes
constexpr double kCountWithin = 0.02;      // of the number of vertices wanted, and of the mean length
constexpr Index kEnoughEdges = 30;         // for a mean
constexpr double kMore = 0.05;             // quality that is aimed at above the one asked for
constexpr double kWhereCrossing = 0.6;     // lengths there, of those before
constexpr double kShortestPart = 1. / 64;  // of the longest
constexpr double kBeside = 1. / 8;         // of the shortest: between feature curves, and where triangles cross
constexpr double kAnyTurn = 1e9;           // radians along an edge of a feature curve
constexpr double kWithin = 0.9;            // of the deviation asked for: there are points between those looked at
constexpr double kSag = 1. / 6;  // curvature times squared length: between a sphere and its triangles' middles

void require_options(const TriangleMesh& mesh, const Eigen::VectorXd& lengths, const CloseRemeshOptions& options) {
    if (lengths.size() != mesh.vertices.rows())
        throw InvalidInput("there are " + std::to_string(lengths.size()) + " lengths for " +
                               std::to_string(mesh.vertices.rows()) + " vertices; give one each",
                           "wrong_shape");
    for (Index v = 0; v < lengths.size(); ++v)
        if (!(lengths[v] > 0 && std::isfinite(lengths[v])))
            throw InvalidInput("the length at vertex " + std::to_string(v) + " is not positive; give positive lengths",
                               "invalid_option", {v});
    if (options.iterations < 1) throw InvalidInput("remeshing needs at least 1 iteration", "invalid_option");
    for (const double number : {options.vertices, options.deviation})
        if (!(number >= 0 && std::isfinite(number)))
            throw InvalidInput("vertices and deviation must not be negative (0: not asked for)", "invalid_option");
    if (!(options.quality >= 0 && options.quality <= 0.5))
        throw InvalidInput("quality must be in [0, 0.5]; more cannot be reached everywhere", "invalid_option");
    if (!(options.max_vertices >= 1 && std::isfinite(options.max_vertices)))
        throw InvalidInput("max_vertices must be at least 1", "invalid_option");
}

class CloseRemesher {
public:
    CloseRemesher(const TriangleMesh& mesh, const FeatureGraph& features, const CloseRemeshOptions& options,
                  const Progress& progress)
        : mesh_(mesh), features_(features), options_(options), progress_(progress), judge_(mesh, features) {}

    CloseRemeshResult run(const Eigen::VectorXd& lengths) {
        if (!options_.keep_stubs) stubs_ = without_stubs(mesh_, features_, scale_of(lengths) * lengths);
        plan(lengths);
        CloseRounds rounds(ground_);
        std::optional<Working> work;
        begin(work, rounds);
        for (int attempt = 0; attempt < kTries + kMoreTries; ++attempt) {
            begun_ = static_cast<double>(attempt + 1) / (kTries + kMoreTries + 1);
            meet_count(*work, rounds);
            meet_lengths(*work, rounds);
            better_triangles(*work, rounds, options_.quality + kMore, kMendings, [&] { alive()(0); });
            const Places places = places_of(*work, rounds, attempt + 1 >= kTries);
            if (places.empty()) break;
            if (!make_shorter(places)) {
                places_of(*work, rounds, true);  // as it is
                break;
            }
            if (stuck_) {
                begin(work, rounds);
            } else {
                rounds.take_lengths(*work);
                rounds.run(*work, 3, alive());
            }
        }
        if (!best_) return kept();
        tell();
        best_->stubs = stubs_;
        return std::move(*best_);
    }

private:
    double scale_of(const Eigen::VectorXd& lengths) const {
        return options_.vertices > 0 ? std::sqrt(vertices_at(mesh_, lengths) / options_.vertices) : 1;
    }

    // From the input's triangles. What coarse triangles have lost, as a slit that they bridge, comes back only from
    // them.
    void begin(std::optional<Working>& work, CloseRounds& rounds) {
        work.emplace(ground_.mesh, ground_.features);
        rounds.begin(*work);
        rounds.run(*work, options_.iterations, alive());
    }

    void plan(const Eigen::VectorXd& lengths) {
        const double scale = scale_of(lengths);
        const double longest = scale * lengths.maxCoeff();
        ground_ = background_of(mesh_, features_, scale * lengths, longest,
                                std::min(kShortestPart * longest, scale * lengths.minCoeff()));
        const Eigen::VectorXd given = ground_.length;
        if (options_.deviation > 0) bound_by_deviation();
        const auto bound = (ground_.length.array() < given.array()).eval();
        if (!options_.keep_stubs)
            narrow_ = let_go_narrow_corners(
                ground_, options_.deviation > 0 ? options_.deviation / 2 : deviation_told * shape_size(mesh_));
        ground_.shortest *= kBeside;
        bound_by_curves(ground_, kAnyTurn, 0);  // triangles of good shape need short edges beside short ones
        bound_by_strips(ground_, 0);
        bound_by_near_features(ground_);
        limit_growth(ground_, SizeFieldOptions{}.growth);
        most_ = Eigen::VectorXd::Constant(ground_.length.size(), std::numeric_limits<double>::infinity());
        if (options_.vertices == 0) most_ = bound.select(ground_.length, most_);
    }

    bool too_many() const { return vertices_at(ground_.mesh, ground_.length) > options_.max_vertices; }

    void bound_by_deviation() {
        for (Index t = 0; t < ground_.mesh.triangles.rows(); ++t) {
            const double fitting = std::sqrt(0.8 * options_.deviation / (kSag * ground_.bend[t]));
            for (const Index v : ground_.mesh.triangles.row(t))
                ground_.length[v] = std::min(ground_.length[v], std::max(ground_.shortest, fitting));
        }
        while (too_many()) ground_.length *= 1.1;  // noise; what is measured lowers them again where it matters
    }

    void meet_count(Working& work, CloseRounds& rounds) {
        if (options_.vertices == 0) return;
        for (int k = 0; k < kCounts; ++k) {
            const double ratio = work.marked.mesh.number_of_vertices() / options_.vertices;
            if (std::abs(ratio - 1) <= kCountWithin || (ratio > 1 && crossed_ >= kPursued)) return;
            scale_lengths(std::clamp(std::sqrt(ratio), 0.5, 2.));
            rounds.take_lengths(work);
            rounds.run(work, 2, alive());
        }
    }

    // Rounds that only split what is long and collapse what is short leave edges of 0.75 to 1 lengths, by the input's
    // triangles: all lengths are multiplied until edges are as long as wanted in the mean.
    void meet_lengths(Working& work, CloseRounds& rounds) {
        if (options_.vertices > 0) return;
        for (int k = 0; k < kCounts; ++k) {
            const double ratio = mean_ratio(work) * given_;
            if (std::abs(ratio - 1) <= kCountWithin) return;
            const double by = std::clamp(1 / ratio, 0.8, 1.25);
            given_ *= by;
            scale_lengths(by);
            rounds.take_lengths(work);
            rounds.run(work, 2, alive());
        }
    }

    // Of edges away from features to the lengths they follow, where nothing asked for shorter ones; such that it is one
    // where there are too few.
    double mean_ratio(const Working& work) const {
        const SurfaceMesh& mesh = work.marked.mesh;
        const auto held = [&](Vertex v) {
            return kind_of(work, v) != free_vertex || std::ranges::any_of(beneath(work, v), [&](Index w) {
                       return std::isfinite(most_[w]) && ground_.length[w] >= most_[w];
                   });
        };
        double sum = 0;
        Index count = 0;
        for (const Edge e : mesh.edges()) {
            if (held(mesh.vertex(e, 0)) || held(mesh.vertex(e, 1))) continue;
            sum += work.ratio(e);
            ++count;
        }
        return count < kEnoughEdges ? 1 / given_ : sum / static_cast<double>(count);
    }

    // Vertices of the background round where one is.
    std::vector<Index> beneath(const Working& work, Vertex v) const {
        const Carrier at = work.carrier[v];
        const auto listed = [](const auto& row) { return std::vector<Index>(row.begin(), row.end()); };
        if (at.on == Carrier::On::segment) return listed(ground_.features.edges.row(at.id));
        if (at.on == Carrier::On::triangle) return listed(ground_.mesh.triangles.row(at.id));
        return {at.id};
    }

    // Those that had to become shorter stay so.
    void scale_lengths(double by) {
        ground_.length = (by * ground_.length).cwiseMin(most_);
        if (by < 1) ground_.shortest *= by;
        if (by > 1 && std::isfinite(most_.minCoeff())) limit_growth(ground_, SizeFieldOptions{}.growth);
    }

    bool make_shorter(const Places& places) {
        const Eigen::VectorXd before = ground_.length;
        if (!lower(ground_, places)) return false;
        most_ = (ground_.length.array() < before.array()).select(ground_.length, most_);
        return true;
    }

    // Whether the surface has come no nearer since the last time.
    static bool stuck(double wrong, double& before) {
        const bool is = wrong > kLess * before;
        before = is ? std::numeric_limits<double>::infinity() : wrong;
        return is;
    }

    // Where lengths must become shorter. Takes the mesh where it follows the input, or as it is where it shall be the
    // last, if it is sound.
    Places places_of(Working& work, CloseRounds& rounds, bool last) {
        const double told = kWithin * options_.deviation;
        Departure own = departure_of_mesh(work, rounds, ground_, told),
                  of_input = departure_of_input(mesh_, ground_, work, told);
        const double most = std::max(own.most, of_input.most);
        if (told > 0 && most > told && !last && !too_many()) {
            std::ranges::move(of_input.places, std::back_inserter(own.places));
            stuck_ = stuck(most, most_before_);
            return own.places;
        }
        auto found = judge_.sound(work.marked);
        if (!found) {
            stuck_ = true;
            ++crossed_;
            return places_of_crossings(work);
        }
        best_.emplace();
        best_->mesh = std::move(found->mesh);
        best_->features = std::move(found->features);
        best_->deviation = of_input.most;
        best_->own_deviation = own.most;
        best_->off_surface = surface::off_surface(work, ground_);
        count_poor(work, *best_);
        return {};
    }

    Places places_of_crossings(const Working& work) {
        if (fault_.empty()) fault_ = judge_.fault;
        Places places;
        for (const Index t : judge_.crossing)
            for (const Vertex v : CGAL::vertices_around_face(work.marked.mesh.halfedge(Face(t)), work.marked.mesh))
                for (const Index w : beneath(work, v)) places.emplace_back(w, kWhereCrossing);
        return places;
    }

    void count_poor(const Working& work, CloseRemeshResult& result) {
        const SurfaceMesh& mesh = work.marked.mesh;
        for (const Face f : mesh.faces()) {
            if (quality_of(work, f) >= options_.quality) continue;
            ++result.poor;
            int features = 0;
            for (const HalfEdgeOf h : CGAL::halfedges_around_face(mesh.halfedge(f), mesh))
                features += work.marked.feature[mesh.edge(h)];
            result.forced += features >= 2;
        }
    }

    void tell() {
        std::vector<std::string>& notes = best_->notes;
        if (!fault_.empty())
            notes.push_back("edges are shorter than wanted where they would spoil the surface (" + fault_ + ")");
        const double most = std::max(best_->deviation, best_->own_deviation);
        if (options_.deviation == 0 && most > deviation_told * shape_size(mesh_))
            notes.push_back("the new surface departs from the input by up to " + short_number(most) +
                            ": shorter edges, or a deviation that is asked for, follow it more closely");
        if (options_.deviation > 0 && most > options_.deviation)
            notes.push_back("the new surface departs from the input by up to " + short_number(most) + ", more than " +
                            short_number(options_.deviation) + ": more vertices follow it more closely");
        if (stubs_.rows() > 0)
            notes.push_back(std::to_string(stubs_.rows()) +
                            " feature edges, of curves that end inside the surface and are "
                            "shorter than two edges, were not followed");
        if (narrow_ > 0)
            notes.push_back(
                "where feature curves meet at less than 12 degrees, one of the two is not followed until "
                "they are apart (" +
                std::to_string(narrow_) + " times)");
        const double count = static_cast<double>(best_->mesh.vertices.rows());
        if (options_.vertices > 0 && std::abs(count / options_.vertices - 1) > 0.05) notes.push_back(why_not(count));
        const Index free = best_->poor - best_->forced;
        if (best_->forced > 0)
            notes.push_back(std::to_string(best_->forced) + " triangles of a quality below " +
                            short_number(options_.quality) + " lie in corners of the input between two feature edges");
        if (free > 0)
            notes.push_back(std::to_string(free) + " triangles have a quality below " + short_number(options_.quality) +
                            ", and no local step makes them better without leaving the surface or its features");
    }

    std::string why_not(double count) const {
        std::set<Index> on_features(best_->features.corners.begin(), best_->features.corners.end());
        const std::size_t corners = on_features.size();
        for (const auto edge : best_->features.edges.rowwise()) on_features.insert(edge.begin(), edge.end());
        std::string note = short_number(count) + " vertices were made, and the number wanted cannot be met: ";
        if (!on_features.empty())
            note += std::to_string(corners) + " are corners and " + std::to_string(on_features.size() - corners) +
                    " on feature curves, and ";
        return note + (count > options_.vertices
                           ? "fewer would cross, turn triangles over or make them worse"
                           : "more could not be placed without turning triangles over or making them worse");
    }

    CloseRemeshResult kept() const {
        CloseRemeshResult result;
        result.mesh = mesh_;
        result.features = features_;
        result.kept = true;
        result.notes.push_back("no sound surface was found at these lengths (" + fault_ +
                               "): the triangles of the input were kept");
        return result;
    }

    std::function<void(double)> alive() const {
        return [this](double) { report_or_throw(progress_, "remesh", begun_, kNone); };
    }

    const TriangleMesh& mesh_;
    FeatureGraph features_;
    Edges stubs_{0, 2};
    const CloseRemeshOptions& options_;
    const Progress& progress_;
    RemeshJudge judge_;
    Background ground_;
    std::optional<CloseRemeshResult> best_;
    Eigen::VectorXd most_;  // (V) of the background: lengths that had to become shorter, else infinite
    int narrow_ = 0, crossed_ = 0;
    bool stuck_ = false;
    double most_before_ = std::numeric_limits<double>::infinity();
    std::string fault_;  // of the first attempt that was unsound
    double begun_ = 0;
    double given_ = 1;  // lengths that rounds follow, of those wanted
};

}  // namespace

CloseRemeshResult close_remesh(const TriangleMesh& mesh, const FeatureGraph& features, const Eigen::VectorXd& lengths,
                               const CloseRemeshOptions& options, const Progress& progress) {
    report_or_throw(progress, "remesh", 0, kNone);
    require_remeshable(mesh, features);
    require_options(mesh, lengths, options);
    require_possible(mesh, features, lengths, options);
    return CloseRemesher(mesh, features, options, progress).run(lengths);
}

}  // namespace octafield::surface
