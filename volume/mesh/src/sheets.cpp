#include "octafield/volume/sheets.hpp"

#include <algorithm>
#include <utility>

#include "boundary_star.hpp"

namespace octafield::volume {

Sheets cut_into_sheets(const surface::TriangleMesh& surface) {
    const BoundaryStars stars(surface, {});
    Sheets sheets;
    sheets.mesh.triangles = surface.triangles;
    for (Index v = 0; v < stars.vertex_count(); ++v) {
        const auto star = stars.triangles(v);
        const std::vector<int> sector = stars.sectors(v);
        std::vector<Index> copy(star.size());
        for (std::size_t i = 0; i < star.size(); ++i) {
            if (sector[i] == static_cast<int>(i)) {
                copy[i] = static_cast<Index>(sheets.vertex_map.size());
                sheets.vertex_map.push_back(v);
            }
            for (int k = 0; k < 3; ++k)
                if (surface.triangles(star[i], k) == v) sheets.mesh.triangles(star[i], k) = copy[sector[i]];
        }
    }
    sheets.mesh.vertices = surface.vertices(sheets.vertex_map, Eigen::all);

    std::vector<std::pair<Index, Index>> sides;
    for (const auto triangle : surface.triangles.rowwise())
        for (int k = 0; k < 3; ++k) sides.push_back(std::minmax({triangle[k], triangle[(k + 1) % 3]}));
    std::sort(sides.begin(), sides.end());
    std::vector<std::pair<Index, Index>> cuts;
    for (std::size_t i = 0, end; i < sides.size(); i = end) {
        end = i + 1;
        while (end < sides.size() && sides[end] == sides[i]) ++end;
        if (end - i > 2) cuts.push_back(sides[i]);
    }
    sheets.cuts.resize(cuts.size(), 2);
    for (std::size_t i = 0; i < cuts.size(); ++i) sheets.cuts.row(i) << cuts[i].first, cuts[i].second;
    return sheets;
}

surface::FeatureGraph features_on_sheets(const surface::FeatureGraph& features, const Sheets& sheets) {
    std::vector<std::pair<Index, Index>> wanted, found;
    for (const auto edge : features.edges.rowwise()) wanted.push_back(std::minmax({edge[0], edge[1]}));
    std::sort(wanted.begin(), wanted.end());
    for (const auto triangle : sheets.mesh.triangles.rowwise())
        for (int k = 0; k < 3; ++k) {
            const Index a = triangle[k], b = triangle[(k + 1) % 3];
            if (std::binary_search(wanted.begin(), wanted.end(),
                                   std::pair<Index, Index>(std::minmax({sheets.vertex_map[a], sheets.vertex_map[b]}))))
                found.push_back(std::minmax({a, b}));
        }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    Edges edges(found.size(), 2);
    for (std::size_t i = 0; i < found.size(); ++i) edges.row(i) << found[i].first, found[i].second;
    return surface::feature_graph(sheets.mesh, edges);
}

}  // namespace octafield::volume
