#include "octafield/volume/locking.hpp"

#include "tet_splitter.hpp"

namespace octafield::volume {

using namespace splitting;
namespace {

LockingElements elements(const Found& found) { return {found.tets, rows_of(found.edges), rows_of(found.triangles)}; }

}  // namespace

LockingElements find_locking(const TetDomain& domain) {
    const TetMesh& mesh = domain.mesh();
    return elements(find(list_of(mesh.tets), surface_of(domain)));
}

LockingSplit split_locking(const TetDomain& domain) {
    const TetMesh& mesh = domain.mesh();
    Splitter splitter(mesh, surface_of(domain));
    const Found found = splitter.find();
    splitter.split(found.edges, edge_corners);
    splitter.split(splitter.find().triangles, triangle_corners);
    constexpr std::array<std::array<int, 4>, 1> whole{{{0, 1, 2, 3}}};
    std::vector<Key<4>> tets;
    for (const Index t : splitter.find().tets) tets.push_back(key_of(splitter.tets()[t], whole[0]));
    sort_unique(tets);
    splitter.split(tets, whole);
    LockingSplit result{.mesh = splitter.mesh(),
                        .parent = splitter.parent(),
                        .found = elements(found),
                        .added_vertices = 0,
                        .left = splitter.find().tets};
    result.added_vertices = static_cast<Index>(result.mesh.vertices.rows() - mesh.vertices.rows());
    return result;
}

}  // namespace octafield::volume
