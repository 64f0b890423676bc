#include "cell_split.hpp"

#include <algorithm>
#include <optional>

#include "cavity.hpp"
#include "cone.hpp"

namespace octafield::volume::detail {
namespace {

using Tet = std::array<Index, 4>;

constexpr int most_tets = 12;
constexpr int most_nodes = 20000;

// Tets on given vertices with a given boundary, found triangle by triangle. As all are positive and the boundary
// closes, they fill the inside once.
class Filler {
public:
    Filler(const CellComplex& complex, Index cell, double least) : complex_(complex), cell_(cell), least_(least) {}

    std::vector<Tet> run(std::vector<FaceCycle> boundary) {
        nodes_ = 0;
        tets_.clear();
        return search(std::move(boundary)) ? tets_ : std::vector<Tet>{};
    }

private:
    // `front`: the boundary, outward, of what is not filled yet.
    bool search(std::vector<FaceCycle> front) {
        if (front.empty()) return true;
        if (static_cast<int>(tets_.size()) == most_tets || ++nodes_ > most_nodes) return false;
        const auto base = front.front().ids;
        for (int k = 0; k < complex_.shape(cell_).vertices; ++k) {
            const Tet tet{base[0], base[2], base[1], complex_.ids(cell_)[k]};
            if (std::find(base.begin(), base.end(), tet[3]) != base.end()) continue;
            const std::optional<std::vector<FaceCycle>> rest = without(front, tet);
            if (!rest || !(quality(tet) >= least_)) continue;
            tets_.push_back(tet);
            if (search(*rest)) return true;
            tets_.pop_back();
        }
        return false;
    }

    static std::optional<std::vector<FaceCycle>> without(std::vector<FaceCycle> front, const Tet& tet) {
        for (const CellFace& local : tet_shape.faces) {
            const FaceCycle face = triangle_cycle(tet[local.local[0]], tet[local.local[1]], tet[local.local[2]]);
            const auto found = std::find(front.begin(), front.end(), face);
            if (found != front.end()) {
                front.erase(found);
                continue;
            }
            if (std::find(front.begin(), front.end(), opposite(face)) != front.end()) return std::nullopt;
            front.push_back(opposite(face));
        }
        return front;
    }

    double quality(const Tet& tet) const {
        return tet_quality(complex_.point(tet[0]), complex_.point(tet[1]), complex_.point(tet[2]),
                           complex_.point(tet[3]));
    }

    const CellComplex& complex_;
    const Index cell_;
    const double least_;
    int nodes_ = 0;
    std::vector<Tet> tets_;
};

}  // namespace

std::vector<Tet> split_into_tets(const CellComplex& complex, Index cell, double least) {
    std::vector<FaceCycle> fixed;
    std::vector<std::array<Index, 4>> free;
    const auto halve = [](const std::array<Index, 4>& q, int from, std::vector<FaceCycle>& triangles) {
        triangles.push_back(triangle_cycle(q[from], q[from + 1], q[from + 2]));
        triangles.push_back(triangle_cycle(q[from], q[from + 2], q[(from + 3) % 4]));
    };
    for (const CellFace& local : complex.shape(cell).faces) {
        const FaceCycle face = complex.face(cell, local);
        const QuadMeeting meeting = face.corners() == 4 ? quad_meeting(complex, face) : QuadMeeting{};
        if (face.corners() == 3)
            fixed.push_back(face);
        else if (meeting.kind == QuadMeeting::Kind::triangles)
            halve(meeting.round, 0, fixed);
        else
            free.push_back(face.ids);
    }
    Filler filler(complex, cell, least);
    for (unsigned diagonals = 0; diagonals < 1u << free.size(); ++diagonals) {
        std::vector<FaceCycle> boundary = fixed;
        for (std::size_t q = 0; q < free.size(); ++q) halve(free[q], diagonals >> q & 1u, boundary);
        std::vector<Tet> tets = filler.run(std::move(boundary));
        if (!tets.empty()) return tets;
    }
    return {};
}

}  // namespace octafield::volume::detail
