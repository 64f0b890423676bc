// Quads that are drawn to the directions of a field.
#include "followed_field.hpp"

#include "octafield/error.hpp"
#include "quad_checks.hpp"

namespace octafield::surface {
namespace {

using detail::FollowedField;

// Values of the cross whose angle from the x axis is `angle` in the plane.
template <class Angle>
Eigen::VectorXcd values_of(const SurfaceDomain& domain, const Angle& angle) {
    Eigen::VectorXcd result(domain.edge_count());
    for (Index e = 0; e < domain.edge_count(); ++e) {
        const auto edge = domain.topology().edges.row(e);
        const Vector a = domain.mesh().vertices.row(edge[0]), b = domain.mesh().vertices.row(edge[1]);
        result[e] = std::polar(1.0, 4 * (angle((a + b) / 2) - std::atan2(b.y() - a.y(), b.x() - a.x())));
    }
    return result;
}

// sin of twice the angle between a direction and the nearest line of the cross.
double off(const Vector& direction, double angle) {
    return std::sin(2 * (std::atan2(direction.y(), direction.x()) - angle));
}

TEST(FollowedField, IsConstantWhereTheFieldIsAndLinearInFourthPowersElsewhere) {
    const SurfaceDomain domain(disk(6));
    const auto middle = [&](Index t) -> Vector {
        const auto corners = domain.mesh().triangles.row(t);
        return (domain.mesh().vertices.row(corners[0]) + domain.mesh().vertices.row(corners[1]) +
                domain.mesh().vertices.row(corners[2])) /
               3;
    };
    const auto still = [](const Vector&) { return 0.3; };
    const auto bent = [](const Vector& p) { return 0.5 * p.x() + 0.2 * p.y(); };
    const Eigen::VectorXcd same = values_of(domain, still), turning = values_of(domain, bent), none;
    EXPECT_FALSE(FollowedField(domain, none));
    const FollowedField constant(domain, same), other(domain, turning);
    ASSERT_TRUE(constant);
    for (Index t = 0; t < domain.triangle_count(); ++t) {
        EXPECT_NEAR(off(constant.direction(t, middle(t)), 0.3), 0, 1e-12);
        EXPECT_NEAR(off(other.direction(t, middle(t)), bent(middle(t))), 0, 2e-3);
        EXPECT_NEAR(other.direction(t, middle(t)).norm(), 1, 1e-12);
    }
}

// Along lines of one value of v + 0.15 cos(pi u) cos(pi v / 2), u = x - y and v = x + y, which follow two sides of the
// square with corners at distance 1 on the axes, and meet the others at right angles.
TEST(FollowedField, DrawsEdgesToItsLines) {
    const ImposedField field = polygon_field(4, 16);
    const SurfaceDomain& domain = field.field.domain;
    const QuadLayout layout = motorcycle_graph(field);
    QuantizedQuadsOptions options;
    options.quad_count = 400;
    options.measure = ArcMeasure::lengths;
    options.blocks = Blocks::fine;
    const Eigen::VectorXcd bent = values_of(domain, [](const Vector& p) {
        const double u = p.x() - p.y(), v = p.x() + p.y();
        const double by_u = -0.15 * pi * std::sin(pi * u) * std::cos(pi * v / 2);
        const double by_v = 1 - 0.075 * pi * std::cos(pi * u) * std::sin(pi * v / 2);
        return std::atan2(-by_u - by_v, by_v - by_u);
    });
    const FollowedField lines(domain, bent);
    const auto mean_off = [&](const QuadMesh& mesh) {
        double sum = 0;
        for (Index q = 0; q < mesh.quads.rows(); ++q) {
            Vector middle = Vector::Zero();
            for (int k = 0; k < 4; ++k) middle += Vector(mesh.vertices.row(mesh.quads(q, k))) / 4;
            Index nearest = 0;
            double least = 1;
            for (Index t = 0; t < domain.triangle_count(); ++t) {
                const auto corners = domain.mesh().triangles.row(t);
                const Vector centre = (domain.mesh().vertices.row(corners[0]) + domain.mesh().vertices.row(corners[1]) +
                                       domain.mesh().vertices.row(corners[2])) /
                                      3;
                if ((centre - middle).norm() >= least) continue;
                least = (centre - middle).norm();
                nearest = t;
            }
            const Vector line = lines.direction(nearest, middle);
            for (int k = 0; k < 4; ++k) {
                const Vector side = mesh.vertices.row(mesh.quads(q, (k + 1) % 4)) - mesh.vertices.row(mesh.quads(q, k));
                sum += std::abs(off(side, std::atan2(line.y(), line.x())));
            }
        }
        return sum / (4 * static_cast<double>(mesh.quads.rows()));
    };
    const QuantizedQuads plain = quantized_quads(layout, options);
    options.follow = bent;
    const QuantizedQuads drawn = quantized_quads(layout, options);
    expect_conforming(drawn, 1);
    EXPECT_EQ(drawn.mesh.quads, plain.mesh.quads);
    EXPECT_LT(mean_off(drawn.mesh), 0.2 * mean_off(plain.mesh));
    EXPECT_GT(drawn.least_scaled_jacobian, 0.9);
    options.measure = ArcMeasure::parameters;
    EXPECT_EQ(kind_of([&] { quantized_quads(layout, options); }), "bad_option");
    options.measure = ArcMeasure::lengths;
    options.follow = bent.head(3);
    EXPECT_EQ(kind_of([&] { quantized_quads(layout, options); }), "bad_option");
}

}  // namespace
}  // namespace octafield::surface
