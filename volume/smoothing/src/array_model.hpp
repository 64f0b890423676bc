// Quadratic models of an ArrayScheme for the trust region, their Hessians in 3 x 3 blocks: exact of an embedding, of
// Gauss and Newton of residuals.
#pragma once

#include <vector>

#include "block_inverse.hpp"
#include "dirichlet_blocks.hpp"
#include "octafield/volume/array_scheme.hpp"

namespace octafield::volume {

// What both share: a symmetric matrix of blocks, one for each pair of sites that are coupled.
class BlockModel {
public:
    static constexpr bool is_sh4 = false;

    const Rows<double, 3>& gradient() const { return gradient_; }
    Tangent precondition(Index v, const Tangent& w) const { return inverses_[v] * w; }
    void turn(Index v, const Tangent& w) { turned_.row(v) = w.transpose(); }
    double hessian_times(const Tangents& w, Tangents& y) const;
    const ConstraintTurns& turns() const { return turns_; }
    double radian() const { return std::sqrt(stiffness_traces_.sum() / 3); }
    double no_gradient() const { return 1e-14 * stiffness_traces_.norm(); }

protected:
    struct Site {  // its diagonal block is stiff + rest
        frames::Matrix3 stiff = frames::Matrix3::Zero(), rest = frames::Matrix3::Zero();
        frames::Vector3 gradient = frames::Vector3::Zero();
    };

    BlockModel(Index sites, const Edges& coupled, const BoundaryConstraints& constraints, int threads);
    void set_block(Index i, Index j, const frames::Matrix3& block) { blocks_[entry(i, j)] = block.cast<float>(); }
    void add_block(Index i, Index j, const frames::Matrix3& block) { blocks_[entry(i, j)] += block.cast<float>(); }
    void clear_blocks() { std::fill(blocks_.begin(), blocks_.end(), Eigen::Matrix3f::Zero()); }
    void set_site(Index v, const Site& site);

    ConstraintTurns turns_;
    const int threads_;

private:
    Index entry(Index i, Index j) const;

    Rows<double, 3> gradient_;
    Eigen::VectorXd stiffness_traces_;
    Tangents turned_;
    std::vector<Index> begin_, column_;  // of the blocks of each site, the diagonal one too, by column
    std::vector<Eigen::Matrix3f> blocks_, inverses_;
};

class ArrayEmbeddingModel : public BlockModel {
public:
    // Refers to the scheme and the sampling.
    ArrayEmbeddingModel(const ArrayScheme& scheme, const Sampling& sampling, const BoundaryConstraints& constraints,
                        int threads);
    double evaluate(const Quaternions& frames);
    void linearise(const Quaternions& frames);  // the field last evaluated

private:
    const ArrayScheme& scheme_;
    const SparseMatrix& matrix_;
    ArrayValues values_;
};

class ArrayResidualModel : public BlockModel {
public:
    ArrayResidualModel(const ArrayScheme& scheme, const Sampling& sampling, const BoundaryConstraints& constraints,
                       int threads)
        : ArrayResidualModel(scheme, sampling.count(), dirichlet_blocks(sampling), constraints, threads) {}
    double evaluate(const Quaternions& frames);
    void linearise(const Quaternions& frames);  // the field last evaluated

private:
    ArrayResidualModel(const ArrayScheme& scheme, Index sites, DirichletBlocks blocks,
                       const BoundaryConstraints& constraints, int threads);

    const ArrayScheme& scheme_;
    const DirichletBlocks blocks_of_energy_;
    const Edges pairs_;
    ArrayValues values_;
};

}  // namespace octafield::volume
