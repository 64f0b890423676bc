// Counts, directions and ends of separatrices on fields known in closed form; distances of evenly spread curves.
#include "streamline_fixtures.hpp"

namespace octafield::surface {
namespace {

// ---- separatrices ----

TEST(Separatrices, PointsOfIndexKHaveNMinusKOfThemEvenlySpread) {
    const TriangleMesh mesh = disk(20);
    const Vector zero(0.031, 0.012, 0);
    for (const int symmetry : {1, 2, 3, 4, 6})
        for (const int turns : {-2, -1, 1}) {
            const auto direction = [&](const Vector& x) {
                return at_angle(0.4 + turns * std::atan2(x.y() - zero.y(), x.x() - zero.x()) / symmetry);
            };
            const auto field = prescribed(mesh, symmetry, direction, up);
            SurfaceSingularities found = surface_singularities(field);
            std::erase_if(found.points, [](const auto& point) { return point.boundary; });
            if (turns == -2 && found.points.size() != 1) continue;  // split in two simple points
            ASSERT_EQ(found.points.size(), 1u);
            const auto lines = separatrices(field, found);
            ASSERT_EQ(static_cast<int>(lines.size()), symmetry - turns) << symmetry << " " << turns;
            expect_sound(mesh, lines);
            for (const Streamline& line : lines) {
                EXPECT_EQ(line.first_end, End::singularity);
                EXPECT_EQ(line.first_singularity, 0);
                EXPECT_EQ(Vector(line.points.row(0)), found.points[0].position);
                EXPECT_EQ(line.last_end, End::boundary);
                // Straight rays where 0.4 + turns phi / N = phi (mod 2 pi / N).
                const Vector last = line.points.row(line.points.rows() - 1);
                const double phi = std::atan2(last.y() - zero.y(), last.x() - zero.x());
                const double residue = std::remainder(0.4 * symmetry + (turns - symmetry) * phi, 2 * pi);
                EXPECT_NEAR(residue / (symmetry - turns), 0, 0.06) << symmetry << " " << turns;
            }
        }
}

// f = prod (z - a)(1 - conj(a) z) / |...|: tangent to the unit circle, harmonic phase.
DirectionField polygon_field(const TriangleMesh& mesh, const std::vector<Complex>& points, double unit = 1) {
    const auto direction = [&](const Vector& x) {
        const Complex z(x.x() / unit, x.y() / unit);
        Complex f = 1;
        for (const Complex& a : points) f *= (z - a) * (1.0 - std::conj(a) * z);
        return at_angle(std::arg(f) / 4);
    };
    return prescribed(mesh, 4, direction, up);
}

TEST(Separatrices, OfFourPointsInADiskConnectThem) {
    const TriangleMesh mesh = disk(32);
    std::vector<Complex> square_points;
    for (int i = 0; i < 4; ++i) square_points.push_back(std::polar(std::pow(3.0 / 11, 1.0 / 8), 0.3 + i * pi / 2));
    const auto field = polygon_field(mesh, square_points);
    const auto found = surface_singularities(field);
    ASSERT_EQ(found.points.size(), 4u);
    const auto lines = separatrices(field, found);
    expect_sound(mesh, lines);
    ASSERT_EQ(lines.size(), 12u);
    std::vector<std::pair<Index, Index>> connections;
    for (const Streamline& line : lines)
        if (line.last_end == End::singularity) {
            connections.emplace_back(line.first_singularity, line.last_singularity);
        } else {
            EXPECT_EQ(line.last_end, End::boundary);
            EXPECT_NEAR(line.length, 1 - std::abs(square_points[0]), 0.02);
        }
    ASSERT_EQ(connections.size(), 8u);
    for (const auto& [a, b] : connections)  // there and back
        EXPECT_EQ(std::count(connections.begin(), connections.end(), std::pair(b, a)), 1);
}

TEST(Separatrices, OfACubeRunAlongItsEdges) {
    const TriangleMesh mesh = cube_surface(6);
    const auto normal = [](const Vector& x) {
        const Vector from_middle = x - Vector::Constant(0.5);
        int axis;
        from_middle.cwiseAbs().maxCoeff(&axis);
        return Vector(from_middle[axis] * Vector::Unit(axis));
    };
    const auto direction = [&](const Vector& x) {
        int axis;
        (x - Vector::Constant(0.5)).cwiseAbs().maxCoeff(&axis);
        return Vector(Vector::Unit((axis + 1) % 3));
    };
    DirectionField field = prescribed(mesh, 4, direction, normal);
    const auto found = surface_singularities(field);
    ASSERT_EQ(found.points.size(), 8u);
    const auto lines = separatrices(field, found);
    ASSERT_EQ(lines.size(), 24u);
    expect_sound(mesh, lines);
    for (const Streamline& line : lines) {
        EXPECT_EQ(line.last_end, End::singularity);
        EXPECT_NEAR(line.length, 1, 0.1);
        EXPECT_NEAR(
            (found.points[line.first_singularity].position - found.points[line.last_singularity].position).norm(), 1,
            1e-12);
    }
    // With its edges as features nothing is left.
    field.domain = field.domain.with_features(detect_features(mesh));
    EXPECT_TRUE(separatrices(field, found).empty());
}

TEST(Separatrices, OfAReentrantCornerContinueItsSides) {
    const TriangleMesh mesh = plate(8, [](double x, double y) { return x < 0.5 || y < 0.5; });
    const auto field = prescribed(
        mesh, 4, [](auto&) { return Vector::UnitX(); }, up);
    const auto found = surface_singularities(field);
    ASSERT_EQ(found.points.size(), 6u);
    const auto lines = separatrices(field, found);
    ASSERT_EQ(lines.size(), 2u);  // none from the five corners of 90 degrees
    const Vector ends[] = {lines[0].points.row(lines[0].points.rows() - 1),
                           lines[1].points.row(lines[1].points.rows() - 1)};
    EXPECT_NEAR((ends[0] - Vector(0, 0.5, 0)).norm(), 0, 1e-3);
    EXPECT_NEAR((ends[1] - Vector(0.5, 0, 0)).norm(), 0, 1e-3);
}

TEST(Separatrices, ScaleWithTheUnit) {
    std::vector<Complex> points;
    for (int i = 0; i < 4; ++i) points.push_back(std::polar(0.8, 0.5 + i * pi / 2));
    std::vector<double> lengths;
    for (const double unit : {1.0, 1e-6, 1e6}) {
        TriangleMesh mesh = disk(12);
        mesh.vertices *= unit;
        const auto field = polygon_field(mesh, points, unit);
        const auto lines = separatrices(field, surface_singularities(field));
        expect_sound(mesh, lines);
        ASSERT_EQ(lines.size(), 12u);
        double length = 0;
        for (const Streamline& line : lines) length += line.length / unit;
        lengths.push_back(length);
    }
    EXPECT_NEAR(lengths[1], lengths[0], 1e-6);
    EXPECT_NEAR(lengths[2], lengths[0], 1e-6);
}

// ---- even cover ----

TEST(EvenStreamlines, CoverAPlateEvenly) {
    const TriangleMesh mesh = square(16);
    const auto field = prescribed(
        mesh, 4, [](auto&) { return at_angle(0.3); }, up);
    const auto found = surface_singularities(field);
    const double spacing = 0.05;
    const auto lines = even_streamlines(field, found, {.spacing = spacing});
    expect_sound(mesh, lines);
    std::vector<double> offsets[2];  // of the lines of each family across its direction
    for (const Streamline& line : lines) {
        const Vector along = (line.points.row(line.points.rows() - 1) - line.points.row(0)).normalized();
        const int family = std::abs(along.dot(at_angle(0.3))) > 0.5 ? 0 : 1;
        offsets[family].push_back(at_angle(0.3 + (family == 0 ? pi / 2 : 0)).dot(Vector(line.points.row(0))));
    }
    for (auto& family : offsets) {
        std::sort(family.begin(), family.end());
        ASSERT_GT(family.size(), 10u);
        for (std::size_t i = 1; i < family.size(); ++i) {
            EXPECT_GT(family[i] - family[i - 1], 0.5 * spacing);
            EXPECT_LT(family[i] - family[i - 1], 2.01 * spacing);
        }
    }
}

TEST(EvenStreamlines, CoverASphereOnceAndAlwaysAlike) {
    const TriangleMesh mesh = icosphere(4);
    const auto field = prescribed(mesh, 4, azimuth, outward);
    const auto found = surface_singularities(field);
    const auto lines = even_streamlines(field, found, {.spacing = 0.15}),
               again = even_streamlines(field, found, {.spacing = 0.15});
    expect_sound(mesh, lines);
    double length = 0;
    for (const Streamline& line : lines) {
        EXPECT_NE(line.last_end, End::stuck);
        length += line.length;
    }
    // Two families at a distance between one and two spacings from line to line.
    EXPECT_GT(length, 2 * 4 * pi / (2 * 0.15));
    EXPECT_LT(length, 2 * 4 * pi / (0.6 * 0.15));
    ASSERT_EQ(lines.size(), again.size());
    for (std::size_t i = 0; i < lines.size(); ++i) EXPECT_EQ(lines[i].points, again[i].points);
    EXPECT_THROW(even_streamlines(field, found, {}, [](auto, double, double) { return false; }), Cancelled);
}

}  // namespace
}  // namespace octafield::surface
