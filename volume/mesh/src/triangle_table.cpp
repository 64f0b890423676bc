#include "octafield/volume/triangle_table.hpp"

#include <algorithm>

#include "folded_tets.hpp"
#include "octafield/error.hpp"
#include "octafield/parallel.hpp"

namespace octafield::volume {
namespace {

// A triangle of one tet, its lowest vertex implied by the bucket.
struct Entry {
    Index middle, highest, side;
    auto operator<=>(const Entry&) const = default;
    bool same_triangle(const Entry& other) const { return middle == other.middle && highest == other.highest; }
};

std::array<Index, 3> sorted_face(const Tets& tets, Eigen::Index t, int corner) {
    const auto& face = tet_face[corner];
    std::array<Index, 3> ids{tets(t, face[0]), tets(t, face[1]), tets(t, face[2])};
    std::sort(ids.begin(), ids.end());
    return ids;
}

struct Buckets {
    std::vector<std::int64_t> begin;  // (n + 1), by lowest vertex
    std::vector<Entry> entries;
};

Buckets sorted_buckets(const TetMesh& mesh, int threads) {
    const Eigen::Index n = mesh.vertices.rows(), m = mesh.tets.rows();
    Buckets buckets{std::vector<std::int64_t>(n + 1, 0), std::vector<Entry>(4 * m)};
    for (Eigen::Index t = 0; t < m; ++t)
        for (int k = 0; k < 4; ++k) ++buckets.begin[sorted_face(mesh.tets, t, k)[0] + 1];
    for (Eigen::Index v = 0; v < n; ++v) buckets.begin[v + 1] += buckets.begin[v];
    std::vector<std::int64_t> next(buckets.begin.begin(), buckets.begin.end() - 1);
    for (Eigen::Index t = 0; t < m; ++t)
        for (int k = 0; k < 4; ++k) {
            const auto [low, middle, high] = sorted_face(mesh.tets, t, k);
            buckets.entries[next[low]++] = {middle, high, static_cast<Index>(4 * t + k)};
        }
    parallel_for(n, threads, [&](std::int64_t v) {
        std::sort(buckets.entries.begin() + buckets.begin[v], buckets.entries.begin() + buckets.begin[v + 1]);
    });
    return buckets;
}

[[noreturn]] void throw_non_manifold(Index a, const Entry& e) {
    throw GeometryError("three or more tets share the triangle with vertices " + first_few({a, e.middle, e.highest}) +
                            "; remove repeated or overlapping tets",
                        "non_manifold_face", {a, e.middle, e.highest});
}

}  // namespace

TriangleTable triangle_table(const TetMesh& mesh, int threads) {
    const Buckets buckets = sorted_buckets(mesh, threads);
    const auto& entries = buckets.entries;
    // A triangle has one entry or two, so the number of triangles before a bucket is found in one pass.
    std::int64_t count = 0;
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
        for (std::int64_t i = buckets.begin[v]; i < buckets.begin[v + 1]; ++i)
            count += i == buckets.begin[v] || !entries[i].same_triangle(entries[i - 1]);

    TriangleTable table{Triangles(count, 3), Edges::Constant(count, 2, -1), Tets(mesh.tets.rows(), 4)};
    std::int64_t t = -1;
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
        for (std::int64_t i = buckets.begin[v]; i < buckets.begin[v + 1]; ++i) {
            const Entry& e = entries[i];
            if (i == buckets.begin[v] || !e.same_triangle(entries[i - 1])) {
                table.triangles.row(++t) << static_cast<Index>(v), e.middle, e.highest;
                table.sides(t, 0) = e.side;
            } else if (table.sides(t, 1) < 0) {
                table.sides(t, 1) = e.side;
            } else {
                throw_non_manifold(static_cast<Index>(v), e);
            }
            table.tet_triangles(e.side / 4, e.side % 4) = static_cast<Index>(t);
        }
    require_unfolded(mesh, table);
    return table;
}

}  // namespace octafield::volume
