// Families of sizes along streamlines, limit cycles and their removal.
#include "octafield/surface/size_families.hpp"

#include "line_widths.hpp"
#include "log_factors.hpp"
#include "octafield/surface/imposed_field.hpp"
#include "octafield/surface/limit_cycles.hpp"
#include "sized_fixtures.hpp"

namespace octafield::surface {
namespace {

Vector at_angle(double angle) { return {std::cos(angle), std::sin(angle), 0}; }

// A ring of radii 1 and 2.
TriangleMesh ring(int around, int across) {
    std::vector<Vector> points;
    std::vector<Eigen::Vector3i> triangles;
    for (int j = 0; j <= across; ++j)
        for (int i = 0; i < around; ++i)
            points.push_back((1.0 + static_cast<double>(j) / across) * at_angle(2 * pi * (i + 0.5 * (j % 2)) / around));
    for (int j = 0; j < across; ++j)
        for (int i = 0; i < around; ++i) {
            const int k = (i + 1) % around, a = j * around + i, b = j * around + k, c = a + around, d = b + around;
            if (j % 2 == 0) {
                triangles.insert(triangles.end(), {{a, c, b}, {b, c, d}});
            } else {
                triangles.insert(triangles.end(), {{a, d, b}, {a, c, d}});
            }
        }
    for (auto& t : triangles) {
        const Vector ab = points[t[1]] - points[t[0]], ac = points[t[2]] - points[t[0]];
        if (ab.cross(ac).z() < 0) std::swap(t[1], t[2]);
    }
    return make_mesh(points, triangles);
}

// Along circles at radius 1.5, turning by `slope` per radius across it.
DirectionField twisted_ring(double slope) {
    const SurfaceDomain domain(ring(120, 24));
    return prescribed(
        domain, 4, [=](const Vector& x) { return at_angle(std::arg(flat(x)) + pi / 2 + slope * (x.norm() - 1.5)); },
        up);
}

TEST(SizeFamilies, TheFieldOfAValenceThreePointHasSquares) {  // of z -> z^(3/4); published: 1.0033
    TriangleMesh mesh = disk(40);
    mesh.vertices.col(0).array() += 0.007;
    mesh.vertices.col(1).array() += 0.003;
    const SurfaceDomain domain(mesh);
    const DirectionField field = prescribed(
        domain, 4, [](const Vector& x) { return at_angle(std::arg(flat(x)) / 4); }, up);
    SizeFamilyOptions options;
    options.singular_radius = 0.1;  // four edges
    const SizeFamilies families = size_families(field, surface_singularities(field), options);
    EXPECT_TRUE(families.converged);
    EXPECT_GT(families.positions.rows(), 500);
    EXPECT_EQ(families.parts, 1);
    EXPECT_LT(families.worst_anisotropy, 1.0033);
    // sigma = (4/3) r^(1/4), up to a factor.
    Eigen::VectorXd off(families.positions.rows());
    for (Index i = 0; i < off.size(); ++i)
        off[i] = families.log_widths.row(i).mean() - std::log(families.positions.row(i).norm()) / 4;
    EXPECT_LT(off.maxCoeff() - off.minCoeff(), 0.05);
}

TEST(SizeFamilies, PolarCoordinatesHaveTheirOwnAnisotropyUnlessCirclesGrow) {
    // Along circles and rays: rays carry a width that grows with r, circles one that is constant.
    const DirectionField field = twisted_ring(0);
    const SizeFamilies families = size_families(field, surface_singularities(field));
    // ln(r) + c against free constants: circles choose their widths, so quads are squares.
    EXPECT_LT(families.worst_anisotropy, 1.02);
    const auto log_radius = [](const Vector& x) { return std::log(x.norm()); };
    double most = 0, mean = 0;
    for (Index v = 0; v < field.domain.vertex_count(); ++v)
        mean += (families.log_sizes[v] - log_radius(field.domain.mesh().vertices.row(v))) / field.domain.vertex_count();
    for (Index v = 0; v < field.domain.vertex_count(); ++v)
        most = std::max(most, std::abs(families.log_sizes[v] - log_radius(field.domain.mesh().vertices.row(v)) - mean));
    EXPECT_LT(most, 0.05);
}

TEST(SizeFamilies, ATurningFieldHasTheAnisotropyOfItsFlux) {
    // alpha = 0.5 x: lines of the first family, along (cos, sin), are carried by grad alpha . J t = -0.5 sin(alpha).
    const SurfaceDomain domain(square(24));
    const DirectionField field = prescribed(
        domain, 4, [](const Vector& x) { return at_angle(0.5 * x.x()); }, up);
    const detail::ChartedField charted(field, detail::corner_links(domain, 4));
    StreamlineSeed seed;
    seed.triangle = domain.triangle_count() / 2;
    seed.direction = {1, 0, 0};
    const Streamline line = streamlines(field, {}, {seed})[0];
    const std::vector<double> growth = detail::width_growth(detail::AngleSlopes(charted), line);
    // ds = dx / cos(alpha): ln w = ln cos(alpha) + const.
    const double first = 0.5 * line.points(0, 0), last = 0.5 * line.points(line.points.rows() - 1, 0);
    EXPECT_NEAR(growth.back(), std::log(std::cos(last) / std::cos(first)), 1e-3);
    EXPECT_GT(std::abs(growth.back()), 0.1);
}

TEST(SizeFamilies, TheConvexProblemIsSolvedToItsMinimum) {
    const std::vector<detail::RatioTerm> terms{{0, 1, 1.0}, {1, 2, -0.4}, {0, 2, 2.5}, {3, 4, 7.0}, {0, 2, 2.5}};
    for (const int power : {1, 2, 4}) {
        const auto found = detail::least_log_factors(terms, 6, power, 200, [](double) { return true; });
        EXPECT_TRUE(found.converged);
        EXPECT_EQ(found.part, (std::vector<Index>{0, 0, 0, 3, 3, 5}));
        EXPECT_NEAR(found.x[4], 7.0, 0.2);  // alone: a = 0
        const auto objective = [&](const Eigen::VectorXd& x) {
            double sum = 0;
            for (const auto& t : terms) sum += std::pow(2 * std::cosh(t.offset + x[t.one] - x[t.other]) - 2, 2 * power);
            return sum;
        };
        EXPECT_NEAR(found.objective, objective(found.x), 1e-9 * found.objective);
        for (const Index i : {1, 2})
            for (const double step : {-0.01, 0.01}) {
                Eigen::VectorXd x = found.x;
                x[i] += step;
                EXPECT_GT(objective(x), found.objective);
            }
    }
}

TEST(PhaseSearch, AParallelFieldHasSquaresInEveryPhase) {
    const SurfaceDomain domain(square(8));
    const DirectionField field = prescribed(
        domain, 4, [](const Vector&) { return at_angle(0.1); }, up);
    SizeFamilyOptions options;
    options.spacing = 0.1;
    const PhaseSearch search = phase_search(field, 3, options);
    EXPECT_LT(search.worst.maxCoeff(), 1 + 1e-9);
    EXPECT_NEAR(search.angles[2], pi / 3, 1e-12);
    EXPECT_THROW(phase_search(field, 0), InvalidInput);
}

TEST(LimitCycles, RegularClosedLinesAreNone) {
    const DirectionField field = twisted_ring(0);
    EXPECT_TRUE(limit_cycles(field, surface_singularities(field)).empty());
}

TEST(LimitCycles, OfATwistedRingIsFoundAndRemoved) {
    for (const double slope : {0.8, -0.8}) {
        const DirectionField field = twisted_ring(slope);
        const auto points = surface_singularities(field);
        const auto cycles = limit_cycles(field, points);
        ASSERT_EQ(cycles.size(), 1u) << slope;
        EXPECT_NEAR(cycles[0].line.length, 2 * pi * 1.5, 0.1);
        EXPECT_NEAR(std::abs(cycles[0].flux), 2 * pi * 1.5 * 0.8, 0.2);
        EXPECT_FALSE(cycles[0].crosses_itself);
        const UnwoundField unwound = without_limit_cycles(field);
        EXPECT_EQ(unwound.removed.size(), 1u);
        EXPECT_TRUE(unwound.left.empty());
        // Outside the band nothing has changed, and no singular point has come.
        Index changed = 0;
        for (Index e = 0; e < field.values.size(); ++e)
            changed += std::abs(unwound.field.values[e] - field.values[e]) > 1e-12;
        EXPECT_GT(changed, 0);
        EXPECT_LT(changed, 0.6 * field.values.size());
        for (const auto& point : surface_singularities(unwound.field).points) EXPECT_TRUE(point.boundary);
    }
}

TEST(LimitCycles, BandsThatReachTheBoundaryAreRefused) {
    const DirectionField field = twisted_ring(0.8);
    const auto points = surface_singularities(field);
    const auto cycles = limit_cycles(field, points);
    ASSERT_EQ(cycles.size(), 1u);
    LimitCycleOptions options;
    options.band_width = 1.2;
    EXPECT_THROW(without_limit_cycle(field, points, cycles[0], options), InvalidInput);
    EXPECT_EQ(without_limit_cycles(field, options).left.size(), 1u);
}

TEST(LimitCycles, OfATorusWithOnePairOfPointsAreForced) {
    const SurfaceDomain domain(torus(48, 24, 1, 0.4));
    SingularPattern pattern;
    pattern.points = {imposed_at_vertex(domain, 5, 1), imposed_at_vertex(domain, 24 * 24 + 11, -1)};
    ImposedFieldOptions imposing;
    imposing.inadmissible = Inadmissible::rotate;
    const ImposedField imposed = impose_singular_points(domain, pattern, imposing);
    const UnwoundField unwound = without_limit_cycles(imposed.field);
    EXPECT_TRUE(unwound.removed.empty());
    ASSERT_FALSE(unwound.left.empty());
    EXPECT_GT(std::abs(unwound.left[0].flux), 0.5);
}

}  // namespace
}  // namespace octafield::surface
