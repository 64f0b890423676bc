#include "arc_counts.hpp"

#include <coin/Cbc_C_Interface.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>

#include "octafield/disjoint_sets.hpp"
#include "octafield/error.hpp"

namespace octafield::surface::detail {
namespace {

constexpr double most_count = 1e6;

// Deviations beyond these shares of the number wanted count three times, and nine times: where sums force numbers away
// from lengths, many arcs give way a little before one gives way by much.
constexpr double shares_above[] = {0.25, 0.75}, shares_below[] = {0.2, 0.45}, steeper = 3;

// Part of what a whole number n may be away from `low`: n + those below - those above = low.
struct Step {
    int sign;
    double width, slope;
};

// |n - wanted| at whole n: falls by 1 each to `low`, has its own slope from there to low + 1, then rises by 1 each, or
// more far away.
struct Deviation {
    int low;
    double at_low;
    std::vector<Step> steps;

    Deviation(double wanted, int least, bool even)
        : low(std::max(least, static_cast<int>(std::floor(wanted)))), at_low(std::abs(low - wanted)) {
        add(1, wanted, shares_below, even);
        steps.push_back({-1, 1, std::abs(low + 1 - wanted) - at_low});
        add(-1, wanted, shares_above, even);
    }

    double at(int n) const {
        double result = at_low, left_below = std::max(low - n, 0), left_above = std::max(n - low, 0);
        for (const Step& step : steps) {
            double& left = step.sign > 0 ? left_below : left_above;
            const double here = std::min(left, step.width);
            result += here * step.slope;
            left -= here;
        }
        return result;
    }

private:
    void add(int sign, double wanted, const double (&shares)[2], bool even) {
        double done = 0, slope = 1;
        for (const double share : shares) {
            if (!even) break;
            const double width = std::max(1.0, std::round(share * wanted) - done);
            steps.push_back({sign, width, slope});
            done += width;
            slope *= steeper;
        }
        steps.push_back({sign, most_count, slope});
    }
};

double factor(const ArcProblem& problem, Index arc) {
    if (!problem.bounded || arc >= static_cast<Index>(problem.bounded->factors.size())) return 0;
    return problem.bounded->factors[arc];
}

struct Part {
    std::vector<Index> arcs, sums;
};

// Arcs that share sums, by lowest arc.
std::vector<Part> parts_of(const ArcProblem& problem) {
    DisjointSets sets(problem.wanted.size());
    for (const EqualSums& sum : problem.sums) {
        const Index first = sum.left.front();
        for (const auto* side : {&sum.left, &sum.right})
            for (const Index arc : *side) sets.join(first, arc);
    }
    Index bounded = -1;
    for (Index a = 0; a < static_cast<Index>(problem.wanted.size()); ++a) {
        if (factor(problem, a) == 0) continue;
        if (bounded >= 0) sets.join(bounded, a);
        bounded = a;
    }
    Index count = 0;
    const std::vector<Index> part_of = std::move(sets).numbers(count);
    std::vector<Part> parts(count);
    for (std::size_t a = 0; a < part_of.size(); ++a) parts[part_of[a]].arcs.push_back(static_cast<Index>(a));
    for (std::size_t s = 0; s < problem.sums.size(); ++s)
        parts[part_of[problem.sums[s].left.front()]].sums.push_back(static_cast<Index>(s));
    return parts;
}

// Columns of each arc of a part: the count, then its steps.
class Programme {
public:
    Programme(const ArcProblem& problem, const Part& part, bool whole = true)
        : model_(Cbc_newModel(), Cbc_deleteModel) {
        std::map<Index, int> place;
        for (std::size_t i = 0; i < part.arcs.size(); ++i) place[part.arcs[i]] = static_cast<int>(i);
        const auto arcs = static_cast<int>(part.arcs.size());
        std::vector<std::map<int, double>> columns;
        std::vector<double> low, high, cost, right;
        const auto add = [&](int row, double sign, double least, double most, double price) {
            columns.push_back({{row, sign}});
            low.push_back(least);
            high.push_back(most);
            cost.push_back(price);
        };
        bool bounded = false;
        for (int i = 0; i < arcs; ++i) {
            const Index arc = part.arcs[i];
            const Deviation d(problem.wanted[arc], problem.least[arc], problem.even);
            const double weight = problem.weights[arc];
            constant_ += weight * d.at_low;
            column_.push_back(static_cast<int>(columns.size()));
            add(i, 1, problem.least[arc], most_count, 0);
            for (const Step& step : d.steps) add(i, step.sign, 0, step.width, weight * step.slope);
            right.push_back(d.low);
        }
        for (const Index s : part.sums) {
            const auto row = static_cast<int>(right.size());
            for (const Index arc : problem.sums[s].left) columns[column_[place.at(arc)]][row] += 1;
            for (const Index arc : problem.sums[s].right) columns[column_[place.at(arc)]][row] -= 1;
            right.push_back(0);
        }
        std::vector<double> up_to = right;
        for (int i = 0; i < arcs; ++i) {
            const double of_arc = factor(problem, part.arcs[i]);
            if (of_arc != 0) columns[column_[i]][static_cast<int>(right.size())] = of_arc;
            bounded |= of_arc != 0;
        }
        if (bounded) {
            right.push_back(problem.bounded->low);
            up_to.push_back(problem.bounded->high);
        }
        std::vector<int> starts = {0}, rows;
        std::vector<double> values;
        for (const auto& column : columns) {
            for (const auto& [row, value] : column) {
                if (value == 0) continue;
                rows.push_back(row);
                values.push_back(value);
            }
            starts.push_back(static_cast<int>(rows.size()));
        }
        Cbc_loadProblem(model_.get(), static_cast<int>(columns.size()), static_cast<int>(right.size()), starts.data(),
                        rows.data(), values.data(), low.data(), high.data(), cost.data(), right.data(), up_to.data());
        for (int i = 0; i < arcs && whole; ++i) Cbc_setInteger(model_.get(), column_[i]);
        Cbc_setParameter(model_.get(), "log", "0");
        Cbc_setLogLevel(model_.get(), 0);
        if (!problem.preprocess) Cbc_setParameter(model_.get(), "preprocess", "off");
    }

