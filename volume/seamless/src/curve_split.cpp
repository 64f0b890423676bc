#include "curve_split.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "map_transitions.hpp"
#include "octafield/frames/octahedral_group.hpp"
#include "octafield/volume/triangle_table.hpp"

namespace octafield::volume::detail {
namespace {

using frames::Quaternion;

constexpr double least_weight = 0.15;  // of a corner in the vertex on a triangle

// From the frame of one vertex to that of another, alike whoever asks.
int step(const Quaternions& frames, Index from, Index to) {
    if (from == to) return 0;
    const auto q = [&](Index v) { return frames::from_wxyz(frames.row(v)); };
    return from < to ? frames::matching(q(from), q(to)) : frames::octahedral_inverse(frames::matching(q(to), q(from)));
}

Eigen::Vector3d point_on(const TetMesh& mesh, const SingularTriangle& triangle) {
    Eigen::Matrix3d corners;
    corners << mesh.vertices.row(triangle.a).transpose(), mesh.vertices.row(triangle.b).transpose(),
        mesh.vertices.row(triangle.c).transpose();
    const Eigen::Vector3d u = corners.col(1) - corners.col(0), v = corners.col(2) - corners.col(0), n = u.cross(v),
                          p = triangle.point - corners.col(0);
    const double s = p.cross(v).dot(n) / n.squaredNorm(), t = u.cross(p).dot(n) / n.squaredNorm();
    const Eigen::Vector3d weights =
        Eigen::Vector3d(1 - s - t, s, t).cwiseMax(0) * (1 - 3 * least_weight) + Eigen::Vector3d::Constant(least_weight);
    return corners * (weights / weights.sum());
}

class Cutter {
public:
    Cutter(const TetDomain& domain, const Quaternions& frames, const SingularGraph& graph)
        : mesh_(domain.mesh()), table_(domain.triangles()), frames_(frames) {
        for (const auto p : mesh_.vertices.rowwise()) points_.push_back(p.transpose());
        of_triangle_.assign(table_.triangles.rows(), -1);
        of_tet_.assign(mesh_.tets.rows(), -1);
        inside_.assign(mesh_.tets.rows(), -1);
        const TriangleRows row_of(table_);
        std::vector<Index> rows;
        for (const SingularTriangle& t : graph.triangles) {
            rows.push_back(row_of({t.a, t.b, t.c}));
            of_triangle_[rows.back()] = added(point_on(mesh_, t));
        }
        for (std::size_t i = 0; i < rows.size(); ++i)
            if (graph.triangles[i].quarter_turns == 0) join_across(rows[i]);
        for (const Index row : rows)
            for (int side = 0; side < 2; ++side)
                if (table_.sides(row, side) >= 0) place_in(table_.sides(row, side) / 4);
    }

    void cut() {
        for (Index t = 0; t < mesh_.tets.rows(); ++t) {
            if (of_tet_[t] < 0) {
                const auto tet = mesh_.tets.row(t);
                add({tet[0], tet[1], tet[2], tet[3]}, t, {tet[0], tet[1], tet[2], tet[3]});
                continue;
            }
            for (int k = 0; k < 4; ++k)
                if (table_.tet_triangles(t, k) != inside_[t]) cut_face(t, k);
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
    using Known = std::array<Index, 4>;  // old vertices of a tet, -1: none; the first one gives the labels

    Index added(const Eigen::Vector3d& point) {
        points_.push_back(point);
        return static_cast<Index>(points_.size() - 1);
    }
    void join_across(Index row) {
        const Index first = table_.sides(row, 0) / 4, second = table_.sides(row, 1) / 4;
        if (table_.sides(row, 1) < 0 || of_tet_[first] >= 0 || of_tet_[second] >= 0) return;
        of_tet_[first] = of_tet_[second] = of_triangle_[row];
        inside_[first] = inside_[second] = row;
    }
    void place_in(Index tet) {
        if (of_tet_[tet] >= 0) return;
        Eigen::Vector3d mean = Eigen::Vector3d::Zero();
        for (int k = 0; k < 4; ++k) mean += mesh_.vertices.row(mesh_.tets(tet, k)).transpose() / 4;
        of_tet_[tet] = added(mean);
    }
    void cut_face(Index tet, int corner) {
        std::array<Index, 3> face;
        for (int i = 0; i < 3; ++i) face[i] = mesh_.tets(tet, tet_face[corner][i]);
        const Index apex = of_tet_[tet], on = of_triangle_[table_.tet_triangles(tet, corner)];
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
            const Quaternion q = frames::from_wxyz(frames_.row(known[k])) *
                                 frames::octahedral_group()[step(frames_, known[k], known[0])];
            const Eigen::Vector4d other = frames::to_wxyz(q);
            sum += other.dot(first) < 0 ? Eigen::Vector4d(-other) : other;
        }
        return sum.normalized();
    }
    std::uint8_t matching(Index first, Index second) const {
        for (const Index v : known_[first])
            if (v >= 0 && std::find(known_[second].begin(), known_[second].end(), v) != known_[second].end())
                return static_cast<std::uint8_t>(frames::octahedral_product(step(frames_, known_[first][0], v),
                                                                            step(frames_, v, known_[second][0])));
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
    std::vector<Eigen::Vector3d> points_;
    std::vector<Index> of_triangle_,
        of_tet_;                 // the vertex on each triangle; inside each tet, or on the one in `inside_`
    std::vector<Index> inside_;  // row of the triangle that a tet shares with the other of its pair
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

MatchedField split_along_curves(const TetDomain& domain, const Quaternions& frames, const SingularGraph& graph) {
    Cutter cutter(domain, frames, graph);
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
            const bool forward = old.sides(between, 1) / 4 == second && old.sides(between, 1) >= 0;
            if (!forward && old.sides(between, 0) / 4 != second) continue;
            const int m = field.matching[between];
            result.matching.back() = static_cast<std::uint8_t>(forward ? m : frames::octahedral_inverse(m));
        }
    }
    return result;
}

}  // namespace octafield::volume::detail
