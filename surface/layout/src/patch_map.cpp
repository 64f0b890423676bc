#include "patch_map.hpp"

#include <Eigen/Geometry>
#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "charts.hpp"

namespace octafield::surface::detail {
namespace {

using Vector = Eigen::Vector3d;
using Vector2 = Eigen::Vector2d;

// A vector in the plane of triangle t, as long and at such angles as the surface measures it.
Vector measured(const SurfaceDomain& domain, Index t, const Vector& vector) {
    if (!domain.has_own_lengths()) return vector;
    const Complex z = vector_by_own_lengths(domain, t, vector);
    return {z.real(), z.imag(), 0};
}

class Patch {
public:
    Patch(const QuadLayout& layout, Index patch, const std::vector<Eigen::VectorXd>& along)
        : layout_(layout), pieces_(*layout.pieces), patch_(patch), along_(along) {}
    PatchMap map() &&;

private:
    void add_boundary();
    double extent(const DirectedSide& side) const { return along_[side.side][along_[side.side].size() - 1]; }
    void add_polygons();
    void split_edges();
    template <class Solver>
    bool solve(const std::vector<Eigen::Triplet<double>>& weights);
    std::vector<Eigen::Triplet<double>> cotangent_weights() const;
    std::vector<Eigen::Triplet<double>> mean_value_weights() const;
    Index add_point(const Vector& position, Index node = -1);
    bool on_one_side(Index a, Index b) const { return (sides_[a] & sides_[b]) != 0; }
    std::array<Vector, 2> sides_from(std::size_t triangle, int k) const;

