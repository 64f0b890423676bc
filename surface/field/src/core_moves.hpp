// Moves of singular points by one edge or so. With |f| = 1 each position of a core between the edges is a local minimum
// of its own: the energy of a core depends on the triangles it sits in by more than on where the point is pulled to.
#pragma once

#include <array>
#include <vector>

#include "start_field.hpp"

namespace octafield::surface::detail {

class CoreMoves {
public:
    // Keeps a reference to problem.
    explicit CoreMoves(const Problem& problem);

    // Where the field turns fast, turns one edge by half a turn after the other, settles the edges round it and keeps
    // what has less energy (1/2 int |grad f|^2 + pull, |f| = 1). Returns the number of moves kept; takes time only by
    // the number of singular points once they are found.
    int improve(Eigen::VectorXcd& values);

private:
    struct Patch {
        std::vector<Index> edges;  // free, by distance from the first
        std::vector<Index> links;  // all that touch them, each once
    };

    std::vector<Index> cores(const Eigen::VectorXcd& values) const;
    void grow(Index center);
    Index other(Index link, Index edge) const;
    double energy(const Eigen::VectorXcd& values) const;
    void settle(Eigen::VectorXcd& values) const;
    bool try_move(Index edge, Eigen::VectorXcd& values);

    const Problem& problem_;
    std::vector<std::array<Index, 4>> links_of_;  // by edge; -1
    std::vector<bool> is_free_;
    std::vector<Index> seen_edge_, seen_link_;  // the number of the patch they were last part of
    Index patches_ = 0;
    Patch patch_;
};

}  // namespace octafield::surface::detail
