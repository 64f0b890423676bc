#include "patch_filler.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <set>

#include "placed_quads.hpp"

namespace octafield::surface::detail {
namespace {

using Quads = std::vector<std::array<int, 4>>;

// Most vertices inside that are tried, by sides / 2: those of the source, fewer in decagons, of which there are many.
constexpr std::array<int, most_sides / 2 + 1> most_interior{0, 0, 0, 3, 4, 2};
constexpr int most_refined = 4;  // fillings whose vertices inside are moved for the last choice

double cost_of(const Quads& quads, const std::vector<Vector2>& points) {
    double sum = 0;
    for (const auto& q : quads) sum += quad_cost({points[q[0]], points[q[1]], points[q[2]], points[q[3]]});
    return sum;
}

// Moves each vertex inside in turn while that lowers the cost; steps are a part of the mean side.
void refine(const Quads& quads, int sides, std::vector<Vector2>& points, double& cost) {
    double step = 0;
    for (int i = 0; i < sides; ++i) step += (points[(i + 1) % sides] - points[i]).norm() / sides;
    static const std::array<Vector2, 4> ways{Vector2(1, 0), Vector2(0, 1), Vector2(-1, 0), Vector2(0, -1)};
    for (double part = 0.2; part > 0.04; part /= 2)
        for (std::size_t v = sides; v < points.size(); ++v)
            for (const Vector2& way : ways) {
                const Vector2 before = points[v];
                points[v] += part * step * way;
                const double moved = cost_of(quads, points);
                if (moved < cost)
                    cost = moved;
                else
                    points[v] = before;
            }
}

}  // namespace

PatchFiller::PatchFiller() {
    for (int sides = 4; sides <= most_sides; sides += 2)
        for (int interior = 0; interior <= most_interior[sides / 2]; ++interior) {
            auto more = placed_of(sides, interior);
            auto& all = placed_[sides / 2];
            all.insert(all.end(), more.begin(), more.end());
        }
}

std::vector<PatchFiller::Placed> PatchFiller::placed_of(int sides, int interior) {
    std::vector<Placed> result;
    std::set<Quads> seen;  // symmetric templates lie alike in several positions
    for (const QuadTemplate& given : quad_templates(sides, interior))
        for (int shift = 0; shift < sides; ++shift)
            for (const bool mirrored : {false, true}) {
                Quads quads = placed_quads(given, shift, mirrored);
                if (seen.insert(quads).second) result.push_back(placed(sides, interior, std::move(quads)));
            }
    return result;
}

PatchFiller::Placed PatchFiller::placed(int sides, int interior, Quads quads) {
    const int n = sides;
    Placed placed{interior, std::move(quads), std::vector<int>(n, 0), {}, 0, {}};
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(interior, interior);
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(interior, n);
    std::vector<int> inner_quads(interior, 0);
    for (const auto& quad : placed.quads)
        for (int k = 0; k < 4; ++k) {
            const int a = quad[k], b = quad[(k + 1) % 4];
            ++(a < n ? placed.corner_quads[a] : inner_quads[a - n]);
            if (a >= n) {  // every edge of a vertex inside leaves it in one quad
                matrix(a - n, a - n) += 1;
                if (b >= n)
                    matrix(a - n, b - n) -= 1;
                else
                    right(a - n, b) += 1;
            } else if (b < n && a < b && b - a > 1 && b - a < n - 1) {
                placed.chords.push_back({a, b});
            }
        }
    for (const int quads : inner_quads) placed.irregular += valence_cost(quads);
    placed.weights = matrix.inverse() * right;
    return placed;
}

double PatchFiller::bound(const Patch& patch, const std::vector<double>& angles, const Placed& placed) {
    double worst = 0, irregular = placed.irregular;
    const int n = static_cast<int>(angles.size());
    for (int i = 0; i < n; ++i) {
        if (placed.corner_quads[i] < patch.least_quads[i]) return std::numeric_limits<double>::infinity();
        worst = std::max(worst, shared_deviation(angles[i], placed.corner_quads[i]));
        if (patch.outer_quads[i] >= 0) irregular += valence_cost(placed.corner_quads[i] + patch.outer_quads[i]);
    }
    if (!patch.joined.empty())
        for (const auto& [a, b] : placed.chords)
            if (patch.joined[a][b]) return std::numeric_limits<double>::infinity();
    return irregular + angle_cost(std::min(worst, 0.999));
}

Filling PatchFiller::fill(const Patch& patch, double limit) const {
    const int n = static_cast<int>(patch.corners.size());
    std::vector<double> angles(n);
    for (int i = 0; i < n; ++i)
        angles[i] =
            turn(patch.corners[(i + 1) % n] - patch.corners[i], patch.corners[(i + n - 1) % n] - patch.corners[i]);
    struct Candidate {
        double cost;
        const Placed* placed;
        bool operator<(const Candidate& other) const { return cost < other.cost; }
    };
    std::vector<Candidate> tried;
    for (const Placed& placed : placed_[n / 2]) {
        const double least = bound(patch, angles, placed);
        if (least < limit) tried.push_back({least, &placed});
    }
    std::stable_sort(tried.begin(), tried.end());
    std::vector<Candidate> best;  // by cost at the barycentres, most_refined of them
    std::vector<Vector2> points(patch.corners);
    const auto set_points = [&](const Placed& placed) {
        points.resize(n + placed.interior);
        for (int v = 0; v < placed.interior; ++v) {
            points[n + v].setZero();
            for (int i = 0; i < n; ++i) points[n + v] += placed.weights(v, i) * patch.corners[i];
        }
    };
    const auto valences = [&](const Placed& placed) {
        double sum = placed.irregular;
        for (int i = 0; i < n; ++i)
            if (patch.outer_quads[i] >= 0) sum += valence_cost(placed.corner_quads[i] + patch.outer_quads[i]);
        return sum;
    };
    for (const Candidate& each : tried) {
        if (best.size() == most_refined && each.cost >= best.back().cost) break;
        set_points(*each.placed);
        best.push_back({valences(*each.placed) + cost_of(each.placed->quads, points), each.placed});
        std::stable_sort(best.begin(), best.end());
        if (best.size() > most_refined) best.pop_back();
    }
    Filling result;
    result.cost = limit;
    for (const Candidate& each : best) {
        set_points(*each.placed);
        const double fixed = valences(*each.placed);
        double cost = each.cost - fixed;
        if (each.placed->interior > 0 && fixed < result.cost) refine(each.placed->quads, n, points, cost);
        if (!(fixed + cost < result.cost)) continue;
        result.cost = fixed + cost;
        result.quads = each.placed->quads;
        result.interior.assign(points.begin() + n, points.end());
    }
    return result;
}

}  // namespace octafield::surface::detail
