// Surfaces and numbers at the edge of what a field can be computed from: a right field or a typed error.
#include "direction_field_fixtures.hpp"
#include "octafield/surface/principal_directions.hpp"
#include "octafield/surface/streamlines.hpp"

namespace octafield::surface {
namespace {

const std::vector<std::string> methods = [] {
    std::vector<std::string> names;
    for (const DirectionFieldMethod& method : direction_field_methods()) names.push_back(method.name);
    return names;
}();

// All methods, even symmetries and ways to follow the boundary give unit directions and the right sum of indices.
void expect_sound_fields(const TriangleMesh& mesh, const FeatureGraph& features = {}) {
    for (const std::string& method : methods)
        for (const int symmetry : {2, 4, 6})
            for (const Alignment boundary : {Alignment::strong, Alignment::weak, Alignment::none}) {
                const DirectionField field = direction_field(
                    {mesh, features}, {.symmetry = symmetry, .method = method, .boundary_alignment = boundary});
                const SurfaceSingularities found = surface_singularities(field);
                EXPECT_TRUE(found.agree) << symmetry << ", sum " << found.index_sum;
                EXPECT_EQ(found.euler_characteristic, euler_characteristic(mesh));
                const Points at_vertices = vertex_directions(field);
                EXPECT_NEAR((at_vertices.rowwise().norm().array() - 1).abs().maxCoeff(), 0, 1e-9);
                const Points normals = triangle_normals(mesh), inside = triangle_directions(field);
                EXPECT_LT(normals.cwiseProduct(inside).rowwise().sum().cwiseAbs().maxCoeff(), 1e-9);
            }
}

// A ring of `count` squares of two triangles each; with a half twist a Moebius strip.
TriangleMesh ring(int count, bool twisted) {
    std::vector<std::array<double, 3>> points;
    std::vector<std::array<Index, 3>> triangles;
    for (int i = 0; i < count; ++i)
        for (const double side : {-0.3, 0.3}) {
            const double a = 2 * pi * i / count, tilt = twisted ? a / 2 : pi / 2;
            const double r = 1 + side * std::cos(tilt);
            points.push_back({r * std::cos(a), r * std::sin(a), side * std::sin(tilt)});
        }
    for (int i = 0; i < count; ++i) {
        const Index a = 2 * i, b = a + 1;
        Index c = (2 * i + 2) % (2 * count), d = c + 1;
        if (twisted && i == count - 1) std::swap(c, d);
        triangles.push_back({a, c, b});
        triangles.push_back({b, c, d});
    }
    TriangleMesh mesh{Points(points.size(), 3), Triangles(triangles.size(), 3)};
    for (std::size_t i = 0; i < points.size(); ++i) mesh.vertices.row(i) << points[i][0], points[i][1], points[i][2];
    for (std::size_t i = 0; i < triangles.size(); ++i)
        mesh.triangles.row(i) << triangles[i][0], triangles[i][1], triangles[i][2];
    return mesh;
}

TEST(HardSurfaces, SmallestMeshesHaveFields) {
    expect_sound_fields(make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}));
    expect_sound_fields(make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}}));
    expect_sound_fields(
        make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}));
}

TEST(HardSurfaces, StripsOneTriangleWideHaveFields) {
    std::vector<std::array<Index, 3>> triangles;
    TriangleMesh flat{Points(22, 3), Triangles(20, 3)};
    for (int i = 0; i < 22; ++i) flat.vertices.row(i) << 0.5 * i, 0.9 * (i % 2), 0;
    for (int i = 0; i < 20; ++i) flat.triangles.row(i) << i + i % 2, i + 1 - i % 2, i + 2;
    expect_sound_fields(flat);
    expect_sound_fields(ring(20, false));
}

TEST(HardSurfaces, MoebiusStripsAreRefusedWhole) {
    const TriangleMesh strip = ring(20, true);
    const auto expect_refusal = [](const std::function<void()>& call) {
        try {
            call();
            FAIL() << "a surface with one side was accepted";
        } catch (const GeometryError& error) {
            EXPECT_EQ(error.kind(), "not_orientable");
            EXPECT_EQ(error.elements().size(), 40u);
        }
    };
    expect_refusal([&] { direction_field(strip); });
    expect_refusal([&] { principal_directions(strip); });
}