    void solve(int most_nodes, const Part& part, ArcCounts& result) {
        Cbc_setParameter(model_.get(), "maxNodes", std::to_string(most_nodes).c_str());
        Cbc_solve(model_.get());
        if (Cbc_isProvenInfeasible(model_.get()))
            throw GeometryError("no whole numbers fit the " + std::to_string(part.arcs.size()) +
                                    " arcs of the T-mesh (" + first_few(part.arcs) +
                                    ") with a quad at least on each: some arc would have to be as long as itself and "
                                    "another one. Where separatrices miss one another by little, change the end "
                                    "tolerance; where faces meet along features, other quads at corners, or other "
                                    "singular points, are needed for the faces to fit one another",
                                "no_integers", part.arcs);
        const double* found = Cbc_bestSolution(model_.get());
        if (!found)
            throw SolverError("no whole numbers were found for the arcs of the T-mesh in " +
                                  std::to_string(most_nodes) + " nodes; allow more",
                              "node_limit", part.arcs);
        for (std::size_t i = 0; i < part.arcs.size(); ++i)
            result.counts[part.arcs[i]] = static_cast<int>(std::lround(found[column_[i]]));
        const bool proven = Cbc_isProvenOptimal(model_.get()) != 0;
        result.optimal &= proven;
        const double value = Cbc_getObjValue(model_.get());
        result.bound += constant_ + (proven ? value : std::min(value, Cbc_getBestPossibleObjValue(model_.get())));
    }

    // Of numbers that need not be whole; infinite where there are none.
    double least_deviation() {
        Cbc_solve(model_.get());
        if (Cbc_isProvenInfeasible(model_.get())) return std::numeric_limits<double>::infinity();
        return constant_ + Cbc_getObjValue(model_.get());
    }

private:
    std::unique_ptr<Cbc_Model, void (*)(Cbc_Model*)> model_;
    std::vector<int> column_;  // of each arc's count
    double constant_ = 0;
};

bool sums_agree(const ArcProblem& problem, const std::vector<int>& counts) {
    return std::all_of(problem.sums.begin(), problem.sums.end(), [&](const EqualSums& sum) {
        long difference = 0;
        for (const Index arc : sum.left) difference += counts[arc];
        for (const Index arc : sum.right) difference -= counts[arc];
        return difference == 0;
    });
}

}  // namespace

ArcCounts integer_counts(const ArcProblem& problem, int most_nodes) {
    ArcCounts result;
    result.counts.assign(problem.wanted.size(), 0);
    for (const Part& part : parts_of(problem)) {
        if (part.sums.empty() && factor(problem, part.arcs[0]) == 0) {
            const Index arc = part.arcs[0];
            result.counts[arc] = std::max(problem.least[arc], static_cast<int>(std::lround(problem.wanted[arc])));
            result.bound += problem.weights[arc] *
                            Deviation(problem.wanted[arc], problem.least[arc], problem.even).at(result.counts[arc]);
        } else {
            Programme(problem, part).solve(most_nodes, part, result);
        }
    }
    for (std::size_t a = 0; a < problem.wanted.size(); ++a) {
        if (result.counts[a] < problem.least[a])
            throw SolverError("the solver gave an arc of the T-mesh too few quads", "solver_failed",
                              {static_cast<Index>(a)});
        result.deviation +=
            problem.weights[a] * Deviation(problem.wanted[a], problem.least[a], problem.even).at(result.counts[a]);
    }
    if (!sums_agree(problem, result.counts))
        throw SolverError("the solver gave whole numbers whose sums do not agree", "solver_failed");
    return result;
}

double least_deviation(const ArcProblem& problem) {
    double result = 0;
    for (const Part& part : parts_of(problem))
        if (!part.sums.empty() || factor(problem, part.arcs[0]) != 0)
            result += Programme(problem, part, false).least_deviation();
    return result;
}

}  // namespace octafield::surface::detail
