// Splitting edges, triangles and tets of a tet mesh that join its surface to itself, or singular vertices to one
// another.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "octafield/volume/tet_domain.hpp"

namespace octafield::volume::splitting {

template <int Size>
using Key = std::array<Index, Size>;

// Vertices of a tet that make its edges, triangles and itself.
inline constexpr std::array<std::array<int, 2>, 6> edge_corners{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
inline constexpr std::array<std::array<int, 3>, 4> triangle_corners{{{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}};

template <std::size_t Size>
Key<Size> key_of(const std::array<Index, 4>& tet, const std::array<int, Size>& corners) {
    Key<Size> key;
    for (std::size_t k = 0; k < Size; ++k) key[k] = tet[corners[k]];
    std::sort(key.begin(), key.end());
    return key;
}

template <std::size_t Size>
void sort_unique(std::vector<Key<Size>>& keys) {
    std::sort(keys.begin(), keys.end());
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
}

template <std::size_t Size>
bool contains(const std::vector<Key<Size>>& sorted, const Key<Size>& key) {
    return std::binary_search(sorted.begin(), sorted.end(), key);
}

template <std::size_t Size>
std::int64_t place(const std::vector<Key<Size>>& sorted, const Key<Size>& key) {
    const auto found = std::lower_bound(sorted.begin(), sorted.end(), key);
    return found != sorted.end() && *found == key ? found - sorted.begin() : -1;
}

struct Surface {
    std::vector<std::uint8_t> holds;  // per tet-mesh vertex
    std::vector<Key<2>> edges;
    std::vector<Key<3>> triangles;
};

Surface surface_of(const TetDomain& domain);

struct Found {
    std::vector<Index> tets;
    std::vector<Key<2>> edges;
    std::vector<Key<3>> triangles;
};

using TetList = std::vector<std::array<Index, 4>>;

// Vertices beyond `surface.holds` are new ones, inside.
Found find(const TetList& tets, const Surface& surface);

TetList list_of(const Tets& tets);

template <std::size_t Size>
Rows<Index, static_cast<int>(Size)> rows_of(const std::vector<Key<Size>>& keys) {
    Rows<Index, static_cast<int>(Size)> rows(keys.size(), Size);
    for (std::size_t i = 0; i < keys.size(); ++i)
        for (std::size_t k = 0; k < Size; ++k) rows(i, k) = keys[i][k];
    return rows;
}

// The mesh while it is being split.
class Splitter {
public:
    Splitter(const TetMesh& mesh, Surface surface) : surface_(std::move(surface)), tets_(list_of(mesh.tets)) {
        for (const auto p : mesh.vertices.rowwise()) points_.push_back(p.transpose());
        for (std::size_t t = 0; t < tets_.size(); ++t) parent_.push_back(static_cast<Index>(t));
    }

    Found find() const { return splitting::find(tets_, surface_); }

    // Splits all the given edges, triangles or tets of the present mesh at the mean of their vertices.
    template <std::size_t Size, std::size_t Count>
    void split(const std::vector<Key<Size>>& keys, const std::array<std::array<int, Size>, Count>& parts) {
        std::vector<std::vector<Index>> tets_with(keys.size());
        const auto list = [&](Index t) {
            for (const auto& corners : parts)
                if (const std::int64_t i = place(keys, key_of(tets_[t], corners)); i >= 0) tets_with[i].push_back(t);
        };
        for (std::size_t t = 0; t < tets_.size(); ++t) list(static_cast<Index>(t));
        for (std::size_t i = 0; i < keys.size(); ++i) {
            std::vector<Index>& star = tets_with[i];
            std::sort(star.begin(), star.end());
            star.erase(std::unique(star.begin(), star.end()), star.end());
            // A tet that was split meanwhile may have handed the part on to a child.
            std::erase_if(star, [&](Index t) { return !has(t, keys[i]); });
            split_at_mean(keys[i], star, list);
        }
    }

    TetMesh mesh() const {
        TetMesh mesh{Points(points_.size(), 3), Tets(tets_.size(), 4)};
        for (std::size_t v = 0; v < points_.size(); ++v) mesh.vertices.row(v) = points_[v].transpose();
        for (std::size_t t = 0; t < tets_.size(); ++t)
            for (int k = 0; k < 4; ++k) mesh.tets(t, k) = tets_[t][k];
        return mesh;
    }

    const TetList& tets() const { return tets_; }
    const std::vector<Index>& parent() const { return parent_; }

private:
    template <std::size_t Size>
    bool has(Index t, const Key<Size>& key) const {
        return std::all_of(key.begin(), key.end(),
                           [&](Index v) { return std::find(tets_[t].begin(), tets_[t].end(), v) != tets_[t].end(); });
    }

    double volume(const std::array<Index, 4>& tet) const {
        const Eigen::Vector3d& p = points_[tet[0]];
        return (points_[tet[1]] - p).dot((points_[tet[2]] - p).cross(points_[tet[3]] - p));
    }

    // In every tet of the star, the new point takes the place of each vertex of the key in turn.
    template <std::size_t Size, class List>
    void split_at_mean(const Key<Size>& key, const std::vector<Index>& star, const List& list) {
        Eigen::Vector3d mean = Eigen::Vector3d::Zero();
        for (const Index v : key) mean += points_[v] / double(Size);
        const Index centre = static_cast<Index>(points_.size());
        points_.push_back(mean);
        TetList children;
        for (const Index t : star)
            for (const Index v : key) {
                children.push_back(tets_[t]);
                std::replace(children.back().begin(), children.back().end(), v, centre);
            }
        if (std::any_of(children.begin(), children.end(), [&](const auto& tet) { return !(volume(tet) > 0); })) {
            points_.pop_back();  // rounding would invert a flat tet
            return;
        }
        for (std::size_t c = 0; c < children.size(); ++c) {
            const Index t = star[c / Size];
            if (c % Size == 0) {
                tets_[t] = children[c];
                list(t);
            } else {
                tets_.push_back(children[c]);
                parent_.push_back(parent_[t]);
                list(static_cast<Index>(tets_.size() - 1));
            }
        }
    }

    Surface surface_;
    TetList tets_;
    std::vector<Eigen::Vector3d> points_;
    std::vector<Index> parent_;
};

}  // namespace octafield::volume::splitting
