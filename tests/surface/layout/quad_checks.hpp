// What quad meshes of layouts are checked for, from their arrays alone.
#pragma once

#include "layout_fixtures.hpp"
#include "octafield/surface/quantized_quads.hpp"

namespace octafield::surface {

struct EdgeCounts {
    long edges = 0, boundary = 0;
    std::vector<int> quads_at;      // of each vertex
    std::vector<bool> on_boundary;  // of each vertex
};

// Each edge has two quads that run it both ways, or is on the boundary.
inline EdgeCounts counted_edges(const QuadMesh& mesh) {
    std::map<std::pair<Index, Index>, int> ways;
    EdgeCounts result;
    result.quads_at.assign(mesh.vertices.rows(), 0);
    result.on_boundary.assign(mesh.vertices.rows(), false);
    for (Index q = 0; q < mesh.quads.rows(); ++q)
        for (int k = 0; k < 4; ++k) {
            ++result.quads_at[mesh.quads(q, k)];
            EXPECT_EQ((++ways[{mesh.quads(q, k), mesh.quads(q, (k + 1) % 4)}]), 1);
        }
    for (const auto& [way, uses] : ways) {
        const bool both = ways.contains({way.second, way.first});
        if (both && way.first > way.second) continue;
        ++result.edges;
        if (both) continue;
        ++result.boundary;
        result.on_boundary[way.first] = result.on_boundary[way.second] = true;
    }
    return result;
}

// Quads more than regular: 4 inside, 2 on the boundary. Only those that are not 0.
inline std::multiset<int> irregularities(const QuadMesh& mesh) {
    const EdgeCounts counts = counted_edges(mesh);
    std::multiset<int> result;
    for (std::size_t v = 0; v < counts.quads_at.size(); ++v)
        if (const int more = counts.quads_at[v] - (counts.on_boundary[v] ? 2 : 4); more != 0) result.insert(more);
    return result;
}

// Points inside and corners of the pattern, as irregularities.
inline std::multiset<int> expected_irregularities(const SingularPattern& pattern) {
    std::multiset<int> result;
    for (const ImposedPoint& p : pattern.points)
        if (p.index_times_four != 0) result.insert(-p.index_times_four);
    for (const CornerQuads& c : pattern.corners)
        if (c.quads != 2) result.insert(c.quads - 2);
    return result;
}

inline void expect_blocks(const QuantizedQuads& quads) {
    const QuadMesh& mesh = quads.mesh;
    std::vector<long> sizes(quads.patch_sizes.rows(), 0);
    for (const Index b : quads.patches) ++sizes.at(b);
    for (Eigen::Index b = 0; b < quads.patch_sizes.rows(); ++b) {
        EXPECT_EQ(sizes[b], static_cast<long>(quads.patch_sizes(b, 0)) * quads.patch_sizes(b, 1));
        for (int d = 0; d < 2; ++d) EXPECT_EQ(quads.patch_sizes(b, d), quads.chord_counts.at(quads.patch_chords(b, d)));
    }
    EXPECT_EQ(static_cast<Eigen::Index>(quads.patches.size()), mesh.quads.rows());
    // No vertex inside a block is irregular: its four quads would be of one block.
    const EdgeCounts counts = counted_edges(mesh);
    std::vector<std::set<Index>> blocks_at(mesh.vertices.rows());
    for (Index q = 0; q < mesh.quads.rows(); ++q)
        for (int k = 0; k < 4; ++k) blocks_at[mesh.quads(q, k)].insert(quads.patches[q]);
    for (std::size_t v = 0; v < blocks_at.size(); ++v)
        EXPECT_TRUE(counts.on_boundary[v] || counts.quads_at[v] == 4 || blocks_at[v].size() > 1);
}

// Where few blocks are wanted, arcs may have no quads.
inline void expect_conforming(const QuantizedQuads& quads, int euler, Blocks blocks = Blocks::fine) {
    const EdgeCounts counts = counted_edges(quads.mesh);
    for (const int count : counts.quads_at) EXPECT_GT(count, 0);
    EXPECT_EQ(quads.mesh.vertices.rows() - counts.edges + quads.mesh.quads.rows(), euler);
    EXPECT_GT(scaled_jacobians(quads.mesh).minCoeff(), 0);
    EXPECT_EQ(scaled_jacobians(quads.mesh).minCoeff(), quads.least_scaled_jacobian);
    for (const int count : quads.arc_counts) EXPECT_GE(count, blocks == Blocks::few ? 0 : 1);
    expect_blocks(quads);
}

inline QuantizedQuads quantized(const QuadLayout& layout, Index count, Blocks blocks = Blocks::fine) {
    QuantizedQuadsOptions options;
    options.quad_count = count;
    options.blocks = blocks;
    return quantized_quads(layout, options);
}

// Patterns of 4 to 10 points in the disk: valence 3, some of valence 5.
inline std::vector<Source> random_sources(std::mt19937& random, int extra) {
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<Source> sources;
    for (int i = 0; i < 4 + 2 * extra; ++i) {
        const double radius = 0.25 + 0.6 * unit(random), turn = i + 0.7 * unit(random);
        sources.push_back({std::polar(radius, 2 * pi * turn / (4 + 2 * extra)), i < 4 + extra ? 1 : -1});
    }
    return sources;
}

inline ImposedField sphere_field(int rings, const std::vector<Vector>& points) {
    const SurfaceDomain domain(icosphere(rings));
    SingularPattern pattern;
    for (const Vector& at : points) pattern.points.push_back(imposed_point(domain, at.normalized() * 0.999, 1));
    return impose_singular_points(domain, pattern);
}

inline std::vector<Vector> random_points(int seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    std::vector<Vector> points;
    while (points.size() < 8) {
        const double x = normal(random), y = normal(random), z = normal(random);
        points.push_back(Vector(x, y, z).normalized());
    }
    return points;
}

}  // namespace octafield::surface
