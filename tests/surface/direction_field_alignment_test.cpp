// How a direction field follows boundary and features: strongly, weakly, not at all; corners; surfaces with one side.
#include "direction_field_fixtures.hpp"

#include "alignment.hpp"

namespace octafield::surface {
namespace {

TriangleMesh ellipse(int rings, double height) {
    TriangleMesh mesh = disk(rings);
    mesh.vertices.col(1) *= height;
    return mesh;
}

// ---- boundary ----

TEST(WeakBoundary, TendsToTheStrongOneAsItsLengthGrows) {
    const TriangleMesh mesh = disk(16);
    const auto at = [&](Alignment boundary, double length) {
        return direction_field(mesh, {.epsilon = 0.1, .boundary_alignment = boundary, .alignment_length = length})
            .energy;
    };
    const double strong = at(Alignment::strong, 0);
    double before = 0;
    for (const double length : {0.1, 1.0, 10.0, 1000.0}) {
        const double weak = at(Alignment::weak, length);
        EXPECT_GT(weak, before);
        EXPECT_LT(weak, strong * (1 + 1e-6));
        before = weak;
    }
    EXPECT_NEAR(before, strong, 1e-3 * strong);
}

TEST(WeakBoundary, LetsSingularPointsSitOnTheBoundary) {
    // A slender ellipse: held strongly, the points stay inside near the tips.
    const TriangleMesh mesh = ellipse(24, 0.25);
    const auto on_boundary = [&](Alignment boundary, double length) {
        const auto found = surface_singularities(
            direction_field(mesh, {.epsilon = 0.1, .boundary_alignment = boundary, .alignment_length = length}));
        EXPECT_TRUE(found.agree);
        return std::count_if(found.points.begin(), found.points.end(), [](const auto& p) { return p.boundary; });
    };
    EXPECT_EQ(on_boundary(Alignment::strong, 0), 0);
    EXPECT_EQ(on_boundary(Alignment::weak, 0.02), 4);
    EXPECT_EQ(on_boundary(Alignment::weak, 100), 0);
}

TEST(WeakBoundary, OnASquareAndAnLTheFieldIsThatOfTheStrongOne) {
    // Parallel to the axes: both terms are 0.
    for (const TriangleMesh& mesh : {square(6), plate(8, [](double x, double y) { return x < 0.5 || y < 0.5; })}) {
        for (const auto boundary : {Alignment::strong, Alignment::weak}) {
            const DirectionField field = direction_field(mesh, {.boundary_alignment = boundary});
            EXPECT_NEAR(field.energy, 0, 1e-9);
            EXPECT_EQ(surface_singularities(field).points.size(), mesh.vertices.rows() == 49 ? 4u : 6u);
        }
    }
}

TEST(FreeBoundary, LeavesAPlaneFieldParallel) {
    const TriangleMesh mesh = disk(10);
    for (const auto method : {"gl", mbo, "eigen"}) {
        const DirectionField field = direction_field(mesh, {.method = method, .boundary_alignment = Alignment::none});
        EXPECT_NEAR(field.energy, 0, 1e-6);
    }
}

// ---- features ----

FeatureGraph middle_line(const TriangleMesh& mesh) {  // x = 1/2 in the unit square
    FeatureGraph features;
    std::vector<std::pair<Index, Index>> found;
    const EdgeTopology topology = edge_topology(mesh);
    for (Index e = 0; e < topology.edges.rows(); ++e)
        if (std::abs(mesh.vertices(topology.edges(e, 0), 0) - 0.5) +
                std::abs(mesh.vertices(topology.edges(e, 1), 0) - 0.5) <
            1e-9)
            found.emplace_back(topology.edges(e, 0), topology.edges(e, 1));
    features.edges.resize(static_cast<Eigen::Index>(found.size()), 2);
    for (std::size_t i = 0; i < found.size(); ++i) features.edges.row(i) << found[i].first, found[i].second;
    return features;
}

TEST(Features, AreFollowedStronglyWeaklyOrNotAtAll) {
    // With N = 6 the sides of a square contradict each other, and a line across it adds to that.
    const TriangleMesh mesh = square(8);
    const FeatureGraph line = middle_line(mesh);
    ASSERT_EQ(line.edges.rows(), 8);
    const auto energy = [&](Alignment features, double flat) {
        DirectionFieldOptions options{.symmetry = 6, .feature_alignment = features, .least_feature_angle = flat};
        return direction_field({mesh, line}, options).energy;
    };
    const double none = direction_field(mesh, {.symmetry = 6}).energy;
    EXPECT_EQ(energy(Alignment::none, 0), none);
    EXPECT_EQ(energy(Alignment::strong, 0.1), none);  // a flat feature
    EXPECT_GT(energy(Alignment::strong, 0), none);
    EXPECT_GT(energy(Alignment::strong, 0), energy(Alignment::weak, 0));
}

TEST(Features, OfOddSymmetryAreTakenWhenTheyAreNotFollowed) {
    const TriangleMesh mesh = square(4);
    EXPECT_THROW(direction_field({mesh, middle_line(mesh)}, {.symmetry = 3}), InvalidInput);
    EXPECT_NO_THROW(direction_field({mesh, middle_line(mesh)}, {.symmetry = 3, .feature_alignment = Alignment::none}));
}

// ---- corners ----

TEST(Corners, OnlyThoseNoFieldCanFollowAreWeak) {
    // A kite with corners of 60, 90, 120 and 90 degrees, split.
    const double h = std::sqrt(3.0) / 2;
    const TriangleMesh kite = make_mesh({{0, 0, 0}, {1.5, h, 0}, {2, 0, 0}, {1.5, -h, 0}}, {{0, 2, 1}, {0, 3, 2}});
    const auto topology = edge_topology(kite);
    const auto contradicting = [&](int symmetry, double tolerance) {
        const auto links = detail::corner_links(kite, symmetry);
        std::vector<bool> follows(topology.edges.rows());
        for (Index e = 0; e < topology.edges.rows(); ++e) follows[e] = topology.edge_triangles.row(e).minCoeff() < 0;
        const auto result = detail::contradicting_edges(kite, links, symmetry, follows,
                                                        Eigen::VectorXcd::Ones(topology.edges.rows()), tolerance);
        return std::vector<bool>(result.begin(), result.end());
    };
    // Edges 0-1, 0-2 (inside), 0-3, 1-2, 2-3. N = 4: the corners of 60 and 120 degrees are off by 2/3 of the worst.
    EXPECT_EQ(contradicting(4, 0.6), (std::vector<bool>{true, false, true, true, true}));
    EXPECT_EQ(contradicting(4, 0.7), (std::vector<bool>{false, false, false, false, false}));
    // N = 6: those of 90 degrees, off by the worst.
    EXPECT_EQ(contradicting(6, 0.9), (std::vector<bool>{true, false, true, true, true}));
    EXPECT_EQ(contradicting(6, 1), (std::vector<bool>{false, false, false, false, false}));
    EXPECT_EQ(contradicting(2, 0.7), (std::vector<bool>{true, false, true, true, true}));
}

TEST(Corners, WeakOnesLowerTheEnergyAndKeepTheIndexSum) {
    // An equilateral triangle of 100 small ones.
    std::vector<Vector> points;
    std::vector<Eigen::Vector3i> triangles;
    const auto id = [](int i, int j) { return (i + j) * (i + j + 1) / 2 + j; };
    for (int s = 0; s <= 10; ++s)
        for (int j = 0; j <= s; ++j) points.emplace_back((s - j) + j * 0.5, j * std::sqrt(3.0) / 2, 0);
    for (int i = 0; i < 10; ++i)
        for (int j = 0; i + j < 10; ++j) {
            triangles.emplace_back(id(i, j), id(i + 1, j), id(i, j + 1));
            if (i + j + 1 < 10) triangles.emplace_back(id(i + 1, j), id(i + 1, j + 1), id(i, j + 1));
        }
    const TriangleMesh mesh = make_mesh(points, triangles);
    const DirectionField weak = direction_field(mesh, {}), strong = direction_field(mesh, {.corner_tolerance = 1});
    EXPECT_LT(weak.dirichlet_energy, strong.dirichlet_energy);
    for (const DirectionField& field : {weak, strong}) {
        const auto found = surface_singularities(field);
        EXPECT_TRUE(found.agree);
        EXPECT_EQ(found.index_sum, 1);
    }
    // Away from the corners the sides are followed exactly in both.
    int exact = 0, sides = 0;
    for (Index e = 0; e < weak.values.size(); ++e)
        if (weak.domain.topology().edge_triangles.row(e).minCoeff() < 0) {
            ++sides;
            exact += weak.values[e] == Complex(1);
            EXPECT_EQ(strong.values[e], Complex(1));
        }
    EXPECT_EQ(sides - exact, 6);
}

TEST(Alignment, RefusesSurfacesWithOneSide) {
    // A Moebius strip of 12 squares; and a strip that is merely inconsistent.
    std::vector<Vector> points;
    std::vector<Eigen::Vector3i> triangles;
    for (int i = 0; i < 12; ++i) {
        const double u = 2 * pi * i / 12;
        for (const double s : {-0.3, 0.3})
            points.emplace_back((1 + s * std::cos(u / 2)) * std::cos(u), (1 + s * std::cos(u / 2)) * std::sin(u),
                                s * std::sin(u / 2));
        const int a = 2 * i, b = a + 1, c = i < 11 ? a + 2 : 1, d = i < 11 ? a + 3 : 0;
        triangles.insert(triangles.end(), {{a, b, c}, {b, d, c}});
    }
    const auto kind = [&] {
        try {
            direction_field(make_mesh(points, triangles));
        } catch (const GeometryError& error) {
            return error.kind();
        }
        return std::string();
    };
    EXPECT_EQ(kind(), "not_orientable");
    triangles.pop_back();
    std::swap(triangles[4][0], triangles[4][1]);
    EXPECT_EQ(kind(), "inconsistent_orientation");
}

}  // namespace
}  // namespace octafield::surface
