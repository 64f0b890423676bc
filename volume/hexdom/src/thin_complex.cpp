#include "thin_complex.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace octafield::volume::detail {
namespace {

using Vector = Eigen::Vector3d;
constexpr std::size_t most_round = 64;  // triangles at a vertex that is taken out: the work is their number squared
constexpr double infinity = std::numeric_limits<double>::infinity();

// The ring as a polygon filled with triangles from one of its vertices.
std::vector<Corners> fan(const std::vector<Index>& ring, std::size_t apex) {
    const std::size_t n = ring.size();
    std::vector<Corners> result;
    for (std::size_t i = 1; i + 1 < n; ++i)
        result.push_back({ring[apex], ring[(apex + i) % n], ring[(apex + i + 1) % n]});
    return result;
}

class Thinning {
public:
    Thinning(TriangleComplex& complex, const std::vector<std::uint8_t>& removable, const LengthBound& bound,
             const ThinLimits& limits)
        : complex_(complex), removable_(removable), bound_(bound), limits_(limits), key_(removable.size(), infinity) {}

    Index run() {
        for (Index v = 0; v < static_cast<Index>(removable_.size()); ++v) enqueue(v);
        Index count = 0;
        while (!queue_.empty()) {
            const auto [key, v] = queue_.top();
            queue_.pop();
            if (key_[v] != key) continue;
            key_[v] = infinity;
            count += take_out(v);
        }
        return count;
    }

private:
    void enqueue(Index v) {
        if (!removable_[v] || complex_.star[v].empty()) return;
        if (complex_.star[v].size() > most_round) {  // put in when it has lost enough of them
            key_[v] = infinity;
            return;
        }
        double least = infinity;
        for (const Index t : complex_.star[v])
            for (const Index w : complex_.triangles[t])
                if (w != v) least = std::min(least, complex_.distance(v, w));
        if (key_[v] == least) return;
        key_[v] = least;
        queue_.emplace(least, v);
    }

    bool take_out(Index v) {
        const std::vector<Page> pages = complex_.pages(v);
        if (pages.empty()) return false;
        longest_ = 0;
        stretch_ = 1;
        for (const Page& page : pages) {
            for (const Index x : page.ring) {
                const double length = complex_.distance(v, x);
                longest_ = std::max(longest_, length);
                if (length < limits_.crowded * bound_.wanted(v)) stretch_ = 1.5;
            }
            for (std::size_t i = 0; i + 1 < page.ring.size(); ++i)
                longest_ = std::max(longest_, complex_.distance(page.ring[i], page.ring[i + 1]));
        }
        const bool done = complex_.curves_at[v].empty() ? take_out_free(v, pages[0]) : take_out_of_curve(v, pages);
        if (done)
            for (const Page& page : pages)
                for (const Index x : page.ring) enqueue(x);
        return done;
    }

    bool take_out_free(Index v, const Page& page) {
        if (page.ring.size() == 3 && complex_.has_triangle(page.ring[0], page.ring[1], page.ring[2])) return false;
        const double least = least_quality(page);
        std::vector<std::pair<double, std::size_t>> apexes;  // best worst quality first
        for (std::size_t k = 0; k < page.ring.size(); ++k)
            if (const double q = fan_quality(page, k, least); q > 0) apexes.emplace_back(-q, k);
        std::sort(apexes.begin(), apexes.end());
        for (const auto& [q, k] : apexes)
            if (replace(page, fan(page.ring, k))) return true;
        if (!limits_.any_filling) return false;
        const std::vector<Corners> made = filled(page.ring, v);
        return !made.empty() && replace(page, made);
    }

    bool replace(const Page& page, std::vector<Corners> made) {
        const Change change{page.triangles, std::move(made)};
        if (!complex_.lies_on_surface(change, limits_.least_cosine)) return false;
        complex_.apply(change);
        return true;
    }

    double longest_edge(Index a, Index b) const { return std::max(longest_, stretch_ * bound_(a, b)); }

    bool new_edge_fits(Index a, Index b) const {
        return complex_.distance(a, b) <= longest_edge(a, b) && !complex_.has_edge(a, b);
    }

    double least_quality(const Page& page) const {
        return std::min(limits_.least_quality, complex_.worst_quality(page.triangles));
    }

    // 0 where the fan is not allowed.
    double fan_quality(const Page& page, std::size_t apex, double least) const {
        const std::size_t n = page.ring.size();
        double worst = 1;
        for (const Corners& t : fan(page.ring, apex)) {
            worst = std::min(worst, complex_.quality(t));
            if (!(worst > 0) || worst < least) return 0;
        }
        for (std::size_t i = 2; i + 1 < n; ++i)
            if (!new_edge_fits(page.ring[apex], page.ring[(apex + i) % n])) return 0;
        return worst;
    }