    const QuadLayout& layout_;
    const LayoutPieces& pieces_;
    Index patch_;
    const std::vector<Eigen::VectorXd>& along_;
    PatchMap result_;
    std::map<Index, Index> local_;  // of points of the cut surface
    std::vector<Index> origins_;    // of each triangle, that of the surface
    std::vector<Vector> positions_;
    std::vector<unsigned> sides_;  // bits of the sides that a point is on; 0: inside
    std::vector<Vector2> fixed_;
};

Index Patch::add_point(const Vector& position, Index node) {
    positions_.push_back(position);
    result_.nodes.push_back(node);
    sides_.push_back(0);
    fixed_.push_back(Vector2::Zero());
    return static_cast<Index>(positions_.size() - 1);
}

void Patch::add_boundary() {
    const CutSurface& cut = pieces_.cut;
    const auto& around = layout_.patches[patch_].loops[0];
    const auto& first = layout_.patches[patch_].corner_sides;
    for (Index i = 0; i < first[1]; ++i) result_.width += extent(around[i]);
    for (Index i = first[1]; i < first[2]; ++i) result_.height += extent(around[i]);
    const Vector2 corners[] = {{0, 0}, {result_.width, 0}, {result_.width, result_.height}, {0, result_.height}};
    const Vector2 ways[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    const double extents[] = {result_.width, result_.height, result_.width, result_.height};
    std::array<double, 4> scales{};
    for (int side = 0; side < 4; ++side) {
        const Index end = side < 3 ? first[side + 1] : static_cast<Index>(around.size());
        for (Index i = first[side]; i < end; ++i) scales[side] += extent(around[i]);
        scales[side] = extents[side] / scales[side];
    }
    int k = -1;
    Index place = -1;
    double before = 0;  // lengths of the sides of the layout before this one on the same side of the patch
    for (const Index c : pieces_.loops[patch_][0]) {
        const bool corner = pieces_.turns[c];
        if (pieces_.vertex_of_node[cut.nodes[c]] >= 0) {
            before = corner ? 0 : before + extent(around[place]);
            k += corner;
            ++place;
        }
        const Index part = pieces_.part_of_side[c] + (pieces_.forward[c] ? 0 : 1);
        double at = along_[around[place].side][part];
        if (around[place].reversed) at = extent(around[place]) - at;
        const Index p = add_point(cut.positions.row(cut.nodes[c]), cut.nodes[c]);
        local_[cut.points[c]] = p;
        sides_[p] = 1u << k;
        if (corner) sides_[p] |= 1u << (k + 3) % 4;
        fixed_[p] = corner ? corners[k] : Vector2(corners[k] + scales[k] * (before + at) * ways[k]);
    }
}

void Patch::add_polygons() {
    const CutSurface& cut = pieces_.cut;
    for (const Index polygon : pieces_.patch_polygons[patch_]) {
        std::vector<Index> ring;
        Vector middle = Vector::Zero();
        for (Index c = cut.first[polygon]; c < cut.first[polygon + 1]; ++c) {
            auto found = local_.find(cut.points[c]);
            if (found == local_.end())
                found = local_.emplace(cut.points[c], add_point(cut.positions.row(cut.nodes[c]), cut.nodes[c])).first;
            ring.push_back(found->second);
            middle += positions_[ring.back()];
        }
        if (ring.size() == 3) {
            result_.triangles.push_back({ring[0], ring[1], ring[2]});
            origins_.push_back(cut.triangles[polygon]);
            continue;
        }
        const Index centre = add_point(middle / static_cast<double>(ring.size()));
        for (std::size_t i = 0; i < ring.size(); ++i)
            result_.triangles.push_back({centre, ring[i], ring[(i + 1) % ring.size()]});
        origins_.resize(result_.triangles.size(), cut.triangles[polygon]);
    }
}

// Edges inside with both ends on one side of the rectangle would be flat with all triangles behind them.
void Patch::split_edges() {
    std::map<std::pair<Index, Index>, int> uses;
    for (const auto& t : result_.triangles)
        for (int k = 0; k < 3; ++k)
            if (on_one_side(t[k], t[(k + 1) % 3])) ++uses[std::minmax(t[k], t[(k + 1) % 3])];
    std::map<std::pair<Index, Index>, Index> middles;
    for (const auto& [edge, count] : uses)
        if (count == 2) middles[edge] = add_point((positions_[edge.first] + positions_[edge.second]) / 2);
    if (middles.empty()) return;
    std::vector<std::array<Index, 3>> waiting = std::move(result_.triangles), done;
    std::vector<Index> waiting_origins = std::move(origins_), done_origins;
    while (!waiting.empty()) {
        const auto t = waiting.back();
        const Index origin = waiting_origins.back();
        waiting.pop_back();
        waiting_origins.pop_back();
        int split = -1;
        for (int k = 0; k < 3 && split < 0; ++k)
            if (middles.contains(std::minmax(t[k], t[(k + 1) % 3]))) split = k;
        if (split < 0) {
            done.push_back(t);
            done_origins.push_back(origin);
            continue;
        }
        const Index a = t[split], b = t[(split + 1) % 3], c = t[(split + 2) % 3], m = middles[std::minmax(a, b)];
        waiting.push_back({a, m, c});
        waiting.push_back({m, b, c});
        waiting_origins.resize(waiting.size(), origin);
    }
    result_.triangles = std::move(done);
    origins_ = std::move(done_origins);
}

// Of a triangle, from its corner k to the next one and to the last one, as the surface measures them.
std::array<Vector, 2> Patch::sides_from(std::size_t triangle, int k) const {
    const auto& t = result_.triangles[triangle];
    const Vector& from = positions_[t[k]];
    return {measured(layout_.domain, origins_[triangle], positions_[t[(k + 1) % 3]] - from),
            measured(layout_.domain, origins_[triangle], positions_[t[(k + 2) % 3]] - from)};
}

std::vector<Eigen::Triplet<double>> Patch::cotangent_weights() const {
    std::vector<Eigen::Triplet<double>> weights;
    for (std::size_t i = 0; i < result_.triangles.size(); ++i)
        for (int k = 0; k < 3; ++k) {
            const Index a = result_.triangles[i][k], b = result_.triangles[i][(k + 1) % 3];
            const auto [u, v] = sides_from(i, (k + 2) % 3);
            const double weight = u.dot(v) / std::max(u.cross(v).norm(), std::numeric_limits<double>::min()) / 2;
            weights.emplace_back(a, b, weight);
            weights.emplace_back(b, a, weight);
        }
    return weights;
}

std::vector<Eigen::Triplet<double>> Patch::mean_value_weights() const {
    std::vector<Eigen::Triplet<double>> weights;
    for (std::size_t i = 0; i < result_.triangles.size(); ++i)
        for (int k = 0; k < 3; ++k) {
            const auto& t = result_.triangles[i];
            const auto [u, v] = sides_from(i, k);
            const double ul = u.norm(), vl = v.norm();
            const double half_tangent = u.cross(v).norm() / (ul * vl + u.dot(v));
            weights.emplace_back(t[k], t[(k + 1) % 3], half_tangent / ul);
            weights.emplace_back(t[k], t[(k + 2) % 3], half_tangent / vl);
        }
    return weights;
}

// Each point inside is the weighted mean of its neighbours. Whether all triangles keep their sense.
template <class Solver>
bool Patch::solve(const std::vector<Eigen::Triplet<double>>& weights) {
    const auto count = static_cast<Index>(positions_.size());
    std::vector<Index> row(count, -1);
    Index inner = 0;
    for (Index p = 0; p < count; ++p)
        if (sides_[p] == 0) row[p] = inner++;
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(inner, 2);
    for (const auto& w : weights) {
        const Index p = row[w.row()], q = row[w.col()];
        if (p < 0) continue;
        entries.emplace_back(p, p, w.value());
        if (q >= 0) {
            entries.emplace_back(p, q, -w.value());
        } else {
            right.row(p) += w.value() * fixed_[w.col()].transpose();
        }
    }
    Eigen::MatrixX2d found(inner, 2);
    if (inner > 0) {
        Eigen::SparseMatrix<double> matrix(inner, inner);
        matrix.setFromTriplets(entries.begin(), entries.end());
        Solver solver(matrix);
        if (solver.info() != Eigen::Success) return false;
        found = solver.solve(right);
    }
    result_.parameters.resize(count, 2);
    for (Index p = 0; p < count; ++p)
        result_.parameters.row(p) = row[p] >= 0 ? Eigen::RowVector2d(found.row(row[p])) : fixed_[p].transpose();
    return std::all_of(result_.triangles.begin(), result_.triangles.end(), [&](const auto& t) {
        const Eigen::RowVector2d a = result_.parameters.row(t[0]);
        const Eigen::RowVector2d u = result_.parameters.row(t[1]) - a, v = result_.parameters.row(t[2]) - a;
        return u[0] * v[1] - u[1] * v[0] > 0;
    });
}

PatchMap Patch::map() && {
    add_boundary();
    add_polygons();
    split_edges();
    if (!solve<Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>>(cotangent_weights())) {
        result_.mean_value = true;
        result_.folded = !solve<Eigen::SparseLU<Eigen::SparseMatrix<double>>>(mean_value_weights());
    }
    result_.positions.resize(static_cast<Eigen::Index>(positions_.size()), 3);
    for (std::size_t p = 0; p < positions_.size(); ++p)
        result_.positions.row(static_cast<Eigen::Index>(p)) = positions_[p];
    return std::move(result_);
}

}  // namespace

PatchMap patch_map(const QuadLayout& layout, Index patch, const std::vector<Eigen::VectorXd>& along) {
    return Patch(layout, patch, along).map();
}

Points grid_positions(const PatchMap& map, int n, int m) {
    const Eigen::Index count = static_cast<Eigen::Index>(n - 1) * (m - 1);
    Points result = Points::Constant(count, 3, std::numeric_limits<double>::quiet_NaN());
    std::vector<double> best(count, -1e-7);  // least weight in the triangle that holds a point
    const double step_x = map.width / n, step_y = map.height / m;
    for (const auto& t : map.triangles) {
        Eigen::Matrix<double, 3, 2> corners;
        for (int k = 0; k < 3; ++k) corners.row(k) = map.parameters.row(t[k]);
        const Eigen::RowVector2d low = corners.colwise().minCoeff(), high = corners.colwise().maxCoeff();
        const Eigen::RowVector2d u = corners.row(1) - corners.row(0), v = corners.row(2) - corners.row(0);
        const double area = u[0] * v[1] - u[1] * v[0];
        const auto first = [](double at, double step) {
            return std::max(1, static_cast<int>(std::ceil(at / step - 1e-6)));
        };
        const auto last = [](double at, double step, int most) {
            return std::min(most - 1, static_cast<int>(std::floor(at / step + 1e-6)));
        };
        for (int j = first(low[1], step_y); j <= last(high[1], step_y, m); ++j)
            for (int i = first(low[0], step_x); i <= last(high[0], step_x, n); ++i) {
                const Eigen::RowVector2d w = Eigen::RowVector2d(i * step_x, j * step_y) - corners.row(0);
                const double second = (w[0] * v[1] - w[1] * v[0]) / area, third = (u[0] * w[1] - u[1] * w[0]) / area;
                const double least = std::min({1 - second - third, second, third});
                const Eigen::Index row = static_cast<Eigen::Index>(j - 1) * (n - 1) + i - 1;
                if (!(least > best[row])) continue;
                best[row] = least;
                result.row(row) = (1 - second - third) * map.positions.row(t[0]) + second * map.positions.row(t[1]) +
                                  third * map.positions.row(t[2]);
            }
    }
    return result;
}

}  // namespace octafield::surface::detail
