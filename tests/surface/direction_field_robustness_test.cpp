// N-direction fields under changes that must not matter, and on input that must be refused.
#include "direction_field_fixtures.hpp"

namespace octafield::surface {
namespace {

// ---- invariances ----

TEST(DirectionField, EnergyDoesNotDependOnTheLengthUnit) {
    TriangleMesh mesh = icosphere(2);
    const DirectionField unit = direction_field(mesh, {.tolerance = 1e-12, .energy_tolerance = 0});
    for (const double scale : {1e-6, 1e6}) {
        mesh.vertices = icosphere(2).vertices * scale;
        const DirectionField scaled = direction_field(mesh, {.tolerance = 1e-12, .energy_tolerance = 0});
        EXPECT_TRUE(scaled.converged);
        EXPECT_NEAR(scaled.epsilon, unit.epsilon * scale, 1e-12 * scale);
        EXPECT_NEAR(scaled.energy, unit.energy, 1e-8 * unit.energy);
    }
}

TEST(DirectionField, FarFromTheOriginTheFieldIsTheSame) {
    for (const double sizes_away : {1e3, 1e5}) {
        TriangleMesh sphere = icosphere(2), round = disk(8);
        const double there = direction_field(round).energy;
        sphere.vertices.rowwise() += Eigen::RowVector3d(2, -1, 0.5) * sizes_away;
        round.vertices.rowwise() += Eigen::RowVector3d(2, -1, 0.5) * sizes_away;
        const DirectionField field = direction_field(sphere);
        EXPECT_TRUE(field.converged);
        EXPECT_NEAR(field.energy, direction_field(icosphere(2)).energy, 1e-3 * field.energy);
        EXPECT_EQ(surface_singularities(field).points.size(), 8u);
        EXPECT_NEAR(direction_field(round).energy, there, 1e-5 * there);
    }
}

TEST(DirectionField, TheEigenvectorDoesNotDependOnEpsilon) {
    // A small component beside a large one: each has its own eigenvector.
    TriangleMesh small = icosphere(2);
    small.vertices *= 1e-5;
    const TriangleMesh mesh = joined({torus(20, 12, 1, 0.4), small});
    const auto at = [&](double epsilon) { return direction_field(mesh, {.method = "eigen", .epsilon = epsilon}); };
    const DirectionField usual = at(0);
    for (const double epsilon : {1e-12, 1e-6, 1e6}) EXPECT_TRUE(at(epsilon).values == usual.values);
    // 8 singular points each turn by 1/4 on the sphere; a random field has hundreds.
    EXPECT_LE(surface_singularities(usual).points.size(), 24u);
}

TEST(DirectionField, SmallEpsilonKeepsTheSmoothestFieldsPoints) {
    const TriangleMesh mesh = icosphere(3);
    const DirectionField smoothest = direction_field(mesh, {.method = "eigen"});
    const DirectionField field = direction_field(mesh, {.epsilon = mean_edge_length(mesh) / 50});
    EXPECT_LE(surface_singularities(field).points.size(), 10u);
    EXPECT_LE(field.dirichlet_energy, smoothest.dirichlet_energy);
}

TEST(DirectionField, OrderOfTrianglesDoesNotMatter) {
    TriangleMesh mesh = disk(8);
    const DirectionField field = direction_field(mesh, {.energy_tolerance = 0});
    std::vector<int> order(mesh.triangles.rows());
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), std::mt19937(7));
    const Triangles before = mesh.triangles;
    for (std::size_t t = 0; t < order.size(); ++t)
        mesh.triangles.row(t) << before(order[t], t % 3), before(order[t], (t + 1) % 3), before(order[t], (t + 2) % 3);
    const DirectionField shuffled = direction_field(mesh, {.energy_tolerance = 0});
    EXPECT_NEAR(shuffled.energy, field.energy, 1e-9 * field.energy);
    EXPECT_EQ(surface_singularities(shuffled).points.size(), 4u);
}

TEST(DirectionField, SameInputGivesSameBits) {
    const TriangleMesh mesh = icosphere(2);
    const DirectionField first = direction_field(mesh, {.seed = 5}), second = direction_field(mesh, {.seed = 5});
    EXPECT_TRUE(first.values == second.values);
    EXPECT_FALSE(first.values == direction_field(mesh, {.seed = 6}).values);
}

TEST(DirectionField, ComponentsWithAndWithoutHeldEdgesAreSolvedTogether) {
    const TriangleMesh mesh = joined({icosphere(2), disk(6), torus(20, 12, 1, 0.4), icosphere(1)});
    const DirectionField field = direction_field(mesh);
    EXPECT_TRUE(field.converged);
    EXPECT_EQ(index_sum(surface_singularities(field).points), 4 * (2 + 1 + 0 + 2));
}

TEST(DirectionField, EnergyFallsAndProgressTellsIt) {
    const TriangleMesh mesh = icosphere(2);
    std::vector<double> told;
    const DirectionField field = direction_field(mesh, {}, [&](std::string_view phase, double fraction, double energy) {
        EXPECT_EQ(phase, "cross field");
        EXPECT_LE(fraction, 1);
        if (!std::isnan(energy)) told.push_back(energy);
        return true;
    });
    EXPECT_EQ(told, field.energy_history);
    EXPECT_EQ(field.energy_history.size(), static_cast<std::size_t>(field.iterations) + 1);
    for (std::size_t i = 1; i < told.size(); ++i) EXPECT_LE(told[i], told[i - 1] * (1 + 1e-12));
    EXPECT_NEAR(field.energy, told.back(), 1e-9);
}

