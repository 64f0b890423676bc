// The fit of a vortex to the values round a point: what it finds, and when it does not tell.
#include "charted_field.hpp"
#include "direction_field_fixtures.hpp"
#include "singular_place.hpp"

namespace octafield::surface {
namespace {

using detail::ChartedField;
using detail::SurfacePlace;

// A flat square of edge length about 1 / 14 (the mean of 1, 1 and sqrt 2 over 16), and the angle k arg(z - zero) on it.
struct Plane {
    TriangleMesh mesh = plate(16, [](double, double) { return true; });
    double edge = (2 + std::sqrt(2.0)) / 3 / 16;
    int index = 1;

    DirectionField vortex(Complex zero) const {
        return prescribed(
            mesh, 4,
            [&](const Vector& x) -> Vector {
                const double angle = (index * std::arg(Complex(x.x(), x.y()) - zero) + 0.4) / 4;
                return {std::cos(angle), std::sin(angle), 0};
            },
            up);
    }
    Index triangle_at(Complex z) const {
        for (Index t = 0; t < mesh.triangles.rows(); ++t) {
            bool inside = true;
            for (int k = 0; k < 3; ++k) {
                const Vector a = mesh.vertices.row(mesh.triangles(t, k)),
                             b = mesh.vertices.row(mesh.triangles(t, (k + 1) % 3));
                inside = inside && (b - a).cross(Vector(z.real(), z.imag(), 0) - a).z() >= 0;
            }
            if (inside) return t;
        }
        return -1;
    }
    // Where the fit puts the point that is looked for from `start` on; nothing where it does not tell.
    std::optional<Complex> found(const DirectionField& field, Complex start,
                                 const std::function<bool(Index)>& is_barrier) const {
        const auto links = detail::corner_links(field.domain, field.symmetry);
        const ChartedField charted(field, links);
        const Index t = triangle_at(start);
        const auto place =
            detail::fitted_place(charted, is_barrier, {t, charted.lower(t, {start.real(), start.imag(), 0})}, index);
        if (!place) return {};
        const Vector at = charted.lift(place->triangle, place->at);
        EXPECT_EQ(triangle_at({at.x(), at.y()}), place->triangle);
        return Complex(at.x(), at.y());
    }
};

bool nowhere(Index) { return false; }

TEST(FittedPlace, IsTheVortexOfEitherSignWithinAnEdgeOfTheStartAndNothingBeyond) {
    for (const int index : {1, -1}) {
        const Plane plane{.index = index};
        const Complex zero(0.523, 0.487);
        const DirectionField field = plane.vortex(zero);
        for (int k = 0; k < 8; ++k)
            for (const double far : {0.0, 0.5, 0.95, 1.05, 1.5}) {  // edge lengths
                const auto found = plane.found(field, zero + std::polar(far * plane.edge, k + 0.1), nowhere);
                ASSERT_EQ(found.has_value(), far < 1) << far;
                if (found) {
                    EXPECT_NEAR(std::abs(*found - zero), 0, 1e-6 * plane.edge);
                }
            }
    }
}

TEST(FittedPlace, TakesTwentyOneValues) {
    // Three of each triangle that can be reached: seven triangles.
    const Plane plane;
    const Complex zero(0.523, 0.487);
    const DirectionField field = plane.vortex(zero);
    std::vector<Index> reached{plane.triangle_at(zero)};
    for (std::size_t next = 0; reached.size() < 12; ++next)
        for (int k = 0; k < 3; ++k) {
            const auto beside =
                field.domain.topology().edge_triangles.row(field.domain.topology().triangle_edges(reached[next], k));
            const Index other = beside[0] == reached[next] ? beside[1] : beside[0];
            if (std::find(reached.begin(), reached.end(), other) == reached.end()) reached.push_back(other);
        }
    for (std::size_t count = 1; count <= 12; ++count) {
        const auto is_barrier = [&](Index e) {
            const auto beside = field.domain.topology().edge_triangles.row(e);
            return std::any_of(beside.begin(), beside.end(), [&](Index t) {
                return std::find(reached.begin(), reached.begin() + count, t) == reached.begin() + count;
            });
        };
        const auto found = plane.found(field, zero, is_barrier);
        EXPECT_EQ(found.has_value(), count >= 7) << count;
        if (found) {
            EXPECT_NEAR(std::abs(*found - zero), 0, 1e-6 * plane.edge);
        }
    }
}

TEST(FittedPlace, LeavesAQuarterRadianUnexplainedAndNoMore) {
    const Plane plane;
    const Complex zero(0.523, 0.487);
    for (const double noise : {0.2, 0.22, 0.32, 0.4}) {
        DirectionField field = plane.vortex(zero);
        std::mt19937 random(5);
        for (Index e = 0; e < field.values.size(); ++e)
            field.values[e] *= std::polar(1.0, random() % 2 == 0 ? noise : -noise);
        const auto found = plane.found(field, zero, nowhere);
        EXPECT_EQ(found.has_value(), noise < 0.25) << noise;
        if (found) {
            EXPECT_LT(std::abs(*found - zero), 0.3 * plane.edge);
        }
    }
}

TEST(FittedPlace, HardlyGoesByTheValuesNearerThanHalfAnEdge) {
    const Plane plane;
    const Complex zero(0.523, 0.487);
    for (const double turn : {0.5, -0.5}) {
        DirectionField field = plane.vortex(zero);
        for (Index e = 0; e < field.values.size(); ++e) {
            const auto ends = field.domain.topology().edges.row(e);
            const Vector middle = (plane.mesh.vertices.row(ends[0]) + plane.mesh.vertices.row(ends[1])) / 2;
            if ((middle - Vector(zero.real(), zero.imag(), 0)).norm() < 0.5 * plane.edge)
                field.values[e] *= std::polar(1.0, turn);
        }
        const auto found = plane.found(field, zero, nowhere);
        ASSERT_TRUE(found);
        EXPECT_LT(std::abs(*found - zero), 0.01 * plane.edge);
    }
}

TEST(FittedPlace, DoesNotGoOverABarrierOrTheBoundary) {
    // The line y = 8/16 is one; a start below, and vortices on both sides.
    const Plane plane;
    const DirectionField any = plane.vortex(0);
    const auto on_line = [&](double y) {
        return [&, y](Index e) {
            const auto ends = any.domain.topology().edges.row(e);
            return plane.mesh.vertices(ends[0], 1) == y && plane.mesh.vertices(ends[1], 1) == y;
        };
    };
    const Complex start(0.53, 0.49);
    for (const double y : {0.485, 0.498, 0.502, 0.52}) {
        const Complex zero(0.54, y);
        EXPECT_TRUE(plane.found(plane.vortex(zero), start, nowhere)) << y;
        EXPECT_EQ(plane.found(plane.vortex(zero), start, on_line(0.5)).has_value(), y < 0.5) << y;
    }
    for (const double y : {0.01, -0.01, -0.03}) {
        EXPECT_EQ(plane.found(plane.vortex({0.54, y}), {0.53, 0.012}, nowhere).has_value(), y > 0) << y;
    }
}

TEST(FittedPlace, MayBeInAnyTriangle) {
    const Complex zero(0.523, 0.487), start(0.501, 0.511);
    for (const int shift : {0, 1}) {  // the triangle of the vortex is then number 0 or 1
        Plane plane;
        const Index t = plane.triangle_at(zero);
        ASSERT_NE(t, plane.triangle_at(start));
        plane.mesh.triangles.row(t).swap(plane.mesh.triangles.row(shift));
        const auto found = plane.found(plane.vortex(zero), start, nowhere);
        ASSERT_TRUE(found);
        EXPECT_NEAR(std::abs(*found - zero), 0, 1e-6 * plane.edge);
    }
}

}  // namespace
}  // namespace octafield::surface
