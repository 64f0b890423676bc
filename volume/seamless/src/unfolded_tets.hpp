// Maps of tets to space without folds, in unknowns that their corners depend on.
#pragma once

#include <Eigen/LU>
#include <vector>

#include "octafield/progress.hpp"
#include "related_values.hpp"

namespace octafield::volume::detail {

struct TetProblem {
    const RelatedValues::Free& free;
    Tets corners;                          // (m, 4): coordinate i of corner k of a tet is number 3 corners(t, k) + i
    std::vector<Eigen::Matrix3d> to_unit;  // of each tet: the inverse of its three edges from corner 0 in the target
    std::vector<double> volumes;           // there
    int threads = 0;
};

// The three edges of a tet in the map, as columns.
Eigen::Matrix3d mapped_edges(const TetProblem& problem, const Eigen::VectorXd& values, Index tet);

// Unknowns for which the derivatives are nearest to the target's: least sum of volume^(2/3) |J - 1|^2, so that the
// small tets round curves count; with their volumes alone more of them are turned over. Throws SolverError
// ("singular_map").
Eigen::VectorXd nearest_map(const TetProblem& problem);

struct UnfoldedTets {
    Eigen::VectorXd values{};
    int steps = 0;                 // of Newton's method
    std::vector<Index> folded{};   // tets that are not mapped with their sense
    std::vector<Index> crushed{};  // these, and tets with less than a thousandth of the target's volume
};

// The least sum over the tets of |J|^2 / chi^(2/3) + (d^2 + 1) / chi, J the map's derivative in the target's frame, d
// its determinant, chi = (d + sqrt(d^2 + e^2)) / 2, e falling until no tet is folded, then 0 (Garanzha, Kaporin,
// Kudryavtseva, Protais, Ray, Sokolov 2021, "Foldover-free maps in 50 lines of code"). Newton's method, each tet's
// second derivatives made positive. Stops by counts. Throws Cancelled.
UnfoldedTets unfolded_tets(const TetProblem& problem, Eigen::VectorXd start, const Progress& progress = {});

}  // namespace octafield::volume::detail
