#include <algorithm>
#include <array>
#include <deque>
#include <utility>

#include "octafield/frames/octahedral_group.hpp"
#include "octafield/parallel.hpp"
#include "octafield/volume/combing.hpp"
#include "require_frames.hpp"

namespace octafield::volume {
namespace {

using frames::octahedral_inverse;
using frames::octahedral_product;

constexpr int most_sweeps = 100;  // each but the last lessens the edges that disagree

// The vertices next to each, ascending, and the matching to them: q_v o is close to q_w.
struct Neighbours {
    std::vector<std::size_t> begin;
    std::vector<Index> vertex;
    std::vector<std::uint8_t> matching;

    Neighbours(const TetMesh& mesh, const Quaternions& rows, int threads) : begin(rows.rows() + 1, 0) {
        std::vector<std::pair<Index, Index>> pairs;
        pairs.reserve(12 * mesh.tets.rows());
        for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t)
            for (int i = 0; i < 4; ++i)
                for (int j = 0; j < 4; ++j)
                    if (i != j) pairs.emplace_back(mesh.tets(t, i), mesh.tets(t, j));
        std::sort(pairs.begin(), pairs.end());
        pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
        vertex.resize(pairs.size());
        matching.resize(pairs.size());
        for (const auto& [v, w] : pairs) ++begin[v + 1];
        for (std::size_t v = 1; v < begin.size(); ++v) begin[v] += begin[v - 1];
        // Matched from the lower to the higher vertex, as in singular_graph, so that all agree also in a tie.
        parallel_for(static_cast<std::int64_t>(pairs.size()), threads, [&](std::int64_t k) {
            const auto [v, w] = pairs[k];
            const frames::Quaternion a = frames::from_wxyz(rows.row(std::min(v, w)));
            const frames::Quaternion b = frames::from_wxyz(rows.row(std::max(v, w)));
            const int element = frames::matching(a, b);
            vertex[k] = w;
            matching[k] = static_cast<std::uint8_t>(v < w ? element : octahedral_inverse(element));
        });
    }
};

// Breadth first from the lowest vertex that is not reached yet: visit(parent, child, place of the edge) where
// enters(parent, child, place) lets it. Returns the number of parts.
template <class Enters, class Visit>
Index breadth_first(const Neighbours& near, const Enters& enters, const Visit& visit) {
    std::vector<std::uint8_t> reached(near.begin.size() - 1, 0);
    std::deque<Index> queue;
    Index parts = 0;
    for (Index root = 0; root < static_cast<Index>(reached.size()); ++root) {
        if (reached[root]) continue;
        ++parts;
        reached[root] = 1;
        for (queue.push_back(root); !queue.empty(); queue.pop_front()) {
            const Index parent = queue.front();
            for (std::size_t k = near.begin[parent]; k < near.begin[parent + 1]; ++k) {
                const Index child = near.vertex[k];
                if (reached[child] || !enters(parent, child, k)) continue;
                reached[child] = 1;
                visit(parent, child, k);
                queue.push_back(child);
            }
        }
    }
    return parts;
}

// What the neighbour asks of v, so that q_v e_v and q_w e_w agree.
int wanted(const Neighbours& near, std::size_t place, const std::vector<std::uint8_t>& element) {
    return octahedral_product(near.matching[place], element[near.vertex[place]]);
}

// Vertex by vertex, the representative that most neighbours agree with: shortens the cut that the tree leaves.
void shorten_cut(const Neighbours& near, std::vector<std::uint8_t>& element) {
    bool changed = true;
    for (int sweep = 0; sweep < most_sweeps && changed; ++sweep) {
        changed = false;
        for (std::size_t v = 0; v < element.size(); ++v) {
            std::array<int, frames::octahedral_order> votes{};
            for (std::size_t k = near.begin[v]; k < near.begin[v + 1]; ++k) ++votes[wanted(near, k, element)];
            const auto best = std::max_element(votes.begin(), votes.end());
            if (*best <= votes[element[v]]) continue;
            element[v] = static_cast<std::uint8_t>(best - votes.begin());
            changed = true;
        }
    }
}

}  // namespace

CombedVertices comb_vertices(const TetDomain& domain, const Quaternions& of_vertices, int threads) {
    const TetMesh& mesh = domain.mesh();
    require_frames(of_vertices, mesh.vertices.rows());
    const Neighbours near(mesh, of_vertices, threads);
    CombedVertices result{of_vertices, std::vector<std::uint8_t>(of_vertices.rows(), 0), {}, 0};
    auto& element = result.element;
    result.parts = breadth_first(
        near, [](Index, Index, std::size_t) { return true; },
        [&](Index parent, Index child, std::size_t k) {
            element[child] =
                static_cast<std::uint8_t>(octahedral_product(octahedral_inverse(near.matching[k]), element[parent]));
        });
    shorten_cut(near, element);
    for (Eigen::Index v = 0; v < of_vertices.rows(); ++v)
        if (element[v] != 0)  // else all bits stay
            result.frames.row(v) =
                frames::to_wxyz(frames::from_wxyz(of_vertices.row(v)) * frames::octahedral_group()[element[v]])
                    .transpose();
    breadth_first(
        near, [&](Index parent, Index, std::size_t k) { return wanted(near, k, element) == element[parent]; },
        [&](Index parent, Index child, std::size_t) {
            if (result.frames.row(child).dot(result.frames.row(parent)) < 0) result.frames.row(child) *= -1;
        });
    result.agree = axes_agree(domain, result.frames, threads);
    return result;
}

std::vector<std::uint8_t> axes_agree(const TetDomain& domain, const Quaternions& of_vertices, int threads) {
    const TetMesh& mesh = domain.mesh();
    require_frames(of_vertices, mesh.vertices.rows());
    std::vector<std::uint8_t> agree(mesh.tets.rows());
    parallel_for(mesh.tets.rows(), threads, [&](std::int64_t t) {
        bool all = true;
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < i && all; ++j)
                all = frames::matching(frames::from_wxyz(of_vertices.row(mesh.tets(t, i))),
                                       frames::from_wxyz(of_vertices.row(mesh.tets(t, j)))) == 0;
        agree[t] = all;
    });
    return agree;
}

}  // namespace octafield::volume
