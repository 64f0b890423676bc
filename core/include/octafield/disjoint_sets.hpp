// Sets of things by number, joined pair by pair.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

#include "octafield/arrays.hpp"

namespace octafield {

class DisjointSets {
public:
    explicit DisjointSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

    void join(Index a, Index b) {
        a = lowest(a);
        b = lowest(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }
    // The lowest member of its set.
    Index lowest(Index a) {
        while (parent_[a] != a) a = parent_[a] = parent_[parent_[a]];
        return a;
    }
    // Number of the set of each member: 0, 1, ... by lowest member. Ends the joining. Returns how many there are in
    // `count`.
    std::vector<Index> numbers(Index& count) && {
        count = 0;
        for (std::size_t a = 0; a < parent_.size(); ++a) {
            const Index up = parent_[a];  // numbered already, unless a is the lowest: parents come first
            parent_[a] = up == static_cast<Index>(a) ? count++ : parent_[up];
        }
        return std::move(parent_);
    }

private:
    std::vector<Index> parent_;  // never above the member
};

}  // namespace octafield
