#include "octafield/volume/locate_points.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <unordered_map>

#include "octafield/error.hpp"
#include "octafield/frames/quaternion.hpp"
#include "octafield/parallel.hpp"

namespace octafield::volume {
namespace {

using Eigen::Vector3d;
using Cell = Eigen::Vector3i;

constexpr double inside_tolerance = 1e-9;  // of a barycentric coordinate
constexpr Eigen::Index tets_in_block = 4096;

Eigen::Vector4d barycentric(const TetMesh& mesh, Eigen::Index t, const Vector3d& p) {
    const auto corner = [&](int k) -> Vector3d { return mesh.vertices.row(mesh.tets(t, k)).transpose(); };
    Eigen::Matrix3d edges;
    for (int k = 0; k < 3; ++k) edges.col(k) = corner(k + 1) - corner(0);
    const Vector3d w = edges.inverse() * (p - corner(0));
    return {1 - w.sum(), w[0], w[1], w[2]};
}

// A grid over the box of the points, about one cell per point; each cell lists its points.
class PointGrid {
public:
    explicit PointGrid(const Points& points) : points_(points) {
        low_ = points.colwise().minCoeff().transpose();
        const Vector3d size = points.colwise().maxCoeff().transpose() - low_;
        const double longest = size.maxCoeff();
        const auto per_side = std::max(1, static_cast<int>(std::cbrt(static_cast<double>(points.rows()))));
        step_ = longest > 0 ? longest / per_side : 1;
        for (int c = 0; c < 3; ++c) last_[c] = static_cast<int>(size[c] / step_);
        begin_.assign(static_cast<std::size_t>(last_[0] + 1) * (last_[1] + 1) * (last_[2] + 1) + 1, 0);
        for (Eigen::Index i = 0; i < points.rows(); ++i) ++begin_[number(cell(points.row(i).transpose())) + 1];
        std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
        std::vector<Index> next(begin_.begin(), begin_.end() - 1);
        ids_.resize(points.rows());
        for (Eigen::Index i = 0; i < points.rows(); ++i)
            ids_[next[number(cell(points.row(i).transpose()))]++] = static_cast<Index>(i);
    }

    // visit(i) for every point in the box, and some near it.
    template <class Visit>
    void in_box(const Vector3d& low, const Vector3d& high, const Visit& visit) const {
        if (((high - low_).array() < 0).any() ||
            ((low - low_).array() > step_ * (last_.cast<double>().array() + 1)).any())
            return;
        const Cell first = cell(low), last = cell(high);
        for (int x = first[0]; x <= last[0]; ++x)
            for (int y = first[1]; y <= last[1]; ++y) {
                const std::size_t row = number({x, y, 0});
                for (Index i = begin_[row + first[2]]; i < begin_[row + last[2] + 1]; ++i) visit(ids_[i]);
            }
    }

private:
    Cell cell(const Vector3d& p) const {
        Cell result;
        for (int c = 0; c < 3; ++c)
            result[c] = static_cast<int>(std::clamp((p[c] - low_[c]) / step_, 0.0, static_cast<double>(last_[c])));
        return result;
    }
    std::size_t number(const Cell& c) const {
        return (static_cast<std::size_t>(c[0]) * (last_[1] + 1) + c[1]) * (last_[2] + 1) + c[2];
    }

