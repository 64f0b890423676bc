#include "charted_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "charts.hpp"
#include "layout_pieces.hpp"
#include "octafield/error.hpp"
#include "patch_map.hpp"
#include "quad_rows.hpp"

namespace octafield::surface::detail {
namespace {

const GridPoint ways[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};

class Charting {
public:
    Charting(const QuadLayout& layout, const Seams& seams, const GridCounts& counts)
        : layout_(layout), pieces_(*layout.pieces), cut_(pieces_.cut), seams_(seams), counts_(counts) {
        lay_out_tiles();
        lay_out_seams();
    }

    ChartedMesh mesh() && {
        const TriangleMesh& surface = layout_.domain.mesh();
        for (Index v = 0; v < layout_.domain.vertex_count(); ++v) mesh_.positions.emplace_back(surface.vertices.row(v));
        mesh_.triangles.resize(layout_.domain.triangle_count());
        for (Index t = 0; t < layout_.domain.triangle_count(); ++t) {
            mesh_.origins.push_back(t);
            for (int k = 0; k < 3; ++k) mesh_.triangles[t][k] = surface.triangles(t, k);
        }
        place_polygons();
        join_triangles();
        turn_planes();
        find_fixed();
        find_start();
        return std::move(mesh_);
    }

private:
    void lay_out_tiles();
    void lay_out_seams();
    void place_polygons();
    void join_triangles();
    void turn_planes();
    void spread_turns(Index start, std::vector<bool>& turned, std::vector<Index>& part);
    std::array<double, 4> votes(const std::vector<Index>& part) const;
    Complex in_plane(Index t, const Eigen::Vector3d& vector) const {
        return vector_by_own_lengths(layout_.domain, t, vector);
    }
    // In quarters of a turn, from the field's step in the triangle.
    double turn_from_step(Index t, const Eigen::Vector3d& vector) const {
        return std::arg(in_plane(t, vector) / in_plane(t, pieces_.steps.row(t))) / (std::numbers::pi / 2);
    }
    void find_fixed();
    void find_start();
    void add_seam(Index side, Index polygon, Index c);
    // From the tile on this side of a polygon to the one across.
    QuarterTurn across(Index c) const {
        const Index mate = cut_.mates[c];
        if (!cut_.is_cut[c]) return {};
        return QuarterTurn::taking(ray_[pieces_.chain_of_side[c]][!pieces_.forward[c]],
                                   ray_[pieces_.chain_of_side[mate]][!pieces_.forward[mate]]);
    }
    int side_on(Index t, Index polygon, Index c) const;

