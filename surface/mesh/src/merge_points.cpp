#include "merge_points.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <unordered_map>

namespace octafield::surface {
namespace {

using Key = std::array<std::uint64_t, 3>;

Key key_of(const Points& points, Index i) {
    Key key;
    for (int k = 0; k < 3; ++k) key[k] = std::bit_cast<std::uint64_t>(points(i, k) + 0.0);  // -0.0 + 0.0 is 0.0
    return key;
}

struct KeyHash {
    std::size_t operator()(const Key& key) const {
        std::uint64_t hash = 0;
        for (const std::uint64_t word : key) {  // the mixing steps of splitmix64
            hash += word + 0x9e3779b97f4a7c15;
            hash = (hash ^ (hash >> 30)) * 0xbf58476d1ce4e5b9;
            hash = (hash ^ (hash >> 27)) * 0x94d049bb133111eb;
            hash ^= hash >> 31;
        }
        return hash;
    }
};

}  // namespace

std::vector<Index> first_equal_points(const Points& points) {
    std::vector<Index> first(points.rows());
    std::unordered_map<Key, Index, KeyHash> seen;
    seen.reserve(points.rows());
    for (Index i = 0; i < points.rows(); ++i) first[i] = seen.try_emplace(key_of(points, i), i).first->second;
    return first;
}

TriangleMesh merge_equal_points(const TriangleMesh& mesh) {
    const std::vector<Index> first = first_equal_points(mesh.vertices);
    std::vector<Index> new_id(first.size());
    TriangleMesh merged;
    merged.vertices.resize(mesh.vertices.rows(), 3);
    Index kept = 0;
    for (Index i = 0; i < mesh.vertices.rows(); ++i)
        if (first[i] == i) {
            merged.vertices.row(kept) = mesh.vertices.row(i);
            new_id[i] = kept++;
        }
    merged.vertices.conservativeResize(kept, 3);
    merged.triangles = mesh.triangles.unaryExpr([&](Index v) { return new_id[first[v]]; });
    return merged;
}

}  // namespace octafield::surface
