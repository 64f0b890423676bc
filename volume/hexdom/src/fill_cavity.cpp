#include "fill_cavity.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "flat_tets.hpp"
#include "octafield/disjoint_sets.hpp"
#include "octafield/error.hpp"
#include "octafield/volume/triangle_table.hpp"
#include "tetgen_run.hpp"

namespace octafield::volume {
namespace {

// Where TetGen fails in one way it may not in another: with points of the lattice inside or without, with bounds on the
// tets or without, with another tolerance for what is coplanar, turned so that nothing is aligned with the axes, points
// put in by a second run.
struct Way {
    bool inside, refine, turned;
    double tolerance;
    bool twice = false;
};
constexpr Way ways[] = {{true, true, false, 0},       {true, true, false, 1e-12}, {true, true, true, 0},
                        {true, true, false, 0, true}, {false, true, false, 0},    {false, true, true, 1e-6},
                        {false, false, false, 0},     {false, false, true, 1e-12}};

// TetGen's arithmetic is at its best round the origin, at sizes near 1.
struct Placement {
    Eigen::RowVector3d centre;
    double scale;
    Eigen::Matrix3d turn;

    Placement(const Points& points, bool turned) {
        const Eigen::RowVector3d low = points.colwise().minCoeff(), high = points.colwise().maxCoeff();
        centre = (low + high) / 2;
        scale = (high - low).maxCoeff();
        turn = turned
                   ? Eigen::AngleAxisd(0.7316, Eigen::Vector3d(0.3713, -0.6127, 0.6977).normalized()).toRotationMatrix()
                   : Eigen::Matrix3d::Identity();
    }
    Points there(const Points& points) const { return (points.rowwise() - centre) / scale * turn.transpose(); }
    Points back(const Points& points) const { return (points * turn * scale).rowwise() + centre; }
};

struct Side {
    std::array<Index, 3> sorted;
    Index triangle;
    bool even;  // the triangle runs through them in ascending cyclic order
};

bool runs_up(Index a, Index b, Index c) { return (a < b) + (b < c) + (c < a) == 2; }

std::array<Index, 3> ascending(Index a, Index b, Index c) {
    std::array<Index, 3> ids{a, b, c};
    std::sort(ids.begin(), ids.end());
    return ids;
}

double volume_inside(const Cavity& cavity) {
    const surface::TriangleMesh& mesh = cavity.mesh;
    double six = 0;
    for (Index t = 0; t < mesh.triangles.rows(); ++t) {
        if (cavity.two_sided[t]) continue;
        const auto p = [&](int k) -> Eigen::Vector3d {
            return mesh.vertices.row(mesh.triangles(t, k)) - mesh.vertices.row(0);
        };
        six += p(0).dot(p(1).cross(p(2)));
    }
    return std::abs(six) / 6;
}

// Vertices from `first` on that no tet has go.
void drop_unused(TetMesh& mesh, Index first) {
    std::vector<Index> number(mesh.vertices.rows(), -1), kept;
    for (Index v = 0; v < first; ++v) number[v] = v, kept.push_back(v);
    for (const Index v : mesh.tets.reshaped()) number[v] = 0;
    for (Index v = 0; v < static_cast<Index>(number.size()); ++v) {
        if (number[v] < 0 || v < first) continue;
        kept.push_back(v);
    }
    for (std::size_t i = 0; i < kept.size(); ++i) number[kept[i]] = static_cast<Index>(i);
    for (Index& v : mesh.tets.reshaped()) v = number[v];
    mesh.vertices = mesh.vertices(kept, Eigen::all).eval();
}

// Empty and a reason, where the way leads nowhere. flat: vertices of the surface on tets without volume are added.
TetMesh filled_in(const Cavity& cavity, const Way& way, std::string& reason, std::vector<Index>& flat,
                  const Progress& progress) {
    const Placement placement(cavity.mesh.vertices, way.turned);
    TetgenParameters parameters;
    parameters.radius_edge_ratio = 1.8;
    parameters.max_volume = 0.4 * std::pow(cavity.edge_length / placement.scale, 3);
    // Between faces far closer than their edges are long refinement would hardly end.
    const double cells = volume_inside(cavity) / std::pow(cavity.edge_length, 3);
    parameters.most_added =
        static_cast<int>(std::min(1e9, 2000 + 3 * (cells + static_cast<double>(cavity.mesh.vertices.rows()))));
    parameters.refine = way.refine && (cavity.refine || !way.inside);
    parameters.inside_later = way.twice;
    parameters.most_seconds =
        20 + static_cast<int>(0.0005 * static_cast<double>(cavity.mesh.vertices.rows() + cavity.inside.rows()));
    parameters.tolerance = way.tolerance;
    if (way.inside && cavity.inside.rows() > 0) parameters.inside = placement.there(cavity.inside);
    for (const Eigen::Vector3d& hole : cavity.holes)
        parameters.holes.push_back(placement.turn * (hole - placement.centre.transpose()) / placement.scale);
    TetgenOutcome outcome =
        run_tetgen({placement.there(cavity.mesh.vertices), cavity.mesh.triangles}, parameters, progress);
    TetMesh& mesh = outcome.mesh;
    const Eigen::Index known = cavity.mesh.vertices.rows();
    reason = outcome.reason;
    if (outcome.out_of_time)
        throw SolverError("filling the space between the hexahedra and the surface with tets was stopped after " +
                              std::to_string(parameters.most_seconds) +
                              " s: the part is far thinner than the cells are long, or has slivers; give an edge "
                              "length nearer to the thickness",
                          "tetgen_time");
    if (!outcome.finished) return {};
    reason = "it did not keep the surface";
    if (mesh.tets.rows() == 0 || mesh.vertices.rows() < known) return {};
    mesh.vertices = placement.back(mesh.vertices);
    mesh.vertices.topRows(known) = cavity.mesh.vertices;
    const Eigen::VectorXd volumes = tet_volumes(mesh);
    for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t)
        if (volumes[t] < 0) std::swap(mesh.tets(t, 2), mesh.tets(t, 3));
    const std::vector<Index> inside = tets_inside(mesh, cavity.mesh, cavity.two_sided);
    if (inside.empty()) return {};
    mesh.tets = mesh.tets(inside, Eigen::all).eval();
    reason = "it left tets without volume";
    const std::vector<Index> without_volume = flat_tets(mesh, flat_for_tetgen);
    for (const Index tet : without_volume)
        for (const Index v : mesh.tets.row(tet))
            if (v < known) flat.push_back(v);
    if (!without_volume.empty()) return {};
    drop_unused(mesh, static_cast<Index>(known));
    return std::move(mesh);
}

}  // namespace