    const QuadLayout& layout_;
    const LayoutPieces& pieces_;
    const CutSurface& cut_;
    const Seams& seams_;
    const GridCounts& counts_;
    ChartedMesh mesh_;
    std::vector<std::array<GridRay, 2>>
        ray_;  // of each arc, run in either sense by the tile on its left: along the arc
    std::vector<std::array<GridPoint, 4>> corners_;  // of each tile
    std::vector<std::vector<int>> at_stop_;          // of each seam
    std::vector<std::vector<double>> lengths_;       // up to each node of boundary arcs
    std::vector<Index> polygon_of_;                  // of each polygon's corner
    std::vector<std::vector<Index>> polygons_;       // of each triangle
    std::vector<QuarterTurn> to_triangle_;           // of each polygon: from its tile's plane
};

void Charting::lay_out_tiles() {
    ray_.resize(layout_.sides.size());
    for (const LayoutPatch& patch : layout_.patches) {
        const auto sides = four_sides(patch);
        GridPoint at(0, 0);
        corners_.emplace_back();
        for (int k = 0; k < 4; ++k) {
            corners_.back()[k] = at;
            for (const DirectedSide& s : sides[k]) {
                const GridPoint end = at + counts_.arcs[s.side] * ways[k];
                ray_[s.side][s.reversed] = s.reversed ? GridRay{end, -ways[k]} : GridRay{at, ways[k]};
                at = end;
            }
        }
        if (at != GridPoint(0, 0)) throw GeometryError("numbers on sides of a patch differ", "bad_subdivision");
    }
}

void Charting::lay_out_seams() {
    for (const Seam& seam : seams_.seams) {
        at_stop_.push_back({0});
        for (Index i = 0; i < seam.part_count(); ++i)
            at_stop_.back().push_back(at_stop_.back().back() + counts_.parts[seam.first_part + i]);
        mesh_.seams.push_back({at_stop_.back().back(), seam.length, seam.closed});
    }
    lengths_.resize(layout_.sides.size());
    for (std::size_t s = 0; s < layout_.sides.size(); ++s) {
        if (seams_.uses[s].empty()) continue;
        const Points& points = layout_.sides[s].points;
        lengths_[s] = {0};
        for (Eigen::Index i = 1; i < points.rows(); ++i)
            lengths_[s].push_back(lengths_[s].back() + (points.row(i) - points.row(i - 1)).norm());
    }
}

// The plane of a triangle is that of its first polygon's tile.
void Charting::place_polygons() {
    polygon_of_.resize(cut_.nodes.size());
    to_triangle_.resize(cut_.polygon_count());
    std::vector<bool> placed(cut_.polygon_count(), false);
    for (Index p = 0; p < cut_.polygon_count(); ++p)
        for (Index c = cut_.first[p]; c < cut_.first[p + 1]; ++c) polygon_of_[c] = p;
    for (Index start = 0; start < cut_.polygon_count(); ++start) {
        if (start > 0 && cut_.triangles[start] == cut_.triangles[start - 1]) {
            if (!placed[start]) throw GeometryError("a triangle's polygons do not hang together", "bad_subdivision");
            continue;
        }
        std::vector<Index> front = {start};
        placed[start] = true;
        for (std::size_t i = 0; i < front.size(); ++i)
            for (Index c = cut_.first[front[i]]; c < cut_.first[front[i] + 1]; ++c) {
                const Index mate = cut_.mates[c];
                if (mate < 0) continue;
                const Index other = polygon_of_[mate];
                if (placed[other] || cut_.triangles[other] != cut_.triangles[start]) continue;
                placed[other] = true;
                to_triangle_[other] = to_triangle_[front[i]].after(across(c).inverse());
                front.push_back(other);
            }
    }
}

// On which side of the triangle a side of a polygon lies.
int Charting::side_on(Index t, Index polygon, Index c) const {
    const Index a = cut_.nodes[c], b = cut_.nodes[cut_.next(polygon, c)];
    for (int k = 0; k < 3; ++k) {
        const auto& inner = cut_.edge_nodes[layout_.domain.topology().triangle_edges(t, k)];
        const auto is_inner = [&](Index n) { return std::find(inner.begin(), inner.end(), n) != inner.end(); };
        if ((a == mesh_.triangles[t][k] || is_inner(a)) && (b == mesh_.triangles[t][(k + 1) % 3] || is_inner(b)))
            return k;
    }
    throw GeometryError("a side of a polygon is on no side of its triangle", "bad_subdivision");
}

void Charting::join_triangles() {
    const std::size_t sides = 3 * mesh_.triangles.size();
    mesh_.mates.assign(sides, -1);
    mesh_.across.resize(sides);
    mesh_.on_seams.resize(sides);
    for (Index p = 0; p < cut_.polygon_count(); ++p)
        for (Index c = cut_.first[p]; c < cut_.first[p + 1]; ++c) {
            const Index t = cut_.triangles[p], mate = cut_.mates[c];
            if (mate >= 0 && cut_.triangles[polygon_of_[mate]] == t) continue;
            const Index side = 3 * t + side_on(t, p, c);
            if (mate < 0) {
                add_seam(side, p, c);
                continue;
            }
            const Index q = polygon_of_[mate];
            mesh_.mates[side] = 3 * cut_.triangles[q] + side_on(cut_.triangles[q], q, mate);
            mesh_.across[side] = to_triangle_[q].after(across(c)).after(to_triangle_[p].inverse());
        }
}

// The line by whole numbers along the seam, which of a closed one are those from its start to its end.
void Charting::add_seam(Index side, Index polygon, Index c) {
    const Index arc = pieces_.chain_of_side[c], part = pieces_.part_of_side[c];
    const double middle = (lengths_[arc][part] + lengths_[arc][part + 1]) / 2;
    int steps = 0, after = 0;
    const SeamUse* use = nullptr;
    for (const SeamUse& u : seams_.uses[arc]) {
        if (use != nullptr && u.before > middle) break;
        use = &u;
        steps = after;
        after += counts_.parts[u.part];
    }
    const Seam& seam = seams_.seams[use->seam];
    const Index i = use->part - seam.first_part;
    const int low = at_stop_[use->seam][i], high = at_stop_[use->seam][i + 1];
    const GridRay& ray = ray_[arc][0];
    const int sense = use->forward ? 1 : -1;
    GridRay line{ray.point(steps - (use->forward ? low : -high)), sense * ray.way};
    const double start = use->forward ? seam.stops[i].at - use->before : seam.stops[i + 1].at + use->before;
    double from = start + sense * lengths_[arc][part], to = start + sense * lengths_[arc][part + 1];
    if (seam.closed && (from + to) / 2 > seam.length) {
        line.at += mesh_.seams[use->seam].count * line.way;
        from -= seam.length;
        to -= seam.length;
    }
    ChartedMesh::OnSeam& on = mesh_.on_seams[side];
    const bool is_new = on.seam < 0;
    line = to_triangle_[polygon](line);
    if (!is_new && (on.seam != use->seam || !(on.line == line)))
        throw GeometryError("a side of a triangle lies on two lines", "bad_subdivision");
    if (is_new) on = {use->seam, line, from, to, -1};
    if (cut_.nodes[c] == mesh_.from(side)) on.from = from;
    if (cut_.nodes[cut_.next(polygon, c)] == mesh_.from(ChartedMesh::next(side))) on.to = to;
}

// Directions are carried from triangle to triangle; how all of them are turned against the planes is what most curves
// say.
void Charting::turn_planes() {
    mesh_.quarters.assign(mesh_.triangles.size(), 0);
    polygons_.resize(mesh_.triangles.size());
    for (Index p = 0; p < cut_.polygon_count(); ++p) polygons_[cut_.triangles[p]].push_back(p);
    std::vector<bool> turned(mesh_.triangles.size(), false);
    for (Index start = 0; start < static_cast<Index>(mesh_.triangles.size()); ++start) {
        if (turned[start]) continue;
        std::vector<Index> part;
        spread_turns(start, turned, part);
        const auto sums = votes(part);
        const auto most = static_cast<int>(std::max_element(sums.begin(), sums.end()) - sums.begin());
        for (const Index t : part) mesh_.quarters[t] = (mesh_.quarters[t] + most) & 3;
    }
}

void Charting::spread_turns(Index start, std::vector<bool>& turned, std::vector<Index>& part) {
    part = {start};
    turned[start] = true;
    for (std::size_t i = 0; i < part.size(); ++i)
        for (int k = 0; k < 3; ++k) {
            const Index side = 3 * part[i] + k, mate = mesh_.mates[side];
            if (mate < 0 || turned[mate / 3]) continue;
            const Eigen::Vector3d edge = mesh_.positions[mesh_.from(mate)] - mesh_.positions[mesh_.from(side)];
            const auto apart =
                static_cast<int>(std::lround(turn_from_step(part[i], edge) - turn_from_step(mate / 3, edge)));
            mesh_.quarters[mate / 3] = (mesh_.quarters[part[i]] - apart - mesh_.across[side].quarters) & 3;
            turned[mate / 3] = true;
            part.push_back(mate / 3);
        }
}

std::array<double, 4> Charting::votes(const std::vector<Index>& part) const {
    std::array<double, 4> result{};
    for (const Index t : part)
        for (const Index p : polygons_[t])
            for (Index c = cut_.first[p]; c < cut_.first[p + 1]; ++c) {
                if (!cut_.is_cut[c]) continue;
                const Eigen::Vector3d way =
                    cut_.positions.row(cut_.nodes[cut_.next(p, c)]) - cut_.positions.row(cut_.nodes[c]);
                const GridRay& ray = ray_[pieces_.chain_of_side[c]][!pieces_.forward[c]];
                const GridPoint step = (pieces_.forward[c] ? 1 : -1) * turned(ray.way, to_triangle_[p].quarters);
                const auto axis = static_cast<int>(std::find(ways, ways + 4, step) - ways);
                const auto found = static_cast<int>(std::lround(turn_from_step(t, way))) - axis;
                result[(found - mesh_.quarters[t]) & 3] += way.norm();
            }
    return result;
}

void Charting::find_fixed() {
    std::set<Index> done;
    for (std::size_t patch = 0; patch < pieces_.loops.size(); ++patch) {
        int k = 0;
        for (const Index c : pieces_.loops[patch][0]) {
            if (!pieces_.turns[c]) continue;
            const Index vertex = pieces_.vertex_of_node[cut_.nodes[c]], p = polygon_of_[c], t = cut_.triangles[p];
            const LayoutVertex& at = layout_.vertices[vertex];
            const GridPoint place = corners_[patch][k++];
            if (at.kind != LayoutVertexKind::singular && at.kind != LayoutVertexKind::crossing) continue;
            if (at.vertex < 0 || !done.insert(at.vertex).second) continue;
            const auto& corners = mesh_.triangles[t];
            const auto which = std::find(corners.begin(), corners.end(), at.vertex) - corners.begin();
            if (which == 3) throw GeometryError("a corner of a tile is at no vertex", "bad_subdivision");
            mesh_.fixed.push_back(
                {static_cast<Index>(3 * t + which), to_triangle_[p](place), at.kind == LayoutVertexKind::singular});
        }
    }
    std::sort(mesh_.fixed.begin(), mesh_.fixed.end(), [](const auto& a, const auto& b) { return a.corner < b.corner; });
}

void Charting::find_start() {
    mesh_.start.assign(mesh_.side_count(), Vector2::Zero());
    for (std::size_t patch = 0; patch < layout_.patches.size(); ++patch) {
        const PatchMap map = patch_map(layout_, static_cast<Index>(patch), counts_.along);
        const Vector2 size = corners_[patch][2].cast<double>();
        std::map<Index, Vector2> place_of;
        for (std::size_t i = 0; i < map.nodes.size(); ++i)
            if (map.nodes[i] >= 0 && map.nodes[i] < layout_.domain.vertex_count())
                place_of[map.nodes[i]] =
                    Vector2(map.parameters(i, 0) / map.width * size[0], map.parameters(i, 1) / map.height * size[1]);
        for (const Index p : pieces_.patch_polygons[patch])
            for (Index c = cut_.first[p]; c < cut_.first[p + 1]; ++c) {
                const auto found = place_of.find(cut_.nodes[c]);
                if (found == place_of.end()) continue;
                const auto& corners = mesh_.triangles[cut_.triangles[p]];
                const auto k = std::find(corners.begin(), corners.end(), cut_.nodes[c]) - corners.begin();
                mesh_.start[3 * cut_.triangles[p] + k] = to_triangle_[p](found->second);
            }
    }
}

}  // namespace

ChartedMesh charted_mesh(const QuadLayout& layout, const Seams& seams, const GridCounts& counts) {
    ChartedMesh mesh = Charting(layout, seams, counts).mesh();
    mesh.match_seams();
    return mesh;
}

}  // namespace octafield::surface::detail
