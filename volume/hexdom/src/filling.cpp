#include "filling.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

#include "fill_cavity.hpp"
#include "near_grid.hpp"
#include "octafield/disjoint_sets.hpp"
#include "octafield/error.hpp"
#include "surface_guide.hpp"
#include "triangle_tests.hpp"

namespace octafield::volume {
namespace {

using Quad = std::array<Index, 4>;
using Triple = std::array<Index, 3>;

template <std::size_t N>
std::array<Index, N> ascending(std::array<Index, N> ids) {
    std::sort(ids.begin(), ids.end());
    return ids;
}

// A face of hexahedra: of one, or between two.
struct HexahedronFace {
    Quad sorted, round;  // round: outward of the first
    Index cell, other;   // other: -1
};

std::vector<HexahedronFace> faces_of(const Hexahedra& hexahedra) {
    std::vector<HexahedronFace> all;
    for (Index k = 0; k < hexahedra.rows(); ++k)
        for (const auto& face : cell_face) {
            Quad round;
            for (int c = 0; c < 4; ++c) round[c] = hexahedra(k, face[c]);
            all.push_back({ascending(round), round, k, -1});
        }
    std::stable_sort(all.begin(), all.end(), [](const auto& x, const auto& y) { return x.sorted < y.sorted; });
    std::vector<HexahedronFace> faces;
    for (const HexahedronFace& face : all) {
        if (!faces.empty() && faces.back().sorted == face.sorted && faces.back().other < 0)
            faces.back().other = face.cell;
        else
            faces.push_back(face);
    }
    return faces;
}

// Numbers of groups of triangles: the regions on their sides.
std::vector<Index> groups_of(const TetDomain& domain) {
    std::map<std::pair<Index, Index>, Index> numbers;
    std::vector<Index> groups;
    for (Eigen::Index f = 0; f < domain.sides().rows(); ++f) {
        const auto region = [&](Index tet) {
            return tet < 0 ? Index(-1) : domain.regions().empty() ? Index(0) : domain.regions()[tet];
        };
        const std::pair key(region(domain.sides()(f, 0)), domain.sides()(f, 1) < 0 ? -1 : region(domain.sides()(f, 1)));
        groups.push_back(numbers.emplace(key, static_cast<Index>(numbers.size())).first->second);
    }
    return groups;
}

// The surface of what tets fill.
struct CavitySurface {
    surface::TriangleMesh mesh;           // compact
    std::vector<Index> vertex;            // of all
    std::vector<Index> cell;              // per triangle: the hexahedron whose face it is of, or -1
    std::vector<Index> triangle;          // per triangle of the surface: its number there, or -1
    std::vector<std::uint8_t> two_sided;  // per triangle: between regions, no hexahedron on either side
};

class CavityOfCells {
public:
    explicit CavityOfCells(CellsOnSurface& cells) : cells_(cells) {
        for (Index q = 0; q < cells.quads.rows(); ++q)
            quads_.push_back(
                {ascending(Quad{cells.quads(q, 0), cells.quads(q, 1), cells.quads(q, 2), cells.quads(q, 3)}), q});
        std::sort(quads_.begin(), quads_.end());
        const Triangles& triangles = cells.surface.mesh.triangles;
        for (Index t = 0; t < triangles.rows(); ++t)
            triples_.push_back({ascending(Triple{triangles(t, 0), triangles(t, 1), triangles(t, 2)}), t});
        std::sort(triples_.begin(), triples_.end());
    }

    void drop(const std::vector<std::uint8_t>& dropped) {
        std::vector<Index> kept;
        for (Index k = 0; k < cells_.hexahedra.rows(); ++k)
            if (!dropped[k]) kept.push_back(k);
        cells_.crossing += static_cast<Index>(cells_.hexahedra.rows() - static_cast<Eigen::Index>(kept.size()));
        cells_.hexahedra = cells_.hexahedra(kept, Eigen::all).eval();
    }

    // Hexahedra with a face on the surface that is no pair of its triangles.
    std::vector<std::uint8_t> without_quad() const {
        std::vector<std::uint8_t> found(cells_.hexahedra.rows(), 0);
        for (const HexahedronFace& face : faces_of(cells_.hexahedra)) {
            const Index q = quad(face.sorted);
            if (q >= 0 && halves(face.round).empty()) {
                found[face.cell] = 1;
                if (face.other >= 0) found[face.other] = 1;
            }
        }
        return found;
    }

