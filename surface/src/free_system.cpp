#include "free_system.hpp"

#include "sparse_cholesky.hpp"

namespace octafield::surface::detail {

FreeSystem::FreeSystem(const std::vector<CornerLink>& links, const std::vector<bool>& held) {
    std::vector<Index> number(held.size(), -1);
    for (std::size_t e = 0; e < held.size(); ++e) {
        if (held[e]) continue;
        number[e] = size();
        edges_.push_back(static_cast<Index>(e));
    }
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(10 * links.size());
    // Real form of the complex entry z at (row, column), row >= column.
    const auto add = [&](Index row, Index column, Complex z) {
        entries.emplace_back(2 * row, 2 * column, z.real());
        entries.emplace_back(2 * row + 1, 2 * column, z.imag());
        entries.emplace_back(2 * row + 1, 2 * column + 1, z.real());
        if (row != column) entries.emplace_back(2 * row, 2 * column + 1, -z.imag());
    };
    for (const CornerLink& link : links) {
        const Index i = number[link.first], j = number[link.second];
        if (i >= 0) add(i, i, link.weight);
        if (j >= 0) add(j, j, link.weight);
        if (i < 0 || j < 0) continue;
        const Complex across = -link.weight * std::conj(link.first_sign) * link.second_turn;
        if (i > j) {
            add(i, j, across);
        } else {
            add(j, i, std::conj(across));
        }
    }
    stiffness_.resize(2 * size(), 2 * size());
    stiffness_.setFromTriplets(entries.begin(), entries.end());
}

Eigen::VectorXd FreeSystem::gather(const Eigen::VectorXcd& values) const {
    Eigen::VectorXd unknowns(2 * size());
    for (Index i = 0; i < size(); ++i) {
        unknowns[2 * i] = values[edges_[i]].real();
        unknowns[2 * i + 1] = values[edges_[i]].imag();
    }
    return unknowns;
}

Eigen::VectorXcd FreeSystem::scatter(const Eigen::VectorXd& unknowns, Eigen::Index edges) const {
    Eigen::VectorXcd values = Eigen::VectorXcd::Zero(edges);
    for (Index i = 0; i < size(); ++i) values[edges_[i]] = Complex(unknowns[2 * i], unknowns[2 * i + 1]);
    return values;
}

Eigen::VectorXi FreeSystem::elimination_order() const {
    // AMD on the graph of the edges: a quarter of the entries, and the same result on every run and thread.
    Eigen::SparseMatrix<double> graph(size(), size());
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(stiffness_.nonZeros() / 3);
    for (Index i = 0; i < size(); ++i)
        for (Matrix::InnerIterator entry(stiffness_, 2 * i); entry; ++entry)
            if (entry.row() % 2 == 0) entries.emplace_back(entry.row() / 2, i, 1);
    graph.setFromTriplets(entries.begin(), entries.end());
    const Eigen::VectorXi edges = amd_order(graph);
    Eigen::VectorXi order(2 * size());
    for (Index i = 0; i < size(); ++i) {
        order[2 * i] = 2 * edges[i];
        order[2 * i + 1] = 2 * edges[i] + 1;
    }
    return order;
}

}  // namespace octafield::surface::detail