std::vector<Index> tets_inside(const TetMesh& mesh, const surface::TriangleMesh& surface,
                               const std::vector<std::uint8_t>& two_sided) {
    TriangleTable table;
    try {
        table = triangle_table(mesh);
    } catch (const GeometryError&) {  // three tets at a triangle
        return {};
    }
    std::vector<Side> walls;
    for (Index t = 0; t < surface.triangles.rows(); ++t) {
        const auto row = surface.triangles.row(t);
        walls.push_back({ascending(row[0], row[1], row[2]), t, runs_up(row[0], row[1], row[2])});
    }
    std::sort(walls.begin(), walls.end(), [](const Side& x, const Side& y) { return x.sorted < y.sorted; });
    DisjointSets parts(mesh.tets.rows());
    // Per tet: a triangle has it on its inner side, its outer side. Of each triangle, sides that have been seen.
    std::vector<std::uint8_t> inner(mesh.tets.rows(), 0), outer(mesh.tets.rows(), 0), seen(surface.triangles.rows(), 0);
    for (Eigen::Index row = 0; row < table.triangles.rows(); ++row) {
        const auto ids = table.triangles.row(row);
        const std::array<Index, 3> sorted = ascending(ids[0], ids[1], ids[2]);
        const auto wall = std::lower_bound(walls.begin(), walls.end(), sorted,
                                           [](const Side& x, const auto& key) { return x.sorted < key; });
        const bool is_wall = wall != walls.end() && wall->sorted == sorted;
        if (!is_wall && table.sides(row, 1) >= 0) parts.join(table.sides(row, 0) / 4, table.sides(row, 1) / 4);
        if (!is_wall && table.sides(row, 1) < 0) outer[table.sides(row, 0) / 4] = 1;  // the hull's
        for (int s = 0; is_wall && s < 2; ++s) {
            const Index side = table.sides(row, s);
            if (side < 0) continue;
            const Index tet = side / 4;
            const auto& face = tet_face[side % 4];
            const bool inward =
                runs_up(mesh.tets(tet, face[0]), mesh.tets(tet, face[1]), mesh.tets(tet, face[2])) == wall->even;
            seen[wall->triangle] |= inward ? 1 : 2;
            (inward || two_sided[wall->triangle] ? inner : outer)[tet] = 1;
        }
    }
    for (std::size_t t = 0; t < seen.size(); ++t)
        if (two_sided[t] ? seen[t] != 3 : !(seen[t] & 1)) return {};
    std::vector<std::uint8_t> part_inner(mesh.tets.rows(), 0), part_outer(mesh.tets.rows(), 0);
    for (Index t = 0; t < mesh.tets.rows(); ++t) {
        part_inner[parts.lowest(t)] |= inner[t];
        part_outer[parts.lowest(t)] |= outer[t];
    }
    std::vector<Index> inside;
    for (Index t = 0; t < mesh.tets.rows(); ++t) {
        const Index part = parts.lowest(t);
        if (part_inner[part] && part_outer[part]) return {};
        if (part_inner[part]) inside.push_back(t);
    }
    return inside;
}

TetMesh fill_cavity(const Cavity& cavity, const Progress& progress) {
    std::string reason;
    std::vector<Index> flat;
    for (const Way& way : ways) {
        TetMesh mesh = filled_in(cavity, way, reason, flat, progress);
        if (mesh.tets.rows() > 0) return mesh;
    }
    std::sort(flat.begin(), flat.end());
    flat.erase(std::unique(flat.begin(), flat.end()), flat.end());
    throw GeometryError("the space between the hexahedra and the surface could not be filled with tets: " + reason +
                            "; give another edge length",
                        "tetgen_failed", flat);
}

}  // namespace octafield::volume
