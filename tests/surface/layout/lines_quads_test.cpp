// Quads from non-orthogonal fields: layouts and whole numbers on the surface measured by the lines.
#include <set>

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

}  // namespace
}  // namespace octafield::surface