    CavitySurface surface() const {
        std::vector<std::uint8_t> covered(cells_.surface.mesh.triangles.rows(), 0);
        std::vector<Triple> triangles;
        std::vector<Index> owners;
        for (const HexahedronFace& face : faces_of(cells_.hexahedra)) {
            const std::vector<Index> on_surface = quad(face.sorted) < 0 ? std::vector<Index>() : halves(face.round);
            for (const Index t : on_surface) covered[t] = 1;
            if (face.other >= 0) continue;
            if (!on_surface.empty()) {
                // Between regions, with tets on the other side.
                for (const Index t : on_surface)
                    if (cells_.two_sided[t]) {
                        triangles.push_back(inward(t, face.round));
                        owners.push_back(face.cell);
                    }
                continue;
            }
            const auto& [a, b, c, d] = face.round;
            // Inward of the cavity's other side: the face seen from the cavity. The diagonal that stands out of the
            // hexahedron, so that a pyramid fits on the face.
            const std::array<Triple, 2> halves = ridge(a, c, b, d) ? std::array<Triple, 2>{{{a, c, b}, {a, d, c}}}
                                                                   : std::array<Triple, 2>{{{a, d, b}, {b, d, c}}};
            for (const Triple& half : halves) {
                triangles.push_back(half);
                owners.push_back(face.cell);
            }
        }
        CavitySurface result;
        std::vector<Index> number(cells_.vertices.rows(), -1);
        const auto local = [&](Index v) {
            if (number[v] < 0) {
                number[v] = static_cast<Index>(result.vertex.size());
                result.vertex.push_back(v);
            }
            return number[v];
        };
        std::vector<Triple> all;
        for (Index t = 0; t < cells_.surface.mesh.triangles.rows(); ++t) {
            if (covered[t]) continue;
            const auto row = cells_.surface.mesh.triangles.row(t);
            all.push_back({local(row[0]), local(row[1]), local(row[2])});
            result.cell.push_back(-1);
            result.triangle.push_back(t);
            result.two_sided.push_back(cells_.two_sided[t]);
        }
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            all.push_back({local(triangles[i][0]), local(triangles[i][1]), local(triangles[i][2])});
            result.cell.push_back(owners[i]);
            result.triangle.push_back(-1);
            result.two_sided.push_back(0);
        }
        result.mesh.triangles.resize(static_cast<Eigen::Index>(all.size()), 3);
        for (std::size_t i = 0; i < all.size(); ++i)
            for (int k = 0; k < 3; ++k) result.mesh.triangles(static_cast<Eigen::Index>(i), k) = all[i][k];
        result.mesh.vertices = cells_.vertices(result.vertex, Eigen::all);
        return result;
    }

    // One point in each part of hexahedra that faces connect.
    std::vector<Eigen::Vector3d> holes() const {
        DisjointSets sets(cells_.hexahedra.rows());
        for (const HexahedronFace& face : faces_of(cells_.hexahedra))
            if (face.other >= 0) sets.join(face.cell, face.other);
        std::vector<Eigen::Vector3d> points;
        for (Index k = 0; k < cells_.hexahedra.rows(); ++k)
            if (sets.lowest(k) == k)
                points.push_back(cells_.vertices(cells_.hexahedra.row(k), Eigen::all).colwise().mean().transpose());
        return points;
    }

