#include "inside_mesh.hpp"

#include <algorithm>
#include <numeric>

#include "octafield/error.hpp"
#include "segment_search.hpp"

namespace octafield::surface::detail {
namespace {

constexpr double most_squares = 5e6;

// Of each point, whether an odd number of the outline's loops goes round it.
std::vector<char> inside(const PlanePoints& points, const Outline& outline) {
    std::vector<Index> order(points.rows());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return points(a, 1) < points(b, 1); });
    std::vector<char> result(points.rows(), false);
    for (Index s = 0; s < outline.loops; ++s) {
        Vector2 low = outline.points.row(outline.segments(s, 0)), high = outline.points.row(outline.segments(s, 1));
        if (low[1] > high[1]) std::swap(low, high);
        auto at =
            std::lower_bound(order.begin(), order.end(), low[1], [&](Index i, double y) { return points(i, 1) < y; });
        for (; at != order.end() && points(*at, 1) < high[1]; ++at)
            if (cross(high - low, Vector2(points.row(*at)) - low) > 0) result[*at] = !result[*at];
    }
    return result;
}

// Mean length of the edges of each vertex.
std::vector<double> local_lengths(const InsideMesh& mesh) {
    std::vector<double> sum(mesh.points.rows(), 0), count(mesh.points.rows(), 0);
    for (Index q = 0; q < mesh.quads.rows(); ++q)
        for (int k = 0; k < 4; ++k)
            for (const int other : {(k + 1) % 4, (k + 3) % 4}) {
                sum[mesh.quads(q, k)] +=
                    (mesh.points.row(mesh.quads(q, k)) - mesh.points.row(mesh.quads(q, other))).norm();
                count[mesh.quads(q, k)] += 1;
            }
    for (std::size_t v = 0; v < sum.size(); ++v) sum[v] = count[v] > 0 ? sum[v] / count[v] : 0;
    return sum;
}

InsideMesh only(const InsideMesh& mesh, const std::vector<char>& kept, const std::vector<char>& loose) {
    std::vector<Index> name(mesh.points.rows(), -1);
    std::vector<Index> vertices;
    std::vector<Index> quads;
    const auto take = [&](Index v) {
        if (name[v] >= 0) return;
        name[v] = static_cast<Index>(vertices.size());
        vertices.push_back(v);
    };
    for (Index q = 0; q < mesh.quads.rows(); ++q)
        if (kept[q]) {
            quads.push_back(q);
            for (int k = 0; k < 4; ++k) take(mesh.quads(q, k));
        }
    for (Index v = 0; v < mesh.points.rows(); ++v)
        if (loose[v]) take(v);
    InsideMesh result{PlanePoints(vertices.size(), 2), Quads(quads.size(), 4)};
    for (std::size_t i = 0; i < vertices.size(); ++i) result.points.row(i) = mesh.points.row(vertices[i]);
    for (std::size_t i = 0; i < quads.size(); ++i)
        for (int k = 0; k < 4; ++k) result.quads(i, k) = name[mesh.quads(quads[i], k)];
    return result;
}

}  // namespace

InsideMesh squares(const PlanePoints& points, double edge_length, const FixedBoundaryOptions& options) {
    Eigen::Matrix2d axes;
    axes << std::cos(options.rotation), -std::sin(options.rotation), std::sin(options.rotation),
        std::cos(options.rotation);
    const PlanePoints own = points * axes / edge_length;  // coordinates along the rotated axes
    const Vector2 offset(options.offset_x, options.offset_y);
    const Vector2 low = (own.colwise().minCoeff().transpose() - offset).array().ceil();
    const Vector2 count = (own.colwise().maxCoeff().transpose() - offset - low).array().floor() + 1;
    InsideMesh result;
    if (!(count.minCoeff() >= 2)) return result;
    if (!(count.prod() <= most_squares))
        throw InvalidInput("the region's box has more than 5 million squares of this edge length", "too_many_quads");
    const Index across = static_cast<Index>(count[0]), up = static_cast<Index>(count[1]);
    result.points.resize(static_cast<Eigen::Index>(across) * up, 2);
    result.quads.resize(static_cast<Eigen::Index>(across - 1) * (up - 1), 4);
    for (Index j = 0; j < up; ++j)
        for (Index i = 0; i < across; ++i)
            result.points.row(j * across + i) = edge_length * (axes * (low + offset + Vector2(i, j))).transpose();
    for (Index j = 0; j + 1 < up; ++j)
        for (Index i = 0; i + 1 < across; ++i) {
            const Index v = j * across + i;
            result.quads.row(j * (across - 1) + i) << v, v + 1, v + across + 1, v + across;
        }
    return result;
}

InsideMesh plane_quads_of(const QuadMesh& mesh) {
    require_valid(mesh, false);
    if (mesh.triangles.rows() > 0 || (mesh.vertices.rows() > 0 && mesh.vertices.col(2).cwiseAbs().maxCoeff() > 0))
        throw InvalidInput("the mesh inside is of quads in the plane z = 0", "bad_inside_mesh");
    InsideMesh result{mesh.vertices.leftCols<2>(), mesh.quads};
    for (Index q = 0; q < result.quads.rows(); ++q) {
        const Vector2 first = result.points.row(result.quads(q, 2)) - result.points.row(result.quads(q, 0));
        const Vector2 second = result.points.row(result.quads(q, 3)) - result.points.row(result.quads(q, 1));
        if (cross(first, second) < 0) result.quads.row(q).reverseInPlace();
    }
    return result;
}

InsideMesh trimmed(const InsideMesh& mesh, const Outline& outline, double clearance) {
    if (mesh.quads.rows() == 0) return {};
    const std::vector<double> length = local_lengths(mesh);
    const double mean = std::accumulate(length.begin(), length.end(), 0.) / static_cast<double>(length.size());
    const SegmentSearch search(outline.points, outline.segments, clearance * mean);
    std::vector<char> clear = inside(mesh.points, outline);
    for (Index v = 0; v < mesh.points.rows(); ++v)
        clear[v] = clear[v] && length[v] > 0 && !search.nearer(mesh.points.row(v), clearance * length[v]);
    std::vector<char> kept(mesh.quads.rows(), false), loose = clear;
    for (Index q = 0; q < mesh.quads.rows(); ++q) {
        std::array<Vector2, 4> corners;
        bool all = true;
        for (int k = 0; k < 4; ++k) {
            corners[k] = mesh.points.row(mesh.quads(q, k));
            all = all && clear[mesh.quads(q, k)];
        }
        kept[q] = all && !search.meets(corners);
    }
    return only(mesh, kept, loose);
}

}  // namespace octafield::surface::detail
