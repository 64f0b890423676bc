#include "unzipped_curves.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "axis_numbers.hpp"
#include "curve_ribbon.hpp"
#include "matched_smoothing.hpp"
#include "octafield/frames/octahedral_group.hpp"
#include "turning_curves.hpp"

namespace octafield::volume::detail {
namespace {

using Eigen::Vector3d;

constexpr double least_rise = 1;  // of a part of a curve with one type, mean edges there; shorter ones are zigzag
constexpr std::array<double, 4> widths{1.5, 1.0, 2.0, 3.0};  // of ribbons, mean edges, the first that can be
constexpr double reach = 2;                                  // along the curve from where it turns, widths
constexpr double most_spread = 6;                            // of a ribbon over the curve's part
constexpr double step_of_edge = 0.5;
constexpr double least_cosine = 0.7;  // between a ribbon and the axis of the frame at an edge that crosses it
constexpr double most_aside = 0.5;    // of the way from one turn to another: how far the axis may miss it
constexpr int most_partners = 4;
constexpr double room = 3;  // round the way of a turn that has no ribbon, mean edges

struct Turn {
    const CurveChain* chain;
    std::size_t at;
    Vector3d place, direction;  // direction: unit, where the curve's parts go on
    double edge;                // mean length there
    bool rises_before;          // type of the part before it
    Index row() const { return chain->rows[at]; }
};

// The part of a chain that a ribbon begins with.
struct Part {
    std::size_t first, last;  // rows
    Vector3d axis;            // mean
    double width;             // across the axis
};

class Unzipper {
public:
    Unzipper(const TetDomain& domain, Quaternions& frames, EdgeMatchings& matchings)
        : domain_(domain), mesh_(domain.mesh()), frames_(frames), matchings_(matchings) {
        const std::vector<Index>& map = domain.surface().vertex_map;
        for (const auto e : domain.features().edges.rowwise()) features_.insert(std::minmax(map[e[0]], map[e[1]]));
        diagonal_ = (mesh_.vertices.colwise().maxCoeff() - mesh_.vertices.colwise().minCoeff()).norm();
        find_turns();
    }

