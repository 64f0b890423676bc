// Directions given at edges and vertices, and guide fields.
#include "direction_field_fixtures.hpp"

namespace octafield::surface {
namespace {

// Angle between a direction and the nearest of the field's N directions at the midpoint of an edge of a plane mesh.
double angle_off(const TriangleMesh& mesh, const DirectionField& field, Index e, double angle) {
    const Vector along =
        mesh.vertices.row(field.domain.topology().edges(e, 1)) - mesh.vertices.row(field.domain.topology().edges(e, 0));
    const double edge = std::atan2(along.y(), along.x());
    return std::abs(std::arg(field.values[e] * std::polar(1.0, field.symmetry * (edge - angle)))) / field.symmetry;
}

// ---- user constraints ----

TEST(Constraints, HardOnesHoldAtEdgesAndVerticesOfAnySymmetry) {
    const TriangleMesh mesh = square(8);
    const EdgeTopology topology = edge_topology(mesh);
    for (const int symmetry : {1, 2, 3, 4, 6})
        for (const auto method : {"gl", mbo, "eigen"}) {
            DirectionFieldOptions options{
                .symmetry = symmetry, .method = method, .boundary_alignment = Alignment::none};
            options.constraints.edges = topology.edges.row(17);
            options.constraints.edges.row(0).reverseInPlace();
            options.constraints.edge_directions.resize(1, 3);
            options.constraints.edge_directions << 3 * std::cos(0.5), 3 * std::sin(0.5), 7;
            options.constraints.vertices = {60};
            options.constraints.vertex_directions = Points::Zero(1, 3);
            options.constraints.vertex_directions << std::cos(0.7), std::sin(0.7), 0;
            const DirectionField field = direction_field(mesh, options);
            EXPECT_NEAR(angle_off(mesh, field, 17, 0.5), 0, 1e-12);
            int incident = 0;
            for (Index e = 0; e < topology.edges.rows(); ++e)
                if (topology.edges(e, 0) == 60 || topology.edges(e, 1) == 60) {
                    ++incident;
                    EXPECT_NEAR(angle_off(mesh, field, e, 0.7), 0, 1e-12);
                }
            EXPECT_GE(incident, 5);
        }
}

TEST(Constraints, GoBeforeTheBoundary) {
    const TriangleMesh mesh = disk(8);
    const EdgeTopology topology = edge_topology(mesh);
    Index e = 0;
    while (topology.edge_triangles.row(e).minCoeff() >= 0) ++e;
    DirectionFieldOptions options;
    options.constraints.edges = topology.edges.row(e);
    options.constraints.edge_directions.resize(1, 3);
    options.constraints.edge_directions << std::cos(0.9), std::sin(0.9), 0;
    EXPECT_NEAR(angle_off(mesh, direction_field(mesh, options), e, 0.9), 0, 1e-12);
}

TEST(Constraints, WeightedOnesBalanceTheTwistOfABar) {
    // Angle 0 held on the left side of the unit square, angle a asked for on the right one with weight w per edge of
    // length h, |f| = 1: phi = 4 theta is linear from 0 to p, and 1/2 p^2 + (w / h) (1 - cos(4 a - p)) is least.
    constexpr int n = 24;
    constexpr double asked = 0.2, weight = 0.05;
    const TriangleMesh mesh = square(n);
    const EdgeTopology topology = edge_topology(mesh);
    std::vector<Index> left, right;
    for (Index e = 0; e < topology.edges.rows(); ++e) {
        if (topology.edge_triangles.row(e).minCoeff() >= 0) continue;
        const double x = (mesh.vertices(topology.edges(e, 0), 0) + mesh.vertices(topology.edges(e, 1), 0)) / 2;
        if (x < 1e-9) left.push_back(e);
        if (x > 1 - 1e-9) right.push_back(e);
    }
    DirectionFieldOptions options{.epsilon = 0.01, .first_epsilon = 0.01, .boundary_alignment = Alignment::none};
    DirectionConstraints& given = options.constraints;
    given.edges.resize(2 * n, 2);
    given.edge_directions.resize(2 * n, 3);
    given.edge_weights = Eigen::VectorXd::Constant(2 * n, weight);
    for (int i = 0; i < n; ++i) {
        given.edges.row(i) = topology.edges.row(left[i]);
        given.edge_directions.row(i) << 1, 0, 0;
        given.edge_weights[i] = std::numeric_limits<double>::infinity();
        given.edges.row(n + i) = topology.edges.row(right[i]);
        given.edge_directions.row(n + i) << std::cos(asked), std::sin(asked), 0;
    }
    double low = 0, high = 4 * asked;
    for (int i = 0; i < 60; ++i) {
        const double p = (low + high) / 2;
        (p < weight * n * std::sin(4 * asked - p) ? low : high) = p;
    }
    const DirectionField field = direction_field(mesh, options);
    for (const Index e : right) EXPECT_NEAR(angle_off(mesh, field, e, 0), low / 4, 2e-3);
    EXPECT_NEAR(field.energy, low * low / 2 + weight * n * (1 - std::cos(4 * asked - low)), 2e-3);
}

TEST(Constraints, OneDirectionPinsAClosedSurfaceAtNoCost) {
    // The energy does not change when all directions turn together.
    const TriangleMesh mesh = icosphere(3);
    DirectionFieldOptions options;
    options.constraints.vertices = {40};
    options.constraints.vertex_directions = Points::Zero(1, 3);
    const Vector x = mesh.vertices.row(40);
    const Vector wanted = x.unitOrthogonal();
    options.constraints.vertex_directions.row(0) = wanted.transpose();
    const DirectionField field = direction_field(mesh, options);
    EXPECT_EQ(surface_singularities(field).points.size(), 8u);
    EXPECT_NEAR(field.energy, direction_field(mesh).energy, 0.05 * field.energy);
    const Vector d = vertex_directions(field).row(40);
    EXPECT_NEAR(std::min(std::abs(d.dot(wanted)), std::abs(d.dot(x.cross(wanted)))), 0, 1e-4);
}

// ---- guide ----

TEST(Guide, IsFollowedClosely) {
    const TriangleMesh mesh = disk(10);
    const auto angle = [](double x, double y) { return 0.4 + 0.6 * x - 0.3 * y * y; };
    DirectionFieldOptions options{.boundary_alignment = Alignment::none};
    options.guide.directions.resize(mesh.triangles.rows(), 3);
    for (Index t = 0; t < mesh.triangles.rows(); ++t) {
        const Eigen::RowVector3d c = mesh.vertices(mesh.triangles.row(t), Eigen::all).colwise().mean();
        options.guide.directions.row(t) << std::cos(angle(c.x(), c.y())), std::sin(angle(c.x(), c.y())), 1;
    }
    const auto worst = [&](double length, const std::string& method) {
        options.guide.length = length;
        options.method = method;
        const DirectionField field = direction_field(mesh, options);
        double most = 0;
        for (Index e = 0; e < field.values.size(); ++e) {
            const Eigen::RowVector3d m =
                mesh.vertices(field.domain.topology().edges.row(e), Eigen::all).colwise().mean();
            most = std::max(most, angle_off(mesh, field, e, angle(m.x(), m.y())));
        }
        return most;
    };
    for (const auto method : {"gl", mbo, "eigen"}) {
        EXPECT_LT(worst(0.01, method), 0.04);
        EXPECT_GT(worst(10, method), 0.2);  // smoothness wins: nearly parallel
    }
}

TEST(Guide, AlongTheCurvatureLinesOfATorusLeavesNoSingularPoint) {
    const TriangleMesh mesh = torus(60, 30, 1, 0.5);
    DirectionFieldOptions options;
    options.guide.directions.resize(mesh.triangles.rows(), 3);
    for (Index t = 0; t < mesh.triangles.rows(); ++t)
        options.guide.directions.row(t) =
            azimuth(mesh.vertices(mesh.triangles.row(t), Eigen::all).colwise().mean().transpose());
    for (const auto method : {"gl", mbo, "eigen"}) {
        options.method = method;
        EXPECT_TRUE(surface_singularities(direction_field(mesh, options)).points.empty());
    }
    EXPECT_FALSE(surface_singularities(direction_field(mesh, {.method = "eigen"})).points.empty());
}

TEST(Guide, WithoutWeightIsNoGuide) {
    const TriangleMesh mesh = disk(6);
    DirectionFieldOptions options;
    options.guide.directions = Points::Zero(mesh.triangles.rows(), 3);
    options.guide.weights = Eigen::VectorXd::Zero(mesh.triangles.rows());
    EXPECT_TRUE(direction_field(mesh, options).values == direction_field(mesh).values);
}

// ---- bad input ----

template <class Change>
std::string refusal_of(const Change& change) {
    const TriangleMesh mesh = square(4);
    DirectionFieldOptions options;
    options.constraints.edges = edge_topology(mesh).edges.row(5);
    options.constraints.edge_directions = Points::Ones(1, 3);
    options.constraints.vertices = {12};
    options.constraints.vertex_directions = Points::Ones(1, 3);
    change(options, mesh);
    try {
        direction_field(mesh, options);
    } catch (const InvalidInput& error) {
        return error.kind();
    }
    return "";
}

TEST(Alignment, RefusesConstraintsAndGuidesThatMakeNoSense) {
    using O = DirectionFieldOptions;
    using M = TriangleMesh;
    EXPECT_EQ(refusal_of([](O&, const M&) {}), "");
    EXPECT_EQ(refusal_of([](O& o, const M&) { o.constraints.edge_directions.resize(2, 3); }), "wrong_size");
    EXPECT_EQ(refusal_of([](O& o, const M&) { o.constraints.vertex_weights.setOnes(3); }), "wrong_size");
    EXPECT_EQ(refusal_of([](O& o, const M&) { o.constraints.edges << 0, 24; }), "unknown_edge");
    EXPECT_EQ(refusal_of([](O& o, const M&) { o.constraints.vertices = {25}; }), "index_out_of_range");
    EXPECT_EQ(refusal_of([](O& o, const M&) { o.constraints.vertex_directions << 0, 0, 1; }), "bad_constraint");
    EXPECT_EQ(refusal_of([](O& o, const M&) { o.constraints.edge_directions.setZero(); }), "bad_constraint");
    EXPECT_EQ(refusal_of([](O& o, const M&) { o.constraints.edge_directions(0, 1) = std::nan(""); }), "bad_constraint");
    EXPECT_EQ(refusal_of([](O& o, const M&) { o.constraints.edge_weights = Eigen::VectorXd::Zero(1); }),
              "bad_constraint");
    EXPECT_EQ(refusal_of([](O& o, const M& m) { o.guide.directions.setZero(m.triangles.rows(), 3); }), "bad_guide");
    EXPECT_EQ(refusal_of([](O& o, const M&) { o.guide.directions.setOnes(3, 3); }), "wrong_size");
    EXPECT_EQ(refusal_of([](O& o, const M&) {
                  o.constraints.edges = o.constraints.edges.replicate(2, 1).eval();
                  o.constraints.edge_directions.resize(2, 3);
                  o.constraints.edge_directions << 1, 0, 0, 1, 0.2, 0;
              }),
              "contradiction");
    const TriangleMesh mesh = disk(3);
    EXPECT_THROW(direction_field(mesh, {.alignment_length = -1}), InvalidInput);
    EXPECT_THROW(direction_field(mesh, {.corner_tolerance = 2}), InvalidInput);
    EXPECT_THROW(direction_field(mesh, {.first_epsilon = -1}), InvalidInput);
}

}  // namespace
}  // namespace octafield::surface
