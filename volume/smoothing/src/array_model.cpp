#include "array_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "array_functions.hpp"
#include "block_laplacian.hpp"

namespace octafield::volume {
namespace {

using frames::Matrix3;
using frames::Vector3;

Edges edges_of(const SparseMatrix& matrix) {
    Edges edges(matrix.nonZeros() / 2, 2);
    Index count = 0;
    for (Index i = 0; i < matrix.cols(); ++i)
        for (SparseMatrix::InnerIterator entry(matrix, i); entry; ++entry)
            if (entry.row() > i) edges.row(count++) << i, static_cast<Index>(entry.row());
    edges.conservativeResize(count, 2);
    return edges;
}

// Edges, then three for each tet, from its first vertex.
Edges pairs_of(const DirichletBlocks& blocks) {
    Edges pairs(blocks.edges.size() + 3 * blocks.tets.size(), 2);
    Index count = 0;
    for (const auto& edge : blocks.edges) pairs.row(count++) << edge.i, edge.j;
    for (const auto& tet : blocks.tets)
        for (int k = 1; k < 4; ++k) pairs.row(count++) << tet.vertices[0], tet.vertices[k];
    return pairs;
}

// All pairs of sites that a block couples.
Edges coupled_by(const DirichletBlocks& blocks) {
    Edges pairs(blocks.edges.size() + 6 * blocks.tets.size(), 2);
    Index count = 0;
    for (const auto& edge : blocks.edges) pairs.row(count++) << edge.i, edge.j;
    for (const auto& tet : blocks.tets)
        for (int k = 1; k < 4; ++k)
            for (int l = 0; l < k; ++l) pairs.row(count++) << tet.vertices[k], tet.vertices[l];
    return pairs;
}

// use(first pair, weights) of each block: its energy is 1/2 sum over its pairs a, b of weights(a, b) d_a . d_b.
template <class Use>
void for_each_block(const DirichletBlocks& blocks, const Use& use) {
    Index pair = 0;
    for (const auto& edge : blocks.edges) use(pair++, Eigen::Matrix<double, 1, 1>::Constant(edge.weight));
    for (const auto& tet : blocks.tets) {
        use(pair, Matrix3(tet.gradient.rightCols<3>().transpose() * tet.gradient.rightCols<3>()));
        pair += 3;
    }
}

Quaternions ends(const Quaternions& frames, const Edges& pairs, int column) {
    return frames(pairs.col(column), Eigen::all);
}

double energy_of(const DirichletBlocks& blocks, const ArrayValues& values) {
    double energy = 0;
    for_each_block(blocks, [&](Index first, const auto& weights) {
        const auto own = values.middleRows(first, weights.rows());
        energy += weights.cwiseProduct(own * own.transpose()).sum() / 2;
    });
    return energy;
}

double energy_of(const SparseMatrix& matrix, const ArrayValues& values, int threads) {
    return block_sum(matrix.cols(), threads, [&](std::int64_t first, std::int64_t last) {
        double sum = 0;
        for (auto i = static_cast<Index>(first); i < last; ++i)
            for (SparseMatrix::InnerIterator entry(matrix, i); entry; ++entry)
                if (entry.row() > i) sum -= entry.value() / 2 * (values.row(i) - values.row(entry.row())).squaredNorm();
        return sum;
    });
}

}  // namespace

double array_energy(const ArrayScheme& scheme, const Sampling& sampling, const Quaternions& frames, int threads) {
    if (scheme.embed) return energy_of(sampling.stiffness, embedded(scheme, frames), threads);
    const DirichletBlocks blocks = dirichlet_blocks(sampling);
    const Edges pairs = pairs_of(blocks);
    return energy_of(blocks, residuals(scheme, ends(frames, pairs, 0), ends(frames, pairs, 1)));
}

BlockModel::BlockModel(Index sites, const Edges& coupled, const BoundaryConstraints& constraints, int threads)
    : turns_(constraints), threads_(threads), begin_(sites + 1), inverses_(sites) {
    std::vector<std::array<Index, 2>> entries;
    entries.reserve(sites + 2 * coupled.rows());
    for (Index v = 0; v < sites; ++v) entries.push_back({v, v});
    for (Index e = 0; e < coupled.rows(); ++e)
        for (const int k : {0, 1}) entries.push_back({coupled(e, k), coupled(e, 1 - k)});
    std::sort(entries.begin(), entries.end());
    entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
    for (const auto& [i, j] : entries) {
        ++begin_[i + 1];
        column_.push_back(j);
    }
    for (Index v = 0; v < sites; ++v) begin_[v + 1] += begin_[v];
    blocks_.assign(column_.size(), Eigen::Matrix3f::Zero());
    gradient_.setZero(sites, 3);
    turned_.setZero(sites, 3);
    stiffness_traces_.setZero(sites);
}

Index BlockModel::entry(Index i, Index j) const {
    const auto first = column_.begin();
    return static_cast<Index>(std::lower_bound(first + begin_[i], first + begin_[i + 1], j) - first);
}

void BlockModel::set_site(Index v, const Site& site) {
    gradient_.row(v) = turns_.allowed<double>(v, site.gradient).transpose();
    set_block(v, v, site.stiff + site.rest);
    inverses_[v] = inverse_of_block(turns_, v, site.stiff, site.rest).cast<float>();
    stiffness_traces_[v] = site.stiff.trace();
}

double BlockModel::hessian_times(const Tangents& w, Tangents& y) const {
    return block_sum(w.rows(), threads_, [&](std::int64_t first, std::int64_t last) {
        double sum = 0;
        for (auto v = static_cast<Index>(first); v < last; ++v) {
            Tangent product = Tangent::Zero();
            for (Index k = begin_[v]; k < begin_[v + 1]; ++k)
                product += blocks_[k] * turned_.row(column_[k]).transpose();
            const Tangent image = turns_.allowed<float>(v, product);
            y.row(v) = image.transpose();
            sum += image.dot(w.row(v).transpose());
        }
        return sum;
    });
}

ArrayEmbeddingModel::ArrayEmbeddingModel(const ArrayScheme& scheme, const Sampling& sampling,
                                         const BoundaryConstraints& constraints, int threads)
    : BlockModel(sampling.count(), edges_of(sampling.stiffness), constraints, threads),
      scheme_(scheme),
      matrix_(sampling.stiffness) {}

double ArrayEmbeddingModel::evaluate(const Quaternions& frames) {
    values_ = embedded(scheme_, frames);
    return energy_of(matrix_, values_, threads_);
}

void ArrayEmbeddingModel::linearise(const Quaternions& frames) {
    turns_.move_to(frames, threads_);
    ArrayValues images = ArrayValues::Zero(values_.rows(), scheme_.dimension);
    parallel_for(matrix_.cols(), threads_, [&](std::int64_t i) {
        for (SparseMatrix::InnerIterator entry(matrix_, static_cast<Index>(i)); entry; ++entry)
            images.row(i) += entry.value() * (values_.row(entry.row()) - values_.row(i));
    });
    const EmbeddingDerivatives found = derivatives(scheme_, frames, values_, images, threads_);
    const auto differential = [&](std::int64_t v) {
        return Eigen::Map<const Rows<double, 3>>(found.differentials.row(v).data(), scheme_.dimension, 3);
    };
    parallel_for(matrix_.cols(), threads_, [&](std::int64_t v) {
        const auto own = differential(v);
        Site site;
        site.gradient = own.transpose() * images.row(v).transpose();
        site.rest = found.curvatures[v];
        const auto i = static_cast<Index>(v);
        for (SparseMatrix::InnerIterator entry(matrix_, i); entry; ++entry) {
            const auto j = static_cast<Index>(entry.row());
            const Matrix3 block = entry.value() * (own.transpose() * differential(j));
            if (i == j)
                site.stiff = block;
            else
                set_block(i, j, block);
        }
        set_site(i, site);
    });
}

ArrayResidualModel::ArrayResidualModel(const ArrayScheme& scheme, Index sites, DirichletBlocks blocks,
                                       const BoundaryConstraints& constraints, int threads)
    : BlockModel(sites, coupled_by(blocks), constraints, threads),
      scheme_(scheme),
      blocks_of_energy_(std::move(blocks)),
      pairs_(pairs_of(blocks_of_energy_)) {}

double ArrayResidualModel::evaluate(const Quaternions& frames) {
    values_ = residuals(scheme_, ends(frames, pairs_, 0), ends(frames, pairs_, 1));
    return energy_of(blocks_of_energy_, values_);
}

void ArrayResidualModel::linearise(const Quaternions& frames) {
    turns_.move_to(frames, threads_);
    const ArrayValues all = residual_differentials(scheme_, ends(frames, pairs_, 0), ends(frames, pairs_, 1), threads_);
    const auto derivative = [&](Index pair, int end) {
        return Eigen::Map<const Rows<double, 6>>(all.row(pair).data(), scheme_.dimension, 6).middleCols<3>(3 * end);
    };
    std::vector<Site> sites(frames.rows());
    clear_blocks();
    for_each_block(blocks_of_energy_, [&](Index first, const auto& weights) {
        const ArrayValues weighted = weights * values_.middleRows(first, weights.rows());
        for (Index a = 0; a < weights.rows(); ++a)
            for (const int end : {0, 1}) {
                const Index i = pairs_(first + a, end);
                const auto own = derivative(first + a, end);
                sites[i].gradient += own.transpose() * weighted.row(a).transpose();
                for (Index b = 0; b < weights.rows(); ++b)
                    for (const int other : {0, 1}) {
                        const Index j = pairs_(first + b, other);
                        const Matrix3 block = weights(a, b) * (own.transpose() * derivative(first + b, other));
                        if (i == j)
                            sites[i].stiff += block;
                        else
                            add_block(i, j, block);
                    }
            }
    });
    for (Index v = 0; v < frames.rows(); ++v) set_site(v, sites[v]);
}

}  // namespace octafield::volume