TEST(HardSurfaces, NeedlesUpToAMillionToOneHaveFields) {
    for (const double squeeze : {1e-3, 1e-6}) {
        TriangleMesh needles = plate(6, [](double, double) { return true; }), sphere = icosphere(1);
        needles.vertices.col(1) *= squeeze;
        sphere.vertices.col(2) *= squeeze;
        expect_sound_fields(needles);
        expect_sound_fields(sphere);
    }
}

TEST(HardSurfaces, TrianglesTooThinForDoublePrecisionAreNamed) {
    TriangleMesh mesh = icosphere(2);  // a point in one triangle, nearly on its first side
    const Index t = 17, a = mesh.triangles(t, 0), b = mesh.triangles(t, 1), c = mesh.triangles(t, 2);
    const auto count = static_cast<Index>(mesh.vertices.rows()), triangles = static_cast<Index>(mesh.triangles.rows());
    mesh.vertices.conservativeResize(count + 1, 3);
    mesh.vertices.row(count) =
        (mesh.vertices.row(a) + mesh.vertices.row(b)) / 2 * (1 - 1e-10) + 1e-10 * mesh.vertices.row(c);
    mesh.triangles.conservativeResize(triangles + 2, 3);
    mesh.triangles.row(t) << a, b, count;
    mesh.triangles.row(triangles) << b, c, count;
    mesh.triangles.row(triangles + 1) << c, a, count;
    for (const std::string& method : methods) {
        try {
            const DirectionField field = direction_field(mesh, {.method = method});
            EXPECT_TRUE(surface_singularities(field).agree);
        } catch (const SolverError& error) {
            EXPECT_EQ(error.kind(), "thin_triangles");
            EXPECT_EQ(error.elements(), std::vector<Index>{t});
            EXPECT_NE(std::string(error.what()).find("remesh"), std::string::npos);
        }
    }
}

TEST(HardSurfaces, SizesBeyondDoublePrecisionAreRefused) {
    for (const double size : {1e-30, 1e-6, 1e6, 1e30}) {
        TriangleMesh mesh = icosphere(1);
        mesh.vertices *= size;
        EXPECT_TRUE(surface_singularities(direction_field(mesh)).agree);
    }
    for (const double size : {1e-200, 1e-90, 1e90, 1e150, 1e300}) {
        TriangleMesh mesh = icosphere(1);
        mesh.vertices *= size;
        try {
            direction_field(mesh);
            FAIL() << "size " << size << " was accepted";
        } catch (const GeometryError& error) {
            EXPECT_EQ(error.kind(), "size_out_of_range");
            EXPECT_EQ(static_cast<Index>(error.elements().size()), mesh.triangles.rows());
        }
    }
}

TEST(HardSurfaces, PiecesClosedAndOpenAndTouchingHaveFields) {
    expect_sound_fields(joined({icosphere(1), disk(4), ring(12, false), icosphere(0)}));
    // Two triangles with one vertex in common, where only boundary edges meet: each part has its own.
    const TriangleMesh touching =
        make_mesh({{0, 0, 0}, {1, -0.5, 0}, {1, 0.5, 0}, {-1, 0.5, 0}, {-1, -0.5, 0}}, {{0, 1, 2}, {0, 3, 4}});
    for (const std::string& method : methods) {
        const SurfaceSingularities found = surface_singularities(direction_field(touching, {.method = method}));
        EXPECT_TRUE(found.agree);
        EXPECT_EQ(found.euler_characteristic, 2);
    }
}

TEST(HardSurfaces, ManyHolesCountNegative) {
    const auto outside = [](double x, double y) {
        const auto odd = [](double s) { return static_cast<int>(std::floor(s * 15)) % 3 == 1; };
        return !(odd(x) && odd(y));
    };
    const TriangleMesh mesh = plate(15, outside);
    ASSERT_EQ(euler_characteristic(mesh), 1 - 25);
    expect_sound_fields(mesh);
}

// ---- features

