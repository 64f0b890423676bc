// Least cuts of networks (Dinic 1970).
#pragma once

#include <cstdint>
#include <vector>

#include "octafield/arrays.hpp"

namespace octafield::surface::detail {

class Network {
public:
    explicit Network(Index nodes) : arcs_at_(nodes) {}
    void add(Index a, Index b, std::int64_t capacity);  // both ways
    // Which nodes are on the side of `source` of a cut of the least capacity, that with the fewest of them.
    std::vector<bool> least_cut(Index source, Index sink);

private:
    struct Arc {
        Index to;
        std::int64_t left;
    };
    bool find_levels(Index source, Index sink);
    std::int64_t push(Index source, Index sink);

    std::vector<Arc> arcs_;  // 2 i and 2 i + 1 are opposite
    std::vector<std::vector<Index>> arcs_at_;
    std::vector<Index> level_, next_;
};

}  // namespace octafield::surface::detail
