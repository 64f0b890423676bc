#include "octafield/volume/singular_split.hpp"

#include "octafield/volume/tet_singularities.hpp"
#include "tet_splitter.hpp"

namespace octafield::volume {

using namespace splitting;

SingularSplit split_between_singular(const TetDomain& domain, const Quaternions& of_tets, int threads) {
    const TetMesh& mesh = domain.mesh();
    const SingularEdges singular = singular_edges(domain, of_tets, threads);
    Surface held = surface_of(domain);
    std::vector<std::uint8_t> on_singular(mesh.vertices.rows(), 0);
    std::vector<Key<2>> kept = held.edges;
    for (const SingularEdge& e : singular.edges) {
        kept.push_back({e.a, e.b});
        on_singular[e.a] = on_singular[e.b] = 1;
    }
    sort_unique(kept);
    std::vector<Key<2>> keys;
    for (const auto& tet : list_of(mesh.tets))
        for (const auto& corners : edge_corners)
            if (const Key<2> key = key_of(tet, corners);
                on_singular[key[0]] && on_singular[key[1]] && !contains(kept, key))
                keys.push_back(key);
    sort_unique(keys);
    Splitter splitter(mesh, std::move(held));
    splitter.split(keys, edge_corners);
    std::vector<Key<2>> left;
    for (const auto& tet : splitter.tets())
        for (const auto& corners : edge_corners)
            if (const Key<2> key = key_of(tet, corners); contains(keys, key)) left.push_back(key);
    sort_unique(left);
    SingularSplit result{splitter.mesh(), splitter.parent(), rows_of(keys), rows_of(left), 0};
    result.added_vertices = static_cast<Index>(result.mesh.vertices.rows() - mesh.vertices.rows());
    return result;
}

}  // namespace octafield::volume
