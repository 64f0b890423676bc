// Curves along prescribed fields whose streamlines are known, and hostile input.
#include "streamline_fixtures.hpp"

namespace octafield::surface {
namespace {

// ---- known curves ----

TEST(Streamlines, ConstantFieldGivesStraightLinesInAllItsDirections) {
    const TriangleMesh mesh = square(10);
    for (const int symmetry : {1, 2, 3, 4, 6}) {
        const double angle = 0.37;
        const auto field = prescribed(
            mesh, symmetry, [&](auto&) { return at_angle(angle); }, up);
        for (int branch = 0; branch < symmetry; ++branch) {
            const double heading = angle + 2 * pi * branch / symmetry;
            const Index t = triangle_at(mesh, {0.52, 0.43, 0});
            const auto [singularities, lines] = trace(field, {{t, at_angle(heading + 0.3 / symmetry)}});
            ASSERT_EQ(lines.size(), 1u);
            expect_sound(mesh, lines);
            const Streamline& line = lines[0];
            EXPECT_EQ(line.first_end, End::boundary);
            EXPECT_EQ(line.last_end, End::boundary);
            const Vector first = line.points.row(0), last = line.points.row(line.points.rows() - 1);
            EXPECT_NEAR(((last - first).normalized() - at_angle(heading)).norm(), 0, 1e-5);
            EXPECT_NEAR((last - first).norm(), line.length, 1e-9);
            for (const Vector& end : {first, last})  // on the square's rim
                EXPECT_NEAR(std::min({end.x(), end.y(), 1 - end.x(), 1 - end.y()}), 0, 1e-9);
        }
    }
}

TEST(Streamlines, CirclesCloseAndDriftToSecondOrder) {
    double drift[2];
    for (const int level : {0, 1}) {
        const TriangleMesh mesh = disk(12 << level);
        const auto field = prescribed(mesh, 4, azimuth, up);
        const Vector place(0.55, 0.1, 0);
        const auto [singularities, lines] = trace(field, {{triangle_at(mesh, place), azimuth(place)}});
        expect_sound(mesh, lines);
        const Points& points = lines[0].points;
        EXPECT_EQ(lines[0].first_end, End::closed);
        EXPECT_EQ(lines[0].last_end, End::closed);
        EXPECT_EQ(points.row(0), points.row(points.rows() - 1));
        const double radius = points.row(0).norm();
        EXPECT_NEAR(lines[0].length / (2 * pi * radius), 1, 0.01);
        drift[level] = (points.rowwise().norm().array() - radius).abs().maxCoeff();
        EXPECT_LT(drift[level], 0.1 / (12 << level));
    }
    EXPECT_LT(drift[1], drift[0] / 2);
}

TEST(Streamlines, RaysRunFromTheCentreToTheCircle) {
    const TriangleMesh mesh = disk(15);
    const auto field = prescribed(
        mesh, 2, [](const Vector& x) -> Vector { return (x - Vector(0.013, 0.007, 0)).normalized(); }, up);
    const auto [singularities, lines] = trace(field, {{triangle_at(mesh, {0.5, 0.3, 0}), {1, 0.5, 0}}});
    EXPECT_EQ(lines[0].first_end, End::singularity);
    ASSERT_GE(lines[0].first_singularity, 0);
    EXPECT_LT(singularities.points[lines[0].first_singularity].position.norm(), 0.1);
    EXPECT_EQ(lines[0].last_end, End::boundary);
    EXPECT_EQ(lines[0].last_singularity, -1);
    const Vector start = lines[0].points.row(lines[0].points.rows() - 1);
    for (const auto& point : lines[0].points.rowwise())
        if (point.norm() > 0.2) {
            EXPECT_NEAR(start.normalized().cross(Vector(point)).norm(), 0, 0.01);
        }
}

TEST(Streamlines, SpiralsKeepTheirAngle) {
    // 30 degrees off the rays: r grows by exp(phi / tan 30).
    const TriangleMesh mesh = disk(40);
    const auto field = prescribed(
        mesh, 4, [](const Vector& x) { return at_angle(std::atan2(x.y(), x.x()) + pi / 6); }, up);
    const Vector place(0.3, 0, 0);
    const auto [singularities, lines] =
        trace(field, {{triangle_at(mesh, place), at_angle(pi / 6)}}, {.both_ways = false});
    EXPECT_EQ(lines[0].first_end, End::seed);
    EXPECT_EQ(lines[0].last_end, End::boundary);
    const Vector first = lines[0].points.row(0), last = lines[0].points.row(lines[0].points.rows() - 1);
    const double turned = std::atan2(last.y(), last.x()) - std::atan2(first.y(), first.x());
    EXPECT_NEAR(std::log(last.norm() / first.norm()), turned / std::tan(pi / 6), 0.01);
    EXPECT_NEAR(lines[0].length, (last.norm() - first.norm()) / std::cos(pi / 6), 0.01);
}

TEST(Streamlines, MeridiansRunFromPoleToPole) {
    const TriangleMesh mesh = icosphere(4);
    const auto field = prescribed(
        mesh, 2, [](const Vector& x) -> Vector { return x.cross(azimuth(x)); }, outward);
    for (const double angle : {0.3, 1.7, 4.0}) {
        const auto [singularities, lines] =
            trace(field, {{triangle_at(mesh, at_angle(angle)), Vector::UnitZ()}}, {.singular_radius = 0.1});
        expect_sound(mesh, lines);
        EXPECT_EQ(lines[0].first_end, End::singularity);
        EXPECT_EQ(lines[0].last_end, End::singularity);
        EXPECT_NEAR(lines[0].length, pi - 0.2, 0.1);
        const double height = lines[0].points(lines[0].points.rows() - 1, 2) - lines[0].points(0, 2);
        EXPECT_GT(height, 1.95);  // with the seed's direction
        const Vector side = azimuth(lines[0].points.row(lines[0].points.rows() / 2));
        EXPECT_LT((lines[0].points * side).cwiseAbs().maxCoeff(), 0.01);
    }
}

TEST(Streamlines, ParallelsOfATorusClose) {
    const TriangleMesh mesh = torus(60, 30, 1, 0.5);
    const auto field = prescribed(mesh, 4, azimuth, from_tube);
    for (const double v : {0.1, 1.3, 2.9}) {
        const Vector place(1 + 0.5 * std::cos(v), 0, 0.5 * std::sin(v));
        const auto [singularities, lines] =
            trace(field, {{triangle_at(mesh, place), Vector::UnitY()}, {triangle_at(mesh, place), {0.1, 0, 1}}});
        expect_sound(mesh, lines);
        EXPECT_EQ(lines[0].last_end, End::closed);
        EXPECT_NEAR(lines[0].length, 2 * pi * lines[0].points.row(0).head<2>().norm(), 0.02);
        EXPECT_EQ(lines[1].last_end, End::closed);
        EXPECT_NEAR(lines[1].length, pi, 0.02);
    }
}

// ---- where curves end ----

TEST(Streamlines, EndAtFeaturesUnlessToldOtherwise) {
    const TriangleMesh mesh = square(10);
    FeatureGraph features;  // the line x = 0.5
    features.edges.resize(10, 2);
    std::vector<std::pair<double, Index>> line;
    for (Index v = 0; v < mesh.vertices.rows(); ++v)
        if (std::abs(mesh.vertices(v, 0) - 0.5) < 1e-9) line.emplace_back(mesh.vertices(v, 1), v);
    std::sort(line.begin(), line.end());
    for (int i = 0; i < 10; ++i) features.edges.row(i) << line[i].second, line[i + 1].second;
    const auto field = prescribed(
        {mesh, features}, 4, [](auto&) { return Vector(1, 0.05, 0).normalized(); }, up);
    const std::vector<StreamlineSeed> seeds = {{triangle_at(mesh, {0.13, 0.33, 0}), Vector::UnitX()}};
    const auto stopped = trace(field, seeds).lines[0];
    EXPECT_EQ(stopped.first_end, End::boundary);
    EXPECT_EQ(stopped.last_end, End::feature);
    EXPECT_NEAR(stopped.points(stopped.points.rows() - 1, 0), 0.5, 1e-12);
    const auto through = trace(field, seeds, {.stop_at_features = false}).lines[0];
    EXPECT_EQ(through.last_end, End::boundary);
    EXPECT_NEAR(through.points(through.points.rows() - 1, 0), 1, 1e-12);
}

TEST(Streamlines, EndAtTheirGreatestLength) {
    const TriangleMesh mesh = square(10);
    const auto field = prescribed(
        mesh, 4, [](auto&) { return at_angle(0.2); }, up);
    const auto lines = trace(field, {{triangle_at(mesh, {0.5, 0.5, 0}), Vector::UnitX()}}, {.max_length = 0.25}).lines;
    EXPECT_EQ(lines[0].first_end, End::length);
    EXPECT_EQ(lines[0].last_end, End::length);
    EXPECT_NEAR(lines[0].length, 0.5, 1e-12);
}

TEST(Streamlines, SeedsMayLieOnVerticesAndEdges) {
    const TriangleMesh mesh = square(6);
    const auto field = prescribed(
        mesh, 4, [](auto&) { return Vector::UnitX(); }, up);  // along edges of the mesh
    std::vector<StreamlineSeed> seeds;
    for (Index t = 0; t < mesh.triangles.rows(); ++t)
        for (const Vector& weights : {Vector(1, 0, 0), Vector(0, 0.5, 0.5), Vector(0, 0, 1)})
            for (const Vector& direction : {Vector(1, 0.1, 0), Vector(-0.1, 1, 0)})
                seeds.push_back({t, direction, weights});
    const auto lines = trace(field, seeds).lines;
    expect_sound(mesh, lines);
    for (const Streamline& line : lines) {
        EXPECT_NE(line.last_end, End::stuck);
        // Seeds on the rim may leave at once, or run along it.
        const Vector middle = line.points.row(line.points.rows() / 2);
        if (std::min({middle.x(), middle.y(), 1 - middle.x(), 1 - middle.y()}) > 0.05) {
            EXPECT_NEAR(line.length, 1, 1e-3);
        }
    }
}

// ---- hostile input ----

TEST(Streamlines, RandomFieldsOnBadMeshesEnd) {
    TriangleMesh needles = square(12), sphere = icosphere(3);
    needles.vertices.col(1) *= 1e-5;
    for (Index v = 0; v < sphere.vertices.rows(); ++v) sphere.vertices.row(v) *= v % 3 == 0 ? 1.0 : 0.6;
    for (const TriangleMesh& mesh : {needles, sphere, icosphere(0), square(1)})
        for (const int symmetry : {1, 4}) {
            DirectionField field;
            field.symmetry = symmetry;
            field.domain = mesh;
            std::mt19937 random(3);
            std::uniform_real_distribution<double> angle(0, 2 * pi);
            field.values.resize(field.domain.topology().edges.rows());
            for (auto& value : field.values) value = std::polar(1.0, angle(random));
            field.values[0] = 0;
            const auto found = surface_singularities(field);
            EXPECT_TRUE(found.agree);
            std::vector<StreamlineSeed> seeds;
            const Points normals = triangle_normals(mesh);
            for (Index t = 0; t < mesh.triangles.rows(); t += 1 + mesh.triangles.rows() / 20)
                seeds.push_back({t, normals.row(t).transpose().unitOrthogonal()});
            SurfaceSingularities none = found;  // so that nothing catches the curves
            none.points.clear();
            auto lines = streamlines(field, none, seeds);
            const auto more = separatrices(field, found);
            lines.insert(lines.end(), more.begin(), more.end());
            for (const Streamline& line : lines) ASSERT_TRUE(line.points.allFinite());
        }
}

TEST(Streamlines, NoneIsStuckOnRealSurfaces) {
    const std::filesystem::path folder = std::filesystem::path(OCTAFIELD_SHARED_DATA) / "surfaces";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no surfaces at " << folder;
    for (const char* name : {"s01", "s04", "s15", "s16", "s17", "i10"}) {
        const TriangleMesh mesh = read_surface(folder / (std::string(name) + "_surface.obj"));
        const FeatureGraph features = detect_features(mesh);
        DirectionFieldOptions options;
        options.method = "eigen";
        const DirectionField field = direction_field({mesh, features}, options);
        const SurfaceSingularities found = surface_singularities(field);
        EXPECT_TRUE(found.agree);
        for (const auto& lines :
             {separatrices(field, found, {.stop_at_features = false}), even_streamlines(field, found)}) {
            expect_sound(mesh, lines);
            for (const Streamline& line : lines) {
                EXPECT_NE(line.first_end, End::stuck) << name;
                EXPECT_NE(line.last_end, End::stuck) << name;
            }
        }
    }
}

TEST(Streamlines, RefuseWhatTheyCannotFollow) {
    const TriangleMesh mesh = square(3);
    const auto field = prescribed(
        mesh, 4, [](auto&) { return Vector::UnitX(); }, up);
    const auto found = surface_singularities(field);
    const Vector x = Vector::UnitX();
    const StreamlineSeed bad[] = {
        {-1, x}, {18, x}, {0, Vector::UnitZ()}, {0, Vector::Zero()}, {0, x, {0.5, 0.6, -0.1}}, {0, x, {0.5, 0.6, 0.1}}};
    for (const StreamlineSeed& seed : bad) {
        try {
            streamlines(field, found, {{0, x}, seed});
            FAIL();
        } catch (const InvalidInput& error) {
            EXPECT_EQ(error.kind(), "bad_seed");
            EXPECT_EQ(error.elements(), std::vector<Index>{1});
        }
    }
    DirectionField short_by_one = field;
    short_by_one.values.conservativeResize(field.values.size() - 1);
    EXPECT_THROW(streamlines(short_by_one, found, {{0, x}}), InvalidInput);
    EXPECT_THROW(streamlines(field, found, {{0, x}}, {.max_length = -1}), InvalidInput);
    EXPECT_THROW(even_streamlines(field, found, {.spacing = std::numeric_limits<double>::quiet_NaN()}), InvalidInput);
    EXPECT_THROW(even_streamlines(field, found, {.spacing = 1e-9}), InvalidInput);
    EXPECT_THROW(even_streamlines(field, found, {.stop_ratio = 0}), InvalidInput);
    SurfaceSingularities foreign = found;
    foreign.points.push_back({{0, 0, 0}, 1, 0.25, 1000, -1, false});
    EXPECT_THROW(separatrices(field, foreign), InvalidInput);
}

}  // namespace
}  // namespace octafield::surface
