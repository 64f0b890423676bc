// Quads from non-orthogonal fields: layouts and whole numbers on the surface measured by the lines.
#include "nonorthogonal/lines_fixtures.hpp"
#include "octafield/surface/lines_metric.hpp"
#include "octafield/surface/quantized_quads.hpp"

namespace octafield::surface {
namespace {

struct Made {
    NonOrthogonalField field;
    SurfaceSingularities singularities;
    ImposedField imposed;
    QuantizedQuads quads;
};

// One quad at each of the corners named.
std::vector<CornerQuads> single(const TriangleMesh& mesh, const std::vector<Vector>& corners) {
    std::vector<CornerQuads> result;
    for (const Vector& corner : corners) result.push_back({vertex_at(mesh, corner), 1});
    return result;
}

Made made(const TriangleMesh& mesh, Index count, const std::vector<CornerQuads>& corners = {}) {
    NonOrthogonalFieldOptions options;
    options.corners = corners;
    Made result{non_orthogonal_field(mesh, options), {}, {}, {}};
    result.singularities = surface_singularities(result.field);
    const SurfaceDomain domain = lines_metric(result.field).domain;
    ImposedFieldOptions moving;
    moving.inadmissible = Inadmissible::move;
    result.imposed = impose_singular_points(domain, singular_pattern(domain, result.singularities), moving);
    QuantizedQuadsOptions quads;
    quads.quad_count = count;
    result.quads = quantized_quads(motorcycle_graph(result.imposed), quads);
    return result;
}

std::vector<Vector> parallelogram_corners(double angle) {
    const Vector slant(std::cos(angle), std::sin(angle), 0);
    return {{0, 0, 0}, {1.3, 0, 0}, Vector(1.3, 0, 0) + slant, slant};
}

// Sines of the angles at a quad's corners, the least over the mesh; computed here.
double least_sine(const QuadMesh& mesh) {
    double least = 1;
    for (Index q = 0; q < mesh.quads.rows(); ++q)
        for (int k = 0; k < 4; ++k) {
            const Vector at = mesh.vertices.row(mesh.quads(q, k));
            const Vector u = mesh.vertices.row(mesh.quads(q, (k + 1) % 4)).transpose() - at;
            const Vector v = mesh.vertices.row(mesh.quads(q, (k + 3) % 4)).transpose() - at;
            least = std::min(least, u.cross(v).z() / (u.norm() * v.norm()));
        }
    return least;
}

TEST(LinesQuads, OfAParallelogramAreAffine) {
    for (const double degrees : {15.0, 30.0, 60.0}) {
        const double angle = degrees * degree;
        const TriangleMesh mesh = parallelogram(angle, 0.12);
        const Made found = made(mesh, 200, single(mesh, parallelogram_corners(angle)));
        EXPECT_TRUE(inside(found.singularities).empty());
        EXPECT_NEAR(static_cast<double>(found.quads.mesh.quads.rows()), 200, 30);
        const QuadMesh& quads = found.quads.mesh;
        const Vector slant(std::cos(angle), std::sin(angle), 0), along(1, 0, 0);
        for (Index q = 0; q < quads.quads.rows(); ++q)
            for (int k = 0; k < 4; ++k) {
                const Eigen::RowVector3d side =
                    quads.vertices.row(quads.quads(q, (k + 1) % 4)) - quads.vertices.row(quads.quads(q, k));
                EXPECT_LT(std::min(off(side, slant), off(side, along)), 1e-6);
            }
        EXPECT_NEAR(least_sine(quads), std::sin(angle), 1e-6);
    }
}

// The corner of the angle, and the singular points inside told by their distance from it.
TEST(LinesQuads, OfAcuteCornersAreAsGoodAsTheCornerAllowsAndFollowBothSides) {
    for (const double degrees : {15.0, 30.0, 45.0, 60.0, 75.0}) {
        const double angle = degrees * degree;
        const Vector tip(0.8 + 1 / std::tan(angle), 0, 0);
        const std::vector<std::pair<TriangleMesh, Vector>> domains = {{wedge(angle, 0.06), Vector::Zero()},
                                                                      {right_trapezoid(angle, 0.1), tip}};
        for (const auto& [mesh, corner] : domains) {
            const Made found = made(mesh, 300);
            EXPECT_NEAR(static_cast<double>(found.quads.mesh.quads.rows()), 300, 30);
            const double sharpest = std::min(angle, &mesh == &domains[0].first ? (pi - angle) / 2 : pi / 2);
            EXPECT_GT(least_sine(found.quads.mesh), std::sin(sharpest) - 0.05) << degrees;
            const Index v = vertex_at(mesh, corner);
            EXPECT_EQ(found.field.quads[v], 1);
            const SurfaceDomain domain(mesh);
            for (const auto& point : inside(found.singularities))
                EXPECT_GT((point.position - corner).norm(), 2 * domain.mean_edge_length()) << degrees;
            // One quad there, along both sides.
            const QuadMesh& quads = found.quads.mesh;
            int there = 0;
            for (Index q = 0; q < quads.quads.rows(); ++q)
                for (int k = 0; k < 4; ++k)
                    there += (quads.vertices.row(quads.quads(q, k)).transpose() - corner).norm() < 1e-12;
            EXPECT_EQ(there, 1);
        }
    }
}

// A constant field is orthonormal in the plane mapped by F^-1, with the lines as columns of F: what is done in its
// metric is what is done there in space.
class LinesMapped : public ::testing::Test {
protected:
    void SetUp() override {
        const Vector first(std::cos(0.3), std::sin(0.3), 0), second(std::cos(1.1), std::sin(1.1), 0);
        map << first, second, Vector::UnitZ();
        // Not quite regular, so that no edges are as long as one another but for rounding.
        const TriangleMesh there = moved(disk(12), [](const Vector& x) -> Vector {
            const double room = 0.05 * (1 - x.squaredNorm());
            return x + room * Vector(std::sin(7 * x.x() + 3 * x.y()), std::sin(4 * x.x() - 9 * x.y()), 0);
        });
        const TriangleMesh mesh = moved(there, [&](const Vector& x) -> Vector { return map * x; });
        NonOrthogonalField field = non_orthogonal_field(mesh);
        const Points& vertices = mesh.vertices;
        for (Index v = 0; v < vertices.rows(); ++v) {
            const auto& fans = field.domain.fans();
            const auto fan =
                std::find_if(fans.fans.begin(), fans.fans.end(), [&](const auto& f) { return f.vertex == v; });
            const Index corner = fans.corners[fan->first];
            const Eigen::RowVector3d along =
                vertices.row(mesh.triangles(corner / 3, (corner % 3 + 1) % 3)) - vertices.row(v);
            const double from = std::atan2(along[1], along[0]);
            field.angles.row(v) << 0.3 - from, 1.1 - from;
        }
        in_metric = lines_metric(field).domain;
        in_space = SurfaceDomain(there);
    }
    ImposedField imposed(const SurfaceDomain& domain) const {
        SingularPattern pattern;
        for (const double at : {0.1, 0.6, 1.1, 1.6})
            pattern.points.push_back(imposed_point(in_space, 0.5 * Vector(std::cos(pi * at), std::sin(pi * at), 0), 1));
        for (const CornerQuads& corner : default_corner_quads(domain)) pattern.corners.push_back({corner.vertex, 2});
        return impose_singular_points(domain, pattern);
    }
    Eigen::Matrix3d map;
    SurfaceDomain in_metric, in_space;
};

TEST_F(LinesMapped, LengthsAnglesAndAreasAreThoseThere) {
    EXPECT_TRUE(in_metric.has_own_lengths());
    EXPECT_LT((in_metric.edge_lengths() - in_space.edge_lengths()).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT((in_metric.corner_angles() - in_space.corner_angles()).cwiseAbs().maxCoeff(), 1e-10);
    EXPECT_LT((in_metric.cotangents() - in_space.cotangents()).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_LT((in_metric.areas() - in_space.areas()).cwiseAbs().maxCoeff(), 1e-12);
}

TEST_F(LinesMapped, ImposedFieldsAndQuadsAreThoseThereTakenBack) {
    const ImposedField here = imposed(in_metric), there = imposed(in_space);
    ASSERT_EQ(here.log_size.size(), there.log_size.size());
    EXPECT_LT((here.log_size - there.log_size).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_LT((here.field.values - there.field.values).cwiseAbs().maxCoeff(), 1e-8);
    LayoutQuadsOptions options;
    options.quad_count = 300;
    const QuadLayout by_lines = quad_layout(here), by_space = quad_layout(there);
    EXPECT_NEAR(by_lines.curves.parameter_area / by_space.curves.parameter_area, 1, 1e-9);
    const QuadMesh of_lines = layout_quads(by_lines, options).mesh, of_space = layout_quads(by_space, options).mesh;
    EXPECT_NEAR(static_cast<double>(of_space.quads.rows()), 300, 60);
    ASSERT_EQ(of_lines.quads, of_space.quads);
    EXPECT_LT((of_lines.vertices - of_space.vertices * map.transpose()).cwiseAbs().maxCoeff(), 1e-7);
}

// Of outer radius 1, `around` vertices on each circle.
TriangleMesh ring_mesh(double inner, int around, int rings) {
    std::vector<Vector> points;
    std::vector<Eigen::Vector3i> triangles;
    for (int j = 0; j <= rings; ++j)
        for (int i = 0; i < around; ++i) {
            const double radius = inner + (1 - inner) * j / rings, at = 2 * pi * (i + 0.5 * (j % 2)) / around;
            points.emplace_back(radius * std::cos(at), radius * std::sin(at), 0);
        }
    for (int j = 0; j < rings; ++j)
        for (int i = 0; i < around; ++i) {
            const int next = (i + 1) % around, a = j * around, b = a + around;
            const int skew = j % 2 == 0 ? b + i : b + next;
            triangles.insert(triangles.end(),
                             {{a + i, skew, a + next}, {b + i, b + next, j % 2 == 0 ? a + next : a + i}});
        }
    return make_mesh(points, triangles);
}

// Four points of each kind on circles, off the angles that a field needs by ten degrees.
TEST_F(LinesMapped, PointsMoveUntilTheMetricHasAField) {
    const TriangleMesh there = ring_mesh(0.3, 48, 10);
    const TriangleMesh here = moved(there, [&](const Vector& x) -> Vector { return map * x; });
    const SurfaceDomain space(there);
    const SurfaceDomain metric = SurfaceDomain(here).with_edge_lengths(space.edge_lengths());
    SingularPattern pattern;
    for (int i = 0; i < 8; ++i) {
        const double radius = i < 4 ? 0.55 : 0.75, at = 0.3 + pi / 2 * i + (i < 4 ? 0 : 10 * degree);
        pattern.points.push_back(imposed_point(space, radius * Vector(std::cos(at), std::sin(at), 0), i < 4 ? -1 : 1));
    }
    for (const CornerQuads& corner : default_corner_quads(metric)) pattern.corners.push_back({corner.vertex, 2});
    ImposedFieldOptions options;
    options.inadmissible = Inadmissible::move;
    for (const SurfaceDomain& domain : {space, metric}) {
        const ImposedField field = impose_singular_points(domain, pattern, options);
        ASSERT_EQ(field.conditions.size(), 1u);
        EXPECT_LT(std::abs(field.conditions[0].angle), 1e-3 * degree);
        EXPECT_GT(field.steps, 0);
        EXPECT_LE(field.steps, 6);
        EXPECT_GT(field.largest_move, 0.02);
        EXPECT_LT(field.largest_move, 0.15);
    }
}

// The metric of crosses at right angles is that of space, however they turn.
TEST(LinesMetric, OfRightAnglesIsThatOfSpace) {
    NonOrthogonalField field = non_orthogonal_field(disk(8));
    for (Index v = 0; v < field.angles.rows(); ++v) field.angles.row(v) << 0.37 * v, 0.37 * v + pi / 2;
    const LinesMetric metric = lines_metric(field);
    EXPECT_TRUE(metric.damped.empty());
    EXPECT_EQ(metric.least_part, 1);
    EXPECT_FALSE(metric.domain.has_own_lengths());
    EXPECT_LT((metric.domain.edge_lengths() - field.domain.edge_lengths()).cwiseAbs().maxCoeff(), 1e-14);
    SingularPattern pattern;
    for (const double at : {0.2, 1.7, 3.5, 4.9})
        pattern.points.push_back(imposed_point(field.domain, Vector(0.5 * std::cos(at), 0.5 * std::sin(at), 0), 1));
    const ImposedField before = impose_singular_points(field.domain, pattern);
    const ImposedField after = impose_singular_points(metric.domain, pattern);
    ASSERT_EQ(before.log_size.size(), after.log_size.size());
    EXPECT_LT((before.log_size - after.log_size).cwiseAbs().maxCoeff(), 1e-12);
}

// Lines that turn by much from vertex to vertex at small angles fit no triangles.
TEST(LinesMetric, OfLinesThatTurnTooFastIsDampedAndTold) {
    NonOrthogonalField field = non_orthogonal_field(disk(8));
    for (Index v = 0; v < field.angles.rows(); ++v) field.angles.row(v) << 1.3 * v, 1.3 * v + 0.2;
    const LinesMetric metric = lines_metric(field);
    EXPECT_FALSE(metric.damped.empty());
    EXPECT_LT(metric.least_part, 1);
    EXPECT_GT(metric.domain.corner_angles().minCoeff(), 0);
    field.angles.row(3) << 0.5, 0.5;
    try {
        lines_metric(field);
        ADD_FAILURE() << "parallel lines are taken";
    } catch (const GeometryError& error) {
        EXPECT_EQ(error.kind(), "parallel_lines");
        EXPECT_EQ(error.elements(), std::vector<Index>{3});
    }
}

TEST(OwnLengths, ThatMakeNoTriangleAreTold) {
    const SurfaceDomain domain(make_mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}));
    const auto error_of = [&](const Eigen::VectorXd& lengths) {
        try {
            domain.with_edge_lengths(lengths);
        } catch (const Error& error) {
            return std::pair(error.kind(), error.elements());
        }
        return std::pair(std::string("none"), std::vector<Index>{});
    };
    Eigen::VectorXd lengths = domain.edge_lengths();  // 01, 02, 03, 12, 23
    EXPECT_EQ(error_of(lengths).first, "none");
    lengths[2] = 3;
    EXPECT_EQ(error_of(lengths), std::pair(std::string("no_triangle"), std::vector<Index>{1}));
    lengths[2] = -1;
    EXPECT_EQ(error_of(lengths), std::pair(std::string("bad_lengths"), std::vector<Index>{2}));
    EXPECT_EQ(error_of(Eigen::VectorXd::Ones(4)).first, "bad_lengths");
    const SurfaceDomain even = domain.with_edge_lengths(Eigen::VectorXd::Ones(5));
    EXPECT_LT((even.corner_angles().array() - pi / 3).abs().maxCoeff(), 1e-15);
    EXPECT_NEAR(even.areas()[0], std::sqrt(3) / 4, 1e-15);
    EXPECT_FALSE(domain.has_own_lengths());
    // Fields that are aligned in space do not take it.
    EXPECT_THROW(non_orthogonal_field(even), InvalidInput);
    DirectionFieldOptions guided;
    guided.guide.directions = Points::Zero(2, 3);
    guided.guide.directions.col(0).setOnes();
    guided.guide.weights = Eigen::VectorXd::Ones(2);
    EXPECT_NO_THROW(direction_field(domain, guided));
    EXPECT_THROW(direction_field(even, guided), InvalidInput);
    EXPECT_EQ(direction_field(even).domain.edge_lengths(), even.edge_lengths());
}

}  // namespace
}  // namespace octafield::surface
