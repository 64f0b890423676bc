#include "dirichlet_blocks.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace octafield::volume {
namespace {

constexpr int corner_pairs[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

using Gradient = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;

Gradient scaled_gradient(const TetMesh& mesh, Index tet) {
    Eigen::Matrix3d edges;  // rows p_k - p_0
    const Eigen::RowVector3d origin = mesh.vertices.row(mesh.tets(tet, 0));
    for (int k = 0; k < 3; ++k) edges.row(k) = mesh.vertices.row(mesh.tets(tet, k + 1)) - origin;
    const double volume = std::abs(edges.determinant()) / 6;
    const Eigen::Matrix3d inverse = edges.inverse();  // columns: gradients of the hat functions 1, 2, 3
    Gradient g;
    g.rightCols<3>() = inverse;
    g.col(0) = -inverse.rowwise().sum();
    return std::sqrt(volume) * g;
}

struct TetEdge {
    Index i, j, tet;
    int pair;
};

// The edges of all tets, sorted by (i, j, tet): runs of equal (i, j) are one mesh edge.
std::vector<TetEdge> sorted_tet_edges(const TetMesh& mesh) {
    std::vector<TetEdge> list;
    list.reserve(6 * mesh.tets.rows());
    for (Index t = 0; t < mesh.tets.rows(); ++t)
        for (int pair = 0; pair < 6; ++pair) {
            const auto [i, j] = std::minmax(mesh.tets(t, corner_pairs[pair][0]), mesh.tets(t, corner_pairs[pair][1]));
            list.push_back({i, j, t, pair});
        }
    std::sort(list.begin(), list.end(),
              [](const TetEdge& a, const TetEdge& b) { return std::tie(a.i, a.j, a.tet) < std::tie(b.i, b.j, b.tet); });
    return list;
}

}  // namespace

DirichletBlocks dirichlet_blocks(const TetMesh& mesh) {
    const Index tet_count = static_cast<Index>(mesh.tets.rows());
    std::vector<Gradient> gradients(tet_count);
    Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor> weights(tet_count, 6);  // -K_ij of each tet
    for (Index t = 0; t < tet_count; ++t) {
        gradients[t] = scaled_gradient(mesh, t);
        const Eigen::Matrix4d k = gradients[t].transpose() * gradients[t];
        for (int pair = 0; pair < 6; ++pair) weights(t, pair) = -k(corner_pairs[pair][0], corner_pairs[pair][1]);
    }

    const std::vector<TetEdge> tet_edges = sorted_tet_edges(mesh);
    std::vector<std::size_t> first;  // start of each mesh edge's run
    Eigen::Matrix<Index, Eigen::Dynamic, 6, Eigen::RowMajor> edge_of(tet_count, 6);
    for (std::size_t k = 0; k < tet_edges.size(); ++k) {
        if (k == 0 || tet_edges[k].i != tet_edges[k - 1].i || tet_edges[k].j != tet_edges[k - 1].j) first.push_back(k);
        edge_of(tet_edges[k].tet, tet_edges[k].pair) = static_cast<Index>(first.size() - 1);
    }
    first.push_back(tet_edges.size());

    const Index edge_count = static_cast<Index>(first.size() - 1);
    std::vector<double> total(edge_count, 0.0);
    for (Index t = 0; t < tet_count; ++t)
        for (int pair = 0; pair < 6; ++pair) total[edge_of(t, pair)] += weights(t, pair);

    // Keep whole the most obtuse tets round each negative edge until what is left is not negative. Keeping a tet whole
    // takes its positive weights from its other edges, which may turn negative in turn: every tet is kept at most once,
    // so this ends.
    std::vector<char> whole(tet_count, 0);
    std::vector<Index> pending(edge_count);
    std::iota(pending.rbegin(), pending.rend(), 0);
    while (!pending.empty()) {
        const Index edge = pending.back();
        pending.pop_back();
        while (total[edge] < 0) {
            Index worst = -1;
            double least = 0;
            for (std::size_t k = first[edge]; k < first[edge + 1]; ++k) {
                const TetEdge& te = tet_edges[k];
                if (!whole[te.tet] && weights(te.tet, te.pair) < least)
                    least = weights(te.tet, te.pair), worst = te.tet;
            }
            if (worst < 0) {
                total[edge] = 0;  // only rounding is left
                break;
            }
            whole[worst] = 1;
            for (int pair = 0; pair < 6; ++pair) {
                total[edge_of(worst, pair)] -= weights(worst, pair);
                if (total[edge_of(worst, pair)] < 0) pending.push_back(edge_of(worst, pair));
            }
        }
    }

    DirichletBlocks blocks;
    for (Index edge = 0; edge < edge_count; ++edge) {
        const TetEdge& te = tet_edges[first[edge]];
        double weight = 0;  // summed again, so that what was subtracted leaves no rounding behind
        for (std::size_t k = first[edge]; k < first[edge + 1]; ++k)
            if (!whole[tet_edges[k].tet]) weight += weights(tet_edges[k].tet, tet_edges[k].pair);
        if (weight > 0) blocks.edges.push_back({te.i, te.j, weight});
    }
    for (Index t = 0; t < tet_count; ++t)
        if (whole[t])
            blocks.tets.push_back({{mesh.tets(t, 0), mesh.tets(t, 1), mesh.tets(t, 2), mesh.tets(t, 3)}, gradients[t]});
    return blocks;
}

DirichletBlocks dirichlet_blocks(const Sampling& sampling) {
    if (sampling.elements) return dirichlet_blocks(*sampling.elements);
    DirichletBlocks blocks;
    for (Index i = 0; i < sampling.count(); ++i)
        for (SparseMatrix::InnerIterator entry(sampling.stiffness, i); entry; ++entry)
            if (entry.row() > i && entry.value() < 0)
                blocks.edges.push_back({i, static_cast<Index>(entry.row()), -entry.value()});
    return blocks;
}

}  // namespace octafield::volume
