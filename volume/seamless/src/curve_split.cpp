#include "curve_split.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "octafield/disjoint_sets.hpp"
#include "octafield/frames/octahedral_group.hpp"
#include "seen_point.hpp"

namespace octafield::volume::detail {
namespace {

using frames::Quaternion;

// Turns that no edge of a hex mesh has.
bool is_complex(int holonomy) {
    const auto found = frames::octahedral_class(holonomy);
    return found == frames::OctahedralClass::third_turn || found == frames::OctahedralClass::edge_half_turn;
}

void sort_unique(std::vector<Index>& ids) {
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

class Cutter {
public:
    Cutter(const TetDomain& domain, const Quaternions& frames, const EdgeMatchings& matchings)
        : mesh_(domain.mesh()),
          table_(domain.triangles()),
          frames_(frames),
          step_(matchings),
          on_triangle_(table_.triangles.rows(), -1),
          in_tet_(mesh_.tets.rows(), -1),
          joined_(table_.triangles.rows(), 0) {
        for (const auto p : mesh_.vertices.rowwise()) points_.push_back(p.transpose());
        std::vector<Index> singular;
        for (Index row = 0; row < table_.triangles.rows(); ++row)
            if (step_.holonomy(row) != 0) singular.push_back(row);
        join_at_complex(singular);
        for (const Index row : singular)
            if (!joined_[row]) on_triangle_[row] = added_mean(table_.triangles.row(row));
        for (const Index row : singular)
            for (int side = 0; side < 2 && table_.sides(row, side) >= 0; ++side)
                if (const Index tet = table_.sides(row, side) / 4; in_tet_[tet] < 0)
                    in_tet_[tet] = added_mean(mesh_.tets.row(tet));
    }

    void cut() {
        for (Index t = 0; t < mesh_.tets.rows(); ++t) {
            if (in_tet_[t] < 0) {
                const auto tet = mesh_.tets.row(t);
                add({tet[0], tet[1], tet[2], tet[3]}, t, {tet[0], tet[1], tet[2], tet[3]});
                continue;
            }
            for (int k = 0; k < 4; ++k)
                if (!joined_[table_.tet_triangles(t, k)]) cut_face(t, k);
        }
    }

    MatchedField field(const TetDomain& domain) const {
        TetMesh mesh{Points(points_.size(), 3), Tets(tets_.size(), 4)};
        for (std::size_t v = 0; v < points_.size(); ++v) mesh.vertices.row(v) = points_[v].transpose();
        for (std::size_t t = 0; t < tets_.size(); ++t)
            for (int k = 0; k < 4; ++k) mesh.tets(t, k) = tets_[t][k];
        MatchedField result{
            with_features_of(domain, std::move(mesh)), Quaternions(tets_.size(), 4), {}, parent_, curves()};
        for (std::size_t t = 0; t < tets_.size(); ++t) result.frames.row(t) = mean_frame(known_[t]).transpose();
        const TriangleTable& table = result.domain.triangles();
        for (Index row = 0; row < table.triangles.rows(); ++row)
            result.matching.push_back(
                table.sides(row, 1) < 0 ? 0 : matching(table.sides(row, 0) / 4, table.sides(row, 1) / 4));
        return result;
    }

private:
    using Known = std::array<Index, 4>;  // old vertices of a tet, ascending, then -1: the first one gives the labels

    template <class Ids>
    Index added_mean(const Ids& vertices) {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (const Index v : vertices) sum += mesh_.vertices.row(v).transpose();
        points_.push_back(sum / static_cast<double>(vertices.size()));
        return static_cast<Index>(points_.size() - 1);
    }

    // Tets with complex triangles between them get one vertex together, where one sees all their outer triangles.
    void join_at_complex(const std::vector<Index>& singular) {
        DisjointSets sets(mesh_.tets.rows());
        std::vector<Index> complex;
        for (const Index row : singular)
            if (table_.sides(row, 1) >= 0 && is_complex(step_.holonomy(row))) complex.push_back(row);
        for (const Index row : complex) sets.join(table_.sides(row, 0) / 4, table_.sides(row, 1) / 4);
        std::map<Index, std::vector<Index>> rows;
        for (const Index row : complex) rows[sets.lowest(table_.sides(row, 0) / 4)].push_back(row);
        for (const auto& [lowest, inner] : rows) {
            std::vector<Index> tets;
            for (const Index row : inner)
                for (int side = 0; side < 2; ++side) tets.push_back(table_.sides(row, side) / 4);
            sort_unique(tets);
            const auto point = seen_point(mesh_, table_, tets, inner);
            if (!point) continue;
            points_.push_back(*point);
            for (const Index t : tets) in_tet_[t] = static_cast<Index>(points_.size() - 1);
            for (const Index row : inner) joined_[row] = 1;
        }
    }

    void cut_face(Index tet, int corner) {
        std::array<Index, 3> face;
        for (int i = 0; i < 3; ++i) face[i] = mesh_.tets(tet, tet_face[corner][i]);
        const Index apex = in_tet_[tet], on = on_triangle_[table_.tet_triangles(tet, corner)];
        if (on < 0) {
            add({face[0], face[2], face[1], apex}, tet, {face[0], face[1], face[2], -1});
            return;
        }
        for (int i = 0; i < 3; ++i)
            add({face[i], on, face[(i + 1) % 3], apex}, tet, {face[i], face[(i + 1) % 3], -1, -1});
        edges_.push_back({std::min(on, apex), std::max(on, apex)});
    }
    void add(const std::array<Index, 4>& tet, Index parent, Known known) {
        std::sort(known.begin(), known.end(), [](Index a, Index b) { return a >= 0 && (b < 0 || a < b); });
        tets_.push_back(tet);
        parent_.push_back(parent);
        known_.push_back(known);
    }

    Eigen::Vector4d mean_frame(const Known& known) const {
        const Eigen::Vector4d first = frames_.row(known[0]).transpose();
        Eigen::Vector4d sum = first;
        for (int k = 1; k < 4 && known[k] >= 0; ++k) {
            const Quaternion q =
                frames::from_wxyz(frames_.row(known[k])) * frames::octahedral_group()[step_(known[k], known[0])];
            const Eigen::Vector4d other = frames::to_wxyz(q);
            sum += other.dot(first) < 0 ? Eigen::Vector4d(-other) : other;
        }
        return sum.normalized();
    }
    std::uint8_t matching(Index first, Index second) const {
        for (const Index v : known_[first])
            if (v >= 0 && std::find(known_[second].begin(), known_[second].end(), v) != known_[second].end())
                return static_cast<std::uint8_t>(
                    frames::octahedral_product(step_(known_[first][0], v), step_(v, known_[second][0])));
        return 0;
    }
    Edges curves() const {
        auto sorted = edges_;
        std::sort(sorted.begin(), sorted.end());
        sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
        Edges result(sorted.size(), 2);
        for (std::size_t e = 0; e < sorted.size(); ++e) result.row(e) << sorted[e][0], sorted[e][1];
        return result;
    }

    const TetMesh& mesh_;
    const TriangleTable& table_;
    const Quaternions& frames_;
    const EdgeMatchings& step_;
    std::vector<Eigen::Vector3d> points_;
    std::vector<Index> on_triangle_, in_tet_;  // new vertices; -1: none
    std::vector<std::uint8_t> joined_;         // triangles between tets that have one vertex together
    std::vector<std::array<Index, 4>> tets_;
    std::vector<Index> parent_;
    std::vector<Known> known_;
    std::vector<std::array<Index, 2>> edges_;
};

}  // namespace

TetDomain with_features_of(const TetDomain& old, TetMesh mesh) {
    const TetDomain domain(std::move(mesh));
    const std::vector<Index>& now = domain.surface().vertex_map;
    surface::FeatureGraph features = old.features();
    const auto number = [&](Index v) {
        return static_cast<Index>(std::lower_bound(now.begin(), now.end(), old.surface().vertex_map[v]) - now.begin());
    };
    for (Index& v : features.edges.reshaped()) v = number(v);
    for (Index& v : features.corners) v = number(v);
    return domain.with_features(std::move(features));
}

MatchedField split_along_curves(const TetDomain& domain, const Quaternions& frames, const EdgeMatchings& matchings) {
    Cutter cutter(domain, frames, matchings);
    cutter.cut();
    return cutter.field(domain);
}

MatchedField of_parts(const MatchedField& field, TetDomain domain, const std::vector<Index>& parent) {
    const TriangleTable &old = field.domain.triangles(), &table = domain.triangles();
    MatchedField result{std::move(domain), Quaternions(parent.size(), 4), {}, {}, field.curves};
    for (std::size_t t = 0; t < parent.size(); ++t) {
        result.frames.row(t) = field.frames.row(parent[t]);
        result.parent.push_back(field.parent[parent[t]]);
    }
    for (Index row = 0; row < table.triangles.rows(); ++row) {
        result.matching.push_back(0);
        if (table.sides(row, 1) < 0) continue;
        const Index first = parent[table.sides(row, 0) / 4], second = parent[table.sides(row, 1) / 4];
        for (int k = 0; k < 4 && first != second; ++k) {
            const Index between = old.tet_triangles(first, k);
            const bool forward = old.sides(between, 1) >= 0 && old.sides(between, 1) / 4 == second;
            if (!forward && old.sides(between, 0) / 4 != second) continue;
            const int m = field.matching[between];
            result.matching.back() = static_cast<std::uint8_t>(forward ? m : frames::octahedral_inverse(m));
        }
    }
    return result;
}

}  // namespace octafield::volume::detail