    // Hexahedra with a face to the cavity.
    std::vector<std::uint8_t> beside() const {
        std::vector<std::uint8_t> found(cells_.hexahedra.rows(), 0);
        for (const Index cell : surface().cell)
            if (cell >= 0) found[cell] = 1;
        return found;
    }

private:
    // A triangle of the surface that is half of a hexahedron's quad, turned as seen from the other side.
    Triple inward(Index t, const Quad& round) const {
        const auto row = cells_.surface.mesh.triangles.row(t);
        const auto place = [&](int k) { return std::find(round.begin(), round.end(), row[k]) - round.begin(); };
        const auto a = place(0), b = place(1), c = place(2);
        const bool outward = (a < b) + (b < c) + (c < a) == 2;
        return outward ? Triple{row[0], row[2], row[1]} : Triple{row[0], row[1], row[2]};
    }
    Index quad(const Quad& sorted) const {
        const auto found = std::lower_bound(quads_.begin(), quads_.end(), std::pair(sorted, Index(0)));
        return found != quads_.end() && found->first == sorted ? found->second : -1;
    }
    // The two triangles of the surface that make the quad, or none.
    std::vector<Index> halves(const Quad& q) const {
        const auto triple = [&](Index a, Index b, Index c) {
            const Triple sorted = ascending(Triple{a, b, c});
            const auto found = std::lower_bound(triples_.begin(), triples_.end(), std::pair(sorted, Index(0)));
            return found != triples_.end() && found->first == sorted ? found->second : -1;
        };
        for (int k = 0; k < 2; ++k) {
            const Index one = triple(q[k], q[k + 1], q[k + 2]), other = triple(q[k], q[k + 2], q[(k + 3) % 4]);
            if (one >= 0 && other >= 0) return {one, other};
        }
        return {};
    }
    // Seen along the outward normal, is the diagonal ac above bd?
    bool ridge(Index a, Index c, Index b, Index d) const {
        const auto p = [&](Index v) { return Eigen::Vector3d(cells_.vertices.row(v)); };
        const Eigen::Vector3d ac = p(c) - p(a), bd = p(d) - p(b);
        return ac.cross(bd).dot(p(a) + p(c) - p(b) - p(d)) >= 0;
    }

    CellsOnSurface& cells_;
    std::vector<std::pair<Quad, Index>> quads_;
    std::vector<std::pair<Triple, Index>> triples_;
};

// Hexahedra whose faces cross something are left out until none does.
CavitySurface sound_surface(CellsOnSurface& cells, CavityOfCells& cavity) {
    for (;;) {
        CavitySurface surface = cavity.surface();
        const std::vector<Index> crossing = surface::intersecting_triangles(surface.mesh);
        if (crossing.empty()) return surface;
        std::vector<std::uint8_t> dropped(cells.hexahedra.rows(), 0);
        bool any = false;
        for (const Index t : crossing)
            if (surface.cell[t] >= 0) dropped[surface.cell[t]] = 1, any = true;
        if (!any) {
            std::vector<Index> old;
            for (const Index t : crossing) old.push_back(cells.surface.triangle[surface.triangle[t]]);
            throw GeometryError("the surface through the points of the lattice crosses itself near triangles " +
                                    first_few(old) + " of the domain's surface; give a smaller edge length there",
                                "self_intersection", old);
        }
        cavity.drop(dropped);
    }
}

// Without hexahedra that have one of the points of the surface.
LatticeCells without(const LatticeCells& cells, const LatticeSurface& lattice, const std::vector<Index>& points) {
    std::vector<std::uint8_t> bad(cells.points.rows(), 0);
    for (const Index i : points) bad[lattice.lattice_point[i]] = 1;
    std::vector<Index> kept;
    for (Index k = 0; k < cells.hexahedra.rows(); ++k) {
        const auto corners = cells.hexahedra.row(k);
        if (std::none_of(corners.begin(), corners.end(), [&](Index p) { return bad[p]; })) kept.push_back(k);
    }
    LatticeCells result = cells;
    result.hexahedra = cells.hexahedra(kept, Eigen::all);
    for (std::size_t i = 0; i < kept.size(); ++i) result.on_surface[i] = cells.on_surface[kept[i]];
    result.on_surface.resize(kept.size());
    return result;
}

// Points of the lattice inside that are no vertices, apart from those and from one another.
void add_spare(CellsOnSurface& result, const TetDomain& domain, const LatticeCells& cells, const EdgeLengths& lengths,
               const std::vector<Index>& number) {
    NearGrids taken(0.6 * lengths.shortest(), 0.6 * lengths.longest());
    for (Index v = 0; v < result.vertices.rows(); ++v) taken.add(v, result.vertices.row(v));
    std::vector<Index> spare;
    std::vector<double> length;
    for (Index p = 0; p < cells.points.rows(); ++p) {
        if (number[p] >= 0) continue;
        const double there = lengths.between(domain.mesh().tets.row(cells.tet[p]), cells.weights.row(p));
        if (!cells.apart && taken.any(cells.points.row(p), 0.6 * there)) continue;
        spare.push_back(p);
        length.push_back(there);
        taken.add(p, cells.points.row(p));
    }
    result.spare = cells.points(spare, Eigen::all);
    result.spare_length = Eigen::Map<const Eigen::VectorXd>(length.data(), static_cast<Eigen::Index>(length.size()));
}

// Spare points not close to a face of what is filled: these would be corners of slivers, and in a thin part, where most
// are such, TetGen would take seconds for a thousand of them.
Points apart_from(const surface::TriangleMesh& faces, const CellsOnSurface& cells) {
    if (cells.spare.rows() == 0) return cells.spare;
    const detail::SurfaceGuide guide(faces, {});
    std::vector<Index> kept;
    for (Index p = 0; p < cells.spare.rows(); ++p) {
        const Eigen::Vector3d at = cells.spare.row(p);
        if ((guide.nearest_on_surface(at).point - at).norm() > 0.25 * cells.spare_length[p]) kept.push_back(p);
    }
    return cells.spare(kept, Eigen::all);
}

}  // namespace