    UnzippedCurves run() {
        UnzippedCurves result{static_cast<int>(turns_.size()), 0};
        while (mend_one()) {
        }
        result.mended = result.turns - static_cast<int>(turns_.size());
        if (!turns_.empty()) result.near = near_ways();
        smooth_matched(domain_, matchings_, touched_, frames_);
        return result;
    }

private:
    void find_turns() {
        chains_ = curve_chains(domain_, frames_, matchings_);
        turns_ = turns_of(chains_);
    }
    std::vector<Turn> turns_of(const std::vector<CurveChain>& chains) const {
        std::vector<Turn> turns;
        for (const CurveChain& chain : chains) {
            const double least = least_rise * mean_edge(chain, chain.rows.size() / 2);
            for (const CurveTurn& turn : curve_turns(domain_, chain, least))
                turns.push_back({&chain, turn.at, middle(chain.rows[turn.at]),
                                 turn.sense * chain.axes[turn.at].normalized(), mean_edge(chain, turn.at),
                                 turn.sense > 0});
        }
        return turns;
    }
    // To the surface where that can be, else two turns are joined.
    bool mend_one() {
        for (const Turn& turn : turns_) {
            if (given_up_.contains(turn.row())) continue;
            if (to_surface(turn)) return true;
            given_up_.insert(turn.row());
        }
        for (const Turn& turn : turns_)
            for (const Turn* other : partners(turn))
                if (join(turn, *other)) return true;
        return false;
    }
    bool to_surface(const Turn& turn) {
        for (const double width : widths) {
            const auto part = part_round(turn, width * turn.edge);
            if (!part) continue;
            const double step = step_of_edge * turn.edge;
            const double spread = std::clamp(width * turn.edge / part->width, 1.0, most_spread);
            const auto ribbon = swept_ribbon(domain_, frames_, line(turn, *part), tets(turn, *part), turn.direction,
                                             step, spread, static_cast<int>(std::ceil(2 * diagonal_ / step)));
            if (ribbon && lay(*ribbon)) return true;
        }
        return false;
    }
    std::vector<std::uint8_t> near_ways() const {
        std::vector<std::uint8_t> near(mesh_.tets.rows(), 0);
        for (const Turn& turn : turns_) {
            const CurveChain& chain = *turn.chain;
            const Index tet = chain.tets[std::min(turn.at, chain.tets.size() - 1)];
            const double step = step_of_edge * turn.edge;
            const auto way = swept_ribbon(domain_, frames_, {centre(tet)}, {tet}, turn.direction, step, 1,
                                          static_cast<int>(std::ceil(2 * diagonal_ / step)));
            for (Index t = 0; way && t < mesh_.tets.rows(); ++t)
                for (const auto& row : way->rows)
                    if ((row.front() - centre(t)).norm() < room * turn.edge) near[t] = 1;
        }
        return near;
    }
    // Turns ahead that look back, the nearest first.
    std::vector<const Turn*> partners(const Turn& turn) const {
        std::vector<std::pair<double, const Turn*>> found;
        for (const Turn& other : turns_) {
            const Vector3d way = other.place - turn.place;
            const double ahead = way.dot(turn.direction);
            if (&other != &turn && ahead > 0 && (way - ahead * turn.direction).norm() < most_aside * ahead &&
                other.direction.dot(turn.direction) < -least_cosine)
                found.emplace_back(way.norm(), &other);
        }
        std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
        std::vector<const Turn*> result;
        for (std::size_t i = 0; i < std::min<std::size_t>(found.size(), most_partners); ++i)
            result.push_back(found[i].second);
        return result;
    }
    bool join(const Turn& turn, const Turn& other) {
        for (const double width : widths) {
            const auto part = part_round(turn, width * turn.edge), end = part_round(other, width * other.edge);
            if (!part || !end) continue;
            std::vector<Vector3d> last = line(other, *end);
            if (turn.rises_before != other.rises_before) std::reverse(last.begin(), last.end());
            if (lay(straight_ribbon(line(turn, *part), last, step_of_edge * turn.edge))) return true;
        }
        return false;
    }

    // The shortest part that is as wide as wanted, or the widest there is.
    std::optional<Part> part_round(const Turn& turn, double width) const {
        const CurveChain& chain = *turn.chain;
        if (chain.rows.size() < 3) return std::nullopt;
        const std::size_t end = chain.rows.size() - 1, at = std::clamp<std::size_t>(turn.at, 1, end - 1);
        const auto length = [&](std::size_t i) { return (middle(chain.rows[i + 1]) - middle(chain.rows[i])).norm(); };
        std::size_t low = at, high = at;
        for (double sum = 0; low > 1 && sum < reach * width; --low) sum += length(low - 1);
        for (double sum = 0; high + 1 < end && sum < reach * width; ++high) sum += length(high);
        std::optional<Part> best;
        for (std::size_t first = low; first <= at; ++first) {
            Vector3d sum = Vector3d::Zero();
            for (std::size_t last = first; last <= high; ++last) {
                sum += chain.axes[last];
                if (last < at) continue;
                Part part{first, last, sum.normalized(), 0};
                const Vector3d across = centre(chain.tets[last]) - centre(chain.tets[first - 1]);
                part.width = (across - across.dot(part.axis) * part.axis).norm();
                const bool wide = part.width >= width;
                if (!best ||
                    (wide ? best->width < width || last - first < best->last - best->first : part.width > best->width))
                    best = part;
            }
        }
        return best;
    }
    // From the middle of the tet before the part to that of the tet behind it, by the middles of triangles and tets.
    std::vector<Vector3d> line(const Turn& turn, const Part& part) const {
        std::vector<Vector3d> points{centre(turn.chain->tets[part.first - 1])};
        for (std::size_t i = part.first; i <= part.last; ++i) {
            points.push_back(middle(turn.chain->rows[i]));
            points.push_back(centre(turn.chain->tets[i]));
        }
        return points;
    }
    std::vector<Index> tets(const Turn& turn, const Part& part) const {
        std::vector<Index> found{turn.chain->tets[part.first - 1]};
        for (std::size_t i = part.first; i <= part.last; ++i) found.insert(found.end(), 2, turn.chain->tets[i]);
        return found;
    }

