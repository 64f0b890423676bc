#include "boundary_star.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <utility>

#include "octafield/error.hpp"

namespace octafield::volume {
namespace {

template <class Table>
void require_in_range(const Table& table, Eigen::Index count, const char* what) {
    std::vector<Index> bad;
    for (Eigen::Index i = 0; i < table.rows(); ++i)
        if (table.row(i).minCoeff() < 0 || table.row(i).maxCoeff() >= count) bad.push_back(static_cast<Index>(i));
    if (!bad.empty())
        throw InvalidInput(std::string(what) + " " + first_few(bad) +
                               " refer to vertices that do not exist; ids are those of the boundary mesh",
                           "index_out_of_range", bad);
}

// Lists per vertex, in ascending order of rows: item(row, column) of every table entry that is the vertex.
template <class Table, class Item>
void list_by_vertex(const Table& table, Eigen::Index count, std::vector<std::int64_t>& begin, std::vector<Index>& items,
                    const Item& item) {
    begin.assign(count + 1, 0);
    for (const Index v : table.reshaped()) ++begin[v + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    items.resize(table.size());
    std::vector<std::int64_t> next(begin.begin(), begin.end() - 1);
    for (Eigen::Index row = 0; row < table.rows(); ++row)
        for (Eigen::Index column = 0; column < table.cols(); ++column)
            items[next[table(row, column)]++] = item(row, column);
}

}  // namespace

BoundaryStars::BoundaryStars(const surface::TriangleMesh& boundary, const surface::FeatureGraph& features)
    : boundary_(boundary) {
    const Eigen::Index count = boundary.vertices.rows();
    require_in_range(boundary.triangles, count, "boundary triangles");
    require_in_range(features.edges, count, "feature edges");
    list_by_vertex(boundary.triangles, count, triangle_begin_, triangles_,
                   [](Eigen::Index row, Eigen::Index) { return static_cast<Index>(row); });
    list_by_vertex(features.edges, count, neighbour_begin_, neighbours_,
                   [&](Eigen::Index row, Eigen::Index column) { return features.edges(row, 1 - column); });
}

bool BoundaryStars::is_feature(Index v, Index w) const {
    const auto end = neighbours_.begin() + neighbour_begin_[v + 1];
    return std::find(neighbours_.begin() + neighbour_begin_[v], end, w) != end;
}

Eigen::Vector3d BoundaryStars::area_vector(Index triangle) const {
    const auto p = [&](int k) { return Eigen::Vector3d(boundary_.vertices.row(boundary_.triangles(triangle, k))); };
    return (p(1) - p(0)).cross(p(2) - p(0));
}

std::vector<Eigen::Vector3d> BoundaryStars::feature_directions(Index v) const {
    std::vector<Eigen::Vector3d> directions;
    for (std::int64_t i = neighbour_begin_[v]; i < neighbour_begin_[v + 1]; ++i)
        directions.push_back(
            (boundary_.vertices.row(neighbours_[i]) - boundary_.vertices.row(v)).transpose().normalized());
    return directions;
}

std::vector<int> BoundaryStars::sectors(Index v) const {
    const std::span<const Index> star = triangles(v);
    const int size = static_cast<int>(star.size());
    std::vector<std::pair<Index, int>>
        spokes;  // (other end of an edge at v, local number of a triangle with that edge)
    for (int i = 0; i < size; ++i)
        for (int k = 0; k < 3; ++k)
            if (const Index w = boundary_.triangles(star[i], k); w != v) spokes.emplace_back(w, i);
    std::sort(spokes.begin(), spokes.end());

    std::vector<int> sector(size);
    std::iota(sector.begin(), sector.end(), 0);
    const auto find = [&](int i) {
        while (sector[i] != i) i = sector[i];
        return i;
    };
    for (std::size_t i = 0; i < spokes.size();) {
        std::size_t end = i + 1;
        while (end < spokes.size() && spokes[end].first == spokes[i].first) ++end;
        if (end - i == 2 && !is_feature(v, spokes[i].first)) {
            const int first = find(spokes[i].second), second = find(spokes[i + 1].second);
            sector[std::max(first, second)] = std::min(first, second);  // the root is the sector's lowest triangle
        }
        i = end;
    }
    for (int& s : sector) s = find(s);
    return sector;
}

std::vector<Eigen::Vector3d> BoundaryStars::sector_normals(Index v) const {
    const std::span<const Index> star = triangles(v);
    const std::vector<int> sector = sectors(v);
    const int size = static_cast<int>(star.size());
    std::vector<Eigen::Vector3d> sums(size, Eigen::Vector3d::Zero());
    std::vector<Eigen::Vector3d> largest(size, Eigen::Vector3d::Zero());
    for (int i = 0; i < size; ++i) {
        const Eigen::Vector3d area = area_vector(star[i]);
        sums[sector[i]] += area;
        if (area.norm() > largest[sector[i]].norm()) largest[sector[i]] = area;
    }
    std::vector<Eigen::Vector3d> normals;
    for (int i = 0; i < size; ++i) {
        if (sector[i] != i) continue;
        // A fold can cancel the sum; its largest triangle then stands for the sector.
        const bool cancelled = sums[i].norm() < 1e-9 * largest[i].norm();
        normals.push_back((cancelled ? largest[i] : sums[i]).normalized());
    }
    return normals;
}

}  // namespace octafield::volume
