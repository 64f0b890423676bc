// Moves of singular points by one vertex or so: each position of a point between the vertices is a local minimum of its
// own, as for direction fields (core_moves.hpp).
#pragma once

#include <array>
#include <vector>

#include "linked_vertices.hpp"

namespace octafield::surface::detail {

class LineMoves {
public:
    // Keeps the references. is_free (V): vertices whose two lines may change.
    LineMoves(const std::vector<VertexLink>& links, std::vector<bool> is_free, double lambda);

    // Turns the lines of each of these vertices half-way into one another, one vertex after the other, settles the
    // vertices round it and keeps what has less energy. Returns the number of moves kept.
    int improve(const std::vector<Index>& vertices, std::vector<TwoLines>& lines);

private:
    using Coefficients = std::array<Complex, 2>;  // c2 sqrt(lambda), c4

    void grow(Index center);
    double energy(const std::vector<TwoLines>& lines) const;
    Coefficients coefficients(const TwoLines& lines) const;
    void settle(std::vector<TwoLines>& lines);
    void settle_vertex(Index vertex, std::vector<TwoLines>& lines) const;
    bool try_move(Index vertex, std::vector<TwoLines>& lines);

    const std::vector<VertexLink>& links_;
    std::vector<bool> is_free_;
    double root_lambda_;
    std::vector<std::vector<Index>> links_of_;    // (V)
    std::vector<Index> seen_vertex_, seen_link_;  // the number of the patch they were last part of
    Index patches_ = 0;
    std::vector<Index> patch_, patch_links_;  // free vertices by distance from the first; links that touch them
};

}  // namespace octafield::surface::detail