    // Quarter turns across the ribbon, in the sense that leaves fewer turns; as before where neither does.
    bool lay(const Ribbon& ribbon) {
        const std::vector<EdgeCrossing> crossings = ribbon_crossings(domain_, ribbon);
        for (const int sense : {1, -1}) {
            const auto changes = changes_of(crossings, sense);
            if (!changes) return false;
            change(*changes, 1);
            if (is_simple(*changes) && turns_of(curve_chains(domain_, frames_, matchings_)).size() < turns_.size()) {
                find_turns();
                for (const Change& c : *changes) touched_.insert(touched_.end(), {c.from, c.to});
                return true;
            }
            change(*changes, -1);
        }
        return false;
    }
    struct Change {
        Index from, to;
        int element;
    };
    std::optional<std::vector<Change>> changes_of(const std::vector<EdgeCrossing>& crossings, int sense) const {
        std::vector<Change> changes;
        for (const EdgeCrossing& c : crossings) {
            if (features_.contains({c.from, c.to})) return std::nullopt;
            const Vector3d in_frame = frames::from_wxyz(frames_.row(c.from)).conjugate() * c.along;
            const int axis = nearest_axis_number(in_frame);
            if (axis_unit(axis).dot(in_frame) < least_cosine) return std::nullopt;
            const int quarter = quarter_turn_about(axis);
            int element = 0;
            for (int i = 0; i < std::abs(c.times); ++i)
                element = frames::octahedral_product(
                    element, sense * c.times > 0 ? quarter : frames::octahedral_inverse(quarter));
            changes.push_back({c.from, c.to, element});
        }
        return changes;
    }
    void change(const std::vector<Change>& changes, int way) {
        for (const Change& c : changes)
            matchings_.turn(c.from, c.to, way > 0 ? c.element : frames::octahedral_inverse(c.element));
    }
    bool is_simple(const std::vector<Change>& changes) const {
        for (const Change& c : changes)
            for (const Index row : matchings_.triangles_at(c.from, c.to))
                if (const int left = matchings_.holonomy(row);
                    left != 0 && frames::octahedral_class(left) != frames::OctahedralClass::quarter_turn)
                    return false;
        return true;
    }

    Vector3d mean(const auto& vertices) const {
        Vector3d sum = Vector3d::Zero();
        for (const Index v : vertices) sum += mesh_.vertices.row(v).transpose();
        return sum / static_cast<double>(vertices.size());
    }
    Vector3d middle(Index row) const { return mean(domain_.triangles().triangles.row(row)); }
    Vector3d centre(Index tet) const { return mean(mesh_.tets.row(tet)); }
    double mean_edge(const CurveChain& chain, std::size_t at) const {
        double sum = 0;
        int count = 0;
        for (std::size_t i = at >= 3 ? at - 3 : 0; i < std::min(at + 3, chain.tets.size()); ++i) {
            const auto tet = mesh_.tets.row(chain.tets[i]);
            for (int k = 0; k < 4; ++k)
                for (int l = 0; l < k; ++l, ++count)
                    sum += (mesh_.vertices.row(tet[k]) - mesh_.vertices.row(tet[l])).norm();
        }
        return count > 0 ? sum / count : 0;
    }

    const TetDomain& domain_;
    const TetMesh& mesh_;
    Quaternions& frames_;
    EdgeMatchings& matchings_;
    std::set<std::pair<Index, Index>> features_;  // edges of the mesh, lower vertex first
    double diagonal_ = 0;
    std::vector<CurveChain> chains_;
    std::vector<Turn> turns_;
    std::set<Index> given_up_;    // rows at turns whose ribbons cannot reach the surface
    std::vector<Index> touched_;  // vertices whose matchings were changed
};

}  // namespace

UnzippedCurves unzip_curves(const TetDomain& domain, Quaternions& frames, EdgeMatchings& matchings) {
    return Unzipper(domain, frames, matchings).run();
}

}  // namespace octafield::volume::detail
