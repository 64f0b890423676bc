#include "related_values.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace octafield::volume::detail {
namespace {

struct Equation {
    Index a, b;
    double sign;
    Form form;
};

RelatedValues::Free solved(const std::vector<Equation>& equations, Index numbers, Index translations) {
    RelatedValues values(numbers, translations);
    for (const Equation& e : equations) values.relate(e.a, e.b, e.sign, e.form);
    return values.free();
}

// Of numbers and translations, for whole unknowns that are multiples of free.multiple: so are the terms.
std::vector<double> numbers_of(const RelatedValues::Free& free, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::vector<double> unknowns(free.count), result;
    for (double& unknown : unknowns) unknown = free.multiple * static_cast<double>(random() % 1000);
    for (const Form& row : free.rows) {
        double number = 0;
        for (const auto& [unknown, c] : row) number += std::round(c * unknowns[unknown]);
        result.push_back(number);
    }
    return result;
}

void expect_equations(const std::vector<Equation>& equations, const std::vector<double>& numbers, Index count) {
    for (const Equation& e : equations) {
        double right = e.sign * numbers[e.b];
        for (const auto& [t, c] : e.form) right += c * numbers[count + t];
        EXPECT_EQ(numbers[e.a], right) << e.a << " and " << e.b;
    }
}

TEST(RelatedValues, AllEquationsHoldExactlyWhateverTheUnknownsAre) {
    std::mt19937_64 random(3);
    for (int trial = 0; trial < 40; ++trial) {
        const Index numbers = 12, translations = 8;
        std::vector<Equation> equations;
        for (int e = 0; e < 18; ++e)
            equations.push_back({static_cast<Index>(random() % numbers),
                                 static_cast<Index>(random() % numbers),
                                 random() % 2 ? 1.0 : -1.0,
                                 {{static_cast<Index>(random() % translations), 1.0}}});
        expect_equations(equations, numbers_of(solved(equations, numbers, translations), trial), numbers);
    }
}

TEST(RelatedValues, WhatNoEquationHoldsStaysFree) {
    EXPECT_EQ(solved({}, 3, 2).count, 5);
    EXPECT_EQ(solved({{0, 1, -1, {{0, 1.0}}}}, 3, 2).count, 4);
    EXPECT_EQ(solved({{0, 1, 1, {{0, 1.0}}}, {0, 1, 1, {{1, 1.0}}}}, 2, 2).count, 2);  // both translations are one
}

// (u, v) = (-v + t, u + s) has one solution, with halves.
TEST(RelatedValues, AQuarterTurnHoldsItsFixedPoint) {
    const auto free = solved({{0, 1, -1, {{0, 1.0}}}, {1, 0, 1, {{1, 1.0}}}}, 2, 2);
    EXPECT_EQ(free.count, 2);
    EXPECT_EQ(free.multiple, 2);
    EXPECT_EQ(free.rows[0], (Form{{0, 0.5}, {1, -0.5}}));
    EXPECT_EQ(free.rows[1], (Form{{0, 0.5}, {1, 0.5}}));
}

TEST(RelatedValues, NumbersAreEqualThatEquationsSaySo) {
    RelatedValues values(4, 1);
    values.relate(0, 1, 1, {});
    values.relate(2, 1, 1, {{0, 1.0}});
    EXPECT_TRUE(values.are_equal(0, 1));
    EXPECT_FALSE(values.are_equal(0, 2));
    values.relate(3, 2, 1, {{0, -1.0}});
    EXPECT_TRUE(values.are_equal(0, 3));
}

}  // namespace
}  // namespace octafield::volume::detail
