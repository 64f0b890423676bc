#include "octafield/surface/atlas.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "../mesh_fixtures.hpp"
#include "least_cut.hpp"
#include "octafield/error.hpp"
#include "octafield/surface/bisected_edges.hpp"

namespace octafield::surface {
namespace {

// Closed tube of the given length and 1 across, in `along` rows.
TriangleMesh tube(int around, int along, double length) {
    std::vector<Eigen::Vector3d> points = {{0, 0, 0}, {0, 0, length}};
    std::vector<Eigen::Vector3i> triangles;
    for (int j = 0; j <= along; ++j)
        for (int i = 0; i < around; ++i) {
            const double angle = 2 * std::numbers::pi * i / around;
            points.emplace_back(std::cos(angle) / 2, std::sin(angle) / 2, length * j / along);
            const int a = 2 + j * around + i, b = 2 + j * around + (i + 1) % around;
            if (j == 0) triangles.emplace_back(0, b, a);
            if (j == along) triangles.emplace_back(1, a, b);
            if (j < along) triangles.insert(triangles.end(), {{a, b, b + around}, {a, b + around, a + around}});
        }
    return testing::make_mesh(points, triangles);
}

SurfaceDomain with_features(const TriangleMesh& mesh) { return {mesh, detect_features(mesh)}; }

// What every atlas has, whatever the surface.
void expect_sound(const Atlas& made, const AtlasOptions& options = {}) {
    const SurfaceDomain& domain = made.domain;
    EXPECT_TRUE(not_positive(made.uv, made.uv_triangles).empty());
    std::vector<Index> chart_of_row(made.uv.rows(), -1);
    for (Index t = 0; t < domain.triangle_count(); ++t)
        for (int k = 0; k < 3; ++k) {
            const Index row = made.uv_triangles(t, k);
            EXPECT_EQ(made.origins[row], domain.mesh().triangles(t, k));
            EXPECT_TRUE(chart_of_row[row] == -1 || chart_of_row[row] == made.charts[t]);
            chart_of_row[row] = made.charts[t];
        }
    EXPECT_EQ(std::count(chart_of_row.begin(), chart_of_row.end(), -1), 0);
    // u, v end at the cuts, the features and the boundary, and nowhere else.
    std::set<std::pair<Index, Index>> cuts;
    for (const auto edge : made.cuts.rowwise()) cuts.emplace(edge[0], edge[1]);
    std::vector<std::array<Index, 4>> rows(domain.edge_count(), {-1, -1, -1, -1});
    for (Index t = 0; t < domain.triangle_count(); ++t)
        for (int k = 0; k < 3; ++k) {
            const Index e = domain.topology().triangle_edges(t, k);
            const bool first = domain.topology().edge_triangles(e, 0) == t;
            rows[e][first ? 0 : 3] = made.uv_triangles(t, k);
            rows[e][first ? 1 : 2] = made.uv_triangles(t, (k + 1) % 3);
        }
    for (Index e = 0; e < domain.edge_count(); ++e) {
        const bool cut = cuts.count({domain.topology().edges(e, 0), domain.topology().edges(e, 1)}) > 0;
        const bool joined = rows[e][0] == rows[e][2] && rows[e][1] == rows[e][3];
        if (cut) {
            EXPECT_FALSE(joined);
            EXPECT_FALSE(domain.is_feature()[e]);
        } else if (!domain.is_feature()[e]) {
            EXPECT_TRUE(joined);
        }
    }
    for (const AtlasChart& chart : made.chart_list) {
        EXPECT_LE(chart.triangles, options.max_triangles);
        EXPECT_EQ(chart.as_asked, chart.conformity >= options.conformity) << chart.evenness;
        EXPECT_LE(chart.least_conformity, chart.conformity);
    }
}

TEST(Atlas, OfSpheresAndToriIsOneChart) {
    for (const TriangleMesh& mesh : {testing::icosphere(0), testing::icosphere(3), testing::torus(40, 20, 1, 0.4)}) {
        const Atlas made = atlas(mesh);
        expect_sound(made);
        EXPECT_EQ(made.chart_list.size(), 1u);
        EXPECT_GT(made.chart_list[0].conformity, 0.2);
        EXPECT_EQ(made.domain.triangle_count(), mesh.triangles.rows());
    }
}

TEST(Atlas, OfACubeHasItsFacesAndBendsNone) {
    const Atlas made = atlas(with_features(testing::cube_surface(6)));
    expect_sound(made);
    EXPECT_EQ(made.face_list.size(), 6u);
    EXPECT_EQ(made.chart_list.size(), 6u);
    EXPECT_EQ(made.cuts.rows(), 0);
    for (const AtlasChart& chart : made.chart_list) EXPECT_NEAR(chart.area, 1, 1e-12);
}

TEST(Atlas, OfATetrahedronWithoutFeaturesIsOneChart) {
    const TriangleMesh mesh =
        testing::make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
    const Atlas made = atlas(mesh, {.conformity = 0, .bisect = false});
    expect_sound(made, {.conformity = 0});
    EXPECT_EQ(made.chart_list.size(), 1u);
    EXPECT_EQ(made.cuts.rows(), 2);
}

TEST(Atlas, LeavesDanglingFeaturesInsideCharts) {
    const TriangleMesh mesh = testing::disk(6);
    const SurfaceDomain domain(mesh, feature_graph(mesh, Edges{{0, 1}}));
    const Atlas made = atlas(domain);
    EXPECT_EQ(made.chart_list.size(), 1u);
    EXPECT_EQ(made.chart_list[0].loops, 1);
}

TEST(Atlas, SplitsToTheMostTriangles) {
    const AtlasOptions options{.max_triangles = 300};
    const Atlas made = atlas(testing::icosphere(3), options);
    expect_sound(made, options);
    EXPECT_EQ(made.chart_list.size(), 5u);  // of 1280 triangles
}

TEST(Atlas, CutsLongTubesOpenRatherThanSplitThem) {
    const Atlas made = atlas(tube(16, 100, 20));  // no features: the caps are parts of it
    expect_sound(made);
    EXPECT_EQ(made.chart_list.size(), 1u);
}

TEST(Atlas, GivesCoarseFacesVerticesInsideAndKeepsTheGeometry) {
    const SurfaceDomain domain = testing::make_mesh(  // a cross of five squares
        {{1, 0, 0},
         {2, 0, 0},
         {2, 1, 0},
         {3, 1, 0},
         {3, 2, 0},
         {2, 2, 0},
         {2, 3, 0},
         {1, 3, 0},
         {1, 2, 0},
         {0, 2, 0},
         {0, 1, 0},
         {1, 1, 0}},
        {{0, 1, 2},
         {0, 2, 11},
         {2, 3, 4},
         {2, 4, 5},
         {5, 6, 7},
         {5, 7, 8},
         {8, 9, 10},
         {8, 10, 11},
         {11, 2, 5},
         {11, 5, 8}});
    const AtlasOptions options{.conformity = 0.2};
    const Atlas made = atlas(domain, options);
    expect_sound(made, options);
    EXPECT_EQ(made.chart_list.size(), 1u);
    EXPECT_TRUE(made.chart_list[0].as_asked);
    EXPECT_GT(made.domain.triangle_count(), domain.triangle_count());
    Eigen::VectorXd areas = Eigen::VectorXd::Zero(domain.triangle_count());
    for (Index t = 0; t < made.domain.triangle_count(); ++t) areas[made.parents[t]] += made.domain.areas()[t];
    EXPECT_LT((areas - domain.areas()).cwiseAbs().maxCoeff(), 1e-12);
    AtlasOptions as_it_is = options;
    as_it_is.bisect = false;
    EXPECT_EQ(atlas(domain, as_it_is).domain.triangle_count(), domain.triangle_count());
}

TEST(Atlas, IsTheSameEachTimeAndWhateverTheUnit) {
    TriangleMesh mesh = testing::torus(30, 16, 1, 0.3);
    const Atlas made = atlas(mesh), again = atlas(mesh);
    EXPECT_EQ(made.uv, again.uv);
    mesh.vertices *= 1024;
    const Atlas larger = atlas(mesh);
    EXPECT_EQ(made.charts, larger.charts);
    EXPECT_LT((made.uv - larger.uv).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(Atlas, RefusesOptionsAndSurfacesThatAreNone) {
    EXPECT_THROW(atlas(testing::icosphere(1), {.conformity = 1}), InvalidInput);
    EXPECT_THROW(atlas(testing::icosphere(1), {.conformity = std::nan("")}), InvalidInput);
    EXPECT_THROW(atlas(testing::icosphere(1), {.max_triangles = 0}), InvalidInput);
    EXPECT_THROW(atlas(TriangleMesh{}), GeometryError);
    EXPECT_THROW(atlas(testing::icosphere(1), {}, [](auto, auto, auto) { return false; }), Cancelled);
}

TEST(PackedUv, PutsChartsSideBySideAtOneScale) {
    const Atlas made = atlas(with_features(testing::cube_surface(5)));
    double scale = 0;
    const PlanePoints uv = packed_uv(made, &scale);
    EXPECT_GE(uv.minCoeff(), 0);
    EXPECT_LE(uv.maxCoeff(), 1);
    EXPECT_TRUE(not_positive(uv, made.uv_triangles).empty());
    std::vector<Eigen::AlignedBox<double, 2>> boxes(made.chart_list.size());
    double area = 0;
    for (Index t = 0; t < made.uv_triangles.rows(); ++t) {
        Eigen::Matrix2d sides;
        for (int k = 0; k < 3; ++k) boxes[made.charts[t]].extend(uv.row(made.uv_triangles(t, k)).transpose());
        for (int k = 0; k < 2; ++k)
            sides.row(k) = uv.row(made.uv_triangles(t, k + 1)) - uv.row(made.uv_triangles(t, 0));
        area += sides.determinant() / 2;
    }
    for (std::size_t a = 0; a < boxes.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) EXPECT_FALSE(boxes[a].intersects(boxes[b]));
    EXPECT_NEAR(area, 6 * scale * scale, 0.1 * area);  // polygons in circles
    EXPECT_GT(area, 0.45);
    Atlas broken = made;
    broken.uv_triangles(0, 0) = 100000;
    EXPECT_THROW(packed_uv(broken), InvalidInput);
}

TEST(BisectedEdges, AreAllShorterAndTheFeaturesTheSameCurves) {
    const SurfaceDomain domain = with_features(testing::cube_surface(1));
    const BisectedEdges made = bisected_edges(domain, Eigen::VectorXd::Constant(domain.triangle_count(), 0.3));
    EXPECT_LE(made.domain.edge_lengths().maxCoeff(), 0.3);
    EXPECT_GT(made.domain.edge_lengths().minCoeff(), 0.1);
    double length = 0;
    for (const auto edge : made.domain.features().edges.rowwise())
        length += (made.domain.mesh().vertices.row(edge[0]) - made.domain.mesh().vertices.row(edge[1])).norm();
    EXPECT_NEAR(length, 12, 1e-12);
    EXPECT_EQ(made.domain.features().corners, domain.features().corners);
    EXPECT_THROW(bisected_edges(domain, Eigen::VectorXd::Constant(domain.triangle_count(), 0.001), 1000), InvalidInput);
    EXPECT_THROW(bisected_edges(domain, Eigen::VectorXd::Zero(domain.triangle_count())), InvalidInput);
    EXPECT_THROW(bisected_edges(domain, Eigen::VectorXd::Ones(2)), InvalidInput);
}

TEST(LeastCut, IsTheLeastOfAllOnSmallNetworks) {
    std::mt19937 random(3);
    for (int trial = 0; trial < 50; ++trial) {
        const Index nodes = 8;
        std::vector<std::tuple<Index, Index, std::int64_t>> arcs;
        detail::Network network(nodes);
        for (Index a = 0; a < nodes; ++a)
            for (Index b = a + 1; b < nodes; ++b)
                if (random() % 2 == 0) {
                    arcs.emplace_back(a, b, 1 + random() % 20);
                    network.add(a, b, std::get<2>(arcs.back()));
                }
        const auto cost = [&](const auto& inside) {
            std::int64_t sum = 0;
            for (const auto& [a, b, capacity] : arcs)
                if (inside(a) != inside(b)) sum += capacity;
            return sum;
        };
        std::int64_t least = std::numeric_limits<std::int64_t>::max();
        for (unsigned set = 0; set < 1u << nodes; ++set)
            if ((set & 1) && !(set >> (nodes - 1) & 1))
                least = std::min(least, cost([&](Index v) { return (set >> v & 1) != 0; }));
        const std::vector<bool> inside = network.least_cut(0, nodes - 1);
        EXPECT_TRUE(inside[0]);
        EXPECT_FALSE(inside[nodes - 1]);
        EXPECT_EQ(cost([&](Index v) { return static_cast<bool>(inside[v]); }), least);
    }
}

}  // namespace
}  // namespace octafield::surface
