// Pyramids where quads meet triangles: of two tets, about a point in the tets round the diagonal, or by giving the cell
// up.
#include <Eigen/Geometry>
#include <algorithm>
#include <deque>
#include <limits>
#include <string>

#include "cavity.hpp"
#include "cell_split.hpp"
#include "octafield/error.hpp"
#include "octafield/volume/recombination.hpp"

namespace octafield::volume {
namespace {

using namespace detail;
using Vector = Eigen::Vector3d;
using Kind = QuadMeeting::Kind;

constexpr double good_pyramid = 0.2;  // of two tets, without a new vertex
constexpr double sound = 1e-3;        // quality that is tried to be kept, at the price of a cell given up
constexpr double least = 1e-9;        // far above rounding
constexpr double positive = 1e-14;    // above rounding: of flat tets that were there before
constexpr double flat = 0.94;         // cosine, about 20 degrees: boundary triangles that a quad may replace

void require_cells(const MixedMesh& mesh) {
    for (const CellDefect& defect : find_cell_defects(mesh))
        if (defect.kind != "mismatched_face") throw GeometryError(defect.message, defect.kind, defect.cells);
}

std::vector<std::uint8_t> vertices_of_quads(const MixedMesh& mesh) {
    std::vector<std::uint8_t> on(mesh.vertices.rows(), 0);
    for_each_cell(mesh, [&](const Cell& cell) {
        if (&cell.shape == &tet_shape) return;
        for (int k = 0; k < cell.shape.vertices; ++k) on[cell.ids[k]] = 1;
    });
    return on;
}

// Every round makes fewer cells with quads that are no pyramids, or as many and fewer quads that meet triangles, or as
// many of both and fewer tets: so it ends.
class Conformer {
public:
    Conformer(const MixedMesh& mesh, const Triangles& walls)
        : complex_(mesh), input_cells_(mesh.cell_count()), input_vertices_(static_cast<Index>(mesh.vertices.rows())) {
        complex_.set_walls(walls);
        for (Index tet = 0; tet < mesh.tets.rows(); ++tet)
            if (between_quads(tet)) complex_.remove(tet);
        const std::vector<std::uint8_t> on_quads = vertices_of_quads(mesh);
        for (Index tet = 0; tet < mesh.tets.rows(); ++tet) {
            int on = 0;
            for (int k = 0; k < 4; ++k) on += on_quads[mesh.tets(tet, k)];
            if (on >= 3 && complex_.alive(tet)) require_open(tet);
        }
        for (Index cell = 0; cell < complex_.cell_count(); ++cell) queue_quads(cell);
    }

    MixedMesh run() {
        join_clear_pairs();
        while (!open_.empty()) {
            const OpenQuad open = open_.front();
            open_.pop_front();
            if (!complex_.alive(open.cell)) continue;
            const QuadMeeting meeting = meeting_of(open);
            if (meeting.kind == Kind::triangles) close(open.cell, meeting.round);
        }
        // Each was placed for the tets of its time.
        for (int sweep = 0; sweep < 3; ++sweep)
            for (Index apex = input_vertices_; apex < complex_.vertex_count(); ++apex)
                if (!complex_.cells_at(apex).empty()) improve_apex(complex_, apex);
        return complex_.mesh(input_vertices_);
    }

    ConformReport report;

private:
    struct OpenQuad {
        Index cell;
        FaceCycle quad;
    };

    // More than a flat tet between two quads of the same vertices: they seem to match, but tets are enclosed.
    void require_open(Index tet) const {
        for (const CellFace& local : tet_shape.faces) {
            const FaceCycle face = complex_.face(tet, local);
            if (complex_.cell_across(face) >= 0 || !lies_on_matched_quad(complex_, face)) continue;
            throw GeometryError("tet " + std::to_string(tet) +
                                    " lies between two quads of the same four vertices; "
                                    "take the tets out between them, or one of the cells",
                                "mismatched_face", {tet});
        }
    }

    // Flat, between two quads of its four vertices, which match without it.
    bool between_quads(Index tet) const {
        for (const CellFace& local : tet_shape.faces)
            if (complex_.cell_across(complex_.face(tet, local)) >= 0) return false;
        const auto& v = complex_.ids(tet);
        for (const auto& round :
             {std::array{v[0], v[1], v[2], v[3]}, {v[0], v[2], v[1], v[3]}, {v[0], v[1], v[3], v[2]}}) {
            const FaceCycle quad = face_cycle(round);
            if (complex_.cell_with(quad) >= 0 && complex_.cell_across(quad) >= 0) return true;
        }
        return false;
    }

