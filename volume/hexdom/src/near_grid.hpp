// Points found again by place.
#pragma once

#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "octafield/arrays.hpp"

namespace octafield::volume {

// Points in boxes of one size; those within that size of a place are found.
class NearGrid {
public:
    explicit NearGrid(double size) : size_(size) {}

    void add(Index id, const Eigen::RowVector3d& at) { boxes_[key(box(at))].push_back({id, at}); }

    // Calls see(id, distance) for all points within `radius` <= size, in the order of boxes and of adding.
    template <class See>
    void near(const Eigen::RowVector3d& at, double radius, const See& see) const {
        const auto centre = box(at);
        for (int x = -1; x <= 1; ++x)
            for (int y = -1; y <= 1; ++y)
                for (int z = -1; z <= 1; ++z) {
                    const auto found = boxes_.find(key({centre[0] + x, centre[1] + y, centre[2] + z}));
                    if (found == boxes_.end()) continue;
                    for (const Entry& entry : found->second) {
                        const double distance = (entry.at - at).norm();
                        if (distance <= radius) see(entry.id, distance);
                    }
                }
    }
    bool any(const Eigen::RowVector3d& at, double radius) const {
        bool found = false;
        near(at, radius, [&](Index, double) { found = true; });
        return found;
    }

private:
    using Box = std::array<std::int64_t, 3>;
    struct Entry {
        Index id;
        Eigen::RowVector3d at;
    };
    Box box(const Eigen::RowVector3d& at) const {
        Box result;
        for (int i = 0; i < 3; ++i) result[i] = static_cast<std::int64_t>(std::floor(at[i] / size_));
        return result;
    }
    // 21 bits a coordinate: boxes 2^21 apart share a key, which costs a distance and nothing else.
    static std::uint64_t key(const Box& b) {
        constexpr std::uint64_t mask = (1u << 21) - 1;
        return (std::uint64_t(b[0]) & mask) | (std::uint64_t(b[1]) & mask) << 21 | (std::uint64_t(b[2]) & mask) << 42;
    }

    double size_;
    std::unordered_map<std::uint64_t, std::vector<Entry>> boxes_;
};

// The same for radii from a shortest to a longest, where points are about as dense as the radii there are short: a grid
// for each power of two between.
class NearGrids {
public:
    NearGrids(double shortest, double longest) {
        for (double size = longest;; size /= 2) {
            grids_.emplace_back(size);
            sizes_.push_back(size);
            if (!(size / 2 >= shortest) || grids_.size() == 24) break;
        }
    }
    void add(Index id, const Eigen::RowVector3d& at) {
        for (NearGrid& grid : grids_) grid.add(id, at);
    }
    bool any(const Eigen::RowVector3d& at, double radius) const {
        std::size_t finest = 0;
        while (finest + 1 < sizes_.size() && sizes_[finest + 1] >= radius) ++finest;
        return grids_[finest].any(at, radius);
    }

private:
    std::vector<NearGrid> grids_;
    std::vector<double> sizes_;
};

}  // namespace octafield::volume
