// The Dirichlet energy of a field as a sum of squares, for least-squares solvers.
#pragma once

#include <array>
#include <vector>

#include "octafield/volume/sampling.hpp"

namespace octafield::volume {

// 1/2 sum_c a_c^T L a_c = 1/2 sum over edges of w |a_i - a_j|^2 + 1/2 sum over tets of |G [a_0 a_1 a_2 a_3]^T|^2.
// Edges alone would do if every cotangent weight were positive; where obtuse tets make an edge's weight negative, some
// of its tets are kept whole (their gradient, three rows), so that the energy and its Gauss-Newton matrix are exactly
// those of L.
struct DirichletBlocks {
    struct Edge {
        Index i, j;
        double weight;  // > 0
    };
    struct Tet {
        std::array<Index, 4> vertices;
        Eigen::Matrix<double, 3, 4, Eigen::RowMajor>
            gradient;  // G: square root of the volume times the gradients of the hat functions
    };
    std::vector<Edge> edges;
    std::vector<Tet> tets;
};

DirichletBlocks dirichlet_blocks(const TetMesh& mesh);  // of linear elements
DirichletBlocks dirichlet_blocks(const Sampling& sampling);

}  // namespace octafield::volume
