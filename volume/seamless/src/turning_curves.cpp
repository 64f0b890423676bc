#include "turning_curves.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "axis_numbers.hpp"
#include "octafield/frames/octahedral_group.hpp"

namespace octafield::volume::detail {
namespace {

using Eigen::Vector3d;

Vector3d middle_of(const TetMesh& mesh, const TriangleTable& table, Index row) {
    Vector3d sum = Vector3d::Zero();
    for (const Index v : table.triangles.row(row)) sum += mesh.vertices.row(v).transpose();
    return sum / 3;
}

// Of the parameter along the axis, from 0 at the first row.
std::vector<double> heights(const TetMesh& mesh, const TriangleTable& table, const CurveChain& chain) {
    std::vector<double> height{0};
    for (std::size_t i = 1; i < chain.rows.size(); ++i) {
        const Vector3d way = middle_of(mesh, table, chain.rows[i]) - middle_of(mesh, table, chain.rows[i - 1]);
        height.push_back(height.back() + (chain.axes[i] + chain.axes[i - 1]).dot(way) / 2);
    }
    return height;
}

class Walker {
public:
    Walker(const TetDomain& domain, const Quaternions& frames, const EdgeMatchings& matchings)
        : mesh_(domain.mesh()),
          table_(domain.triangles()),
          frames_(frames),
          matchings_(matchings),
          turn_(table_.triangles.rows()),
          visited_(table_.triangles.rows(), 0),
          count_(mesh_.tets.rows(), 0) {
        for (Index row = 0; row < table_.triangles.rows(); ++row) {
            turn_[row] = static_cast<std::uint8_t>(matchings_.holonomy(row));
            for (int side = 0; side < 2 && turn_[row] != 0 && table_.sides(row, side) >= 0; ++side)
                ++count_[table_.sides(row, side) / 4];
        }
    }

    std::vector<CurveChain> chains() {
        std::vector<CurveChain> found;
        for (Index row = 0; row < static_cast<Index>(turn_.size()); ++row)
            if (is_quarter(row) && !visited_[row]) found.push_back(chain_from(row));
        return found;
    }

private:
    bool is_quarter(Index row) const {
        return frames::octahedral_class(turn_[row]) == frames::OctahedralClass::quarter_turn;
    }
    Index tet_at(Index row, int side) const { return table_.sides(row, side) < 0 ? -1 : table_.sides(row, side) / 4; }

    // The other singular triangle of the tet; -1 where there is none, or more.
    Index through(Index tet, Index row) const {
        if (tet < 0 || count_[tet] != 2) return -1;
        for (int k = 0; k < 4; ++k)
            if (const Index other = table_.tet_triangles(tet, k); other != row && turn_[other] != 0)
                return is_quarter(other) ? other : -1;
        return -1;
    }
    CurveChain chain_from(Index seed) {
        std::array<std::vector<Index>, 2> rows, tets;  // on both sides of the seed
        visited_[seed] = 1;
        CurveChain chain;
        for (int side = 0; side < 2 && !chain.closed; ++side) {
            Index row = seed, tet = tet_at(seed, side);
            for (Index next; (next = through(tet, row)) >= 0;) {
                tets[side].push_back(tet);
                chain.closed = next == seed;
                if (chain.closed) break;
                visited_[next] = 1;
                rows[side].push_back(next);
                row = next;
                tet = tet_at(row, tet_at(row, 0) == tet ? 1 : 0);
            }
        }
        chain.rows.assign(rows[1].rbegin(), rows[1].rend());
        chain.tets.assign(tets[1].rbegin(), tets[1].rend());
        chain.rows.push_back(seed);
        chain.rows.insert(chain.rows.end(), rows[0].begin(), rows[0].end());
        chain.tets.insert(chain.tets.end(), tets[0].begin(), tets[0].end());
        for (std::size_t i = 0; i < chain.rows.size(); ++i) chain.axes.push_back(axis(chain, i));
        if (chain.closed) begin_half_way(chain);
        return chain;
    }
    // So that a closed chain turns within it, not where it begins.
    void begin_half_way(CurveChain& chain) const {
        const std::vector<double> height = heights(mesh_, table_, chain);
        const auto [least, most] = std::minmax_element(height.begin(), height.end());
        const double half = (*least + *most) / 2;
        const auto first =
            std::min_element(height.begin(), height.end(),
                             [&](double a, double b) { return std::abs(a - half) < std::abs(b - half); }) -
            height.begin();
        std::rotate(chain.rows.begin(), chain.rows.begin() + first, chain.rows.end());
        std::rotate(chain.tets.begin(), chain.tets.begin() + first, chain.tets.end());
        std::rotate(chain.axes.begin(), chain.axes.begin() + first, chain.axes.end());
    }
    Vector3d axis(const CurveChain& chain, std::size_t i) const {
        const Index row = chain.rows[i];
        const auto corner = [&](int k) { return Vector3d(mesh_.vertices.row(table_.triangles(row, k)).transpose()); };
        const Index next = i < chain.tets.size() ? chain.tets[i]
                           : i > 0               ? tet_at(row, tet_at(row, 0) == chain.tets[i - 1] ? 1 : 0)
                                                 : tet_at(row, 0);
        const Index tet = next >= 0 ? next : tet_at(row, 0);  // a boundary triangle at the end: the tet behind it
        Vector3d centre = Vector3d::Zero();
        for (const Index v : mesh_.tets.row(tet)) centre += mesh_.vertices.row(v).transpose() / 4;
        const double along = (corner(1) - corner(0)).cross(corner(2) - corner(0)).dot(centre - corner(0));
        const double sign = (along > 0) == (next >= 0) ? 1 : -1;
        return sign *
               (frames::from_wxyz(frames_.row(table_.triangles(row, 0))) * axis_unit(axis_of_quarter_turn(turn_[row])));
    }

