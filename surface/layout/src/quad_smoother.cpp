#include "quad_smoother.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

#include "given_corners.hpp"
#include "quad_untangler.hpp"

namespace octafield::surface::detail {
namespace {

using Vector = Eigen::Vector3d;
constexpr double good_enough = 0.9;  // scaled Jacobian: vertices with no worse quads stay
constexpr double reachable = 0.98;   // of the sine of an angle that nothing changes
constexpr double few_bad = 0.02;     // of the quads
constexpr int beside = 8;            // rings round what is relaxed that are optimised with it
constexpr double softness = 10;
constexpr double size_share = 0.3;  // of sizes beside shapes
constexpr int rings[] = {1, 2, 4, 8}, relaxing_rounds = 20;
constexpr int evened_rings[] = {4, 8, 16};
constexpr int most_evened = 40, most_passes = 3;  // places, all of them again
constexpr double least_gain = 1e-4;
constexpr double bend = 2;
constexpr double steps[] = {0.3, 0.1, 0.03};  // of the mean length of a vertex' edges, or
constexpr double short_edge = 0.1;            // of the shortest, if it is below that of the mean

class Smoother {
public:
    Smoother(const SmootherInput& input, QuadMesh& mesh)
        : input_(input), mesh_(mesh), parts_(input.parts), movable_(input, mesh) {
        const auto count = static_cast<std::size_t>(mesh.vertices.rows());
        around_.resize(count);
        neighbours_.resize(count);
        for (Index q = 0; q < mesh.quads.rows(); ++q)
            for (int k = 0; k < 4; ++k) {
                around_[mesh.quads(q, k)].push_back(q);
                neighbours_[mesh.quads(q, k)].push_back(mesh.quads(q, (k + 1) % 4));
                neighbours_[mesh.quads(q, k)].push_back(mesh.quads(q, (k + 3) % 4));
            }
        for (auto& list : neighbours_) {
            std::sort(list.begin(), list.end());
            list.erase(std::unique(list.begin(), list.end()), list.end());
        }
        active_.assign(count, true);
        along_.resize(input.seams.seams.size());
        for (std::size_t v = 0; v < places_.size(); ++v)
            if (places_[v].seam >= 0 && !around_[v].empty()) along_[places_[v].seam].push_back(static_cast<Index>(v));
        for (auto& vertices : along_)
            std::stable_sort(vertices.begin(), vertices.end(),
                             [&](Index a, Index b) { return places_[a].at < places_[b].at; });
        for (Index q = 0; q < mesh.quads.rows(); ++q) normals_.push_back(surface_normal(q));
        given_corners_ = given_corners(mesh, movable_);
    }

    std::vector<Index> facing_away() const {
        std::vector<Index> result;
        for (Index q = 0; q < mesh_.quads.rows(); ++q)
            if (quality(q) < -1) result.push_back(q);
        return result;
    }

    // Optimised vertex by vertex; where that gets stuck, once more from where the vertices round bad quads are at the
    // means of their neighbours, in growing rings, first with all quads round a vertex counting. The better one is
    // kept. Singular points inside are held first, and released where bad quads are left and that is wanted.
    bool run(int rounds, Rescue how) {
        everywhere_ = how == Rescue::everywhere;
        optimise(rounds);
        const bool rescued =
            how != Rescue::where_few || bad_count() <= few_bad * static_cast<double>(mesh_.quads.rows());
        if (rescued) rescue(rounds);
        if (rescued && input_.release && least_margin(bad) < 0 && release()) {
            optimise(rounds);
            rescue(rounds);
            double before = -std::numeric_limits<double>::infinity(), now = least_margin(bad);
            for (int i = 0; i < most_passes && now < 0 && now > before; ++i) {
                before = now;
                even_bad(rounds);
                now = least_margin(bad);
            }
        }
        std::copy(places_.begin(), places_.end(), input_.on_seams.begin());
        return rescued;
    }

    void prepare(Start start) {
        if (start == Start::relaxed) relax(std::vector<bool>(around_.size(), true), relaxing_rounds);
        if (start == Start::untangled) untangle(input_, movable_, 0, mesh_);
        if (start == Start::freed) {
            release();
            relax(std::vector<bool>(around_.size(), true), relaxing_rounds);
        }
        if (start == Start::evened && input_.release) release();
        if (start == Start::evened || start == Start::held || start == Start::freed)
            untangle(input_, movable_, size_share, mesh_);
        std::copy(places_.begin(), places_.end(), input_.on_seams.begin());
    }

