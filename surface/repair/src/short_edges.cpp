#include "short_edges.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

#include "octafield/error.hpp"

namespace octafield::surface {
namespace {

Index root(std::vector<Index>& parent, Index v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
}

}  // namespace

std::size_t collapse_short_edges(TriangleMesh& mesh, double length) {
    std::vector<Index> parent(mesh.vertices.rows());
    std::iota(parent.begin(), parent.end(), 0);
    std::size_t joined = 0;
    for (Index t = 0; t < mesh.triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k) {
            const Index a = mesh.triangles(t, k), b = mesh.triangles(t, (k + 1) % 3);
            if ((mesh.vertices.row(a) - mesh.vertices.row(b)).norm() > length) continue;
            const Index first = root(parent, a), second = root(parent, b);
            if (first == second) continue;
            parent[std::max(first, second)] = std::min(first, second);
            ++joined;
        }
    if (joined == 0) return 0;
    TriangleMesh result{mesh.vertices, Triangles(mesh.triangles.rows(), 3)};
    Index kept = 0;
    for (Index t = 0; t < mesh.triangles.rows(); ++t) {
        const Index a = root(parent, mesh.triangles(t, 0)), b = root(parent, mesh.triangles(t, 1)),
                    c = root(parent, mesh.triangles(t, 2));
        if (a != b && b != c && c != a) result.triangles.row(kept++) << a, b, c;
    }
    result.triangles.conservativeResize(kept, 3);
    try {
        if (kept == 0 || euler_characteristic(mesh) != euler_characteristic(result)) return 0;
    } catch (const GeometryError&) {  // three triangles at an edge
        return 0;
    }
    mesh = std::move(result);
    return joined;
}

}  // namespace octafield::surface