    QuadMeeting meeting_of(const OpenQuad& open) const {
        const QuadMeeting meeting = quad_meeting(complex_, open.quad);
        if (meeting.kind == Kind::part)
            throw GeometryError("a quad of the " + name(open.cell) + " meets triangles that do not fill it; " +
                                    "give two triangles or a quad there",
                                "mismatched_face", numbers(open.cell));
        return meeting;
    }

    std::string name(Index cell) const {
        return std::string(complex_.shape(cell).name) +
               (cell < input_cells_ ? " " + std::to_string(cell) : std::string(" made here"));
    }
    std::vector<Index> numbers(Index cell) const {
        return cell < input_cells_ ? std::vector<Index>{cell} : std::vector<Index>{};
    }

    void queue_quads(Index cell) {
        if (!complex_.alive(cell) || &complex_.shape(cell) == &tet_shape) return;
        for (const CellFace& local : complex_.shape(cell).faces) {
            const FaceCycle face = complex_.face(cell, local);
            if (face.corners() == 4 && meeting_of({cell, face}).kind == Kind::triangles) open_.push_back({cell, face});
        }
    }

    // First, as it needs no vertex and is lost when the tets have been changed for another quad.
    void join_clear_pairs() {
        std::deque<OpenQuad> rest;
        for (const OpenQuad& open : open_) {
            const QuadMeeting meeting = quad_meeting(complex_, open.quad);
            if (meeting.kind != Kind::triangles || joined_quality(meeting.round) < good_pyramid)
                rest.push_back(open);
            else
                join(meeting.round);
        }
        open_.swap(rest);
    }

    void close(Index cell, const std::array<Index, 4>& round) {
        if (&complex_.shape(cell) == &pyramid_shape) return split(cell);
        if (absorb(cell, round)) return;
        const double joined = joined_quality(round);
        const Filling raised = joined < good_pyramid ? filling_round(round) : no_filling();
        if (std::max(joined, raised.apex.quality) >= sound) return put_pyramid(round, joined, raised);
        const Filling given_up = filling_of(cell);
        if (given_up.apex.quality >= sound) return give_up(given_up);
        if (std::max(joined, raised.apex.quality) >= least) return put_pyramid(round, joined, raised);
        if (given_up.apex.quality >= least) return give_up(given_up);
        split(cell);
    }

    void put_pyramid(const std::array<Index, 4>& round, double joined, const Filling& raised) {
        if (joined >= good_pyramid || joined >= raised.apex.quality) return join(round);
        ++report.raised;
        fill(complex_, raised);
    }

    // The two tets outside the quad's halves, -1 where they are no tets.
    std::array<Index, 2> tets_outside(const std::array<Index, 4>& q) const {
        std::array<Index, 2> tets{complex_.cell_across(triangle_cycle(q[0], q[1], q[2])),
                                  complex_.cell_across(triangle_cycle(q[0], q[2], q[3]))};
        for (Index& tet : tets)
            if (tet >= 0 && &complex_.shape(tet) != &tet_shape) tet = -1;
        return tets;
    }

    Index apex_over(const std::array<Index, 4>& q) const {
        const auto [first, second] = tets_outside(q);
        if (first < 0 || second < 0 || first == second) return -1;
        const auto apex = [&](Index tet) {
            const auto& ids = complex_.ids(tet);
            return *std::find_if(ids.begin(), ids.end(),
                                 [&](Index v) { return v != q[0] && v != q[2] && v != q[1] && v != q[3]; });
        };
        return apex(first) == apex(second) ? apex(first) : -1;
    }

    double joined_quality(const std::array<Index, 4>& q) const {
        const Index apex = apex_over(q);
        if (apex < 0) return -1;
        return pyramid_quality({complex_.point(q[0]), complex_.point(q[1]), complex_.point(q[2]), complex_.point(q[3])},
                               complex_.point(apex));
    }

    void join(const std::array<Index, 4>& q) {
        const Index apex = apex_over(q);
        for (const Index tet : tets_outside(q)) complex_.remove(tet);
        complex_.add(pyramid_shape, std::array<Index, 5>{q[0], q[1], q[2], q[3], apex});
        ++report.combined;
    }