    // Below 0 where quads are worse than that, and than the angles that they are given.
    double least_margin(double wanted) const {
        double least = 1;
        for (Index q = 0; q < mesh_.quads.rows(); ++q) least = std::min(least, quality(q) - reachable_of(q, wanted));
        return least;
    }

private:
    bool release() {
        for (const Index v : held_) fixed_[v] = false;
        return !held_.empty();
    }

    void rescue(int rounds) {
        double least = least_margin(bad);
        for (const int ring : rings) {
            if (least >= 0) break;
            const Points before = mesh_.vertices;
            const auto places = places_;
            relax(ring);
            optimise_softly(rounds);
            const double found = least_margin(bad);
            if (found > least) {
                least = found;
                continue;
            }
            mesh_.vertices = before;
            places_ = places;
        }
        active_.assign(around_.size(), true);
    }

    // Rows of quads that are too narrow next to singular points only give way together with these, by many vertices:
    // round each bad quad all are moved at once, in growing rings.
    void even_bad(int rounds) {
        const std::vector<bool> fixed = fixed_;
        std::vector<std::pair<double, Index>> order;
        for (Index q = 0; q < mesh_.quads.rows(); ++q) normals_[q] = surface_normal(q);
        for (Index q = 0; q < mesh_.quads.rows(); ++q)
            if (const double margin = margin_of(q); margin < 0) order.emplace_back(margin, q);
        std::sort(order.begin(), order.end());
        std::vector<bool> seen(around_.size(), false);
        int places = 0;
        for (const auto& [margin, q] : order) {
            if (places == most_evened) break;
            if (margin_of(q) >= 0 || seen[mesh_.quads(q, 0)]) continue;
            ++places;
            for (const int ring : evened_rings) {
                if (margin_of(q) >= 0) break;
                even_round(q, ring, rounds);
                fixed_ = fixed;
                for (std::size_t v = 0; v < seen.size() && ring == evened_rings[0]; ++v)
                    seen[v] = seen[v] || active_[v];
            }
        }
        active_.assign(around_.size(), true);
        movable_.quads.resize(mesh_.quads.rows());
        std::iota(movable_.quads.begin(), movable_.quads.end(), 0);
    }

    // Kept where the worst of the quads that are moved gets better.
    void even_round(Index bad_quad, int ring, int rounds) {
        std::vector<bool> near(around_.size(), false);
        for (int k = 0; k < 4; ++k) near[mesh_.quads(bad_quad, k)] = true;
        active_ = grown(std::move(near), ring);
        movable_.quads.clear();
        for (Index q = 0; q < mesh_.quads.rows(); ++q)
            if (std::any_of(mesh_.quads.row(q).begin(), mesh_.quads.row(q).end(), [&](Index v) { return active_[v]; }))
                movable_.quads.push_back(q);
        for (std::size_t v = 0; v < fixed_.size(); ++v) fixed_[v] = fixed_[v] || !active_[v];
        const auto worst = [&] {
            double least = 1;
            for (const Index q : movable_.quads) least = std::min(least, margin_of(q));
            return least;
        };
        const auto see = [&] {
            for (const Index q : movable_.quads) normals_[q] = surface_normal(q);
        };
        see();
        const double before = worst();
        const Points vertices = mesh_.vertices;
        const auto places = places_;
        untangle(input_, movable_, size_share, mesh_);
        see();
        optimise_softly(rounds);
        if (worst() > before) return;
        mesh_.vertices = vertices;
        places_ = places;
        see();
    }

    double margin_of(Index q) const { return quality(q) - reachable_of(q, bad); }

    Index bad_count() const {
        Index result = 0;
        for (Index q = 0; q < mesh_.quads.rows(); ++q) result += quality(q) < reachable_of(q, bad);
        return result;
    }

    // A vertex is looked at again when it, or a vertex of the quads round it, has moved since.
    void optimise(int rounds) {
        moved_at_.assign(around_.size(), 0);
        std::vector<long> looked_at(around_.size(), 0);
        std::vector<Index> vertices;
        for (Index v = 0; v < static_cast<Index>(around_.size()); ++v)
            if (active_[v] && !fixed_[v] && !around_[v].empty()) vertices.push_back(v);
        long now = 0;
        for (int round = 0; round < rounds; ++round) {
            bool moved = false;
            for (const Index v : vertices) {
                if (is_settled(v, looked_at[v])) continue;
                looked_at[v] = ++now;
                if (!improve(v)) continue;
                moved_at_[v] = now;
                moved = true;
            }
            if (!moved) return;
        }
    }

    // With all quads round a vertex counting first, which gets past places where two are as bad as one another.
    void optimise_softly(int rounds) {
        soft_ = true;
        optimise(rounds);
        soft_ = false;
        optimise(rounds);
    }

