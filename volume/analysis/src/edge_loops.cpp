#include "edge_loops.hpp"

#include <algorithm>
#include <array>
#include <tuple>

#include "octafield/frames/octahedral_lift.hpp"
#include "octafield/parallel.hpp"

namespace octafield::volume {
namespace {

// Corners (a, b, c, d) of a positively oriented tet for each of its edges ab: an even permutation, so that the way
// round a -> b (right-handed) enters the tet through the triangle abc and leaves it through abd.
constexpr std::array<std::array<int, 4>, 6> even{
    {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}}};

TetAtEdge tet_at_edge(const TetMesh& mesh, const TriangleTable& table, Index tet, int edge) {
    const auto& c = even[edge];
    const auto id = [&](int k) { return mesh.tets(tet, c[k]); };
    if (id(0) < id(1)) return {id(0), id(1), tet, id(2), id(3), table.tet_triangles(tet, c[2])};
    return {id(1), id(0), tet, id(3), id(2), table.tet_triangles(tet, c[3])};
}

}  // namespace

std::vector<std::uint8_t> triangle_matchings(const TriangleTable& table, const Quaternions& of_tets, int threads) {
    std::vector<std::uint8_t> result(table.triangles.rows(), 0);
    parallel_for(table.triangles.rows(), threads, [&](std::int64_t t) {
        if (table.sides(t, 1) < 0) return;
        const auto frame = [&](int side) { return frames::from_wxyz(of_tets.row(table.sides(t, side) / 4)); };
        result[t] = static_cast<std::uint8_t>(frames::matching(frame(0), frame(1)));
    });
    return result;
}

LiftedMatchings lifted_matchings(const TriangleTable& table, const Quaternions& of_tets, int threads) {
    const std::size_t count = table.triangles.rows();
    LiftedMatchings result{std::vector<std::uint8_t>(count, 0), std::vector<std::uint8_t>(count, 0)};
    parallel_for(table.triangles.rows(), threads, [&](std::int64_t t) {
        if (table.sides(t, 1) < 0) return;
        const auto frame = [&](int side) { return frames::from_wxyz(of_tets.row(table.sides(t, side) / 4)); };
        const auto [element, tie] = frames::lifted_matching(frame(0), frame(1));
        result.element[t] = static_cast<std::uint8_t>(element);
        result.tie[t] = tie;
    });
    return result;
}

// Bucketed by lowest vertex, then sorted in the buckets.
std::vector<TetAtEdge> tets_at_edges(const TetMesh& mesh, const TriangleTable& table, int threads) {
    const Eigen::Index n = mesh.vertices.rows(), m = mesh.tets.rows();
    std::vector<std::int64_t> begin(n + 1, 0);
    for (Index t = 0; t < m; ++t)
        for (int e = 0; e < 6; ++e) ++begin[std::min(mesh.tets(t, even[e][0]), mesh.tets(t, even[e][1])) + 1];
    for (Eigen::Index v = 0; v < n; ++v) begin[v + 1] += begin[v];
    std::vector<std::int64_t> next(begin.begin(), begin.end() - 1);
    std::vector<TetAtEdge> result(6 * m);
    for (Index t = 0; t < m; ++t)
        for (int e = 0; e < 6; ++e) {
            const TetAtEdge at = tet_at_edge(mesh, table, t, e);
            result[next[at.a]++] = at;
        }
    parallel_for(n, threads, [&](std::int64_t v) {
        std::sort(result.begin() + begin[v], result.begin() + begin[v + 1],
                  [](const TetAtEdge& x, const TetAtEdge& y) { return std::tie(x.b, x.tet) < std::tie(y.b, y.tet); });
    });
    return result;
}

// As for triangles, h is the inverse of the product of the matchings along the loop, from the lowest tet.
EdgeLoop edge_loop(std::span<const TetAtEdge> tets, const TriangleTable& table,
                   const std::vector<std::uint8_t>& matching) {
    int product = 0;
    auto at = tets.begin();
    for (std::size_t step = 0; step < tets.size(); ++step) {
        if (table.sides(at->triangle, 1) < 0) return {};
        const bool forward = table.sides(at->triangle, 0) / 4 == at->tet;
        const int m = matching[at->triangle];
        product = frames::lifted_product(product, forward ? m : frames::lifted_inverse(m));
        const Index enter = at->leave;
        at = std::find_if(tets.begin(), tets.end(), [&](const TetAtEdge& t) { return t.enter == enter; });
        if (at == tets.end()) return {};
        if (at == tets.begin() && step + 1 != tets.size()) return {};  // two fans that touch in this edge
    }
    const int lift = frames::lifted_inverse(product);
    return {true, frames::holonomy_of(lift), lift};
}

}  // namespace octafield::volume
