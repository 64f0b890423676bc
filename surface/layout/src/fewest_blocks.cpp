// How few blocks there can be; the proof is in docs/quad_layouts.md, "Few blocks".
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "face_lines.hpp"
#include "linear_programme.hpp"
#include "octafield/error.hpp"
#include "octafield/surface/base_complex.hpp"

namespace octafield::surface {
namespace {

using detail::Face;
using detail::FaceLines;
using detail::LinearProgramme;
using detail::LinearSum;

constexpr double rounding = 1e-6;
constexpr int same_points = 3;  // at most, of which two lines never join the same two

// The least number of places where lines cross or end, beside irregular vertices: a linear programme in the numbers of
// lines across each edge, and whether there are lines that may be there or not.
class Crossings {
public:
    explicit Crossings(const FaceLines& lines) : lines_(lines) {
        for (Index e = 0; e < lines.edge_count(); ++e) {
            programme_.add();
            if (lines.is_boundary(e) || lines.is_line(e)) sum_.factors[e] += lines.is_boundary(e) ? 0.5 : 1;
        }
        spokes_.assign(lines.dart_count(), -1);
        sum_.constant = lines.crossed_nodes();
        for (const Face& face : lines.faces()) {
            add_headings(face);
            add_cone(face);
            add_reflex_corner(face);
            add_strips(face);
            add_obstacles(face);
        }
    }

    double least() const {
        LinearProgramme whole = programme_;
        LinearSum sum = sum_;
        // p q >= p q0 + p0 q - p0 q0, of whole numbers that are not below p0 and q0.
        for (const auto& [p, q] : products_) {
            const double least_p = least_of(p), least_q = least_of(q);
            LinearSum product;
            product.factors[whole.add()] = 1;
            sum.add(product);
            product.add(p, -least_q).add(q, -least_p).constant += least_p * least_q;
            whole.enough.push_back(std::move(product));
        }
        return value(whole, sum).value_or(0);
    }

private:
    static std::optional<double> value(const LinearProgramme& programme, const LinearSum& sum) {
        const auto found = programme.least(sum);
        if (!found) return {};
        double result = sum.constant;
        for (const auto& [number, factor] : sum.factors) result += factor * (*found)[number];
        return result;
    }
    double least_of(const LinearSum& sum) const {
        return std::max(0.0, std::ceil(value(programme_, sum).value_or(0) - rounding));
    }
    void add_spoke(Index dart, LinearSum& to) {
        if (lines_.is_known(dart)) {
            to.constant += 1;
            return;
        }
        if (spokes_[dart] < 0) spokes_[dart] = programme_.add(1);
        to.factors[spokes_[dart]] += 1;
    }
    // Lines that end there, from within the face.
    LinearSum ends(const std::vector<Index>& sides, bool with_last) {
        LinearSum result;
        for (std::size_t i = 0; i < sides.size(); ++i) {
            if (i == 0 || lines_.starts_at_node(sides[i])) result.factors[lines_.edge(sides[i])] += 1;
            if (i + 1 == sides.size() && !with_last) break;
            for (const Index dart : lines_.spokes(sides[i])) add_spoke(dart, result);
        }
        return result;
    }
    LinearSum side_ends(const Face& face, std::size_t corner) { return ends(face.side_after(corner), false); }

