// The map to the integer grid, checked from its coordinates alone.
#include <algorithm>

#include "octafield/surface/feature_cut.hpp"
#include "octafield/surface/integer_grid_map.hpp"
#include "quad_checks.hpp"

namespace octafield::surface {
namespace {

using Vector2 = Eigen::Vector2d;

Vector2 place(const IntegerGridMap& map, Eigen::Index corner) { return map.coordinates.row(corner); }

double twice_area(const IntegerGridMap& map, Eigen::Index t) {
    const Vector2 u = place(map, 3 * t + 1) - place(map, 3 * t), v = place(map, 3 * t + 2) - place(map, 3 * t);
    return u[0] * v[1] - u[1] * v[0];
}

double off_whole(double x) { return std::abs(x - std::round(x)); }

// Every triangle has its sense; edges inside are turned by quarters and shifted by whole numbers; those of the boundary
// are on lines of whole numbers. Returns the area.
double expect_grid_map(const IntegerGridMap& map) {
    double area = 0;
    std::map<std::pair<Index, Index>, Eigen::Index> side_of;
    for (Eigen::Index t = 0; t < map.triangles.rows(); ++t) {
        EXPECT_GT(twice_area(map, t), 0);
        area += twice_area(map, t) / 2;
        for (int k = 0; k < 3; ++k) {
            const bool is_new =
                side_of.emplace(std::pair(map.triangles(t, k), map.triangles(t, (k + 1) % 3)), 3 * t + k).second;
            EXPECT_TRUE(is_new);
        }
    }
    const auto next = [](Eigen::Index s) { return s % 3 == 2 ? s - 2 : s + 1; };
    for (const auto& [ends, side] : side_of) {
        const Vector2 a = place(map, side), b = place(map, next(side));
        const auto found = side_of.find({ends.second, ends.first});
        if (found == side_of.end()) {
            const bool flat = std::abs(a[0] - b[0]) < 1e-9;
            EXPECT_LT(off_whole(flat ? a[0] : a[1]), 1e-9);
            EXPECT_LT(std::abs(flat ? a[0] - b[0] : a[1] - b[1]), 1e-9);
            continue;
        }
        // As complex numbers, (d - c) / (b - a) is a power of i.
        const Vector2 c = place(map, next(found->second)), d = place(map, found->second);
        const Complex turn = Complex(d[0] - c[0], d[1] - c[1]) / Complex(b[0] - a[0], b[1] - a[1]);
        EXPECT_LT(std::abs(turn * turn * turn * turn - 1.0), 1e-5);
        const Complex rounded(std::round(turn.real()), std::round(turn.imag()));
        const Complex shift = Complex(c[0], c[1]) - rounded * Complex(a[0], a[1]);
        EXPECT_LT(off_whole(shift.real()) + off_whole(shift.imag()), 1e-7);
    }
    EXPECT_LT(map.largest_residual, 1e-8);
    EXPECT_GE(map.mean_distortion, 1 - 1e-12);
    EXPECT_LE(map.mean_distortion, map.largest_distortion);
    return area;
}

TEST(IntegerGridMap, OfASquareIsASimilarity) {
    const QuadLayout layout = motorcycle_graph(polygon_field(4, 8));
    const QuantizedQuads quads = quantized(layout, 400);
    const IntegerGridMap map = integer_grid_map(layout, quads);
    EXPECT_NEAR(expect_grid_map(map), 400, 1e-9);
    EXPECT_LT(map.largest_distortion, 1 + 1e-9);
    EXPECT_TRUE(map.singular.empty());
}

TEST(IntegerGridMap, OfADiskHasItsPointsAtWholeNumbers) {
    const QuadLayout layout = motorcycle_graph(disk_field(20, four_in_disk(0.5, {0, 90, 180, 270})));
    const QuantizedQuads quads = quantized(layout, 300);
    const IntegerGridMap map = integer_grid_map(layout, quads);
    EXPECT_NEAR(expect_grid_map(map), static_cast<double>(quads.mesh.quads.rows()), 1e-6);
    ASSERT_EQ(map.singular.size(), 4u);
    for (Eigen::Index c = 0; c < map.coordinates.rows(); ++c) {
        if (!std::binary_search(map.singular.begin(), map.singular.end(), map.triangles(c / 3, c % 3))) continue;
        EXPECT_LT(off_whole(map.coordinates(c, 0)) + off_whole(map.coordinates(c, 1)), 1e-12);
    }
    EXPECT_LT(map.mean_distortion, 1.05);
}

// On both sides of a seam, coordinates along it go up alike.
TEST(IntegerGridMap, OfACubeAgreesAlongItsEdges) {
    const TriangleMesh cube = cube_surface(4);
    const FeatureCut cut = cut_along_features(SurfaceDomain(cube, detect_features(cube)));
    const QuadLayout layout = motorcycle_graph(impose_singular_points(cut.domain, {}));
    QuantizedQuadsOptions options;
    options.quad_count = 600;
    options.origins = cut.origins;
    const QuantizedQuads quads = quantized_quads(layout, options);
    const IntegerGridMap map = integer_grid_map(layout, quads, cut.origins);
    EXPECT_NEAR(expect_grid_map(map), 600, 1e-6);
    std::map<std::array<long, 6>, std::vector<double>> lengths;  // by the edge's two places in space
    std::map<std::pair<Index, Index>, int> uses;
    for (Eigen::Index s = 0; s < 3 * map.triangles.rows(); ++s)
        ++uses[std::minmax(map.triangles(s / 3, s % 3), map.triangles(s / 3, (s + 1) % 3))];
    for (Eigen::Index s = 0; s < 3 * map.triangles.rows(); ++s) {
        const Eigen::Index n = s % 3 == 2 ? s - 2 : s + 1;
        const Index a = map.triangles(s / 3, s % 3), b = map.triangles(n / 3, n % 3);
        if (uses[std::minmax(a, b)] == 2) continue;
        std::array<long, 6> key;
        const Eigen::RowVector3d middle = map.positions.row(a) + map.positions.row(b);
        const Eigen::RowVector3d apart = (map.positions.row(a) - map.positions.row(b)).cwiseAbs();
        for (int k = 0; k < 3; ++k) {
            key[k] = std::lround(1e6 * middle[k]);
            key[k + 3] = std::lround(1e6 * apart[k]);
        }
        lengths[key].push_back((place(map, n) - place(map, s)).norm());
    }
    for (const auto& [key, both] : lengths) {
        ASSERT_EQ(both.size(), 2u);
        EXPECT_NEAR(both[0], both[1], 1e-9);
    }
}

// Nothing but a vertex that is chosen holds the map.
TEST(IntegerGridMap, OfATorusIsWholeNumbersRound) {
    const QuadLayout layout = motorcycle_graph(impose_singular_points(SurfaceDomain(torus(24, 12, 1, 0.5)), {}));
    const QuantizedQuads quads = quantized(layout, 300);
    const IntegerGridMap map = integer_grid_map(layout, quads);
    EXPECT_NEAR(expect_grid_map(map), static_cast<double>(quads.mesh.quads.rows()), 1e-6);
    EXPECT_TRUE(map.singular.empty());
}

// Tracks that became one: tiles without width.
TEST(IntegerGridMap, GoesOverTilesWithoutQuads) {
    const QuadLayout layout =
        motorcycle_graph(disk_field(14, four_in_disk(0.6, {0, 83, 190, 262})), LayoutCurveOptions{1e-6});
    const QuantizedQuads quads = quantized(layout, 100, Blocks::few);
    ASSERT_TRUE(std::count(quads.arc_counts.begin(), quads.arc_counts.end(), 0) > 0);
    const IntegerGridMap map = integer_grid_map(layout, quads);
    EXPECT_NEAR(expect_grid_map(map), static_cast<double>(quads.mesh.quads.rows()), 1e-6);
    EXPECT_EQ(map.singular.size(), 4u);
}

TEST(IntegerGridMap, NumbersOfAnotherLayoutAreRefused) {
    const QuadLayout layout = motorcycle_graph(polygon_field(4, 6));
    const QuantizedQuads quads = quantized(layout, 100);
    for (int way = 0; way < 5; ++way) {
        QuantizedQuads other = quads;
        if (way == 0) other.arc_counts.pop_back();
        if (way == 1) ++other.arc_counts[0];
        if (way == 2) other.part_counts.clear();
        if (way == 3) other.size = std::nan("");
        if (way == 4) other.arc_counts.assign(other.arc_counts.size(), -1);
        EXPECT_EQ(kind_of([&] { integer_grid_map(layout, other); }), "bad_option") << way;
    }
    EXPECT_EQ(kind_of([&] { integer_grid_map({}, quads); }), "bad_option");
}

}  // namespace
}  // namespace octafield::surface
