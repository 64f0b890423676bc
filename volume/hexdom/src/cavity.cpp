#include "cavity.hpp"

#include <algorithm>
#include <limits>

namespace octafield::volume::detail {
namespace {

using Vector = Eigen::Vector3d;

constexpr double good_quality = 0.15;  // above it no cells are added to a region
constexpr int most_growths = 8;

// The other face at edge a-c of a cell entered through triangle (a, c, from): its third vertex, -1 if that is a quad.
Index turn_round_edge(const CellComplex& complex, Index cell, Index a, Index c, Index from) {
    for (const CellFace& local : complex.shape(cell).faces) {
        const FaceCycle face = complex.face(cell, local);
        int with = 0;
        Index third = -1;
        for (int k = 0; k < face.corners(); ++k) {
            if (face.ids[k] == a || face.ids[k] == c)
                ++with;
            else
                third = face.ids[k];
        }
        if (with == 2 && face.corners() == 3 && third != from) return third;
    }
    return -1;
}

std::array<FaceCycle, 2> halves_of(const std::array<Index, 4>& round) {
    return {triangle_cycle(round[0], round[1], round[2]), triangle_cycle(round[0], round[2], round[3])};
}

// A cell lies against the outward triangle, and nothing behind it.
bool faces_quad(const CellComplex& complex, const FaceCycle& triangle) {
    return complex.cell_across(triangle) >= 0 && complex.cell_with(triangle) < 0;
}

// visit(quad, rest) for quads outward of which the triangle is one half and `rest` the other, until one is true.
template <class Visit>
bool any_quad_on(const CellComplex& complex, const FaceCycle& triangle, const Visit& visit) {
    for (const Index cell : complex.cells_at(triangle.ids[0]))
        for (const CellFace& local : complex.shape(cell).faces) {
            if (local.corners == 3) continue;
            const FaceCycle face = complex.face(cell, local);
            const auto& f = face.ids;
            for (int k = 0; k < 4; ++k) {
                const std::array<FaceCycle, 2> halves =
                    halves_of({f[k], f[(k + 1) % 4], f[(k + 2) % 4], f[(k + 3) % 4]});
                if (halves[0] == triangle && visit(face, halves[1])) return true;
            }
        }
    return false;
}

// The triangle is half of another quad that two triangles fill: three vertices of one quad may be three of another's.
bool in_pair_of_another(const CellComplex& complex, const FaceCycle& triangle, const FaceCycle& quad) {
    return any_quad_on(complex, triangle, [&](const FaceCycle& other, const FaceCycle& rest) {
        return other != quad && complex.cell_across(other) < 0 && faces_quad(complex, rest);
    });
}

std::vector<ConeFace> cone_faces(const CellComplex& complex, const std::vector<FaceCycle>& boundary) {
    std::vector<ConeFace> faces;
    for (const FaceCycle& cycle : boundary) {
        ConeFace face{cycle.corners(), {}};
        for (int k = 0; k < face.corners; ++k) face.points[k] = complex.point(cycle.ids[k]);
        faces.push_back(face);
    }
    return faces;
}

double mean_edge(const std::vector<ConeFace>& faces) {
    double total = 0;
    int edges = 0;
    for (const ConeFace& face : faces)
        for (int k = 0; k < face.corners; ++k, ++edges)
            total += (face.points[(k + 1) % face.corners] - face.points[k]).norm();
    return total / edges;
}

Vector centroid(const std::vector<ConeFace>& faces) {
    Vector total = Vector::Zero();
    for (const ConeFace& face : faces) {
        Vector sum = Vector::Zero();
        for (int k = 0; k < face.corners; ++k) sum += face.points[k];
        total += sum / face.corners;
    }
    return total / static_cast<double>(faces.size());
}

// The tet or pyramid across the worst face that has one, -1: none.
Index cell_across_worst(const CellComplex& complex, const Filling& filling) {
    const std::vector<ConeFace> faces = cone_faces(complex, filling.region.boundary);
    double worst = std::numeric_limits<double>::infinity();
    Index across = -1;
    for (std::size_t f = 0; f < faces.size(); ++f) {
        if (faces[f].corners == 4) continue;
        const double quality = cone_quality(faces[f], filling.apex.place);
        if (quality >= worst) continue;
        const FaceCycle& face = filling.region.boundary[f];
        const Index cell = complex.wall(face) ? -1 : complex.cell_across(face);
        if (cell < 0 || (&complex.shape(cell) != &tet_shape && &complex.shape(cell) != &pyramid_shape)) continue;
        worst = quality;
        across = cell;
    }
    return across;
}

}  // namespace

QuadMeeting quad_meeting(const CellComplex& complex, const FaceCycle& quad) {
    const auto& q = quad.ids;
    if (complex.cell_across(quad) >= 0) return {QuadMeeting::Kind::quad, q};
    QuadMeeting meeting{QuadMeeting::Kind::boundary, q};
    int pairs = 0, lone = 0;
    for (int k = 0; k < 2; ++k) {
        const std::array<Index, 4> round{q[k], q[k + 1], q[(k + 2) % 4], q[(k + 3) % 4]};
        const std::array<FaceCycle, 2> halves = halves_of(round);
        const bool first = faces_quad(complex, halves[0]), second = faces_quad(complex, halves[1]);
        if (first && second) {
            ++pairs;
            meeting.round = round;
        } else if (first != second && !in_pair_of_another(complex, halves[first ? 0 : 1], quad)) {
            ++lone;
        }
    }
    if (pairs == 1 && lone == 0) meeting.kind = QuadMeeting::Kind::triangles;
    if (pairs > 1 || lone > 0) meeting.kind = QuadMeeting::Kind::part;
    return meeting;
}

bool lies_on_matched_quad(const CellComplex& complex, const FaceCycle& triangle) {
    const FaceCycle outward = opposite(triangle);  // of the quad
    const auto matched = [&](const FaceCycle& quad, const FaceCycle&) { return complex.cell_across(quad) >= 0; };
    return any_quad_on(complex, outward, matched) && !in_pair_of_another(complex, outward, FaceCycle{});
}

void add_to_region(const CellComplex& complex, Index cell, Region& region) {
    const auto toggle = [&](const FaceCycle& face) {
        const auto found = std::find(region.boundary.begin(), region.boundary.end(), opposite(face));
        if (found == region.boundary.end())
            region.boundary.push_back(face);
        else
            region.boundary.erase(found);
    };
    region.cells.push_back(cell);
    for (const CellFace& local : complex.shape(cell).faces) {
        const FaceCycle face = complex.face(cell, local);
        if (face.corners() == 4) {
            const QuadMeeting meeting = quad_meeting(complex, face);
            if (meeting.kind == QuadMeeting::Kind::triangles) {
                const auto& [a, b, c, d] = meeting.round;
                toggle(triangle_cycle(a, b, c));
                toggle(triangle_cycle(a, c, d));
                continue;
            }
        }
        toggle(face);
    }
}

std::optional<Region> cells_round_diagonal(const CellComplex& complex, const std::array<Index, 4>& round) {
    const auto& [a, b, c, d] = round;
    Region region;
    Index cell = complex.cell_across(triangle_cycle(a, b, c));
    for (Index at = b; at != d;) {
        // Cells are met once each where the mesh is sound; the bound ends the walk where it is not.
        if (cell < 0 || region.cells.size() > complex.cells_at(a).size()) return std::nullopt;
        region.cells.push_back(cell);
        at = turn_round_edge(complex, cell, a, c, at);
        if (at < 0 || (at != d && complex.wall(triangle_cycle(a, at, c)))) return std::nullopt;
        cell = complex.cell_across(triangle_cycle(a, at, c));
    }
    const std::vector<Index> cells = std::move(region.cells);
    region.cells.clear();
    for (const Index of_fan : cells) add_to_region(complex, of_fan, region);
    for (const FaceCycle& half : {triangle_cycle(a, c, b), triangle_cycle(a, d, c)}) {
        const auto found = std::find(region.boundary.begin(), region.boundary.end(), half);
        if (found == region.boundary.end()) return std::nullopt;
        region.boundary.erase(found);
    }
    region.boundary.push_back(face_cycle({a, d, c, b}));
    return region;
}

Filling best_filling(const CellComplex& complex, Region region, std::vector<Vector> seeds) {
    Filling best{{}, {Vector::Zero(), -std::numeric_limits<double>::infinity()}};
    for (int growth = 0;; ++growth) {
        const std::vector<ConeFace> faces = cone_faces(complex, region.boundary);
        seeds.push_back(centroid(faces));
        Filling now{std::move(region), best_apex(faces, seeds, 0.1 * mean_edge(faces))};
        if (now.apex.quality > best.apex.quality) best = now;
        if (now.apex.quality >= good_quality || growth == most_growths) break;
        const Index more = cell_across_worst(complex, now);
        if (more < 0) break;
        seeds.push_back(now.apex.place);
        region = std::move(now.region);
        add_to_region(complex, more, region);
    }
    return best;
}

void fill(CellComplex& complex, const Filling& filling) {
    for (const Index cell : filling.region.cells) complex.remove(cell);
    const Index apex = complex.add_vertex(filling.apex.place);
    for (const FaceCycle& face : filling.region.boundary) {
        const auto& f = face.ids;
        if (face.corners() == 3)
            complex.add(tet_shape, std::array<Index, 4>{f[0], f[2], f[1], apex});
        else
            complex.add(pyramid_shape, std::array<Index, 5>{f[0], f[3], f[2], f[1], apex});
    }
}

void improve_apex(CellComplex& complex, Index vertex) {
    std::vector<FaceCycle> around;
    for (const Index cell : complex.cells_at(vertex))
        for (const CellFace& local : complex.shape(cell).faces) {
            const FaceCycle face = complex.face(cell, local);
            if (std::find(face.ids.begin(), face.ids.end(), vertex) == face.ids.end()) around.push_back(face);
        }
    const std::vector<ConeFace> faces = cone_faces(complex, around);
    const Vector here = complex.point(vertex);
    complex.move(vertex, best_apex(faces, {here, centroid(faces)}, 0.1 * mean_edge(faces)).place);
}

}  // namespace octafield::volume::detail
