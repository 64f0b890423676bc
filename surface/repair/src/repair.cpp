#include "octafield/surface/repair.hpp"

#include <algorithm>
#include <cmath>

#include "combinatorial_repair.hpp"
#include "deviation.hpp"
#include "fill_holes.hpp"
#include "flat_triangles.hpp"
#include "half_edges.hpp"
#include "merge_points.hpp"
#include "near_points.hpp"
#include "octafield/error.hpp"
#include "resolve_crossings.hpp"
#include "short_edges.hpp"
#include "short_number.hpp"
#include "snap.hpp"
#include "triangle_tests.hpp"
#include "wrap.hpp"

namespace octafield::surface {
namespace {

constexpr double kTinyPiece = 1e-3;  // diagonals
constexpr double kOnePlace = 1e-13;  // diagonals: ends of an edge that TetGen cannot tell apart
constexpr double kRoundings = 2;     // of the coordinates' precision, between two points meant as one
constexpr double kWrapParts = 50;    // wrap_alpha in a diagonal
constexpr double kOffsetParts = 20;  // wrap_offset in wrap_alpha
constexpr double kSnapOffsets = 3;  // from the surface: vertices of a wrap farther away bridge a gap
// Of a wrap, twice its volume over its area. Round sheets that enclose nothing it is 2 offsets, and up to 0.16 alphas.
constexpr double kThinInAlphas = 0.4, kThinInOffsets = 3;

std::string counted(std::size_t count, const std::string& noun) {
    return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

// Numbers that no repair can guess are left for validation to name.
bool usable(const TriangleMesh& mesh) {
    return mesh.triangles.rows() > 0 && mesh.triangles.minCoeff() >= 0 &&
           mesh.triangles.maxCoeff() < mesh.vertices.rows() && mesh.vertices.allFinite();
}

void require_options(const RepairOptions& options) {
    for (const double length : {options.wrap_alpha, options.wrap_offset})
        if (!(length >= 0 && std::isfinite(length)))
            throw InvalidInput("alpha and offset of the wrap must be positive, or 0 for the default", "invalid_option");
    if (options.max_hole_edges < 0 || options.small_hole_edges < 0)
        throw InvalidInput("the bound of edges of a hole must not be negative (0: none)", "invalid_option");
    if (!std::isfinite(options.merge_tolerance))
        throw InvalidInput("the tolerance of merging must be finite (negative: from the coordinates)",
                           "invalid_option");
}

// The levels one by one, each on what the one before it left.
class Repair {
public:
    Repair(const TriangleMesh& mesh, const RepairOptions& options) : options_(options) {
        require_options(options);
        result_.mesh = mesh;
        usable_ = usable(mesh);
        if (usable_) tolerance_ = tolerance();
    }

    void apply(RepairLevel level) {
        if (!usable_ || mesh_.triangles.rows() == 0) return;
        switch (level) {
            case RepairLevel::none: break;
            case RepairLevel::merge: merge(); break;
            case RepairLevel::safe: mend(); break;
            case RepairLevel::fill:
                if (options_.closed) fill(options_.max_hole_edges, true);
                orient_all();
                break;
            case RepairLevel::resolve: resolve(); break;
            case RepairLevel::wrap:
                if (options_.closed) wrap();
                break;
        }
    }

    RepairResult& result() { return result_; }

private:
    double tolerance() const {
        if (options_.merge_tolerance >= 0) return options_.merge_tolerance;
        Points used(mesh_.triangles.size(), 3);
        for (Index i = 0; i < used.rows(); ++i) used.row(i) = mesh_.vertices.row(mesh_.triangles.data()[i]);
        return kRoundings * coordinate_precision(used);
    }

    void note(std::size_t count, const char* verb, const char* noun, const std::string& rest) {
        if (count > 0) result_.actions.push_back(verb + counted(count, noun) + rest);
    }

    void merge() {
        TriangleMesh merged = merge_equal_points(mesh_);
        const auto count = static_cast<std::size_t>(mesh_.vertices.rows() - merged.vertices.rows());
        if (count > 0) mesh_ = std::move(merged);
        note(count, "merged ", "point", " into others at the same place");
        const NearMerge near = merge_near_points(mesh_, tolerance_);
        note(near.points, "merged ", "point",
             " of open edges into others nearer than " + short_number(tolerance_) + ", by at most " +
                 short_number(near.largest_move));
        note(near.triangles, "removed ", "triangle", " that merging points left without area");
        moved(near.largest_move);
    }

    void mend() {
        note(drop_repeating_a_vertex(mesh_.triangles), "removed ", "triangle", " that used a vertex twice");
        if (repeats_vertex(mesh_.triangles, 0)) return;  // all do; nothing would be left
        const std::size_t unused = drop_unused_vertices(mesh_);  // first, as tolerances come from the size of the rest
        note(drop_repeated(mesh_.triangles), "removed ", "triangle", " on the same three vertices as another");
        note(drop_fins(mesh_.triangles), "removed ", "dangling triangle",
             " (one side on an edge of three or more triangles, two free)");
        const double tiny = kTinyPiece * bounding_box_diagonal(mesh_.vertices);
        note(drop_tiny_open_pieces(mesh_, tiny), "removed ", "triangle",
             " of open pieces smaller than " + short_number(tiny));
        note(split_open_edges(mesh_, tolerance_), "split ", "triangle",
             " at points on their open edges, nearer than " + short_number(tolerance_));
        note(orient_alike(mesh_.triangles), "reversed ", "triangle", " to agree with the neighbours");
        join_ends();
        note(flip_flat_triangles(mesh_), "flipped away ", "triangle", " without area");
        if (options_.closed) fill(options_.small_hole_edges, false);
        orient_all();
        note(unused + drop_unused_vertices(mesh_), "left out ", "point", " that no triangle uses");
    }

    void join_ends() {
        const std::size_t joined = collapse_short_edges(mesh_, kOnePlace * bounding_box_diagonal(mesh_.vertices));
        if (joined > 0) drop_unused_vertices(mesh_);
        note(joined, "joined the ends of ", "edge", " that were one place but for rounding");
    }

    void orient_all() {
        note(orient_outward(mesh_), "reversed ", "triangle", " of shells that faced the wrong way");
    }

    void fill(int most, bool smooth) {
        const HoleFilling done = fill_holes(mesh_, most, smooth);
        const std::string with = " with " + counted(done.triangles, "triangle");
        if (done.plain + done.smooth > 0)
            note(done.plain + done.smooth, "filled ", "hole",
                 with + (done.vertices > 0 ? " and " + std::to_string(done.vertices) + " new vertices" : ""));
        if (smooth) note(done.too_large, "left ", "hole",
             " of more than " + std::to_string(most) + " edges open (the largest has " +
                 std::to_string(done.largest) + "; --max-hole-edges)");
    }

    void resolve() {
        const std::size_t crossing = intersecting_triangles(mesh_).size();
        if (crossing == 0) return;
        before_resolving_ = mesh_;
        note(unite_crossing_pieces(mesh_), "united ", "piece", " with others that it crossed");
        join_ends();
        const TriangleMesh before = mesh_;
        const std::size_t left = intersecting_triangles(mesh_).size();
        if (left == 0 || !remove_crossings(mesh_)) return;
        const double distance = std::max(one_sided_distance(mesh_, before), one_sided_distance(before, mesh_));
        note(left, "made ", "triangle", " that crossed others anew, with what lies round them: " +
             counted(static_cast<std::size_t>(mesh_.triangles.rows()), "triangle") + " now, " +
             std::to_string(before.triangles.rows()) + " before, no point farther away than " + short_number(distance));
        moved(distance);
        orient_all();
    }

    void wrap() {
        if (find_defects(mesh_).empty()) return;
        const TriangleMesh& input = before_resolving_.triangles.rows() > 0 ? before_resolving_ : mesh_;
        const double diagonal = bounding_box_diagonal(input.vertices);
        const double alpha = options_.wrap_alpha > 0 ? options_.wrap_alpha : diagonal / kWrapParts;
        const double offset = options_.wrap_offset > 0 ? options_.wrap_offset : alpha / kOffsetParts;
        TriangleMesh wrapped = alpha_wrap(input, alpha, offset);
        if (wrapped.triangles.rows() == 0) return;  // nothing has area
        const std::string sizes = "alpha " + short_number(alpha) + ", offset " + short_number(offset);
        const double thickness = 2 * signed_volume(wrapped) / triangle_areas(wrapped).sum();
        if (thickness < std::max(kThinInAlphas * alpha, kThinInOffsets * offset)) {
            result_.actions.push_back("not wrapped (" + sizes +
                                      "): the wrap would enclose little but its own thickness, as the surface has an "
                                      "opening wider than alpha, or encloses nothing (--wrap-alpha, --wrap-offset)");
            return;
        }
        const std::size_t snapped = snap(wrapped, input, kSnapOffsets * offset);
        const double outside = one_sided_distance(wrapped, input), lost = one_sided_distance(input, wrapped);
        result_.actions.push_back("wrapped anew (" + sizes + "): " +
                                  counted(static_cast<std::size_t>(wrapped.triangles.rows()), "triangle") + ", " +
                                  std::to_string(snapped) + " of " + std::to_string(wrapped.vertices.rows()) +
                                  " vertices drawn onto the surface, up to " + short_number(outside) + " away from the surface, which lies up to " +
                                  short_number(lost) + " inside");
        mesh_ = std::move(wrapped);
        moved(std::max(outside, lost));
    }

    void moved(double distance) { result_.largest_move = std::max(result_.largest_move, distance); }

    const RepairOptions& options_;
    RepairResult result_;
    TriangleMesh& mesh_ = result_.mesh;
    TriangleMesh before_resolving_;
    double tolerance_ = 0;
    bool usable_ = false;
};

constexpr RepairLevel next(RepairLevel level) { return static_cast<RepairLevel>(static_cast<int>(level) + 1); }

}  // namespace

const std::vector<std::string>& repair_level_names() {
    static const std::vector<std::string> names = {"none", "merge", "safe", "fill", "resolve", "wrap"};
    return names;
}

RepairLevel repair_level(const std::string& name) {
    const auto& names = repair_level_names();
    const auto place = std::ranges::find(names, name);
    if (place == names.end())
        throw InvalidInput("the repair level " + name + " is none of none, merge, safe, fill, resolve, wrap",
                           "unknown_option_value");
    return static_cast<RepairLevel>(place - names.begin());
}

RepairResult repair(const TriangleMesh& mesh, const RepairOptions& options) {
    Repair repair(mesh, options);
    for (auto level = RepairLevel::none; level != options.level; level = next(level)) repair.apply(next(level));
    return std::move(repair.result());
}

RepairAdvice advise_repair(const TriangleMesh& mesh, const RepairOptions& options, Index most_triangles) {
    Repair repair(mesh, options);
    RepairAdvice advice;
    const ValidateOptions tests{.closed = options.closed};
    advice.left = find_defects(mesh, tests);
    for (auto level = options.level; !advice.left.empty() && level != RepairLevel::wrap;) {
        level = next(level);
        const Index count = static_cast<Index>(repair.result().mesh.triangles.rows());
        if (level >= RepairLevel::resolve && count > most_triangles) {
            advice.not_tried = "resolve and wrap were not tried on " + std::to_string(count) + " triangles";
            break;
        }
        const std::size_t before = repair.result().actions.size();
        repair.apply(level);
        if (repair.result().actions.size() == before) continue;
        advice.left = find_defects(repair.result().mesh, tests);
        if (advice.left.empty()) advice.level = repair_level_names()[static_cast<std::size_t>(level)];
    }
    advice.actions = repair.result().actions;
    return advice;
}

}  // namespace octafield::surface
