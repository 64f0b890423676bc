// H and theta against closed forms, and what is exact on any mesh.
#include "imposed_fixtures.hpp"
#include "octafield/surface/streamlines.hpp"

namespace octafield::surface {
namespace {

std::vector<Source> four_in_disk(double radius, double turned) {
    std::vector<Source> sources;
    for (int i = 0; i < 4; ++i) sources.push_back({std::polar(radius, turned + i * pi / 2), 1});
    return sources;
}

TEST(ImposedOnDisk, PotentialConvergesToTheClosedForm) {
    const auto sources = four_in_disk(0.85009, 0.3);
    const double largest[] = {1.4e-2, 5e-3, 1.4e-3}, mean[] = {1.8e-3, 5.2e-4, 1.3e-4};
    int level = 0;
    for (const int rings : {13, 26, 51}) {
        const SurfaceDomain domain(disk(rings));
        const ImposedField field = impose_singular_points(domain, pattern_of(domain, sources));
        const Errors errors = potential_errors(
            field,
            [&](const Vector& x) {
                return disk_potential(sources, {x[0], x[1]});
            },
            farther(sources, 0.1));
        EXPECT_LT(errors.largest, largest[level]);
        EXPECT_LT(errors.root_mean_square, mean[level]);
        EXPECT_LT(field.closure, 1e-9);
        EXPECT_TRUE(field.conditions.empty());
        ++level;
    }
}

TEST(ImposedOnDisk, AnglesAreTheClosedFormsAtEveryEdgeMidpoint) {
    const std::vector<Source> sources = {{{0.3, 0.1}, -4}, {{-0.4, 0.2}, 2}, {{0.1, -0.6}, 3}, {{-0.2, 0.6}, 3}};
    const SurfaceDomain domain(disk(40));
    const ImposedField field = impose_singular_points(domain, pattern_of(domain, sources));
    const SurfaceDomain& fine = field.field.domain;
    const Edges& edges = fine.topology().edges;
    // theta = sum k (arg(z - a) + arg(1 - conj(a) z)) + constant, from the x axis; tangent to the circle.
    std::vector<Complex> ratios;
    for (Index e = 0; e < fine.edge_count(); ++e) {
        const Complex a = plane_point(field, edges(e, 0)), b = plane_point(field, edges(e, 1)), z = (a + b) / 2.0;
        if (!farther(sources, 0.15)(in_plane(z))) continue;
        double theta = 0;
        for (const Source& s : sources)
            theta += s.index_times_four / 4.0 * (std::arg(z - s.at) + std::arg(1.0 - std::conj(s.at) * z));
        ratios.push_back(std::polar(1.0, 4 * (std::arg(b - a) - theta)) * field.field.values[e]);
    }
    Complex mean = 0;
    for (const Complex r : ratios) mean += r / static_cast<double>(ratios.size());
    double worst = 0;
    for (const Complex r : ratios) worst = std::max(worst, std::abs(std::arg(r / mean)) / 4);
    EXPECT_LT(worst, 1.0 * degree);
}

TEST(ImposedOnDisk, EightBoundaryPointsRoundValenceEight) {
    std::vector<Source> sources = {{0.0, -4}};
    const SurfaceDomain domain(disk(32));
    for (int i = 0; i < 8; ++i) sources.push_back({std::polar(1.0, pi / 4 * i), 1});
    const ImposedField field = impose_singular_points(domain, pattern_of(domain, sources));
    const Errors errors = potential_errors(
        field,
        [](const Vector& x) {
            const Complex z(x[0], x[1]);
            return -std::log(std::abs(z)) + std::log(std::abs(std::pow(z, 8) - 1.0)) / 2;
        },
        farther(sources, 0.1));
    EXPECT_LT(errors.largest, 2e-2);
    const auto singularities = surface_singularities(field.field);
    EXPECT_TRUE(singularities.agree);
    EXPECT_EQ(found_indices(field.field)[field.point_vertices[0]], -4);
    EXPECT_EQ(separatrices(field.field, singularities).size(), 8u);  // one quad at each boundary point: none there
}

TEST(ImposedOnPlates, SquareAndLShapeHaveOneCrossAndOneSize) {
    const SurfaceDomain square(plate(8, [](double, double) { return true; }));
    const SurfaceDomain l_shape(plate(8, [](double x, double y) { return x < 0.5 || y < 0.5; }));
    for (const SurfaceDomain& domain : {square, l_shape}) {
        const ImposedField field = impose_singular_points(domain, {});
        EXPECT_EQ(field.field.domain.vertex_count(), domain.vertex_count());  // nothing to refine
        EXPECT_LT(field.log_size.cwiseAbs().maxCoeff(), 1e-12);
        const Edges& edges = domain.topology().edges;
        for (Index e = 0; e < domain.edge_count(); ++e) {
            const double angle = std::arg(plane_point(field, edges(e, 1)) - plane_point(field, edges(e, 0)));
            EXPECT_LT(std::abs(field.field.values[e] * std::polar(1.0, 4 * angle) - 1.0), 1e-11);
        }
    }
    const ImposedField field = impose_singular_points(l_shape, {});
    EXPECT_EQ(field.pattern.corners.size(), 6u);
    EXPECT_EQ(std::count_if(field.pattern.corners.begin(), field.pattern.corners.end(),
                            [](const CornerQuads& c) { return c.quads == 3; }),
              1);
}

TEST(ImposedOnAnnulus, WithoutPointsSizeIsTheRadius) {
    const double largest[] = {2.5e-3, 6e-4};
    int level = 0;
    for (const int around : {64, 128}) {
        const SurfaceDomain domain(annulus(0.3, around, around / 5));
        const ImposedField field = impose_singular_points(domain, {});
        const Errors errors = potential_errors(
            field, [](const Vector& x) { return std::log(x.norm()); }, [](const Vector&) { return true; });
        EXPECT_LT(errors.largest, largest[level++]);
        ASSERT_EQ(field.conditions.size(), 1u);
        EXPECT_LT(std::abs(field.conditions[0].angle), 1e-9);
    }
}

// int exp(-H) ds on the line from a, where the size goes as a power of the distance, to b.
double parameter_length(const ImposedField& field, Complex a, Complex b) {
    const SurfaceDomain& domain = field.field.domain;
    const int samples = 300;
    double sum = 0;
    for (int i = 0; i < samples; ++i) {
        const double s = (i + 0.5) / samples;
        const ImposedPoint at = imposed_point(domain, in_plane(a + (b - a) * s * s * s), 0);
        double h = 0;
        for (int k = 0; k < 3; ++k) h += at.weights[k] * field.log_size[domain.mesh().triangles(at.triangle, k)];
        sum += std::exp(-h) * 3 * s * s / samples;
    }
    return std::abs(b - a) * sum;
}

// n kites, each conformally a square, for the centre of valence n.
TEST(ImposedOnPolygons, HalfSideAndApothemAreOfOneLength) {
    for (const int n : {3, 5, 6, 8}) {
        const SurfaceDomain domain(polygon(n, 96 / n));
        SingularPattern pattern;
        if (n != 4) pattern.points.push_back(imposed_point(domain, Vector::Zero(), 4 - n));
        for (int i = 0; i < n; ++i) pattern.corners.push_back({0, 1});
        for (int i = 0; i < n; ++i) {
            const Vector corner = in_plane(std::polar(1.0, 2 * pi * i / n));
            for (Index v = 0; v < domain.vertex_count(); ++v)
                if ((domain.mesh().vertices.row(v).transpose() - corner).norm() < 1e-9) pattern.corners[i].vertex = v;
        }
        const ImposedField field = impose_singular_points(domain, pattern);
        const Complex corner = 1, middle = (corner + std::polar(1.0, 2 * pi / n)) / 2.0;
        const double ratio = parameter_length(field, corner, middle) / parameter_length(field, 0, middle);
        EXPECT_NEAR(ratio, 1, 0.015) << n;
    }
}

TEST(ImposedField, QuadsOfUnitSizeAreAsManyAsTheArea) {
    const SurfaceDomain domain(disk(20));
    const auto sources = four_in_disk(0.5, 0.1);
    const ImposedField field = impose_singular_points(domain, pattern_of(domain, sources));
    const Eigen::VectorXd areas = triangle_areas(field.field.domain.mesh());
    double quads = 0;
    for (Index t = 0; t < areas.size(); ++t) {
        double h = 0;
        for (int k = 0; k < 3; ++k) h += field.log_size[field.field.domain.mesh().triangles(t, k)] / 3;
        quads += areas[t] * std::exp(-2 * h);
    }
    EXPECT_NEAR(quads, areas.sum(), 0.02 * areas.sum());
}

}  // namespace
}  // namespace octafield::surface