    bool is_settled(Index v, long looked_at) const {
        return std::all_of(around_[v].begin(), around_[v].end(), [&](Index q) {
            for (int k = 0; k < 4; ++k)
                if (moved_at_[mesh_.quads(q, k)] >= looked_at) return false;
            return true;
        });
    }

    std::vector<bool> grown(std::vector<bool> near, int rings) const {
        std::vector<Index> front;
        for (std::size_t v = 0; v < near.size(); ++v)
            if (near[v]) front.push_back(static_cast<Index>(v));
        for (int i = 0; i < rings; ++i) {
            std::vector<Index> next;
            for (const Index v : front)
                for (const Index n : neighbours_[v])
                    if (!near[n]) {
                        near[n] = true;
                        next.push_back(n);
                    }
            front = std::move(next);
        }
        return near;
    }

    // No quad is better than an angle that it is given.
    double reachable_of(Index q, double wanted) const {
        const auto found = given_corners_.find(q);
        if (found == given_corners_.end()) return wanted;
        for (const int k : found->second) {
            const Vector at = position(mesh_.quads(q, k)), u = position(mesh_.quads(q, (k + 1) % 4)) - at,
                         v = position(mesh_.quads(q, (k + 3) % 4)) - at;
            wanted = std::min(wanted, reachable * u.cross(v).norm() / (u.norm() * v.norm()));
        }
        return wanted;
    }

    void relax(int ring) {
        std::vector<bool> near(around_.size(), false);
        for (Index q = 0; q < mesh_.quads.rows(); ++q)
            for (int k = 0; k < 4 && quality(q) < reachable_of(q, bad); ++k) near[mesh_.quads(q, k)] = true;
        near = grown(std::move(near), ring);
        if (!everywhere_) active_ = grown(near, beside);
        relax(near, relaxing_rounds);
    }

    void relax(const std::vector<bool>& near, int rounds) {
        for (int round = 0; round < rounds; ++round) {
            relax_seams(near);
            for (Index v = static_cast<Index>(places_.size()); v < static_cast<Index>(near.size()); ++v) {
                if (!near[v] || fixed_[v] || around_[v].empty()) continue;
                Vector mean = Vector::Zero();
                for (const Index n : neighbours_[v]) mean += position(n) / static_cast<double>(neighbours_[v].size());
                mesh_.vertices.row(v) = nearest(v, mean);
            }
        }
    }

    // To halfway between the neighbours along the seam.
    void relax_seams(const std::vector<bool>& near) {
        for (std::size_t s = 0; s < along_.size(); ++s) {
            const Seam& seam = input_.seams.seams[s];
            const auto count = along_[s].size();
            for (std::size_t i = 0; i < count; ++i) {
                const Index v = along_[s][i];
                if (!near[v] || fixed_[v]) continue;
                const double before = i > 0         ? places_[along_[s][i - 1]].at
                                      : seam.closed ? places_[along_[s].back()].at - seam.length
                                                    : 0;
                const double after = i + 1 < count ? places_[along_[s][i + 1]].at
                                     : seam.closed ? places_[along_[s].front()].at + seam.length
                                                   : seam.length;
                places_[v].at = (before + after) / 2;
                mesh_.vertices.row(v) = position_on(seam, places_[v].at);
            }
        }
    }

    Vector position(Index v) const { return mesh_.vertices.row(v); }
    bool on_seam(Index v) const { return v < static_cast<Index>(places_.size()); }

    Vector surface_normal(Index q) {
        Vector middle = Vector::Zero();
        for (int k = 0; k < 4; ++k) middle += position(mesh_.quads(q, k)) / 4;
        Index& triangle = movable_.triangles[q];
        triangle = parts_.nearest(part_[q], middle, triangle).second;
        return parts_.normal(triangle);
    }

    // Of the surface, to a vertex inside.
    Vector nearest(Index v, const Vector& p) const {
        const Index quad = around_[v][0];
        return parts_.nearest(part_[quad], p, movable_.triangles[quad]).first;
    }

    // Less than -1 where it faces against the surface.
    double quality(Index q) const {
        std::array<Vector, 4> p;
        for (int k = 0; k < 4; ++k) p[k] = position(mesh_.quads(q, k));
        const Vector normal = (p[2] - p[0]).cross(p[3] - p[1]).normalized();
        double least = 1;
        for (int k = 0; k < 4; ++k) {
            const Vector u = p[(k + 1) % 4] - p[k], v = p[(k + 3) % 4] - p[k];
            const double lengths = u.norm() * v.norm();
            least = std::min(least, lengths > 0 ? u.cross(v).dot(normal) / lengths : -1.0);
        }
        const double facing = normal.dot(normals_[q]);
        return facing > 0 ? least : -2 + facing;
    }

