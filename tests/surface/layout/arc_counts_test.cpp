// Whole numbers for arcs against all that there are.
#include "arc_counts.hpp"
#include "arc_shortage.hpp"
#include "layout_fixtures.hpp"

namespace octafield::surface {
namespace {

using detail::ArcProblem;
using detail::EqualSums;

// Of so many more: three times as much each behind one share of the number wanted, nine times behind the other.
double dearer(int more, double wanted, double share, double other) {
    const double first = std::max(1.0, std::round(share * wanted));
    const double second = first + std::max(1.0, std::round(other * wanted) - first);
    double sum = 0;
    for (int i = 1; i <= more; ++i) sum += i <= first ? 1 : i <= second ? 3 : 9;
    return sum;
}

double deviation(const ArcProblem& problem, std::size_t arc, int count) {
    const double wanted = problem.wanted[arc];
    if (!problem.even) return std::abs(count - wanted);
    const int low = std::max(problem.least[arc], static_cast<int>(std::floor(wanted)));
    if (count <= low) return std::abs(low - wanted) + dearer(low - count, wanted, 0.2, 0.45);
    return std::abs(low + 1 - wanted) + dearer(count - low - 1, wanted, 0.25, 0.75);
}

double deviation(const ArcProblem& problem, const std::vector<int>& counts) {
    double sum = 0;
    for (std::size_t a = 0; a < counts.size(); ++a) sum += problem.weights[a] * deviation(problem, a, counts[a]);
    return sum;
}

bool fits(const ArcProblem& problem, const std::vector<int>& counts) {
    for (const EqualSums& sum : problem.sums) {
        int difference = 0;
        for (const Index a : sum.left) difference += counts[a];
        for (const Index a : sum.right) difference -= counts[a];
        if (difference != 0) return false;
    }
    if (!problem.bounded) return true;
    const auto& [factors, low, high] = *problem.bounded;
    const double sum = std::inner_product(factors.begin(), factors.end(), counts.begin(), 0.0);
    return low <= sum && sum <= high;
}

// Every choice of 5 numbers up to 6.
std::optional<double> least_of_all(const ArcProblem& problem) {
    std::optional<double> best;
    std::vector<int> counts(5);
    for (int code = 0; code < 6 * 6 * 6 * 6 * 6; ++code) {
        int rest = code;
        bool enough = true;
        for (int a = 0; a < 5; ++a) {
            counts[a] = rest % 6 + 1;
            rest /= 6;
            enough &= counts[a] >= problem.least[a];
        }
        if (!enough || !fits(problem, counts)) continue;
        const double value = deviation(problem, counts);
        if (!best || value < *best) best = value;
    }
    return best;
}

TEST(ArcCounts, AreTheBestOfAll) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> length(0.2, 3);
    std::uniform_int_distribution<Index> arc(0, 4);
    int solved = 0, refused = 0;
    for (int round = 0; round < 150; ++round) {
        ArcProblem problem;
        for (int a = 0; a < 5; ++a) {
            problem.wanted.push_back(length(random));
            problem.weights.push_back(round % 2 ? 1 : 1 / problem.wanted.back());
            problem.least.push_back(1 + (a == 4 && round % 3 == 0));
        }
        for (int s = 0; s < 2; ++s) {
            EqualSums sum;
            sum.left = {arc(random), arc(random)};
            sum.right = {arc(random)};
            if (round % 5 == 0) sum.right.push_back(arc(random));
            problem.sums.push_back(sum);
        }
        problem.even = round % 3 == 1;
        // Of arcs that no sum joins, too.
        if (round % 4 == 1) problem.bounded = {{2, 0, 1, 3}, 9.5, 12.5};
        const auto best = least_of_all(problem);
        const std::vector<double> missing = detail::arc_shortages(problem);
        const double sum = std::accumulate(missing.begin(), missing.end(), 0.0);
        if (best) {
            EXPECT_EQ(sum, 0);  // shortages do not know of bounds
            const double bound = detail::least_deviation(problem);
            EXPECT_LE(bound, *best + 1e-9);
        }
        if (!best) {
            EXPECT_EQ(kind_of([&] { detail::integer_counts(problem, 100); }), "no_integers");
            ++refused;
            continue;
        }
        const detail::ArcCounts found = detail::integer_counts(problem, 100);
        EXPECT_TRUE(fits(problem, found.counts));
        EXPECT_TRUE(found.optimal);
        EXPECT_NEAR(deviation(problem, found.counts), *best, 1e-9);
        EXPECT_NEAR(found.deviation, *best, 1e-9);
        EXPECT_NEAR(found.bound, *best, 1e-6);
        ++solved;
    }
    EXPECT_GT(solved, 30);
    EXPECT_GT(refused, 5);
}

// Four arcs of 4 against one of 22: any sum of 22 deviates as much in all, but none has to give way by more than 2.
TEST(ArcCounts, ShareWhatLengthsLackEvenly) {
    ArcProblem problem{{4, 4, 4, 4, 22}, {1, 1, 1, 1, 100}, {1, 1, 1, 1, 1}, {{{0, 1, 2, 3}, {4}}}};
    EXPECT_NEAR(detail::integer_counts(problem, 100).deviation, 6, 1e-9);
    problem.even = true;
    const detail::ArcCounts found = detail::integer_counts(problem, 100);
    EXPECT_NEAR(found.deviation, 6, 1e-9);
    for (int a = 0; a < 4; ++a) EXPECT_LE(found.counts[a], 6);
    EXPECT_EQ(found.counts[4], 22);
    // Beyond that each costs three times as much.
    problem.wanted[4] = 25;
    EXPECT_NEAR(detail::integer_counts(problem, 100).deviation, 8 + 3, 1e-9);
}

TEST(ArcCounts, WithoutSumsAreRounded) {
    const ArcProblem problem{{0.2, 2.4, 2.6}, {1, 1, 1}, {1, 1, 1}, {}};
    EXPECT_EQ(detail::integer_counts(problem, 10).counts, (std::vector<int>{1, 2, 3}));
}

// 0 + 1 = 0 leaves nothing for 1; 2 = 3 has no part in it.
TEST(ArcShortages, NameTheArcsInTheWay) {
    const ArcProblem problem{{1, 1, 1, 1}, {1, 1, 1, 1}, {1, 2, 1, 1}, {{{0, 1}, {0}}, {{2}, {3}}}};
    const std::vector<double> missing = detail::arc_shortages(problem);
    ASSERT_EQ(missing.size(), 4u);
    EXPECT_EQ(missing[0], 0);
    EXPECT_NEAR(missing[1], 2, 1e-6);
    EXPECT_EQ(missing[2] + missing[3], 0);
    EXPECT_TRUE(std::isinf(detail::least_deviation(problem)));
}

// 1.5 and 1.5 against 4: a quad too many or too few, shared out as one likes.
TEST(ArcCounts, NeedNotBeWholeForTheBound) {
    const ArcProblem problem{{1.5, 1.5, 4}, {1, 1, 1}, {1, 1, 1}, {{{0, 1}, {2}}}};
    EXPECT_NEAR(detail::least_deviation(problem), 1, 1e-6);
}

}  // namespace
}  // namespace octafield::surface