TEST(HardFeatures, CurvesOfAnyShapeGiveSoundFields) {
    const TriangleMesh mesh = plate(8, [](double, double) { return true; });
    const auto at = [&](double x, double y) {
        Index nearest = 0;
        (mesh.vertices.rowwise() - Eigen::RowVector3d(x, y, 0)).rowwise().norm().minCoeff(&nearest);
        return nearest;
    };
    const auto path = [&](const std::vector<std::array<double, 2>>& points) {
        Edges edges(static_cast<Eigen::Index>(points.size()) - 1, 2);
        for (Eigen::Index i = 0; i < edges.rows(); ++i)
            edges.row(i) << at(points[i][0], points[i][1]), at(points[i + 1][0], points[i + 1][1]);
        return feature_graph(mesh, edges);
    };
    const double h = 1.0 / 8, a = 3 * h, b = 4 * h;
    expect_sound_fields(mesh, path({{a, a}, {b, a}, {b, b}, {a, b}, {a, a}}));          // closed loop
    expect_sound_fields(mesh, path({{a, a}, {b, a}, {b + h, a}}));                      // two dead ends
    expect_sound_fields(mesh, path({{0, b}, {h, b}, {2 * h, b}}));                      // touches the boundary
    expect_sound_fields(mesh, path({{a, a}, {b, a}, {a, a}, {b, a}}));                  // one edge thrice
    expect_sound_fields(mesh, path({{a, b}, {b, b}, {b + h, b}, {b, b}, {b, b + h}}));  // T-junction
    EXPECT_EQ(path({{a, a}, {b, a}, {a, a}}).edges.rows(), 1);
}

TEST(HardFeatures, CornersOfAnyAngleHaveTheirNearestIndex) {
    // A sector of the disk: its corner in the middle turns by pi - angle, the round side by angle + two right corners.
    for (int degrees = 15; degrees <= 345; degrees += 15) {
        const int rings = 6, steps = degrees / 15;
        TriangleMesh mesh{Points(1 + rings * (steps + 1), 3), Triangles(steps * (2 * rings - 1), 3)};
        const auto id = [&](int ring, int step) { return 1 + (ring - 1) * (steps + 1) + step; };
        mesh.vertices.row(0).setZero();
        Index next = 0;
        for (int r = 1; r <= rings; ++r)
            for (int s = 0; s <= steps; ++s) {
                const double angle = s * pi / 12;
                mesh.vertices.row(id(r, s)) << r * std::cos(angle) / rings, r * std::sin(angle) / rings, 0;
                if (s == steps) continue;
                if (r == 1) {
                    mesh.triangles.row(next++) << 0, id(1, s), id(1, s + 1);
                } else {
                    mesh.triangles.row(next++) << id(r - 1, s), id(r, s), id(r, s + 1);
                    mesh.triangles.row(next++) << id(r - 1, s), id(r, s + 1), id(r - 1, s + 1);
                }
            }
        for (const std::string& method : methods) {
            const DirectionField field = direction_field(mesh, {.method = method});
            const SurfaceSingularities found = surface_singularities(field);
            EXPECT_TRUE(found.agree) << degrees;
            // Index 1/2 - angle / (2 pi), rounded to quarters, where the corner is near to one: else it is released.
            const double exact = 4 * (0.5 - degrees / 360.0);
            if (std::abs(exact - std::round(exact)) > 0.25) continue;
            int index = 0;
            for (const auto& point : found.points) index += point.vertex == 0 ? point.index_times_symmetry : 0;
            EXPECT_EQ(index, static_cast<int>(std::lround(exact))) << degrees;
        }
    }
}

// ---- numbers

std::string refusal(const DirectionFieldOptions& options) {
    const TriangleMesh mesh = disk(4);
    try {
        direction_field(mesh, options);
        return "";
    } catch (const Error& error) {
        return error.kind();
    }
}

TEST(HardNumbers, LengthsBeyondTheScaleOfTheMeshAreRefused) {
    for (const std::string& method : methods) {
        EXPECT_EQ(refusal({.method = method, .epsilon = 1e300}), "bad_epsilon");
        EXPECT_NE(refusal({.method = method, .epsilon = 1e-300}), "");
        Eigen::VectorXd lengths = Eigen::VectorXd::Constant(edge_topology(disk(4)).edges.rows(), 0.3);
        lengths[5] = -1;
        EXPECT_EQ(refusal({.method = method, .edge_epsilon = lengths}), "bad_epsilon");
    }
}

TEST(HardNumbers, GuidesWithoutALengthOrAWeightToComputeWithAreRefused) {
    const Eigen::Index triangles = disk(4).triangles.rows();
    const Points x = Eigen::RowVector3d(1, 0, 0).replicate(triangles, 1);
    for (const std::string& method : methods) {
        EXPECT_EQ(refusal({.method = method, .guide = {x, {}, 1e-200}}), "option_out_of_range");
        EXPECT_EQ(refusal({.method = method, .guide = {x, {}, 1e200}}), "option_out_of_range");
    }
}

