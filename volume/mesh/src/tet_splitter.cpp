#include "tet_splitter.hpp"

#include <utility>

namespace octafield::volume::splitting {

Surface surface_of(const TetDomain& domain) {
    Surface result;
    result.holds.assign(domain.vertex_count(), 0);
    for (const Index row : domain.surface_rows()) {
        const auto ids = domain.triangles().triangles.row(row);
        for (const Index v : ids) result.holds[v] = 1;
        result.triangles.push_back({ids[0], ids[1], ids[2]});
        for (const auto& [a, b] : {std::pair(0, 1), std::pair(0, 2), std::pair(1, 2)})
            result.edges.push_back({ids[a], ids[b]});
    }
    sort_unique(result.edges);
    sort_unique(result.triangles);
    return result;
}

// Vertices beyond `surface.holds` are new ones, inside.
Found find(const TetList& tets, const Surface& surface) {
    Found found;
    const auto held = [&](Index v) { return v < static_cast<Index>(surface.holds.size()) && surface.holds[v]; };
    for (std::size_t t = 0; t < tets.size(); ++t) {
        const auto& tet = tets[t];
        const int count = static_cast<int>(std::count_if(tet.begin(), tet.end(), held));
        if (count < 2) continue;
        if (count == 4) found.tets.push_back(static_cast<Index>(t));
        for (const auto& corners : edge_corners) {
            const Key<2> key = key_of(tet, corners);
            if (held(key[0]) && held(key[1]) && !contains(surface.edges, key)) found.edges.push_back(key);
        }
        if (count < 3) continue;
        for (const auto& corners : triangle_corners) {
            const Key<3> key = key_of(tet, corners);
            const bool edges_on_surface = contains(surface.edges, {key[0], key[1]}) &&
                                          contains(surface.edges, {key[0], key[2]}) &&
                                          contains(surface.edges, {key[1], key[2]});
            if (edges_on_surface && !contains(surface.triangles, key)) found.triangles.push_back(key);
        }
    }
    sort_unique(found.edges);
    sort_unique(found.triangles);
    return found;
}

TetList list_of(const Tets& tets) {
    TetList list(tets.rows());
    for (Eigen::Index t = 0; t < tets.rows(); ++t) list[t] = {tets(t, 0), tets(t, 1), tets(t, 2), tets(t, 3)};
    return list;
}

}  // namespace octafield::volume::splitting
