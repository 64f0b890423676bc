// Which singular points there are, and where those stay that no fit moves.
#include "direction_field_fixtures.hpp"

namespace octafield::surface {
namespace {

// A triangle in the middle of three others: too few values for a fit. The corners of all begin at `shift`, and vertices
// are numbered backwards.
TriangleMesh four_triangles(int shift, bool backwards) {
    std::vector<Vector> points = {{0, 0, 0}, {1, 0.1, 0}, {0.4, 0.9, 0}, {0.6, -0.8, 0}, {1.3, 1, 0}, {-0.5, 0.6, 0}};
    std::vector<Eigen::Vector3i> triangles = {{0, 1, 2}, {1, 0, 3}, {2, 1, 4}, {0, 2, 5}};
    for (Eigen::Vector3i& t : triangles) {
        t = Eigen::Vector3i(t[shift], t[(shift + 1) % 3], t[(shift + 2) % 3]);
        if (backwards) t = 5 - t.array();
    }
    if (backwards) std::reverse(points.begin(), points.end());
    return make_mesh(points, triangles);
}

TEST(SingularPoints, WithoutAFitAreZerosOfTheLinearFunctionThroughTheMidpoints) {
    for (const int symmetry : {1, 2, 4})
        for (const bool backwards : {false, true})
            for (const int shift : {0, 1, 2})
                for (const Complex zero : {Complex(0.45, 0.3), {0.5, 0.25}, {0.4, 0.4}}) {
                    const TriangleMesh mesh = four_triangles(shift, backwards);
                    const auto direction = [&](const Vector& x) -> Vector {
                        const double angle = std::arg(flat(x) - zero) / symmetry;
                        return {std::cos(angle), std::sin(angle), 0};
                    };
                    const auto found = surface_singularities(prescribed(mesh, symmetry, direction, up));
                    EXPECT_TRUE(found.agree);
                    // Barycentric coordinates among the midpoints, of the point where the unit values balance.
                    Eigen::Matrix3d system, midpoints;
                    for (int k = 0; k < 3; ++k) {
                        const Vector middle = (mesh.vertices.row(mesh.triangles(0, k)) +
                                               mesh.vertices.row(mesh.triangles(0, (k + 1) % 3))) /
                                              2;
                        const double angle = std::arg(flat(middle) - zero);
                        system.col(k) << std::cos(angle), std::sin(angle), 1;
                        midpoints.col(k) = middle;
                    }
                    const Vector expected = midpoints * system.inverse().col(2);
                    int inside = 0;
                    for (const auto& point : found.points) {
                        if (point.boundary) continue;
                        ++inside;
                        EXPECT_EQ(point.triangle, 0);
                        EXPECT_EQ(point.index_times_symmetry, 1);
                        EXPECT_NEAR((point.position - expected).norm(), 0, 1e-12) << symmetry << shift << zero;
                    }
                    EXPECT_EQ(inside, 1);
                }
}

TEST(SingularPoints, OfATriangleAndItsCornerCancelWhereTheFieldDoesNotTurn) {
    // Inside, as the boundary has points of its own. Two sides of a triangle turned by a third of a turn to either
    // side: the angles of its sides go once round, and those of the edges at the corner between the two go once back.
    const TriangleMesh mesh = disk(3);
    const DirectionField constant = prescribed(
        mesh, 4,
        [](auto&) -> Vector {
            return {1, 0.2, 0};
        },
        up);
    const auto inside = [&](const DirectionField& field) {
        const auto found = surface_singularities(field);
        EXPECT_TRUE(found.agree);
        return std::count_if(found.points.begin(), found.points.end(),
                             [](const auto& point) { return !point.boundary; });
    };
    ASSERT_EQ(inside(constant), 0);
    for (const double sign : {1.0, -1.0})
        for (Index t = 0; t < mesh.triangles.rows(); ++t) {
            if (mesh.vertices(mesh.triangles.row(t), Eigen::all).rowwise().norm().maxCoeff() > 0.99) continue;
            for (int k = 0; k < 3; ++k) {
                DirectionField field = constant;
                field.values[field.domain.topology().triangle_edges(t, k)] *= std::polar(1.0, sign * 2 * pi / 3);
                field.values[field.domain.topology().triangle_edges(t, (k + 2) % 3)] *=
                    std::polar(1.0, -sign * 2 * pi / 3);
                EXPECT_EQ(inside(field), 0) << t << ' ' << k;
            }
        }
}

// The disk lifted to a cone with this angle defect at its tip.
TriangleMesh cone(double defect) {
    TriangleMesh mesh = disk(8);
    const double side = 0.5 / std::sin((2 * pi - defect) / 12);  // of the six triangles at the tip, over their base
    const double slope = std::sqrt(std::max(side * side - 1, 0.0));
    mesh.vertices.col(2) = slope * mesh.vertices.leftCols(2).rowwise().norm();
    return mesh;
}

TEST(SingularPoints, StayAtTheTipOfAConeOfMoreThanFifteenHundredthsAndLeaveOneOfLess) {
    for (const double defect : {0.0, 0.1, 0.149, 0.151, 0.2, 0.3}) {
        const TriangleMesh mesh = cone(defect);
        // Round the tip: the N-th power turns once against every plane there.
        const DirectionField field = prescribed(
            mesh, 1,
            [](const Vector& x) -> Vector {
                return {-x.y(), x.x(), 0};
            },
            [&](const Vector& x) -> Vector {
                const double r = x.head<2>().norm(), slope = r > 0 ? x.z() / r : 0;
                return {-slope * x.x() / r, -slope * x.y() / r, 1};
            });
        int inside = 0;
        for (const auto& point : surface_singularities(field).points) {
            if (point.boundary) continue;
            ++inside;
            EXPECT_EQ(point.index_times_symmetry, 1);
            EXPECT_EQ(point.vertex, defect > 0.15 ? 0 : -1) << defect;
            EXPECT_EQ(point.triangle<0, defect> 0.15) << defect;
            EXPECT_GE(point.triangle, -1);
            EXPECT_LT(point.position.norm(), 0.02);
        }
        EXPECT_EQ(inside, 1) << defect;
    }
}

// A zero at the middle vertex of a square that is folded along y = 1/2 by `fold`. On that line the field is along or
// across it: exactly where it is held, else to a billionth.
DirectionField folded(TriangleMesh& mesh, double fold, bool held) {
    const Complex middle(0.5, 0.5);
    DirectionField field = prescribed(
        mesh, 4,
        [&](const Vector& x) -> Vector {
            const double angle = std::arg(flat(x) - middle) / 4;
            return {std::cos(angle), std::sin(angle), 0};
        },
        up);
    for (Index e = 0; e < field.values.size(); ++e) {
        const auto ends = field.domain.topology().edges.row(e);
        if (mesh.vertices(ends[0], 1) != 0.5 || mesh.vertices(ends[1], 1) != 0.5) continue;
        EXPECT_NEAR(std::abs(field.values[e].real()), 1, 1e-12);
        field.values[e] = std::round(field.values[e].real()) * std::polar(1.0, held ? 0 : 1e-9);
    }
    for (Index v = 0; v < mesh.vertices.rows(); ++v) {
        const double over = mesh.vertices(v, 1) - 0.5;
        if (over > 0) mesh.vertices.row(v).tail<2>() << 0.5 + over * std::cos(fold), over * std::sin(fold);
    }
    field.domain = mesh;
    return field;
}

TEST(SingularPoints, StayAtVerticesOfEdgesThatTheFieldFollowsAndOfCreases) {
    for (const bool held : {false, true})
        for (const double degrees : {0.0, 39.0, -39.0, 41.0, -41.0}) {
            TriangleMesh mesh = plate(16, [](double, double) { return true; });
            const DirectionField field = folded(mesh, degrees * pi / 180, held);
            int inside = 0;
            for (const auto& point : surface_singularities(field).points) {
                if (point.boundary) continue;
                ++inside;
                EXPECT_EQ(point.index_times_symmetry, 1);
                EXPECT_EQ(point.vertex >= 0, held || std::abs(degrees) > 40) << held << degrees;
                EXPECT_NEAR((point.position - Vector(0.5, 0.5, 0)).norm(), 0, 1e-6);
            }
            EXPECT_EQ(inside, 1) << held << degrees;
        }
}

}  // namespace
}  // namespace octafield::surface
