#include "grid_points.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "octafield/disjoint_sets.hpp"
#include "octafield/error.hpp"
#include "octafield/volume/triangle_table.hpp"
#include "simplex_search.hpp"

namespace octafield::volume::detail {

BlockHexahedra GridPoints::mesh(const std::vector<std::array<Index, 8>>& hexahedra, std::vector<Index> blocks) const {
    DisjointSets sets(points_.size());
    for (const auto& [a, b] : same_) sets.join(a, b);
    Index count = 0;
    const std::vector<Index> set = std::move(sets).numbers(count);
    std::vector<Index> best(count, -1), number(count, -1);
    for (std::size_t p = 0; p < points_.size(); ++p)
        if (best[set[p]] < 0 || points_[p].before(points_[best[set[p]]])) best[set[p]] = static_cast<Index>(p);
    for (const auto& cell : hexahedra)
        for (const Index p : cell) number[set[p]] = 0;
    BlockHexahedra result;
    Index used = 0;
    for (Index& n : number)
        if (n == 0) n = used++;
    result.mesh.vertices.resize(used, 3);
    result.support.resize(used);
    for (Index s = 0; s < count; ++s) {
        if (number[s] < 0) continue;
        result.mesh.vertices.row(number[s]) = points_[best[s]].at.transpose();
        result.support[number[s]] = points_[best[s]].support;
    }
    result.mesh.hexahedra.resize(static_cast<Index>(hexahedra.size()), 8);
    std::vector<Index> collapsed;
    for (std::size_t h = 0; h < hexahedra.size(); ++h) {
        std::set<Index> corners;
        for (int k = 0; k < 8; ++k)
            corners.insert(result.mesh.hexahedra(static_cast<Index>(h), k) = number[set[hexahedra[h][k]]]);
        if (corners.size() < 8) collapsed.push_back(static_cast<Index>(h));
    }
    if (!collapsed.empty())
        throw GeometryError("hexahedra " + first_few(collapsed) +
                                " have a vertex twice, as arcs beside them have no edge; ask for more cells",
                            "collapsed_cell", collapsed);
    result.blocks = std::move(blocks);
    return result;
}

PatchGrids::PatchGrids(const SeamlessMap& map, const BlockComplex& blocks, const std::vector<int>& numbers,
                       GridPoints& points)
    : map_(map), blocks_(blocks), numbers_(numbers), points_(points), arc_points_(blocks.arcs.size()) {
    add_nodes();
    add_arcs();
}

// Nodes are the first and last points of their arcs.
void PatchGrids::add_nodes() {
    std::map<Index, std::uint8_t> support;
    for (const BlockArc& arc : blocks_.arcs)
        for (const Index node : {arc.vertices.front(), arc.vertices.back()}) {
            const std::uint8_t of_arc = arc.feature ? 2 : arc.boundary ? 1 : 0;
            support[node] = std::max(support[node], of_arc);
        }
    for (const Index corner : map_.corners)
        if (support.count(corner)) support[corner] = 3;
    std::map<Index, Index> point;
    for (const auto& [node, kind] : support)
        point[node] = points_.add(map_.mesh.vertices.row(node).transpose(), kind, PointOf::node);
    for (std::size_t a = 0; a < blocks_.arcs.size(); ++a) {
        const BlockArc& arc = blocks_.arcs[a];
        arc_points_[a] = {point.at(arc.vertices.front()), point.at(arc.vertices.back())};
        if (numbers_[a] == 0) points_.join(arc_points_[a][0], arc_points_[a][1]);
    }
}

void PatchGrids::add_arcs() {
    for (std::size_t a = 0; a < blocks_.arcs.size(); ++a) {
        const BlockArc& arc = blocks_.arcs[a];
        const std::uint8_t support = arc.feature ? 2 : arc.boundary ? 1 : 0;
        const Index last = arc_points_[a].back();
        arc_points_[a].pop_back();
        for (int k = 1; k < numbers_[a]; ++k) {
            const double at = arc.length() * k / numbers_[a];
            const auto above = std::upper_bound(arc.parameters.begin(), arc.parameters.end() - 1, at);
            const auto i = std::max<std::ptrdiff_t>(above - arc.parameters.begin(), 1);
            const double step = arc.parameters[i] - arc.parameters[i - 1];
            const double part = step > 0 ? (at - arc.parameters[i - 1]) / step : 0;
            const Eigen::Vector3d place = (1 - part) * map_.mesh.vertices.row(arc.vertices[i - 1]).transpose() +
                                          part * map_.mesh.vertices.row(arc.vertices[i]).transpose();
            arc_points_[a].push_back(points_.add(place, support, PointOf::arc));
        }
        if (numbers_[a] > 0) arc_points_[a].push_back(last);
    }
}

PatchGrids::Line PatchGrids::line(const std::vector<SideArc>& side, double low, double high) {
    Line result;
    double from = low;
    for (const SideArc& part : side) {
        std::vector<Index> points = arc_points_[part.arc];
        if (!part.along) std::reverse(points.begin(), points.end());
        const double length = blocks_.arcs[part.arc].length();
        for (std::size_t k = result.points.empty() ? 0 : 1; k < points.size(); ++k) {
            result.points.push_back(points[k]);
            result.places.push_back(from + length * static_cast<double>(k) / std::max(numbers_[part.arc], 1));
        }
        from += length;
    }
    result.places.back() = high;
    result.places.front() = low;
    return result;
}

PatchGrid PatchGrids::grid(const BlockPatch& patch) {
    PatchGrid grid;
    grid.size = patch_size(patch, numbers_);
    const auto [width, height] = grid.size;
    grid.points.assign(static_cast<std::size_t>(width + 1) * (height + 1), -1);
    const Line bottom = line(patch.sides[0], patch.low[0], patch.high[0]);
    const Line top = line(patch.sides[1], patch.low[0], patch.high[0]);
    const Line left = line(patch.sides[2], patch.low[1], patch.high[1]);
    const Line right = line(patch.sides[3], patch.low[1], patch.high[1]);
    const auto put = [&](int i, int j, Index point) {
        Index& known = grid.points[grid.at(i, j)];
        if (known < 0)
            known = point;
        else
            points_.join(known, point);
    };
    for (int i = 0; i <= width; ++i) {
        put(i, 0, bottom.points[i]);
        put(i, height, top.points[i]);
    }
    for (int j = 0; j <= height; ++j) {
        put(0, j, left.points[j]);
        put(width, j, right.points[j]);
    }
    // Straight lines between opposite sides; they cross once.
    const Eigen::Vector2d extent = patch.high - patch.low;
    const auto share = [&](const Line& line, int k, int along) {
        return (line.places[k] - patch.low[along]) / extent[along];
    };
    for (int i = 0; i <= width; ++i)
        for (int j = 0; j <= height; ++j) {
            const double a = share(left, j, 1), b = share(right, j, 1), c = share(bottom, i, 0), d = share(top, i, 0);
            const double u = (c + (d - c) * a) / (1 - (d - c) * (b - a)), v = a + (b - a) * u;
            grid.places.push_back(patch.low + extent.cwiseProduct(Eigen::Vector2d(u, v)));
        }
    place_inside(patch, grid);
    return grid;
}

void PatchGrids::place_inside(const BlockPatch& patch, PatchGrid& grid) {
    if (std::find(grid.points.begin(), grid.points.end(), -1) == grid.points.end()) return;
    const int axis = patch.places[0].side / 2;
    std::vector<SimplexSearch<2>::Simplex> triangles;
    for (const Index face : patch.faces) {
        SimplexSearch<2>::Simplex triangle;
        for (int k = 0; k < 3; ++k) {
            const auto& at = blocks_.places[blocks_.block_vertices(face / 4, tet_face[face % 4][k])];
            triangle[k] = {at[(axis + 1) % 3], at[(axis + 2) % 3]};
        }
        triangles.push_back(triangle);
    }
    const SimplexSearch<2> search(std::move(triangles));
    const std::uint8_t support = patch.places.size() == 1 ? 1 : 0;
    for (std::size_t p = 0; p < grid.points.size(); ++p) {
        if (grid.points[p] >= 0) continue;
        const auto found = search.find(grid.places[p]);
        const Index face = patch.faces[found.simplex];
        Eigen::Vector3d at = Eigen::Vector3d::Zero();
        for (int k = 0; k < 3; ++k)
            at +=
                found.weights[k] * map_.mesh.vertices.row(map_.mesh.tets(face / 4, tet_face[face % 4][k])).transpose();
        grid.points[p] = points_.add(at, support, PointOf::patch);
    }
}

}  // namespace octafield::volume::detail
