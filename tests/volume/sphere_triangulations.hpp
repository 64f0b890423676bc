// All triangulations of the sphere with few corners, by flips of edges: any two with the same number of corners are
// joined by flips (Wagner 1936). Numbers of them: OEIS A000109.
#pragma once

#include <algorithm>
#include <array>
#include <set>
#include <vector>

namespace octafield::volume::testing {

class SphereTriangulation {
public:
    // A tetrahedron, then corner after corner in one of the triangles.
    explicit SphereTriangulation(int corners) : n_(corners), left_(corners, std::vector<int>(corners, -1)) {
        for (const auto& [a, b, c] : {std::array{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}) set(a, b, c);
        for (int v = 4; v < corners; ++v) {
            const int a = 0, b = 1, c = left_[0][1];
            set(a, b, v), set(b, c, v), set(c, a, v);
        }
    }

    std::vector<int> degrees() const {
        std::vector<int> degrees;
        for (const auto& row : left_)
            degrees.push_back(static_cast<int>(std::count_if(row.begin(), row.end(), [](int v) { return v >= 0; })));
        return degrees;
    }

    // Those that differ by one edge.
    std::vector<SphereTriangulation> flips() const {
        std::vector<SphereTriangulation> result;
        for (int u = 0; u < n_; ++u)
            for (int v = u + 1; v < n_; ++v) {
                if (left_[u][v] < 0) continue;
                const int a = left_[u][v], b = left_[v][u];
                if (left_[a][b] >= 0) continue;  // already joined
                result.push_back(*this);
                result.back().left_[u][v] = result.back().left_[v][u] = -1;
                result.back().set(a, u, b), result.back().set(b, v, a);
            }
        return result;
    }

    // The same for isomorphic ones only, mirror images included.
    std::vector<int> canonical_code() const {
        std::vector<int> best;
        for (int u = 0; u < n_; ++u)
            for (int v = 0; v < n_; ++v)
                for (const bool mirrored : {false, true})
                    if (left_[u][v] >= 0)
                        if (auto code = code_from(u, v, mirrored); best.empty() || code < best) best = std::move(code);
        return best;
    }

private:
    void set(int a, int b, int c) { left_[a][b] = c, left_[b][c] = a, left_[c][a] = b; }

    // Neighbours of every corner in turn, numbered as they are met first.
    std::vector<int> code_from(int u, int v, bool mirrored) const {
        std::vector<int> label(n_, -1), order{u, v}, from{v, u}, code;
        label[u] = 0, label[v] = 1;
        for (std::size_t i = 0; i < order.size(); ++i) {
            const int a = order[i];
            int c = from[i];
            do {
                if (label[c] < 0) {
                    label[c] = static_cast<int>(order.size());
                    order.push_back(c), from.push_back(a);
                }
                code.push_back(label[c]);
                c = mirrored ? left_[c][a] : left_[a][c];
            } while (c != from[i]);
            code.push_back(-1);
        }
        return code;
    }

    int n_;
    std::vector<std::vector<int>> left_;  // [u][v]: third corner of the triangle to the left of u -> v, -1: no edge
};

inline std::vector<SphereTriangulation> all_triangulations(int corners) {
    std::vector<SphereTriangulation> found{SphereTriangulation(corners)};
    std::set<std::vector<int>> codes{found[0].canonical_code()};
    for (std::size_t i = 0; i < found.size(); ++i)
        for (const SphereTriangulation& next : SphereTriangulation(found[i]).flips())
            if (codes.insert(next.canonical_code()).second) found.push_back(next);
    return found;
}

}  // namespace octafield::volume::testing
