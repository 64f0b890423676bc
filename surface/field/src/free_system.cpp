#include "free_system.hpp"

#include <algorithm>

#include "sparse_cholesky.hpp"

namespace octafield::surface::detail {
namespace {

struct Entry {
    Index row;
    Complex value;
};

// Sorts a column by row and adds up the entries of one place; returns their number. Columns have a handful of entries.
Index merged(Entry* first, Entry* last) {
    std::sort(first, last, [](const Entry& a, const Entry& b) { return a.row < b.row; });
    Entry* end = first;
    for (const Entry* entry = first; entry != last; ++entry) {
        if (end != first && (end - 1)->row == entry->row)
            (end - 1)->value += entry->value;
        else
            *end++ = *entry;
    }
    return static_cast<Index>(end - first);
}

}  // namespace

FreeSystem::FreeSystem(const std::vector<CornerLink>& links, const std::vector<bool>& held) {
    std::vector<Index> number(held.size(), -1);
    for (std::size_t e = 0; e < held.size(); ++e) {
        if (held[e]) continue;
        number[e] = size();
        edges_.push_back(static_cast<Index>(e));
    }
    // Columns side by side with room for the diagonal and every link, filled, then each sorted and merged in place.
    std::vector<std::size_t> start(edges_.size() + 1, 0);
    for (std::size_t i = 0; i < edges_.size(); ++i) start[i + 1] = 1;
    const auto couples = [&](const CornerLink& link) { return number[link.first] >= 0 && number[link.second] >= 0; };
    for (const CornerLink& link : links)
        if (couples(link)) ++start[std::min(number[link.first], number[link.second]) + 1];
    for (std::size_t i = 0; i < edges_.size(); ++i) start[i + 1] += start[i];
    std::vector<Entry> entries(start.back());
    std::vector<std::size_t> end(start.begin(), start.end() - 1);
    for (Index i = 0; i < size(); ++i) entries[end[i]++] = {i, 0};
    for (const CornerLink& link : links) {
        const Index i = number[link.first], j = number[link.second];
        if (i >= 0) entries[start[i]].value += link.weight;
        if (j >= 0) entries[start[j]].value += link.weight;
        if (!couples(link)) continue;
        const Complex across = -link.weight * std::conj(link.first_sign) * link.second_turn;
        if (i > j)
            entries[end[j]++] = {i, across};
        else
            entries[end[i]++] = {j, std::conj(across)};
    }

    stiffness_.resize(size(), size());
    int* const columns = stiffness_.outerIndexPtr();
    columns[0] = 0;
    for (Index i = 0; i < size(); ++i)
        columns[i + 1] = columns[i] + merged(entries.data() + start[i], entries.data() + start[i + 1]);
    stiffness_.resizeNonZeros(columns[size()]);
    for (Index i = 0; i < size(); ++i)
        for (int k = columns[i]; k < columns[i + 1]; ++k) {
            stiffness_.innerIndexPtr()[k] = entries[start[i] + (k - columns[i])].row;
            stiffness_.valuePtr()[k] = entries[start[i] + (k - columns[i])].value;
        }
}

Eigen::VectorXd FreeSystem::diagonal() const {
    Eigen::VectorXd diagonal(size());
    for (Index i = 0; i < size(); ++i) diagonal[i] = stiffness_.valuePtr()[stiffness_.outerIndexPtr()[i]].real();
    return diagonal;
}

Eigen::VectorXcd FreeSystem::gather(const Eigen::VectorXcd& values) const { return values(edges_); }
Eigen::VectorXd FreeSystem::gather(const Eigen::VectorXd& values) const { return values(edges_); }

Eigen::VectorXcd FreeSystem::scatter(const Eigen::VectorXcd& unknowns, Eigen::Index edges) const {
    Eigen::VectorXcd values = Eigen::VectorXcd::Zero(edges);
    values(edges_) = unknowns;
    return values;
}

Eigen::VectorXi FreeSystem::elimination_order() const { return SparseCholesky<Complex>::amd_order(stiffness_); }

Eigen::VectorXi FreeSystem::real_order(const Eigen::VectorXi& order) {
    Eigen::VectorXi both(2 * order.size());
    for (Eigen::Index i = 0; i < order.size(); ++i) {
        both[2 * i] = 2 * order[i];
        both[2 * i + 1] = 2 * order[i] + 1;
    }
    return both;
}

FreeSystem::RealMatrix FreeSystem::real_stiffness() const {
    RealMatrix matrix(2 * size(), 2 * size());
    int* const columns = matrix.outerIndexPtr();
    columns[0] = 0;
    for (Index i = 0; i < size(); ++i) {
        const int below = stiffness_.outerIndexPtr()[i + 1] - stiffness_.outerIndexPtr()[i] - 1;
        columns[2 * i + 1] = columns[2 * i] + 2 * below + 2;
        columns[2 * i + 2] = columns[2 * i + 1] + 2 * below + 1;
    }
    matrix.resizeNonZeros(columns[2 * size()]);
    for (Index i = 0; i < size(); ++i) {
        int left = columns[2 * i], right = columns[2 * i + 1];
        const auto put = [&](int& place, Index row, double value) {
            matrix.innerIndexPtr()[place] = row;
            matrix.valuePtr()[place++] = value;
        };
        for (Matrix::InnerIterator entry(stiffness_, i); entry; ++entry) {
            const Index row = static_cast<Index>(entry.row());
            const Complex z = entry.value();
            put(left, 2 * row, z.real());
            put(left, 2 * row + 1, row == i ? 0 : z.imag());
            if (row != i) put(right, 2 * row, -z.imag());
            put(right, 2 * row + 1, z.real());
        }
    }
    return matrix;
}

}  // namespace octafield::surface::detail