TEST(DirectionField, CancellingKeepsTheBestState) {
    const TriangleMesh mesh = icosphere(3);
    int energies = 0;
    const DirectionField field = direction_field(
        mesh, {}, [&](std::string_view, double, double energy) { return std::isnan(energy) || ++energies < 4; });
    EXPECT_FALSE(field.converged);
    EXPECT_EQ(field.iterations, 3);
    EXPECT_LT(field.energy, field.energy_history.front());
    const DirectionField start = direction_field(mesh, {}, [](auto, double, double) { return false; });
    EXPECT_FALSE(start.converged);
    EXPECT_TRUE(start.values.array().isFinite().all());
}

// ---- bad input ----

TEST(DirectionField, RejectsUnusableOptions) {
    const TriangleMesh mesh = icosphere(0);
    EXPECT_THROW(direction_field(mesh, {.symmetry = 0}), InvalidInput);
    EXPECT_THROW(direction_field(mesh, {.epsilon = -1}), InvalidInput);
    EXPECT_THROW(direction_field(mesh, {.epsilon = std::nan("")}), InvalidInput);
    EXPECT_THROW(direction_field(mesh, {.max_iterations = -1}), InvalidInput);
    EXPECT_THROW(direction_field(mesh, {.tolerance = -1}), InvalidInput);
}

TEST(DirectionField, RefusesAnEpsilonAtWhichTheFieldVanishes) {
    // On the unit sphere f = 0 is the minimum from epsilon 1/2 on: the lowest eigenvalue is 4 for 4-fold fields.
    const TriangleMesh sphere = icosphere(3);
    for (const double epsilon : {0.52, 1.0, 100.0}) {
        try {
            direction_field(sphere, {.epsilon = epsilon});
            FAIL() << "a field without directions was returned, epsilon " << epsilon;
        } catch (const SolverError& error) {
            EXPECT_EQ(error.kind(), "epsilon_too_large");
            EXPECT_EQ(static_cast<Index>(error.elements().size()), sphere.triangles.rows());
            EXPECT_NE(std::string(error.what()).find("smaller epsilon"), std::string::npos);
        }
    }
    EXPECT_TRUE(direction_field(sphere, {.epsilon = 0.4}).converged);
    EXPECT_TRUE(direction_field(disk(8), {.epsilon = 100}).converged);  // its boundary keeps it from vanishing
    TriangleMesh small = icosphere(2);
    small.vertices /= 1000;
    const TriangleMesh both = joined({small, icosphere(3)});
    try {
        direction_field(both);
        FAIL() << "the small sphere has no directions at this epsilon";
    } catch (const SolverError& error) {
        EXPECT_EQ(static_cast<Index>(error.elements().size()), small.triangles.rows());
    }
}

TEST(DirectionField, RefusesAnEpsilonFarBelowTheEdgeLength) {
    const TriangleMesh mesh = icosphere(2);
    try {
        direction_field(mesh, {.epsilon = mean_edge_length(mesh) / 101});
        FAIL() << "the field would stay as it starts";
    } catch (const InvalidInput& error) {
        EXPECT_EQ(error.kind(), "epsilon_too_small");
    }
    EXPECT_NO_THROW(direction_field(mesh, {.epsilon = mean_edge_length(mesh) / 99}));
}

TEST(DirectionField, RejectsCornersThatAreNoVertices) {
    const TriangleMesh mesh = disk(3);
    for (const Index corner : {-1, 9999}) EXPECT_THROW(direction_field({mesh, {Edges(0, 2), {corner}}}), InvalidInput);
}

TEST(DirectionField, RejectsFeaturesItCannotFollow) {
    const TriangleMesh mesh = icosphere(1);
    FeatureGraph absent{Edges(1, 2), {}};
    absent.edges << 0, 1;  // joined before the split
    try {
        direction_field({mesh, absent});
        FAIL() << "an edge that is not in the mesh was accepted";
    } catch (const InvalidInput& error) {
        EXPECT_EQ(error.kind(), "not_an_edge");
        EXPECT_EQ(error.elements(), std::vector<Index>{0});
    }
    EXPECT_THROW(direction_field({mesh, all_edges(mesh)}, {.symmetry = 3}), InvalidInput);
}

TEST(DirectionField, RejectsUnsoundMeshes) {
    EXPECT_THROW(direction_field(TriangleMesh{}), GeometryError);
    TriangleMesh flat = plate(2, [](double, double) { return true; });
    flat.vertices.col(1).setZero();
    try {
        direction_field(flat);
        FAIL() << "triangles without area were accepted";
    } catch (const GeometryError& error) {
        EXPECT_EQ(error.kind(), "degenerate_triangle");
        EXPECT_EQ(error.elements().size(), 8u);
    }
    TriangleMesh fin =
        make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}}, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
    EXPECT_THROW(direction_field(fin), GeometryError);
    TriangleMesh dangling = icosphere(0);
    dangling.triangles(3, 1) = 99;
    EXPECT_THROW(direction_field(dangling), GeometryError);
    TriangleMesh infinite = icosphere(0);
    infinite.vertices(2, 1) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(direction_field(infinite), GeometryError);
}

}  // namespace
}  // namespace octafield::surface
