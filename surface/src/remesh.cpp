#include "octafield/surface/remesh.hpp"

#include <CGAL/Polygon_mesh_processing/remesh.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <sstream>

#include "marked_surface.hpp"
#include "octafield/error.hpp"
#include "octafield/surface/validate.hpp"
#include "shells.hpp"
#include "short_number.hpp"

namespace octafield::surface {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kVolumeTold = 0.01;                      // relative change of the volume that a default length may make
constexpr double kShortest = 1. / 16;                     // of the wanted length
constexpr double kCellsToFollow = 2e5, kMostCells = 4e5;  // bounds of lengths shortened to follow, to be sound

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

struct Topology {
    int euler = 0;
    Index pieces = 0;
    bool closed = true;
    bool operator==(const Topology&) const = default;
};

Topology topology_of(const TriangleMesh& mesh) {
    const std::vector<Index> piece = connected_pieces(mesh, sorted_half_edges(mesh.triangles));
    const EdgeTopology edges = edge_topology(mesh);
    return {euler_characteristic(mesh), *std::ranges::max_element(piece) + 1, edges.edge_triangles.minCoeff() >= 0};
}

// Why the result is unusable; none if it is sound.
std::optional<std::string> fault(const RemeshResult& result, const Topology& wanted) {
    const auto defects = find_defects(result.mesh, {.closed = wanted.closed});
    if (!defects.empty()) return defects.front().message.substr(0, defects.front().message.find("; "));
    if (topology_of(result.mesh) != wanted) return "holes or pieces of the surface were lost";
    return std::nullopt;
}

double expected_triangles(const TriangleMesh& mesh, double length) {
    return triangle_areas(mesh).sum() / (std::numbers::sqrt3 / 4 * length * length);
}

// At which there are so many triangles, or tets inside (12.5 in a cube of one edge length, measured).
double length_for(const TriangleMesh& mesh, double cells, bool closed) {
    const double tets = closed ? 12.5 * std::abs(signed_volume(mesh)) : 0;
    return std::max(std::sqrt(expected_triangles(mesh, 1) / cells), std::cbrt(tets / cells));
}

double checked_edge_length(const TriangleMesh& mesh, const RemeshOptions& options) {
    if (options.iterations < 1) throw InvalidInput("remeshing needs at least 1 iteration", "invalid_option");
    if (!(options.edge_length >= 0 && std::isfinite(options.edge_length)))
        throw InvalidInput("the target edge length must be positive, or 0 for 1/25 of the size", "invalid_option");
    const double length = options.edge_length > 0 ? options.edge_length : default_edge_length(mesh);
    const double expected = expected_triangles(mesh, length), most = 5e7;
    if (expected > most)
        throw InvalidInput("a target edge length of " + short_number(length) + " would give about " +
                               short_number(expected) + " triangles; choose a larger one",
                           "invalid_option");
    return length;
}

std::string in_percent(double ratio) { return short_number(100 * ratio) + " %"; }

// A surface between the input and the user.
class Remesher {
public:
    Remesher(const TriangleMesh& mesh, const FeatureGraph& features, const RemeshOptions& options,
             const Progress& progress)
        : mesh_(mesh),
          features_(features),
          iterations_(options.iterations),
          topology_(topology_of(mesh)),
          told_(deviation_told * shape_size(mesh)),
          input_(mark(mesh, features)),
          trees_(input_),
          progress_(progress) {}

