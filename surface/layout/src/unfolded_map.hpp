// Maps of triangles to the plane without folds.
#pragma once

#include "grid_values.hpp"
#include "octafield/progress.hpp"

namespace octafield::surface::detail {

struct MapProblem {
    const GridValues& values;
    // Of each triangle: the inverse of its two edges from corner 0, in the frame that the map is to be a square grid
    // in; and the area there.
    std::vector<Eigen::Matrix2d> to_unit;
    std::vector<double> areas;
};

struct UnfoldedMap {
    Eigen::VectorXd values{};
    int steps = 0;     // of Newton's method
    Index folded = 0;  // triangles that are not mapped with their sense
};

// The least sum over the triangles of ((1 - w) |J|^2 / 2 + w (d^2 + 1) / 2) / chi, J the map's derivative in the
// target's frame, d its determinant, chi = (d + sqrt(d^2 + e^2)) / 2, e falling until no triangle is folded (Garanzha,
// Kaporin, Kudryavtseva, Protais, Ray, Sokolov 2021, "Foldover-free maps in 50 lines of code"); then with e = 0,
// triangles counting by their areas in the map. Newton's method, each triangle's second derivatives made positive: J is
// the sum of a similarity and one that reverses the sense, of lengths p and q, |J|^2 = p^2 + q^2 and d = (p^2 - q^2) /
// 2, so they are four numbers. Stops by counts. Throws Cancelled.
UnfoldedMap unfolded_map(const MapProblem& problem, Eigen::VectorXd start, const Progress& progress = {});

}  // namespace octafield::surface::detail
