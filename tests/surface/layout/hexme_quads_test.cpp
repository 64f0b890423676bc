// Quads on the boundaries of real parts, with the features of their files.
#include "hexme_surface.hpp"
#include "octafield/error.hpp"
#include "octafield/surface/corner_pattern.hpp"
#include "octafield/surface/feature_cut.hpp"
#include "quad_checks.hpp"

namespace octafield::surface {
namespace {

struct Part {
    SurfaceDomain whole;
    FeatureCut cut;
    SingularPattern pattern;
};

// Points inside the faces from the computed field, corners by it, at least 1 quad each.
Part part_of(const SurfaceDomain& whole) {
    Part part{whole, cut_along_features(whole), {}};
    const DirectionField field = direction_field(part.cut.domain);
    const SingularPattern computed = singular_pattern(field, surface_singularities(field));
    part.pattern = with_corner_quads(part.cut.domain, computed, finite_corner_quads(part.cut.domain, computed));
    return part;
}

ImposedField field_of(const Part& part) {
    ImposedFieldOptions how;
    how.inadmissible = Inadmissible::move;
    try {
        return impose_singular_points(part.cut.domain, part.pattern, how);
    } catch (const SolverError&) {
        how.inadmissible = Inadmissible::rotate;
        return impose_singular_points(part.cut.domain, part.pattern, how);
    }
}

QuantizedQuads quads_of(const Part& part, Index count, Blocks blocks = Blocks::fine) {
    QuantizedQuadsOptions options;
    options.quad_count = count;
    options.blocks = blocks;
    options.origins = part.cut.origins;
    return quantized_quads(motorcycle_graph(field_of(part)), options);
}

// Irregular vertices that the points inside, and the quads of all faces' corners at each vertex of features, sum up to.
std::multiset<int> expected_whole(const Part& part) {
    std::multiset<int> result;
    for (const ImposedPoint& p : part.pattern.points)
        if (p.index_times_four != 0) result.insert(-p.index_times_four);
    std::map<Index, int> quads_of_copy;
    const EdgeTopology& topology = part.cut.domain.topology();
    for (Eigen::Index e = 0; e < topology.edges.rows(); ++e)
        if (topology.edge_triangles.row(e).minCoeff() < 0)
            for (int k = 0; k < 2; ++k) quads_of_copy[topology.edges(e, k)] = 2;
    for (const CornerQuads& c : default_corner_quads(part.cut.domain)) quads_of_copy[c.vertex] = c.quads;
    for (const CornerQuads& c : part.pattern.corners) quads_of_copy[c.vertex] = c.quads;
    std::map<Index, int> sums;
    for (const auto& [copy, quads] : quads_of_copy) sums[part.cut.origins[copy]] += quads;
    for (const auto& [vertex, quads] : sums)
        if (quads != 4) result.insert(quads - 4);
    return result;
}

double volume(const TriangleMesh& mesh) {
    double sum = 0;
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
        const Vector a = mesh.vertices.row(mesh.triangles(t, 0)), b = mesh.vertices.row(mesh.triangles(t, 1)),
                     c = mesh.vertices.row(mesh.triangles(t, 2));
        sum += a.dot(b.cross(c)) / 6;
    }
    return sum;
}

void expect_whole(const Part& part, const QuantizedQuads& quads, Blocks blocks = Blocks::fine) {
    expect_conforming(quads, euler_characteristic(part.whole.mesh()), blocks);
    EXPECT_EQ(counted_edges(quads.mesh).boundary, 0);
    EXPECT_EQ(irregularities(quads.mesh), expected_whole(part));
    const double exact = volume(part.whole.mesh());
    EXPECT_NEAR(volume(split_quads(quads.mesh)) / exact, 1, 0.02);
    // Where other than two features meet, there is a vertex.
    std::map<Index, int> degree;
    for (Eigen::Index e = 0; e < part.whole.features().edges.rows(); ++e)
        for (int k = 0; k < 2; ++k) ++degree[part.whole.features().edges(e, k)];
    for (const auto& [vertex, count] : degree) {
        if (count == 2) continue;
        const auto apart = quads.mesh.vertices.rowwise() - part.whole.mesh().vertices.row(vertex);
        EXPECT_LT(apart.rowwise().norm().minCoeff(), 1e-9 * part.whole.size());
    }
}

SurfaceDomain box(int n) {
    const TriangleMesh mesh = cube_surface(n);
    return SurfaceDomain(mesh, detect_features(mesh));
}

TEST(HexmeQuads, OfACubeAreItsFaces) {
    const Part part = part_of(box(5));
    EXPECT_EQ(part.cut.domain.vertex_count(), part.whole.vertex_count() + 8 * 2 + 12 * 4);
    EXPECT_TRUE(part.pattern.points.empty());
    const QuantizedQuads quads = quads_of(part, 600);
    expect_whole(part, quads);
    EXPECT_EQ(quads.mesh.quads.rows(), 600);
    EXPECT_EQ(quads.patch_sizes.rows(), 6);
    EXPECT_EQ(quads.chord_counts.size(), 3u);
    EXPECT_GT(quads.least_scaled_jacobian, 0.999);
}

// A line across a plate, and one that ends in it: the mesh follows both, and the boundary stays open.
TEST(HexmeQuads, OfAPlateWithLinesInside) {
    for (const double end : {1.0, 0.5}) {
        const TriangleMesh mesh = plate(8, [](double, double) { return true; });
        const EdgeTopology topology = edge_topology(mesh);
        Edges edges(0, 2);
        for (Eigen::Index e = 0; e < topology.edges.rows(); ++e) {
            const Vector a = mesh.vertices.row(topology.edges(e, 0)), b = mesh.vertices.row(topology.edges(e, 1));
            if (std::abs(a[0] - 0.5) > 1e-9 || std::abs(b[0] - 0.5) > 1e-9 || std::max(a[1], b[1]) > end + 1e-9)
                continue;
            edges.conservativeResize(edges.rows() + 1, 2);
            edges.row(edges.rows() - 1) = topology.edges.row(e);
        }
        const Part part = part_of(SurfaceDomain(mesh, feature_graph(mesh, edges)));
        const QuantizedQuads quads = quads_of(part, 300);
        expect_conforming(quads, 1);
        EXPECT_EQ(irregularities(quads.mesh), std::multiset<int>({-1, -1, -1, -1}));
        EXPECT_NEAR(triangle_areas(split_quads(quads.mesh)).sum(), 1, 1e-9);
        std::set<long> places;  // of vertices on the line
        for (Index v = 0; v < quads.mesh.vertices.rows(); ++v)
            if (std::abs(quads.mesh.vertices(v, 0) - 0.5) < 1e-9 && quads.mesh.vertices(v, 1) <= end + 1e-9)
                places.insert(std::lround(1e6 * quads.mesh.vertices(v, 1)));
        EXPECT_GE(places.size(), 300 * end * end / 40);
        EXPECT_TRUE(places.contains(0) && places.contains(std::lround(1e6 * end)));
    }
}

TEST(HexmeQuads, OfParts) {
    if (!std::filesystem::exists(shared_data() / "hexme")) GTEST_SKIP() << "no data";
    const struct {
        const char* name;
        double least;
        int most_irregular;
    } cases[] = {{"s03c", 0.9, 12}, {"s05c", 0.8, 16}, {"s10c", 0.8, 14}, {"s12c", 0.8, 8},
                 {"s16c", 0.95, 0}, {"i02c", 0.3, 44}, {"i10b", 0.99, 8}};
    for (const auto& c : cases) {
        SCOPED_TRACE(c.name);
        const Part part = part_of(hexme_surface(c.name));
        const QuantizedQuads quads = quads_of(part, 2000);
        expect_whole(part, quads);
        EXPECT_GT(quads.least_scaled_jacobian, c.least);
        EXPECT_EQ(static_cast<int>(quads.irregular.size()), c.most_irregular);
        EXPECT_NEAR(quads.mesh.quads.rows(), 2000, 100);
    }
}

// Blocks follow one another across features, so that there are few.
TEST(HexmeQuads, AreInFewBlocks) {
    if (!std::filesystem::exists(shared_data() / "hexme")) GTEST_SKIP() << "no data";
    for (const char* name : {"s05c"}) {
        SCOPED_TRACE(name);
        const Part part = part_of(hexme_surface(name));
        const QuantizedQuads few = quads_of(part, 2000, Blocks::few), fine = quads_of(part, 2000);
        expect_whole(part, few, Blocks::few);
        expect_whole(part, fine);
        EXPECT_LE(few.patch_sizes.rows(), 4 * few.fewest_blocks);
        EXPECT_LT(few.patch_sizes.rows(), fine.patch_sizes.rows() / 4);
        EXPECT_GE(few.least_scaled_jacobian, 0.5);
    }
}

// The notched cube: a corner of 135 degrees gets one quad, and then the faces' points do not fit one another.
TEST(HexmeQuads, FacesThatDoNotFitAreTold) {
    if (!std::filesystem::exists(shared_data() / "hexme")) GTEST_SKIP() << "no data";
    const Part part = part_of(hexme_surface("s07c"));
    EXPECT_EQ(kind_of([&] { quads_of(part, 2000); }), "no_integers");
}

}  // namespace
}  // namespace octafield::surface
