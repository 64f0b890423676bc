#include "reordering.hpp"

#include <algorithm>
#include <utility>

namespace octafield::volume {
namespace {

class Search {
public:
    explicit Search(const SparseMatrix& matrix) : matrix_(matrix), seen_(matrix.rows(), 0) {}

    // Appends the component of `first` to `order`, breadth first. Marks visits by `stamp`.
    void append(Index first, int stamp, std::vector<Index>& order) {
        std::size_t next = order.size();
        order.push_back(first);
        seen_[first] = stamp;
        for (; next < order.size(); ++next)
            for (SparseMatrix::InnerIterator entry(matrix_, order[next]); entry; ++entry) {
                const Index other = static_cast<Index>(entry.row());
                if (seen_[other] == stamp) continue;
                seen_[other] = stamp;
                order.push_back(other);
            }
    }
    bool is_seen(Index v) const { return seen_[v] != 0; }

private:
    const SparseMatrix& matrix_;
    std::vector<char> seen_;
};

template <class Matrix>
Matrix reordered_rows(const Matrix& rows, const std::vector<Index>& order) {
    Matrix result(rows.rows(), rows.cols());
    for (std::size_t i = 0; i < order.size(); ++i) result.row(i) = rows.row(order[i]);
    return result;
}

}  // namespace

std::vector<Index> breadth_first_order(const SparseMatrix& matrix) {
    const Index n = static_cast<Index>(matrix.rows());
    Search search(matrix);
    std::vector<Index> order;
    order.reserve(n);
    for (Index v = 0; v < n; ++v) {
        if (search.is_seen(v)) continue;
        const std::size_t begin = order.size();
        search.append(v, 1, order);
        const Index end = order.back();  // as far from v as any: layers from it are thin
        order.resize(begin);
        search.append(end, 2, order);
    }
    return order;
}

std::vector<Index> inverse_order(const std::vector<Index>& order) {
    std::vector<Index> inverse(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) inverse[order[i]] = static_cast<Index>(i);
    return inverse;
}

Sampling reordered(const Sampling& sampling, const std::vector<Index>& order) {
    const std::vector<Index> place = inverse_order(order);
    Sampling result;
    result.sites = sampling.sites;
    result.body_radius = sampling.body_radius;
    result.edge_length = sampling.edge_length;
    result.size = sampling.size;
    result.mass = reordered_rows(sampling.mass, order);
    result.stiffness.resize(sampling.stiffness.rows(), sampling.stiffness.cols());
    result.stiffness.reserve(sampling.stiffness.nonZeros());
    std::vector<std::pair<Index, double>> entries;
    for (std::size_t i = 0; i < order.size(); ++i) {
        entries.clear();
        for (SparseMatrix::InnerIterator entry(sampling.stiffness, order[i]); entry; ++entry)
            entries.emplace_back(place[entry.row()], entry.value());
        std::sort(entries.begin(), entries.end());
        result.stiffness.startVec(i);
        for (const auto& [row, value] : entries) result.stiffness.insertBack(row, i) = value;
    }
    result.stiffness.finalize();
    return result;
}

BoundaryConstraints reordered(const BoundaryConstraints& constraints, const std::vector<Index>& order) {
    BoundaryConstraints result = constraints;
    for (std::size_t i = 0; i < order.size(); ++i) {
        result.kind[i] = constraints.kind[order[i]];
        result.on_boundary[i] = constraints.on_boundary[order[i]];
    }
    result.axis = reordered_rows(constraints.axis, order);
    result.frames = reordered_rows(constraints.frames, order);
    if (constraints.lengths.rows() != 0) result.lengths = reordered_rows(constraints.lengths, order);
    const std::vector<Index> place = inverse_order(order);
    for (Index& corner : result.released_corners) corner = place[corner];
    return result;
}

Quaternions reordered(const Quaternions& frames, const std::vector<Index>& order) {
    return reordered_rows(frames, order);
}

}  // namespace octafield::volume