TEST(HardNumbers, WeightsTooSmallToCountAreNone) {
    const TriangleMesh mesh = plate(6, [](double, double) { return true; });
    const Points x = Eigen::RowVector3d(1, 0, 0).replicate(mesh.triangles.rows(), 1);
    const Eigen::VectorXd tiny = Eigen::VectorXd::Constant(mesh.triangles.rows(), 1e-300);
    for (const std::string& method : methods) {
        const DirectionField weak = direction_field(
            mesh, {.method = method, .boundary_alignment = Alignment::weak, .alignment_length = 1e-300});
        const DirectionField guided =
            direction_field(mesh, {.method = method, .boundary_alignment = Alignment::none, .guide = {x, tiny}});
        const DirectionField free = direction_field(mesh, {.method = method, .boundary_alignment = Alignment::none});
        EXPECT_EQ(weak.values, free.values);
        EXPECT_EQ(guided.values, free.values);
        EXPECT_LT(free.energy, 1e-9);
    }
}

TEST(HardNumbers, SymmetriesBeyondAnyMeshAreRefused) {
    EXPECT_THROW(direction_field(disk(3), {.symmetry = largest_symmetry + 1}), InvalidInput);
    const TriangleMesh mesh = disk(3);
    EXPECT_TRUE(surface_singularities(direction_field(mesh, {.symmetry = largest_symmetry})).agree);
}

TEST(HardNumbers, TheSizeOfAFieldDoesNotMatterToCurves) {
    const TriangleMesh mesh = icosphere(2);
    DirectionField field = direction_field(mesh);
    const SurfaceSingularities found = surface_singularities(field);
    const auto lines = separatrices(field, found);
    for (const double size : {0x1p-1000, 0x1p1000}) {
        DirectionField scaled = field;
        scaled.values *= size;
        const auto same = separatrices(scaled, found);
        ASSERT_EQ(same.size(), lines.size());
        for (std::size_t i = 0; i < lines.size(); ++i) EXPECT_NEAR(same[i].length, lines[i].length, 1e-6);
    }
}

TEST(HardNumbers, NoCurveIsLongerThanAsked) {
    const TriangleMesh mesh = icosphere(2);
    const DirectionField field = direction_field(mesh);
    const SurfaceSingularities found = surface_singularities(field);
    for (const double most : {1e-9, 0.05, 0.3, 1.0, 3.0}) {
        std::size_t cut = 0;
        for (const Streamline& line : separatrices(field, found, {.max_length = most})) {
            double length = 0;
            for (Eigen::Index i = 1; i < line.points.rows(); ++i)
                length += (line.points.row(i) - line.points.row(i - 1)).norm();
            EXPECT_LE(line.length, most);
            EXPECT_NEAR(line.length, length, 1e-12);
            EXPECT_EQ(static_cast<Eigen::Index>(line.triangles.size()) + 1, line.points.rows());
            cut += line.last_end == StreamlineEnd::length;
            if (line.last_end == StreamlineEnd::length) {
                EXPECT_DOUBLE_EQ(line.length, most);
                EXPECT_EQ(line.last_singularity, -1);
            }
        }
        EXPECT_TRUE(cut > 0 || most > 2);
    }
}

// ---- directions at vertices

TEST(VertexDirections, FollowTheBoundaryOnlyWhereTheFieldDoes) {
    const TriangleMesh mesh = plate(8, [](double, double) { return true; });
    const Eigen::RowVector3d tilted(std::cos(0.3), std::sin(0.3), 0);
    DirectionFieldOptions options{.boundary_alignment = Alignment::none};
    options.guide.directions = tilted.replicate(mesh.triangles.rows(), 1);
    const auto off = [&](const Points& directions) {  // largest angle to the guide, of the four
        double most = 0;
        for (const auto d : directions.rowwise()) {
            const double angle = std::remainder(std::atan2(d[1], d[0]) - 0.3, pi / 2);
            most = std::max(most, std::abs(angle));
        }
        return most;
    };
    EXPECT_LT(off(vertex_directions(direction_field(mesh, options))), 1e-6);
    options.boundary_alignment = Alignment::strong;
    const FeatureGraph rim = detect_features(mesh);  // with the corners
    EXPECT_NEAR(off(vertex_directions(direction_field({mesh, rim}, options))), 0.3, 1e-6);
}

}  // namespace
}  // namespace octafield::surface