    const Points& points_;
    Vector3d low_;
    double step_;
    Cell last_;
    std::vector<Index> begin_, ids_;
};

// Per point the tet of a range that it lies deepest in, and how deep; -1: none holds it.
struct Deepest {
    std::vector<double> depth;
    std::vector<Index> tet;
};

Deepest deepest(const TetMesh& mesh, const Points& points, const PointGrid& grid, Eigen::Index begin,
                Eigen::Index end) {
    Deepest result{std::vector<double>(points.rows(), -inside_tolerance), std::vector<Index>(points.rows(), -1)};
    for (Eigen::Index t = begin; t < end; ++t) {
        Eigen::Array3d low = mesh.vertices.row(mesh.tets(t, 0)).transpose(), high = low;
        for (int k = 1; k < 4; ++k) {
            const Eigen::Array3d p = mesh.vertices.row(mesh.tets(t, k)).transpose();
            low = low.min(p), high = high.max(p);
        }
        const double slack = 1e-8 * (high - low).maxCoeff();
        grid.in_box(low - slack, high + slack, [&](Index i) {
            const Vector3d p = points.row(i).transpose();
            if ((p.array() < low - slack).any() || (p.array() > high + slack).any()) return;
            const double depth = barycentric(mesh, t, p).minCoeff();
            if (depth < result.depth[i] || (depth == result.depth[i] && result.tet[i] >= 0)) return;
            result.depth[i] = depth;
            result.tet[i] = static_cast<Index>(t);
        });
    }
    return result;
}

Vector3d centre(const TetMesh& mesh, Eigen::Index t) {
    Vector3d sum = Vector3d::Zero();
    for (int k = 0; k < 4; ++k) sum += mesh.vertices.row(mesh.tets(t, k)).transpose();
    return sum / 4;
}

// Takes the centres in their order, but none nearer to one taken before than `distance`.
std::vector<Index> take_apart(const Points& centres, double distance) {
    const Vector3d low = centres.colwise().minCoeff().transpose();
    std::unordered_map<std::int64_t, std::vector<Index>> cells;
    const auto key = [](const Eigen::Matrix<std::int64_t, 3, 1>& c) {
        return (c[0] * (std::int64_t{1} << 21) + c[1]) * (std::int64_t{1} << 21) + c[2];
    };
    std::vector<Index> taken;
    for (Index i = 0; i < centres.rows(); ++i) {
        const Vector3d p = centres.row(i).transpose();
        const Eigen::Matrix<std::int64_t, 3, 1> cell = ((p - low) / distance).array().floor().cast<std::int64_t>();
        bool free = true;
        for (int n = 0; n < 27 && free; ++n) {
            const auto found =
                cells.find(key(cell + Eigen::Matrix<std::int64_t, 3, 1>(n / 9 - 1, n / 3 % 3 - 1, n % 3 - 1)));
            if (found == cells.end()) continue;
            for (const Index j : found->second) free = free && (centres.row(j).transpose() - p).norm() >= distance;
        }
        if (!free) continue;
        cells[key(cell)].push_back(i);
        taken.push_back(i);
    }
    return taken;
}

}  // namespace

LocatedPoints locate_points(const TetDomain& domain, const Points& points, int threads) {
    const TetMesh& mesh = domain.mesh();
    if (!points.allFinite()) throw InvalidInput("points must be finite numbers", "not_finite");
    LocatedPoints result{std::vector<Index>(points.rows(), -1), Rows<double, 4>::Zero(points.rows(), 4)};
    if (points.rows() == 0) return result;
    const PointGrid grid(points);
    // Blocks of tets on their own, then the deepest of theirs, the lowest tet of equals: the same in any number.
    const std::int64_t count = std::clamp<std::int64_t>(mesh.tets.rows() / tets_in_block, 1, thread_count(threads));
    std::vector<Deepest> found(count);
    parallel_for(
        count, threads,
        [&](std::int64_t k) {
            found[k] = deepest(mesh, points, grid, mesh.tets.rows() * k / count, mesh.tets.rows() * (k + 1) / count);
        },
        1);
    parallel_for(points.rows(), threads, [&](std::int64_t i) {
        double depth = -std::numeric_limits<double>::infinity();
        for (const Deepest& block : found)
            if (block.tet[i] >= 0 && block.depth[i] > depth) depth = block.depth[i], result.tet[i] = block.tet[i];
        if (result.tet[i] < 0) return;
        const Eigen::Vector4d inside = barycentric(mesh, result.tet[i], points.row(i).transpose()).cwiseMax(0);
        result.weights.row(i) = (inside / inside.sum()).transpose();
    });
    return result;
}

Points spread_points(const TetDomain& domain, int count) {
    const TetMesh& mesh = domain.mesh();
    if (count < 0)
        throw InvalidInput("the number of points is " + std::to_string(count) + "; give 0 or more",
                           "option_out_of_range");
    if (count == 0) return Points(0, 3);
    constexpr std::int64_t tried_per_point = 256;  // beyond these hardly any fits
    const std::int64_t tried = std::min<std::int64_t>(mesh.tets.rows(), tried_per_point * count);
    std::vector<Index> tets(mesh.tets.rows());
    std::iota(tets.begin(), tets.end(), 0);
    std::mt19937_64 generator(1);
    Points centres(tried, 3);
    for (std::int64_t i = 0; i < tried; ++i) {
        const auto rest = static_cast<double>(mesh.tets.rows() - i);
        std::swap(tets[i], tets[i + static_cast<std::int64_t>(frames::uniform01(generator) * rest)]);
        centres.row(i) = centre(mesh, tets[i]).transpose();
    }

    constexpr double saturation = 0.73;  // points per cube of the distance, where no more fit (Torquato et al. 2006)
    double distance = std::cbrt(saturation * tet_volumes(mesh).sum() / count);
    std::vector<Index> taken = take_apart(centres, distance);
    while (static_cast<int>(taken.size()) > count) {  // near the surface, and in thin parts, more fit
        distance *= std::max(1.05, std::cbrt(static_cast<double>(taken.size()) / count));
        taken = take_apart(centres, distance);
    }
    return centres(taken, Eigen::all);
}

}  // namespace octafield::volume
