#include "count_chooser.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "octafield/error.hpp"

namespace octafield::surface::detail {
namespace {

constexpr double most_quads = 1e8;
constexpr int most_sizes = 6;         // tried for a number of quads
constexpr double near_enough = 0.02;  // of that
constexpr double limits[] = {near_enough, 0.05};
constexpr int most_rounds = 4;  // of numbers sought by their quads
constexpr std::size_t few_arcs = 1500;
constexpr double most_uneven = 0.2;  // if the others are less

bool is_within(double quads, double wanted, double share) { return std::abs(quads - wanted) <= share * wanted; }

}  // namespace

SizedCounts counts_of(const QuadLayout& layout, const Seams& seams, ArcCounts arcs, double size) {
    SizedCounts result{std::move(arcs), {}, size, 0};
    auto& counts = result.arcs.counts;
    const auto parts = counts.begin() + static_cast<std::ptrdiff_t>(layout.sides.size());
    result.part_counts.assign(parts, parts + static_cast<std::ptrdiff_t>(seams.parts.size()));
    counts.erase(parts, counts.end());
    result.quads = total_quads(layout, counts);
    return result;
}

SizedCounts CountChooser::at_size(const ArcProblem& sums, double size) const {
    ArcProblem problem = sums;
    set_size(problem, layout_, seams_, size, options_.weights);
    const double most = *std::max_element(problem.wanted.begin(), problem.wanted.end());
    if (!(most * most <= most_quads))
        throw InvalidInput("the edge length would give more than 1e8 quads", "bad_option");
    return counts_of(layout_, seams_, integer_counts(problem, options_.most_nodes), size);
}

SizedCounts CountChooser::with_quads(const ArcProblem& problem, double wanted, double size) const {
    SizedCounts best;
    double low = 0, high = std::numeric_limits<double>::infinity();
    for (int i = 0; i < most_sizes; ++i) {
        SizedCounts found = at_size(problem, size);
        const double quads = found.quads;
        if (i == 0 || std::abs(quads - wanted) < std::abs(best.quads - wanted)) best = std::move(found);
        if (is_within(quads, wanted, near_enough)) return best;
        (quads > wanted ? low : high) = size;
        size *= std::sqrt(quads / wanted);
        if (size <= low || size >= high)
            size = std::isinf(high) ? 1.5 * low : low > 0 ? std::sqrt(low * high) : high / 1.5;
    }
    return best;
}

SizedCounts CountChooser::nearer(ArcProblem problem, SizedCounts best) const {
    const auto wanted = static_cast<double>(options_.quad_count);
    if (wanted == 0 || problem.least.size() > few_arcs) return best;
    for (std::size_t a = 0; a < best.arcs.counts.size(); ++a)
        if (best.arcs.counts[a] > 0) problem.least[a] = std::max(problem.least[a], 1);
    for (const double share : limits) {
        std::vector<int> at = best.arcs.counts;
        for (int round = 0; round < most_rounds && !is_within(best.quads, wanted, share); ++round) {
            std::optional<SizedCounts> found = within(problem, at, share * wanted);
            if (!found || found->arcs.counts == at) break;
            at = found->arcs.counts;
            if (is_better(*found, best, wanted)) best = std::move(*found);
        }
    }
    return best;
}

std::optional<SizedCounts> CountChooser::within(ArcProblem problem, const std::vector<int>& at, double most) const {
    QuadsNear near = quads_near(layout_, at);
    const double middle = static_cast<double>(options_.quad_count) - near.constant;
    problem.bounded = {std::move(near.factors), middle - most, middle + most};
    try {
        return at_size(problem, first_size());
    } catch (const Error& error) {
        if (error.kind() != "no_integers" && error.kind() != "node_limit") throw;
        return {};
    }
}

bool CountChooser::is_better(const SizedCounts& found, const SizedCounts& than, double wanted) const {
    const auto uneven = [&](const SizedCounts& c) { return unevenness(layout_, c.arcs.counts, first_size()); };
    return std::abs(found.quads - wanted) < std::abs(than.quads - wanted) &&
           uneven(found) <= std::max(most_uneven, uneven(than));
}

SizedCounts CountChooser::wanted(const ArcProblem& problem, double first) const {
    SizedCounts result =
        options_.quad_count > 0 ? with_quads(problem, options_.quad_count, first) : at_size(problem, first);
    if (!(result.quads <= most_quads)) throw InvalidInput("the size would give more than 1e8 quads", "bad_option");
    return result;
}

double CountChooser::next_size(const SizedCounts& found) const {
    if (options_.quad_count <= 0 || is_within(found.quads, options_.quad_count, near_enough)) return found.size;
    return found.size * std::sqrt(found.quads / options_.quad_count);
}

double CountChooser::first_size() const {
    if (options_.quad_count <= 0) return options_.edge_length;
    return std::sqrt(layout_.curves.parameter_area / static_cast<double>(options_.quad_count));
}

}  // namespace octafield::surface::detail
