// Lengths that are asked for are those that are made, or they are refused.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "expected_vertices.hpp"
#include "mesh_fixtures.hpp"
#include "octafield/error.hpp"

namespace octafield::surface {
namespace {

using namespace testing;

Eigen::VectorXd all_of(const TriangleMesh& mesh, double length) {
    return Eigen::VectorXd::Constant(mesh.vertices.rows(), length);
}

std::string refusal(const TriangleMesh& mesh, double length, const CloseRemeshOptions& options = {}) {
    try {
        close_remesh(mesh, detect_features(mesh), all_of(mesh, length), options);
    } catch (const InvalidInput& error) {
        return error.kind();
    }
    return "none";
}

TEST(AskedLengths, AreTheMeanOfEdgesWhateverTheInputsTrianglesAre) {
    for (const int fineness : {2, 4})
        for (const double length : {0.08, 0.2}) {
            const TriangleMesh ball = icosphere(fineness);
            const TriangleMesh made = close_remesh(ball, {}, all_of(ball, length)).mesh;
            EXPECT_NEAR(mean_edge_length(made) / length, 1, 0.05) << fineness << ", " << length;
            const double expected = 2 / std::numbers::sqrt3 * triangle_areas(ball).sum() / (length * length);
            EXPECT_NEAR(made.vertices.rows() / expected, 1, 0.1);
        }
}

// Halves of triangles beside a corner go from curve to curve, and are no strip.
TEST(AskedLengths, AreNotShorterAtCornersWhereTheInputIsFine) {
    const TriangleMesh coarse = cube_surface(1), fine = cube_surface(60);
    const auto vertices = [](const TriangleMesh& cube) {
        return close_remesh(cube, detect_features(cube), all_of(cube, 0.25)).mesh.vertices.rows();
    };
    EXPECT_NEAR(vertices(fine), vertices(coarse), 0.1 * vertices(coarse));
}

TEST(AskedLengths, DeviationMayAskForShorterOnesAndTheseStay) {
    const TriangleMesh ball = icosphere(4);
    const CloseRemeshResult made = close_remesh(ball, {}, all_of(ball, 0.4), {.deviation = 0.004});
    EXPECT_LT(mean_edge_length(made.mesh), 0.2);
    EXPECT_LE(std::max(made.deviation, made.own_deviation), 0.004);
}

TEST(AskedLengths, VerticesThatADeviationTakesAreThoseOfABallOrOfFacets) {
    const TriangleMesh ball = icosphere(5);
    // Triangles larger than the facets: on a ball of radius 1, deviation = length^2 / 4.8 at most; twice as many, as
    // both curvatures count, of which one may be all there is.
    const double coarse = 0.01, area = 4 * std::numbers::pi;
    EXPECT_NEAR(vertices_within(ball, {}, coarse) / (2 / std::numbers::sqrt3 * area / (4.8 * coarse)), 2, 0.1);
    const double made = close_remesh(ball, {}, all_of(ball, 1), {.deviation = coarse}).mesh.vertices.rows();
    EXPECT_NEAR(std::log2(vertices_within(ball, {}, coarse) / made), 0, 1);
    // Far smaller ones lie along the edges: as many times more as the deviation is less.
    EXPECT_NEAR(vertices_within(ball, {}, 1e-9) / vertices_within(ball, {}, 1e-8), 10, 1e-9);
    const TriangleMesh cube = cube_surface(5);
    EXPECT_EQ(vertices_within(cube, detect_features(cube), 1e-9), 0) << "flat between what is followed";
}

TEST(AskedLengths, WhatNoSurfaceHasIsRefused) {
    const TriangleMesh ball = icosphere(3), ring = torus(30, 12, 1, 0.4);
    EXPECT_EQ(refusal(ball, 0.3, {.deviation = 1e-8}), "too_many_cells");
    EXPECT_EQ(refusal(ring, 3), "too_few_cells");
    EXPECT_EQ(refusal(ring, 1, {.vertices = 6}), "too_few_cells");
    EXPECT_EQ(refusal(ball, 1, {.vertices = 3}), "too_few_cells");
    EXPECT_EQ(refusal(ball, 5, {.deviation = 0.01}), "none") << "the deviation decides";
    EXPECT_EQ(refusal(cube_surface(1), 9), "none") << "its corners hold it";
}

TEST(AskedLengths, ANumberThatCannotBeMetTellsWhatIsHeld) {
    const TriangleMesh cube = cube_surface(1);
    const CloseRemeshResult few = close_remesh(cube, detect_features(cube), all_of(cube, 1), {.vertices = 5});
    ASSERT_FALSE(few.notes.empty());
    EXPECT_NE(few.notes.back().find("8 are corners and 0 on feature curves"), std::string::npos) << few.notes.back();
    const TriangleMesh ball = icosphere(3);
    for (const std::string& note : close_remesh(ball, {}, all_of(ball, 1), {.vertices = 10}).notes)
        EXPECT_EQ(note.find("corners"), std::string::npos) << note;
}

}  // namespace
}  // namespace octafield::surface
