#include "stubs.hpp"

#include <algorithm>
#include <vector>

namespace octafield::surface {
namespace {

constexpr double kShortStub = 2;  // of the lengths wanted

}  // namespace

Edges without_stubs(const TriangleMesh& mesh, FeatureGraph& features, const Eigen::VectorXd& lengths) {
    const Edges& edges = features.edges;
    std::vector<std::vector<Index>> round(mesh.vertices.rows());
    for (Index e = 0; e < edges.rows(); ++e)
        for (const Index v : edges.row(e)) round[v].push_back(e);
    std::vector<bool> gone(edges.rows(), false), corner(mesh.vertices.rows(), false);
    for (const Index v : features.corners) corner[v] = true;
    const auto left = [&](Index v) { return std::ranges::count_if(round[v], [&](Index e) { return !gone[e]; }); };
    std::vector<Index> ends;
    for (Index v = 0; v < mesh.vertices.rows(); ++v)
        if (left(v) == 1) ends.push_back(v);
    while (!ends.empty()) {
        Index v = ends.back();
        ends.pop_back();
        if (left(v) != 1) continue;
        // From its end to where it meets others, ends, or turns.
        std::vector<Index> curve;
        double length = 0, wanted = lengths[v];
        do {
            const Index e = *std::ranges::find_if(
                round[v], [&](Index one) { return !gone[one] && (curve.empty() || one != curve.back()); });
            const Index next = edges(e, 0) == v ? edges(e, 1) : edges(e, 0);
            length += (mesh.vertices.row(next) - mesh.vertices.row(v)).norm();
            wanted = std::min(wanted, lengths[next]);
            curve.push_back(e);
            v = next;
        } while (left(v) == 2 && !corner[v]);
        if (length >= kShortStub * wanted) continue;
        for (const Index e : curve) gone[e] = true;
        if (left(v) == 1) ends.push_back(v);
    }
    const Index taken = static_cast<Index>(std::ranges::count(gone, true));
    Edges stubs(taken, 2), kept(edges.rows() - taken, 2);
    for (Index e = 0, s = 0, k = 0; e < edges.rows(); ++e) (gone[e] ? stubs.row(s++) : kept.row(k++)) = edges.row(e);
    std::erase_if(features.corners, [&](Index v) { return left(v) == 0; });
    features.edges = std::move(kept);
    return stubs;
}

}  // namespace octafield::surface
