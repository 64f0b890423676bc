// Blocks of quad meshes that are known.
#include <random>
#include <set>

#include "layout_fixtures.hpp"
#include "octafield/surface/base_complex.hpp"

namespace octafield::surface {
namespace {

QuadMesh quad_mesh(Index vertices, const std::vector<std::array<Index, 4>>& quads) {
    QuadMesh mesh;
    mesh.vertices = Points::Zero(vertices, 3);
    mesh.quads.resize(static_cast<Eigen::Index>(quads.size()), 4);
    for (std::size_t q = 0; q < quads.size(); ++q)
        for (int k = 0; k < 4; ++k) mesh.quads(static_cast<Eigen::Index>(q), k) = quads[q][k];
    return mesh;
}

// n by m quads; round: joined at the left and right; both: at all sides. hole: one quad in the middle left out.
QuadMesh grid(int n, int m, bool round, bool both, bool hole = false) {
    const int columns = round ? n : n + 1, rows = both ? m : m + 1;
    const auto at = [&](int i, int j) { return static_cast<Index>((j % rows) * columns + i % columns); };
    std::vector<std::array<Index, 4>> quads;
    for (int j = 0; j < m; ++j)
        for (int i = 0; i < n; ++i) {
            if (hole && i == n / 2 && j == m / 2) continue;
            quads.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
            std::rotate(quads.back().begin(), quads.back().begin() + (i + 2 * j) % 4, quads.back().end());
        }
    return quad_mesh(columns * rows, quads);
}

// n^3 cubes' surface, each face of n^2 quads.
QuadMesh cube_quads(int n) {
    std::map<std::array<int, 3>, Index> number;
    std::vector<std::array<Index, 4>> quads;
    for (int d = 0; d < 3; ++d)
        for (const int end : {0, n})
            for (int i = 0; i < n; ++i)
                for (int j = 0; j < n; ++j) {
                    const auto at = [&](int u, int v) {
                        std::array<int, 3> p{};
                        p[d] = end;
                        p[(d + 1) % 3] = u;
                        p[(d + 2) % 3] = v;
                        return number.emplace(p, static_cast<Index>(number.size())).first->second;
                    };
                    quads.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
                    if (end == 0) std::swap(quads.back()[1], quads.back()[3]);
                }
    return quad_mesh(static_cast<Index>(number.size()), quads);
}

void expect_grids(const QuadMesh& mesh, const BaseComplex& complex) {
    std::vector<long> counts(complex.block_sizes.rows(), 0);
    for (const Index b : complex.blocks) ++counts.at(b);
    for (Eigen::Index b = 0; b < complex.block_sizes.rows(); ++b) {
        EXPECT_EQ(counts[b], static_cast<long>(complex.block_sizes(b, 0)) * complex.block_sizes(b, 1));
        for (int d = 0; d < 2; ++d)
            EXPECT_EQ(complex.block_sizes(b, d), complex.chord_counts.at(complex.block_chords(b, d)));
    }
    EXPECT_EQ(static_cast<Eigen::Index>(complex.blocks.size()), mesh.quads.rows());
}

TEST(BaseComplex, OfAGridIsOneBlock) {
    const QuadMesh mesh = grid(5, 3, false, false);
    const BaseComplex complex = base_complex(mesh);
    expect_grids(mesh, complex);
    EXPECT_EQ(complex.block_sizes.rows(), 1);
    EXPECT_EQ(complex.irregular.size(), 4u);
    EXPECT_EQ(complex.chord_counts.size(), 2u);
}

TEST(BaseComplex, OfAGridWithAHoleIsEightBlocks) {
    const QuadMesh mesh = grid(7, 5, false, false, true);
    const BaseComplex complex = base_complex(mesh);
    expect_grids(mesh, complex);
    EXPECT_EQ(complex.block_sizes.rows(), 8);
    EXPECT_EQ(complex.irregular.size(), 8u);
    EXPECT_EQ(complex.chord_counts.size(), 8u);  // the hole parts the middle ones
}

TEST(BaseComplex, OfRingsAndToriIsCut) {
    const QuadMesh ring = grid(6, 4, true, false), torus = grid(6, 4, true, true);
    for (const QuadMesh& mesh : {ring, torus}) {
        const BaseComplex complex = base_complex(mesh);
        expect_grids(mesh, complex);
        EXPECT_EQ(complex.block_sizes.rows(), 1);
        EXPECT_TRUE(complex.irregular.empty());
        EXPECT_GE(complex.cut_vertices, 1);
    }
}

TEST(BaseComplex, OfACubeIsItsFaces) {
    const int n = 3;
    const QuadMesh mesh = cube_quads(n);
    const BaseComplex complex = base_complex(mesh);
    expect_grids(mesh, complex);
    EXPECT_EQ(complex.block_sizes.rows(), 6);
    EXPECT_EQ(complex.irregular.size(), 8u);
    EXPECT_EQ(complex.chord_counts.size(), 3u);
    for (Index q = 0; q < mesh.quads.rows(); ++q) EXPECT_EQ(complex.blocks[q], q / (n * n));
}

// Quads of squares of the plane, of which some are left out.
QuadMesh squares(const std::vector<std::array<int, 2>>& at) {
    std::map<std::array<int, 2>, Index> number;
    std::vector<std::array<Index, 4>> quads;
    const auto vertex = [&](int x, int y) {
        return number.emplace(std::array<int, 2>{x, y}, static_cast<Index>(number.size())).first->second;
    };
    for (const auto& [x, y] : at)
        quads.push_back({vertex(x, y), vertex(x + 1, y), vertex(x + 1, y + 1), vertex(x, y + 1)});
    return quad_mesh(static_cast<Index>(number.size()), quads);
}

// Counted by hand: a cube has six faces, and corners for no fewer; an L has 5 + 3 quads at corners, and two lines that
// end at its boundary; a plus has 8 + 4 * 3, which are those of its five squares; a square with a hole 4 + 4 * 3, and
// eight lines from the hole to the outer boundary.
TEST(FewestBlocks, AreAQuarterOfTheCornersOfBlocks) {
    for (const int n : {1, 3}) EXPECT_EQ(fewest_blocks(cube_quads(n)), 6);
    EXPECT_EQ(fewest_blocks(grid(5, 3, false, false)), 1);
    EXPECT_EQ(fewest_blocks(grid(6, 4, true, false)), 1);
    EXPECT_EQ(fewest_blocks(grid(6, 4, true, true)), 1);
    const QuadMesh l_shape = squares({{0, 0}, {1, 0}, {0, 1}}),
                   plus = squares({{1, 0}, {0, 1}, {1, 1}, {2, 1}, {1, 2}});
    EXPECT_EQ(fewest_blocks(l_shape), 3);
    EXPECT_EQ(base_complex(l_shape).block_sizes.rows(), 3);
    EXPECT_EQ(fewest_blocks(plus), 5);
    EXPECT_EQ(base_complex(plus).block_sizes.rows(), 5);
    EXPECT_EQ(fewest_blocks(grid(7, 5, false, false, true)), 8);
}

TEST(FewestBlocks, OfPartsAddUp) {
    EXPECT_EQ(fewest_blocks(squares({{0, 0}, {5, 0}, {6, 0}, {5, 1}})), 1 + 3);
    QuadMesh none;
    none.quads.resize(0, 4);
    EXPECT_EQ(fewest_blocks(none), 0);
}

// A triangular prism: its triangles have a point of valence 3 each, with lines to their three sides, that go on over
// the other faces.
TEST(FewestBlocks, LinesGoOnOverFaces) {
    // Three kites in each triangle; 6 corners, 3 middles of edges, 1 middle, for below and above.
    std::vector<std::array<Index, 4>> quads;
    std::vector<Index> faces;
    for (Index k = 0; k < 3; ++k) {
        const Index next = (k + 1) % 3, last = (k + 2) % 3;
        quads.push_back({k, 3 + k, 6, 3 + last});
        faces.push_back(0);
        quads.push_back({10 + k, 10 + 3 + last, 16, 10 + 3 + k});
        faces.push_back(1);
        quads.push_back({3 + k, k, 10 + k, 13 + k});
        quads.push_back({next, 3 + k, 13 + k, 10 + next});
        faces.insert(faces.end(), 2, 2 + k);
    }
    for (auto& quad : quads)
        for (Index& v : quad)
            if (v >= 10) v -= 3;
    const QuadMesh prism = quad_mesh(14, quads);
    EXPECT_EQ(fewest_blocks(prism), 6);
    EXPECT_EQ(fewest_blocks(prism, faces), 12);
    EXPECT_EQ(base_complex(prism).block_sizes.rows(), 12);
    EXPECT_EQ(kind_of([&] { fewest_blocks(prism, {0}); }), "bad_option");
}

// Squares of the plane and faces of them, at random: no bound is above the blocks that there are.
TEST(FewestBlocks, AreNoMoreThanThereAre) {
    std::mt19937 random(1);
    int compared = 0, exact = 0;
    for (int i = 0; i < 600; ++i) {
        std::set<std::array<int, 2>> chosen = {{10, 10}};
        const int wanted = 2 + static_cast<int>(random() % 28);
        while (static_cast<int>(chosen.size()) < wanted) {
            auto at = *std::next(chosen.begin(), static_cast<long>(random() % chosen.size()));
            at[random() % 2] += random() % 2 == 0 ? 1 : -1;
            chosen.insert(at);
        }
        bool touches = false;  // at a corner alone
        for (const auto& [x, y] : chosen)
            for (const int d : {-1, 1})
                touches = touches || (chosen.contains({x + 1, y + d}) && !chosen.contains({x + 1, y}) &&
                                      !chosen.contains({x, y + d}));
        if (touches) continue;
        const QuadMesh mesh = squares({chosen.begin(), chosen.end()});
        std::vector<Index> faces;
        for (const auto& [x, y] : chosen) faces.push_back(i % 3 == 0 ? 0 : (x / (1 + i % 4)) + 100 * (y / (2 + i % 3)));
        const Index blocks = static_cast<Index>(base_complex(mesh).block_sizes.rows());
        const Index least = fewest_blocks(mesh, faces), of_one = fewest_blocks(mesh);
        EXPECT_LE(least, blocks) << i;
        EXPECT_LE(of_one, blocks) << i;
        ++compared;
        exact += std::max(least, of_one) == blocks;
    }
    EXPECT_GT(compared, 300);
    EXPECT_GT(exact, compared / 20);
}

// On a closed surface there are as many blocks as vertices of the layout less the Euler characteristic, so no fewer
// than irregular vertices less that.
TEST(FewestBlocks, OfClosedSurfacesFollowFromEuler) {
    const QuadMesh cube = cube_quads(4);
    EXPECT_EQ(fewest_blocks(cube), static_cast<Index>(base_complex(cube).irregular.size()) - 2);
}

TEST(FewestBlocks, OfWhatIsNoQuadMeshAreRefused) {
    QuadMesh mesh = grid(2, 2, false, false);
    mesh.quads(0, 0) = 100;
    EXPECT_EQ(kind_of([&] { fewest_blocks(mesh); }), "index_out_of_range");
    mesh = quad_mesh(8, {{0, 1, 2, 3}, {1, 0, 4, 5}, {1, 0, 6, 7}});
    EXPECT_EQ(kind_of([&] { fewest_blocks(mesh); }), "non_manifold_edge");
}

TEST(BaseComplex, OfWhatIsNoQuadMeshIsRefused) {
    QuadMesh mesh = grid(2, 2, false, false);
    mesh.quads(0, 0) = 100;
    EXPECT_EQ(kind_of([&] { base_complex(mesh); }), "index_out_of_range");
    mesh = quad_mesh(8, {{0, 1, 2, 3}, {1, 0, 4, 5}, {1, 0, 6, 7}});
    EXPECT_EQ(kind_of([&] { base_complex(mesh); }), "non_manifold_edge");
    mesh = grid(2, 2, false, false);
    mesh.triangles.resize(1, 3);
    mesh.triangles << 0, 1, 3;
    EXPECT_EQ(kind_of([&] { base_complex(mesh); }), "not_quads");
}

}  // namespace
}  // namespace octafield::surface