    // One tet on both halves: its four vertices are the quad's, and the quad may as well be on its other side.
    bool absorb(Index cell, const std::array<Index, 4>& q) {
        const auto [tet, second] = tets_outside(q);
        if (tet < 0 || tet != second) return false;
        const FaceCycle far[2] = {triangle_cycle(q[0], q[1], q[3]), triangle_cycle(q[1], q[2], q[3])};
        const bool behind[2] = {complex_.cell_across(far[0]) >= 0, complex_.cell_across(far[1]) >= 0};
        if (behind[0] != behind[1]) return false;
        const FaceCycle quad = face_cycle(q);
        if (!behind[0] && complex_.cell_across(quad) < 0 && boundary_fold(q) < flat) return false;
        complex_.remove(tet);
        const QuadMeeting meeting = meeting_of({cell, quad});
        if (meeting.kind == Kind::triangles) open_.push_front({cell, quad});
        return true;
    }

    // Cosine of the turn between triangles (0, 1, 3) and (1, 2, 3).
    double boundary_fold(const std::array<Index, 4>& q) const {
        const Vector b = complex_.point(q[1]), d = complex_.point(q[3]);
        const Vector first = (b - complex_.point(q[0])).cross(d - complex_.point(q[0])).normalized();
        return first.dot((d - complex_.point(q[2])).cross(b - complex_.point(q[2])).normalized());
    }

    static Filling no_filling() { return {{}, {Vector::Zero(), -std::numeric_limits<double>::infinity()}}; }

    Filling filling_round(const std::array<Index, 4>& q) const {
        const std::optional<Region> region = cells_round_diagonal(complex_, q);
        if (!region) return no_filling();
        const Vector a = complex_.point(q[0]), c = complex_.point(q[2]), diagonal = c - a,
                     across = complex_.point(q[3]) - complex_.point(q[1]), middle = (a + c) / 2,
                     centre = middle / 2 + (complex_.point(q[1]) + complex_.point(q[3])) / 4;
        const Vector inward = diagonal.cross(across).normalized() * diagonal.norm();
        std::vector<Vector> seeds;
        for (const double height : {0.4, 0.25, 0.15, 0.08, 0.04, 0.02, 0.01}) {
            seeds.push_back(centre + height * inward);
            seeds.push_back(middle + height * inward);
        }
        return best_filling(complex_, *region, std::move(seeds));
    }

    Filling filling_of(Index cell) const {
        Region region;
        add_to_region(complex_, cell, region);
        Vector centre = Vector::Zero();
        const int corners = complex_.shape(cell).vertices;
        for (int k = 0; k < corners; ++k) centre += complex_.point(complex_.ids(cell)[k]) / corners;
        return best_filling(complex_, std::move(region), {centre});
    }

    void give_up(const Filling& filling) {
        ++report.split;
        fill(complex_, filling);
    }

    void split(Index cell) {
        std::vector<std::array<Index, 4>> tets;
        for (const double quality : {0.05, sound, least, positive})
            if (tets.empty()) tets = split_into_tets(complex_, cell, quality);
        if (tets.empty())
            throw GeometryError("no pyramid fits on a quad of the " + name(cell) +
                                    " that meets two triangles, and it cannot be split; improve the cells there",
                                "unsplittable_cell", numbers(cell));
        std::vector<OpenQuad> beside;
        for (const CellFace& local : complex_.shape(cell).faces) {
            const FaceCycle face = complex_.face(cell, local);
            const Index other = face.corners() == 4 ? complex_.cell_across(face) : -1;
            if (other >= 0) beside.push_back({other, opposite(face)});
        }
        if (&complex_.shape(cell) != &pyramid_shape) ++report.split;
        complex_.remove(cell);
        for (const auto& tet : tets) complex_.add(tet_shape, tet);
        open_.insert(open_.end(), beside.begin(), beside.end());
    }

    CellComplex complex_;
    const Index input_cells_, input_vertices_;
    std::deque<OpenQuad> open_;
};

}  // namespace

MixedMesh conform(const MixedMesh& mesh, ConformReport* report, const Triangles& walls) {
    require_cells(mesh);
    Conformer conformer(mesh, walls);
    MixedMesh result = conformer.run();
    require_valid(result);
    if (report) *report = conformer.report;
    return result;
}

}  // namespace octafield::volume