    // Ears cut off the ring, the best triangle first; empty where none is left that is allowed.
    std::vector<Corners> filled(std::vector<Index> ring, Index v) const {
        std::vector<Corners> made;
        const Vector normal = ring_normal(ring, v);
        while (ring.size() > 3) {
            const std::size_t n = ring.size();
            std::size_t best = n;
            double most = 0;
            for (std::size_t k = 0; k < n; ++k) {
                const Corners ear{ring[(k + n - 1) % n], ring[k], ring[(k + 1) % n]};
                const double q = ear_quality(ear, normal, ring);
                if (q > most && new_edge_fits(ear[0], ear[2])) most = q, best = k;
            }
            if (best == n) return {};
            made.push_back({ring[(best + n - 1) % n], ring[best], ring[(best + 1) % n]});
            ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(best));
        }
        made.push_back({ring[0], ring[1], ring[2]});
        return complex_.quality(made.back()) >= limits_.least_quality ? made : std::vector<Corners>{};
    }

    Vector ring_normal(const std::vector<Index>& ring, Index v) const {
        Vector sum = Vector::Zero();
        for (std::size_t i = 0; i < ring.size(); ++i)
            sum += (complex_.place(ring[i]) - complex_.place(v))
                       .cross(complex_.place(ring[(i + 1) % ring.size()]) - complex_.place(v));
        return sum;
    }

    // 0 where it is turned over or has another vertex of the ring over it.
    double ear_quality(const Corners& ear, const Vector& normal, const std::vector<Index>& ring) const {
        const auto side = [&](Index a, Index b, Index c) {
            return normal.dot((complex_.place(b) - complex_.place(a)).cross(complex_.place(c) - complex_.place(a)));
        };
        if (!(side(ear[0], ear[1], ear[2]) > 0)) return 0;
        for (const Index x : ring)
            if (x != ear[0] && x != ear[1] && x != ear[2] && side(ear[0], ear[1], x) >= 0 &&
                side(ear[1], ear[2], x) >= 0 && side(ear[2], ear[0], x) >= 0)
                return 0;
        const double q = complex_.quality(ear);
        return q >= limits_.least_quality ? q : 0;
    }

    bool take_out_of_curve(Index v, const std::vector<Page>& pages) {
        const CurveEdge joined = complex_.joined_curve(v);
        if (complex_.curve_edges[complex_.curves_at[v][0]].feature !=
            complex_.curve_edges[complex_.curves_at[v][1]].feature)
            return false;
        if (!chord_fits(joined)) return false;
        std::vector<std::pair<double, Index>> ends;
        for (const Index end : {joined.a, joined.b}) {
            double worst = 1;
            for (const Page& page : pages) worst = std::min(worst, page_quality(page, end));
            if (worst > 0) ends.emplace_back(-worst, end);
        }
        std::sort(ends.begin(), ends.end());
        for (const auto& [q, end] : ends)
            if (collapse_on_curve(v, pages, end)) return true;
        return false;
    }

    // The longer curve edge: short enough, not there, along those beneath. Where a triangle between it and v is all
    // there is of a page, it may be there as that triangle's third side.
    bool chord_fits(const CurveEdge& joined) const {
        const Vector chord = complex_.place(joined.b) - complex_.place(joined.a);
        if (!(chord.norm() > 0) || chord.norm() > longest_edge(joined.a, joined.b) ||
            complex_.curve_edge(joined.a, joined.b) >= 0)
            return false;
        const Vector direction = chord.normalized();
        return std::all_of(joined.beneath.begin(), joined.beneath.end(),
                           [&](const Vector& d) { return d.dot(direction) > limits_.least_cosine; });
    }

    double page_quality(const Page& page, Index end) const {
        if (page.ring.size() == 2) return 1;
        return fan_quality(page, page.ring.front() == end ? 0 : page.ring.size() - 1, least_quality(page));
    }

    bool collapse_on_curve(Index v, const std::vector<Page>& pages, Index end) {
        std::vector<Change> changes;
        bool thin_page = false;
        for (const Page& page : pages) {
            Change change{page.triangles, {}};
            if (page.ring.size() == 2) {
                const Index over = complex_.across(page.ring[0], page.ring[1], page.triangles[0]);
                if (over < 0 || thin_page) return false;
                thin_page = true;
                change.gone.push_back(over);
                change.made.push_back(complex_.triangles[over]);
            } else {
                change.made = fan(page.ring, page.ring.front() == end ? 0 : page.ring.size() - 1);
                for (const auto& [a, b, c] : change.made)
                    if (complex_.has_triangle(a, b, c)) return false;
            }
            if (!complex_.lies_on_surface(change, limits_.least_cosine)) return false;
            changes.push_back(std::move(change));
        }
        const CurveEdge joined = complex_.joined_curve(v);
        if (!thin_page && complex_.has_edge(joined.a, joined.b)) return false;
        for (const Change& change : changes) complex_.apply(change);
        complex_.join_curve(v);
        return true;
    }

    TriangleComplex& complex_;
    const std::vector<std::uint8_t>& removable_;
    const LengthBound& bound_;
    const ThinLimits& limits_;
    double longest_ = 0, stretch_ = 1;  // round the vertex at hand
    std::vector<double> key_;           // of those in the queue
    std::priority_queue<std::pair<double, Index>, std::vector<std::pair<double, Index>>, std::greater<>> queue_;
};

}  // namespace

Index thin(TriangleComplex& complex, const std::vector<std::uint8_t>& removable, const LengthBound& bound,
           const ThinLimits& limits) {
    return Thinning(complex, removable, bound, limits).run();
}

}  // namespace octafield::volume::detail