    RemeshResult run(double wanted, bool given) {
        std::optional<Attempt> best;
        std::string why;  // lengths longer than the last are worse
        double length = wanted;
        while (true) {
            double next = length / 2;
            if (auto attempt = at_length(length)) {
                best = std::move(attempt);
                const double excess = excess_of(*best);
                if (given || excess <= 1) break;
                if (why.empty()) why = "follow the surface poorly (" + departure(*best) + ")";
                next = length * std::clamp(std::sqrt(0.8 / excess), 0.5, 0.9);  // the departure is quadratic in it
            } else if (why.empty()) {
                why = "spoil the surface (" + fault_ + ")";
            }
            next = std::max({next, kShortest * wanted,
                             length_for(mesh_, best ? kCellsToFollow : kMostCells, topology_.closed)});
            if (next > 0.95 * length) break;
            length = next;
        }
        if (!best) return kept(wanted, why);
        if (best->length < wanted)
            best->result.notes.push_back("edges of " + short_number(wanted) + " would " + why + ": those of " +
                                         short_number(best->length) + " were taken");
        if (excess_of(*best) > 1)
            best->result.notes.push_back("the remeshed surface is not quite that of the input: " + departure(*best) +
                                         "; a shorter edge length follows it more closely");
        return std::move(best->result);
    }

private:
    struct Attempt {
        RemeshResult result;
        double length, volume_change;  // relative
        Eigen::Vector3d place;         // of the largest deviation
    };

    double excess_of(const Attempt& attempt) const {
        return std::max(attempt.result.deviation / told_, attempt.volume_change / kVolumeTold);
    }

    std::string departure(const Attempt& attempt) const {
        std::ostringstream text;
        text.precision(4);
        const Eigen::Vector3d& at = attempt.place;
        text << "it leaves it by up to " << short_number(attempt.result.deviation) << " at (" << at[0] << ", " << at[1]
             << ", " << at[2] << ")";
        if (topology_.closed) text << ", and its volume differs by " << in_percent(attempt.volume_change);
        return text.str();
    }

    // None where no sound surface comes of it; fault_ says why.
    std::optional<Attempt> at_length(double length) {
        fault_.clear();
        for (const bool protect : {false, true}) {
            try {
                Marked marked = mark(mesh_, features_);
                run_rounds(marked, trees_, length, iterations_, protect, forward());
                Attempt attempt{to_arrays(marked), length, 0, Eigen::Vector3d::Zero()};
                const auto problem = fault(attempt.result, topology_);
                if (!problem) {
                    measure(marked, attempt);
                    return attempt;
                }
                if (fault_.empty()) fault_ = *problem;
            } catch (const CGAL::Failure_exception& failure) {
                if (fault_.empty()) fault_ = failure.what();
            }
        }
        return std::nullopt;
    }

    void measure(const Marked& marked, Attempt& attempt) const {
        const PatchTrees trees(marked);
        for (const Vertex v : input_.mesh.vertices()) {
            if (input_.mesh.is_isolated(v)) continue;
            const int patch = patch_at(input_, v);
            if (trees.empty(patch)) continue;
            const Point& p = input_.mesh.point(v);
            const double distance = std::sqrt(CGAL::squared_distance(p, trees.closest(patch, p)));
            if (!(distance > attempt.result.deviation)) continue;
            attempt.result.deviation = distance;
            attempt.place = Eigen::Vector3d(p.x(), p.y(), p.z());
        }
        const double volume = signed_volume(mesh_);
        if (topology_.closed && volume != 0)
            attempt.volume_change = std::abs(signed_volume(attempt.result.mesh) / volume - 1);
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
    int iterations_;
    Topology topology_;
    double told_;
    Marked input_;
    PatchTrees trees_;
    const Progress& progress_;
    std::string fault_;
    double furthest_ = 0;
};

}  // namespace

double default_edge_length(const TriangleMesh& mesh) { return shape_size(mesh) / 25; }

RemeshResult remesh(const TriangleMesh& mesh, const FeatureGraph& features, const RemeshOptions& options,
                    const Progress& progress) {
    report_or_throw(progress, "remesh", 0, kNone);
    require_valid(mesh, {.closed = false});
    feature_graph(mesh, features.edges);  // throws where they are no edges of the mesh
    for (const Index v : features.corners)
        if (v < 0 || v >= mesh.vertices.rows())
            throw InvalidInput("corner " + std::to_string(v) + " is no vertex of the mesh", "index_out_of_range", {v});
    return Remesher(mesh, features, options, progress).run(checked_edge_length(mesh, options), options.edge_length > 0);
}

}  // namespace octafield::surface