CellsOnSurface cells_on_surface(const TetDomain& domain, const LatticeCells& cells, const EdgeLengths& lengths,
                                const std::vector<std::uint8_t>& stays) {
    const LatticeSurface lattice = lattice_surface(domain, cells, lengths);
    CellsOnSurface result;
    result.edge_length = lengths.longest();
    result.apart = cells.apart;
    result.quads = lattice.quads;
    try {
        result.surface =
            point_surface(domain.surface().mesh, domain.features(), groups_of(domain), lattice.points, lattice.quads,
                          lengths.longest(), stays, lengths.of(domain.surface().vertex_map));
    } catch (const InvalidInput& error) {
        if (error.kind() != "coincident_points") throw;
        const LatticeCells fewer = without(cells, lattice, error.elements());
        if (fewer.hexahedra.rows() == cells.hexahedra.rows())
            throw GeometryError("points of the lattice lie at one place of the surface; give another edge length",
                                "coincident_points");
        return cells_on_surface(domain, fewer, lengths, stays);
    }
    for (const Index t : result.surface.triangle) result.two_sided.push_back(domain.sides()(t, 1) >= 0);
    const Index on_surface = static_cast<Index>(result.surface.mesh.vertices.rows());
    std::vector<Index> number(cells.points.rows(), -1), inner;
    for (std::size_t i = 0; i < lattice.lattice_point.size(); ++i)
        number[lattice.lattice_point[i]] = static_cast<Index>(i);
    result.hexahedra = cells.hexahedra;
    for (Index& p : result.hexahedra.reshaped<Eigen::RowMajor>()) {
        if (number[p] < 0) {
            number[p] = on_surface + static_cast<Index>(inner.size());
            inner.push_back(p);
        }
        p = number[p];
    }
    result.vertices.resize(on_surface + static_cast<Eigen::Index>(inner.size()), 3);
    result.vertices.topRows(on_surface) = result.surface.mesh.vertices;
    result.vertices.bottomRows(static_cast<Eigen::Index>(inner.size())) = cells.points(inner, Eigen::all);
    add_spare(result, domain, cells, lengths, number);
    return result;
}

void leave_out(CellsOnSurface& cells, const std::vector<std::uint8_t>& marked) { CavityOfCells(cells).drop(marked); }

std::vector<std::uint8_t> beside_cavity(CellsOnSurface& cells) { return CavityOfCells(cells).beside(); }

MixedMesh filled(CellsOnSurface& cells, const Progress& progress) {
    CavityOfCells cavity(cells);
    cavity.drop(cavity.without_quad());
    const CavitySurface surface = sound_surface(cells, cavity);
    MixedMesh mesh;
    mesh.vertices = cells.vertices;
    mesh.hexahedra = cells.hexahedra;
    if (surface.mesh.triangles.rows() == 0) return mesh;
    TetMesh tets;
    try {
        tets = fill_cavity({surface.mesh, surface.two_sided, cavity.holes(), apart_from(surface.mesh, cells),
                            !cells.apart, cells.edge_length},
                           progress);
    } catch (const GeometryError& error) {
        std::vector<Index> vertices;
        for (const Index v : error.elements()) vertices.push_back(surface.vertex[v]);
        throw GeometryError(error.what(), error.kind(), vertices);
    }
    const Eigen::Index known = surface.mesh.vertices.rows(), added = tets.vertices.rows() - known;
    mesh.vertices.conservativeResize(cells.vertices.rows() + added, 3);
    mesh.vertices.bottomRows(added) = tets.vertices.bottomRows(added);
    mesh.tets = tets.tets;
    for (Index& v : mesh.tets.reshaped<Eigen::RowMajor>())
        v = v < known ? surface.vertex[v] : static_cast<Index>(cells.vertices.rows() + v - known);
    return mesh;
}

}  // namespace octafield::volume