    double quality_round(Index v) const {
        double least = 1, sum = 0;
        for (const Index q : around_[v]) {
            const double found = quality(q);
            least = std::min(least, found);
            if (soft_) sum += std::exp(-softness * found);
        }
        return soft_ ? -std::log(sum / static_cast<double>(around_[v].size())) / softness : least;
    }

    double quality_round_at(Index v, const Vector& target) {
        const Vector before = position(v);
        mesh_.vertices.row(v) = target;
        const double found = quality_round(v);
        mesh_.vertices.row(v) = before;
        return found;
    }

    // Moves it there if that is better than `best`.
    bool try_at(Index v, const Vector& target, double& best) {
        const double found = quality_round_at(v, target);
        if (found <= best + least_gain) return false;
        mesh_.vertices.row(v) = target;
        best = found;
        return true;
    }

    bool improve(Index v) {
        double best = quality_round(v);
        if (best > good_enough) return false;
        double edges = 0, shortest = std::numeric_limits<double>::infinity();
        Vector mean = Vector::Zero();
        for (const Index n : neighbours_[v]) {
            const double edge = (position(n) - position(v)).norm();
            edges += edge / static_cast<double>(neighbours_[v].size());
            shortest = std::min(shortest, edge);
            mean += position(n) / static_cast<double>(neighbours_[v].size());
        }
        const auto moved = [&](double unit) { return on_seam(v) ? slide(v, unit, best) : wander(v, mean, unit, best); };
        const bool far = moved(edges);
        return (shortest < short_edge * edges && moved(shortest)) || far;
    }

    bool slide(Index v, double edges, double& best) {
        const Seam& seam = input_.seams.seams[places_[v].seam];
        bool moved = false;
        for (const double step : steps)
            for (const double way : {-1.0, 1.0}) {
                double at = places_[v].at + way * step * edges;
                if (!seam.closed && !(at > 0 && at < seam.length)) continue;
                if (!try_at(v, position_on(seam, at), best)) continue;
                places_[v].at = at;
                moved = true;
            }
        return moved;
    }

    bool wander(Index v, const Vector& mean, double edges, double& best) {
        const auto try_near = [&](const Vector& p) { return try_at(v, nearest(v, p), best); };
        bool moved = false;
        for (const double step : {1.0, 0.5})
            if (try_near(position(v) + step * (mean - position(v)))) {
                moved = true;
                break;
            }
        const Vector normal = normals_[around_[v][0]];
        const Vector u = normal.unitOrthogonal(), w = normal.cross(u);
        for (const double step : steps)
            for (int i = 0; i < 8; ++i) {
                const double angle = i * std::numbers::pi / 4;
                const Vector way = std::cos(angle) * u + std::sin(angle) * w;
                const Vector target = position(v) + step * edges * way;
                // The surface is off the tangent plane by about that much of an edge where it is bent.
                if (quality_round_at(v, target) > best - bend * step * step) moved |= try_near(target);
            }
        return moved;
    }

    const SmootherInput& input_;
    bool everywhere_ = false;
    bool soft_ = false;  // the quads round a vertex count all, the worse the more
    QuadMesh& mesh_;
    const SurfaceParts& parts_;
    std::vector<std::vector<Index>> around_, neighbours_;
    Movable movable_;
    std::vector<SideGrids::OnSeam>& places_ = movable_.places;
    std::vector<std::vector<Index>> along_;  // vertices of each seam, in their order
    std::vector<bool>& fixed_ = movable_.fixed;
    std::vector<bool> active_;
    std::vector<long> moved_at_;                       // when vertices were moved last
    std::map<Index, std::vector<int>> given_corners_;  // of quads
    const std::vector<Index>&held_ = movable_.held, &part_ = movable_.part;
    std::vector<Vector> normals_;  // of the surface at each quad
};

}  // namespace

bool smooth(const SmootherInput& input, int rounds, Rescue rescue, QuadMesh& mesh) {
    return Smoother(input, mesh).run(rounds, rescue);
}

void prepare(const SmootherInput& input, Start start, QuadMesh& mesh) { Smoother(input, mesh).prepare(start); }

double least_margin(const SmootherInput& input, double wanted, QuadMesh& mesh) {
    return Smoother(input, mesh).least_margin(wanted);
}

std::vector<Index> facing_away(const SmootherInput& input, QuadMesh& mesh) {
    return Smoother(input, mesh).facing_away();
}

}  // namespace octafield::surface::detail
