#include "merged_vertices.hpp"

#include <algorithm>
#include <cmath>

#include "octafield/disjoint_sets.hpp"

namespace octafield::surface::detail {
namespace {

// The mean of places on a seam; of a closed one, near the first.
double mean_place(const Seam& seam, const std::vector<Index>& vertices,
                  const std::vector<SideGrids::OnSeam>& on_seams) {
    const double first = on_seams[vertices[0]].at;
    double sum = 0, number = 0;
    for (const Index v : vertices) {
        if (v >= static_cast<Index>(on_seams.size())) break;
        const double off = on_seams[v].at - first;
        sum += seam.closed ? off - seam.length * std::round(off / seam.length) : off;
        number += 1;
    }
    return first + sum / number;
}

}  // namespace

void merge_vertices(const Seams& seams, const std::vector<std::pair<Index, Index>>& same,
                    const std::vector<std::pair<Index, int>>& held, QuadMesh& mesh,
                    std::vector<SideGrids::OnSeam>& on_seams) {
    const auto count = static_cast<Index>(mesh.vertices.rows());
    DisjointSets sets(count);
    for (const auto& [a, b] : same) sets.join(a, b);
    std::vector<std::vector<Index>> members(count);
    for (Index v = 0; v < count; ++v) members[sets.lowest(v)].push_back(v);
    std::vector<bool> is_held(count, false);
    for (const auto& [v, valence] : held) is_held[v] = true;
    std::vector<Index> new_vertex(count, -1);
    std::vector<SideGrids::OnSeam> places;
    Points positions(count, 3);
    Index next = 0;
    for (Index v = 0; v < count; ++v) {
        const std::vector<Index>& all = members[v];
        if (all.empty()) continue;
        Eigen::RowVector3d position = mesh.vertices.row(v);
        if (v < static_cast<Index>(on_seams.size())) {  // nodes have the lowest numbers, then what is on seams
            places.push_back(on_seams[v]);
            if (const Index s = on_seams[v].seam; s >= 0 && all.size() > 1) {
                places.back().at = mean_place(seams.seams[s], all, on_seams);
                position = position_on(seams.seams[s], places.back().at).transpose();
            }
        } else if (const auto at = std::find_if(all.begin(), all.end(), [&](Index m) { return is_held[m]; });
                   at != all.end()) {
            position = mesh.vertices.row(*at);
        } else {
            position.setZero();
            for (const Index m : all) position += mesh.vertices.row(m) / static_cast<double>(all.size());
        }
        for (const Index m : all) new_vertex[m] = next;
        positions.row(next++) = position;
    }
    mesh.vertices = positions.topRows(next);
    for (Index q = 0; q < mesh.quads.rows(); ++q)
        for (int k = 0; k < 4; ++k) mesh.quads(q, k) = new_vertex[mesh.quads(q, k)];
    on_seams = std::move(places);
}

bool is_as_expected(const Quads& quads, const std::vector<std::pair<Index, Index>>& same,
                    const std::vector<std::pair<Index, int>>& held, Index nodes, Index vertex_count) {
    DisjointSets sets(vertex_count);
    for (const auto& [a, b] : same) sets.join(a, b);
    std::vector<std::pair<Index, Index>> edges;
    std::vector<int> valences(vertex_count, 0);
    for (Index q = 0; q < quads.rows(); ++q) {
        std::array<Index, 4> v;
        for (int k = 0; k < 4; ++k) v[k] = sets.lowest(quads(q, k));
        if (v[0] == v[2] || v[1] == v[3]) return false;
        for (int k = 0; k < 4; ++k) {
            edges.emplace_back(std::minmax(v[k], v[(k + 1) % 4]));
            ++valences[v[k]];
        }
    }
    std::sort(edges.begin(), edges.end());
    std::vector<bool> on_boundary(vertex_count, false);
    for (std::size_t i = 0, next; i < edges.size(); i = next) {
        const auto [a, b] = edges[i];
        for (next = i; next < edges.size() && edges[next] == edges[i];) ++next;
        if (next - i > 2 || a == b) return false;
        if (next - i == 1) on_boundary[a] = on_boundary[b] = true;
    }
    for (const auto& [v, valence] : held) {
        if (valences[sets.lowest(v)] != valence) return false;
        valences[sets.lowest(v)] = 0;  // done
    }
    for (Index v = nodes; v < vertex_count; ++v)
        if (valences[v] != 0 && sets.lowest(v) >= nodes && valences[v] != (on_boundary[v] ? 2 : 4)) return false;
    return true;
}

}  // namespace octafield::surface::detail