    const TetMesh& mesh_;
    const TriangleTable& table_;
    const Quaternions& frames_;
    const EdgeMatchings& matchings_;
    std::vector<std::uint8_t> turn_, visited_;
    std::vector<Index> count_;  // singular triangles of each tet
};

}  // namespace

std::vector<CurveChain> curve_chains(const TetDomain& domain, const Quaternions& frames,
                                     const EdgeMatchings& matchings) {
    return Walker(domain, frames, matchings).chains();
}

std::vector<CurveTurn> curve_turns(const TetDomain& domain, const CurveChain& chain, double least) {
    const auto outward = [&](Index row) {  // of a boundary triangle; else 0
        if (domain.triangles().sides(row, 1) >= 0) return Vector3d(Vector3d::Zero());
        const auto corner = [&](int k) {
            return Vector3d(domain.mesh().vertices.row(domain.triangles().triangles(row, k)).transpose());
        };
        const Vector3d normal = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
        const Index behind = domain.triangles().sides(row, 0);
        const Vector3d apex = domain.mesh().vertices.row(domain.mesh().tets(behind / 4, behind % 4));
        return Vector3d((apex - corner(0)).dot(normal) > 0 ? -normal : normal);
    };
    // On the surface the axis is the normal, so the type of an end there is plain, however short the rest of it is.
    std::vector<double> height = heights(domain.mesh(), domain.triangles(), chain);
    height.insert(height.begin(), 2 * least * chain.axes.front().dot(outward(chain.rows.front())));
    height.push_back(height.back() + 2 * least * chain.axes.back().dot(outward(chain.rows.back())));
    std::vector<std::size_t> ends{0};  // ends of ups and downs
    for (std::size_t i = 1; i < height.size(); ++i) {
        const auto up = [&](std::size_t a, std::size_t b) { return height[b] > height[a]; };
        if (ends.size() > 1 && up(ends.back(), i) == up(ends[ends.size() - 2], ends.back()))
            ends.back() = i;
        else
            ends.push_back(i);
    }
    while (ends.size() > 2) {
        const auto rise = [&](std::size_t i) { return std::abs(height[ends[i + 1]] - height[ends[i]]); };
        std::size_t lowest = 0;
        for (std::size_t i = 1; i + 1 < ends.size(); ++i)
            if (rise(i) < rise(lowest)) lowest = i;
        if (rise(lowest) >= least) break;
        if (lowest == 0)
            ends.erase(ends.begin());
        else if (lowest + 2 == ends.size())
            ends.pop_back();
        else
            ends.erase(ends.begin() + static_cast<std::ptrdiff_t>(lowest),
                       ends.begin() + static_cast<std::ptrdiff_t>(lowest) + 2);
    }
    std::vector<CurveTurn> turns;
    for (std::size_t i = 1; i + 1 < ends.size(); ++i)
        turns.push_back({std::min(std::max<std::size_t>(ends[i], 1), chain.rows.size()) - 1,
                         height[ends[i]] > height[ends[i - 1]] ? 1 : -1});
    return turns;
}

}  // namespace octafield::volume::detail
