#include "cell_split.hpp"

#include <algorithm>
#include <cstdint>

#include "cavity.hpp"
#include "cone.hpp"

namespace octafield::volume::detail {
namespace {

using Tet = std::array<Index, 4>;

constexpr int most_states = 200000;

// Triangles between vertices 0 to 7 of a cell, each both ways round: bit i of `ways[w]` is triangle i, in ascending
// order (w = 0) or turned over.
struct TriangleSet {
    std::array<std::uint64_t, 2> ways{0, 0};
    bool empty() const { return (ways[0] | ways[1]) == 0; }
};

struct LocalTriangle {
    int number, way;
};

LocalTriangle local_triangle(int a, int b, int c) {
    const int way = (a < b) + (b < c) + (c < a) == 2 ? 0 : 1;
    if (b < a) std::swap(a, b);
    if (c < b) std::swap(b, c);
    if (b < a) std::swap(a, b);
    return {a + b * (b - 1) / 2 + c * (c - 1) * (c - 2) / 6, way};
}

// Tets on given vertices with a given boundary, found triangle by triangle. As all are positive and the boundary
// closes, they fill the inside once.
class Filler {
public:
    Filler(const CellComplex& complex, Index cell, double least) {
        const int n = complex.shape(cell).vertices;
        const auto point = [&](int k) { return complex.point(complex.ids(cell)[k]); };
        for (int a = 0; a < n; ++a)
            for (int b = a + 1; b < n; ++b)
                for (int c = b + 1; c < n; ++c)
                    for (int d = c + 1; d < n; ++d) {
                        const double quality = tet_quality(point(a), point(b), point(c), point(d));
                        if (quality >= least) add({a, b, c, d});
                        if (-quality >= least) add({a, b, d, c});
                    }
    }

    // The tets by their corners in the cell.
    std::vector<std::array<int, 4>> run(const TriangleSet& boundary) {
        used_.clear();
        std::vector<std::array<int, 4>> result;
        if (search(boundary))
            for (const int tet : used_) result.push_back(tets_[tet].corners);
        return result;
    }

private:
    struct LocalTet {
        std::array<int, 4> corners;
        std::array<LocalTriangle, 4> faces;  // outward
    };

    void add(const std::array<int, 4>& corners) {
        LocalTet tet{corners, {}};
        for (int f = 0; f < 4; ++f) {
            const auto& local = tet_shape.faces[f].local;
            tet.faces[f] = local_triangle(corners[local[0]], corners[local[1]], corners[local[2]]);
            behind_[tet.faces[f].way][tet.faces[f].number].push_back(static_cast<int>(tets_.size()));
        }
        tets_.push_back(tet);
    }

    // False where the tet does not lie within what `front` bounds.
    bool without(TriangleSet& front, const LocalTet& tet) const {
        for (const auto& [number, way] : tet.faces) {
            const std::uint64_t bit = std::uint64_t{1} << number;
            if (front.ways[way] & bit)
                front.ways[way] &= ~bit;
            else if (front.ways[1 - way] & bit)
                return false;
            else
                front.ways[1 - way] |= bit;
        }
        return true;
    }

    std::vector<std::pair<int, TriangleSet>> choices(const TriangleSet& front, int number, int way) const {
        std::vector<std::pair<int, TriangleSet>> found;
        for (const int tet : behind_[way][number]) {
            TriangleSet rest = front;
            if (without(rest, tets_[tet])) found.emplace_back(tet, rest);
        }
        return found;
    }

    // `front`: the boundary, outward, of what is not filled yet. Goes on at the triangle with the fewest tets.
    bool search(const TriangleSet& front) {
        if (front.empty()) return true;
        if (++states_ > most_states) return false;
        std::vector<std::pair<int, TriangleSet>> fewest;
        bool first = true;
        for (int way = 0; way < 2; ++way)
            for (std::uint64_t rest = front.ways[way]; rest; rest &= rest - 1) {
                auto found = choices(front, __builtin_ctzll(rest), way);
                if (found.empty()) return false;
                if (first || found.size() < fewest.size()) fewest = std::move(found);
                first = false;
            }
        for (const auto& [tet, rest] : fewest) {
            used_.push_back(tet);
            if (search(rest)) return true;
            used_.pop_back();
        }
        return false;
    }

    std::vector<LocalTet> tets_;
    std::array<std::array<std::vector<int>, 56>, 2> behind_;  // tets by a face of theirs
    std::vector<int> used_;
    int states_ = 0;
};

void add_halves(const std::array<int, 4>& q, int from, TriangleSet& triangles) {
    const auto add = [&](int a, int b, int c) {
        const auto [number, way] = local_triangle(a, b, c);
        triangles.ways[way] |= std::uint64_t{1} << number;
    };
    add(q[from], q[from + 1], q[from + 2]);
    add(q[from], q[from + 2], q[(from + 3) % 4]);
}

}  // namespace

std::vector<Tet> split_into_tets(const CellComplex& complex, Index cell, double least) {
    const auto& ids = complex.ids(cell);
    const auto corner = [&](Index v) { return static_cast<int>(std::find(ids.begin(), ids.end(), v) - ids.begin()); };
    TriangleSet fixed;
    std::vector<std::array<int, 4>> free;
    for (const CellFace& local : complex.shape(cell).faces) {
        const FaceCycle face = complex.face(cell, local);
        if (face.corners() == 3) {
            const auto [number, way] = local_triangle(local.local[0], local.local[1], local.local[2]);
            fixed.ways[way] |= std::uint64_t{1} << number;
            continue;
        }
        const QuadMeeting meeting = quad_meeting(complex, face);
        const auto& r = meeting.round;
        const std::array<int, 4> round{corner(r[0]), corner(r[1]), corner(r[2]), corner(r[3])};
        if (meeting.kind == QuadMeeting::Kind::triangles)
            add_halves(round, 0, fixed);
        else
            free.push_back(round);
    }
    Filler filler(complex, cell, least);
    for (unsigned diagonals = 0; diagonals < 1u << free.size(); ++diagonals) {
        TriangleSet boundary = fixed;
        for (std::size_t q = 0; q < free.size(); ++q) add_halves(free[q], diagonals >> q & 1u, boundary);
        const std::vector<std::array<int, 4>> found = filler.run(boundary);
        std::vector<Tet> tets;
        for (const auto& [a, b, c, d] : found) tets.push_back({ids[a], ids[b], ids[c], ids[d]});
        if (!tets.empty()) return tets;
    }
    return {};
}

}  // namespace octafield::volume::detail