    // A line across a face where lines do not turn leaves in the way opposite to that in which it came.
    void add_headings(const Face& face) {
        if (!face.has_headings) return;
        std::array<LinearSum, 4> inward;
        for (const auto& loop : face.loops)
            for (std::size_t i = 0; i < loop.size(); ++i) {
                const Index side = loop[i];
                if (i == 0 || lines_.starts_at_node(side))
                    inward[(lines_.heading(side) + 1) % 4].factors[lines_.edge(side)] += 1;
                for (const Index dart : lines_.spokes(side)) add_spoke(dart, inward[lines_.heading(dart)]);
            }
        for (const int d : {0, 1}) programme_.none.push_back(inward[d].add(inward[d + 2], -1));
        if (face.is_grid()) products_.emplace_back(side_ends(face, 0), side_ends(face, 1));
    }
    // n corners round one point of n quads: a kite at each, and lines that cut off one side.
    void add_cone(const Face& face) {
        if (!face.is_cone()) return;
        const auto count = static_cast<Index>(face.corners.size());
        std::vector<Index> across(count);
        for (Index& number : across) {
            number = programme_.add();
            sum_.factors[number] += 1;  // crosses the point's line to that side
        }
        for (Index i = 0; i < count; ++i) {
            LinearSum equal = side_ends(face, i);
            equal.constant -= 1;
            equal.factors[across[(i + 1) % count]] -= 1;
            equal.factors[across[(i + count - 1) % count]] -= 1;
            programme_.none.push_back(std::move(equal));
        }
    }
    // An L: three rectangles.
    void add_reflex_corner(const Face& face) {
        if (!face.is_l()) return;
        std::size_t reflex = 0;
        while (face.corners[reflex].quads != 3) ++reflex;
        std::vector<LinearSum> t;
        for (std::size_t i = 0; i < 6; ++i) t.push_back(side_ends(face, (reflex + i) % 6));
        products_.emplace_back(t[0], t[1]);
        products_.emplace_back(t[4], t[5]);
        products_.emplace_back(t[1], t[4]);
        const std::vector<Index> spokes = lines_.spokes(face.corners[reflex].side);  // along the next, the last side
        if (lines_.is_known(spokes[0])) sum_.add(t[4]);
        if (lines_.is_known(spokes[1])) sum_.add(t[1]);
    }
    // Rows of quads along a side grow until they meet a vertex that a line runs back from.
    void add_strips(const Face& face) {
        if (face.is_grid() || face.is_ring() || !lines_.has_lines_at_reflex_corners(face)) return;
        for (const auto& loop : face.loops) {
            if (lines_.has_corners(loop)) continue;
            LinearSum sum = ends(loop, true);
            sum.constant -= 1;
            programme_.enough.push_back(std::move(sum));
        }
        for (std::size_t i = 0; i < face.corners.size(); ++i) {
            const std::size_t before = face.previous(i), next = face.next(i), after = face.next(next);
            if (before == next || i == next) continue;  // two corners
            bool convex = true;
            for (const std::size_t c : {before, i, next, after}) convex = convex && face.corners[c].quads == 1;
            if (!convex) continue;
            LinearSum sum = side_ends(face, i);
            sum.constant -= 1;
            programme_.enough.push_back(std::move(sum));
        }
    }
    // Lines from what bends the face away from them come together again too seldom.
    void add_obstacles(const Face& face) {
        const auto points = static_cast<int>(face.points.size());
        if (std::any_of(face.points.begin(), face.points.end(), [](int quads) { return quads < 5; })) return;
        const int quads = std::accumulate(face.points.begin(), face.points.end(), 0);
        if (face.is_disk() && points >= 2 && points <= same_points) {
            LinearSum sum = ends(face.loops[0], true);
            sum.constant -= quads - 2 * (points - 1);
            programme_.enough.push_back(std::move(sum));
        }
        if (!face.is_annulus() || points > 1) return;
        for (const int hole : {0, 1}) {
            const int bend = lines_.bend_of_hole(face.loops[hole]);
            if (points == 0 ? bend != 0 && bend < 2 : bend < 3) continue;
            LinearSum sum = ends(face.loops[1 - hole], true);
            sum.add(ends(face.loops[hole], true), -1);
            sum.constant -= points == 0 ? 0 : quads - 2;
            programme_.enough.push_back(std::move(sum));
        }
    }

    const FaceLines& lines_;
    LinearProgramme programme_;
    LinearSum sum_;
    std::vector<Index> spokes_;  // number of each dart that may be a line
    std::vector<std::pair<LinearSum, LinearSum>> products_;
};

}  // namespace

Index fewest_blocks(const QuadMesh& mesh, const std::vector<Index>& faces) {
    detail::require_only_quads(mesh);
    if (!faces.empty() && static_cast<Eigen::Index>(faces.size()) != mesh.quads.rows())
        throw InvalidInput("give the face of each quad, or of none", "bad_option");
    Index result = 0;
    for (const std::vector<Index>& part : detail::connected_parts(mesh.quads)) {
        Quads quads(static_cast<Eigen::Index>(part.size()), 4);
        std::vector<Index> face_of(part.size(), 0);
        for (std::size_t i = 0; i < part.size(); ++i) {
            quads.row(static_cast<Eigen::Index>(i)) = mesh.quads.row(part[i]);
            if (!faces.empty()) face_of[i] = faces[part[i]];
        }
        const detail::QuadSides sides(quads);
        double corners = 0;
        for (const Index v : sides.irregular) corners += static_cast<double>(sides.out[v].size());
        const double least = Crossings(FaceLines(sides, face_of)).least();
        result += std::max<Index>(1, static_cast<Index>(std::ceil(corners / 4 + least - rounding)));
    }
    return result;
}

}  // namespace octafield::surface
