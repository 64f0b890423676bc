#include "triangle_complex.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace octafield::volume::detail {
namespace {

using Vector = Eigen::Vector3d;

bool contains(const Corners& t, Index v) { return t[0] == v || t[1] == v || t[2] == v; }

// Ericson, Real-Time Collision Detection (2005), 5.1.5.
double squared_distance(const Vector& p, const Vector& a, const Vector& b, const Vector& c) {
    const Vector ab = b - a, ac = c - a, ap = p - a;
    const double d1 = ab.dot(ap), d2 = ac.dot(ap);
    if (d1 <= 0 && d2 <= 0) return ap.squaredNorm();
    const Vector bp = p - b;
    const double d3 = ab.dot(bp), d4 = ac.dot(bp);
    if (d3 >= 0 && d4 <= d3) return bp.squaredNorm();
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return (ap - d1 / (d1 - d3) * ab).squaredNorm();
    const Vector cp = p - c;
    const double d5 = ab.dot(cp), d6 = ac.dot(cp);
    if (d6 >= 0 && d5 <= d6) return cp.squaredNorm();
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return (ap - d2 / (d2 - d6) * ac).squaredNorm();
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 >= d3 && d5 >= d6) return (bp - (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b)).squaredNorm();
    const double sum = va + vb + vc;
    return (ap - vb / sum * ab - vc / sum * ac).squaredNorm();
}

}  // namespace

void TriangleComplex::add(const Corners& t, Index group_of_it, Index old_triangle, const Vector& old_normal) {
    const Index id = static_cast<Index>(triangles.size());
    triangles.push_back({-1, -1, -1});
    group.push_back(group_of_it);
    put(id, t);
    first_sample_.push_back(static_cast<Index>(samples_.size()));
    reference_.push_back(first_sample_.back());
    samples_.push_back({middle(t), old_normal, old_triangle, -1});
}

void TriangleComplex::add_curve_edge(Index a, Index b, bool feature, const Vector& direction) {
    for (const Index v : {a, b}) curves_at[v].push_back(static_cast<Index>(curve_edges.size()));
    curve_edges.push_back({a, b, feature, {direction}});
}

Index TriangleComplex::curve_edge(Index a, Index b) const {
    for (const Index e : curves_at[a])
        if (curve_edges[e].a == b || curve_edges[e].b == b) return e;
    return -1;
}

void TriangleComplex::triangles_at_edge(Index a, Index b, std::vector<Index>& found) const {
    found.clear();
    if (star[b].size() < star[a].size()) std::swap(a, b);
    for (const Index t : star[a])
        if (contains(triangles[t], b)) found.push_back(t);
}

bool TriangleComplex::has_edge(Index a, Index b) const {
    if (star[b].size() < star[a].size()) std::swap(a, b);
    return std::any_of(star[a].begin(), star[a].end(), [&](Index t) { return contains(triangles[t], b); });
}

bool TriangleComplex::has_triangle(Index a, Index b, Index c) const {
    return std::any_of(star[a].begin(), star[a].end(),
                       [&](Index t) { return contains(triangles[t], b) && contains(triangles[t], c); });
}

Vector TriangleComplex::scaled_normal(const Corners& t) const {
    return (place(t[1]) - place(t[0])).cross(place(t[2]) - place(t[0]));
}

double TriangleComplex::quality(const Corners& t) const {
    const double sum = (at.row(t[0]) - at.row(t[1])).squaredNorm() + (at.row(t[1]) - at.row(t[2])).squaredNorm() +
                       (at.row(t[2]) - at.row(t[0])).squaredNorm();
    return sum > 0 ? 2 * std::sqrt(3.0) * scaled_normal(t).norm() / sum : 0;
}

double TriangleComplex::worst_quality(const std::vector<Index>& some) const {
    double worst = 1;
    for (const Index t : some) worst = std::min(worst, quality(triangles[t]));
    return worst;
}

Index TriangleComplex::across(Index a, Index b, Index triangle) const {
    Index other = -1;
    if (star[b].size() < star[a].size()) std::swap(a, b);
    for (const Index t : star[a]) {
        if (t == triangle || !contains(triangles[t], b)) continue;
        if (other >= 0) return -1;
        other = t;
    }
    return other;
}

std::vector<Page> TriangleComplex::pages(Index v) const {
    if (star[v].empty() || (!curves_at[v].empty() && curves_at[v].size() != 2)) return {};
    std::vector<std::pair<Index, Index>> sides;  // opposite v, as its triangles run
    for (const Index t : star[v]) {
        const Corners c = turned(triangles[t], v);
        sides.emplace_back(c[1], c[2]);
    }
    const bool free = curves_at[v].empty();
    std::vector<Page> result;
    std::size_t used = 0;
    for (std::size_t first = 0; first < sides.size(); ++first) {
        if (free ? first > 0 : curve_edge(v, sides[first].first) < 0) continue;
        Page page{{sides[first].first}, {star[v][first]}};
        Index head = sides[first].second;
        while (free ? head != page.ring[0] : curve_edge(v, head) < 0) {
            page.ring.push_back(head);
            const auto next = std::find_if(sides.begin(), sides.end(), [&](const auto& s) { return s.first == head; });
            if (next == sides.end() || page.triangles.size() >= sides.size()) return {};
            page.triangles.push_back(star[v][next - sides.begin()]);
            head = next->second;
        }
        if (!free && head == page.ring[0]) return {};
        if (!free) page.ring.push_back(head);
        used += page.triangles.size();
        result.push_back(std::move(page));
    }
    if (used != sides.size()) return {};
    return result;
}

std::vector<Index> TriangleComplex::samples_of(const std::vector<Index>& some) const {
    std::vector<Index> result;
    for (const Index t : some)
        for (Index s = first_sample_[t]; s >= 0; s = samples_[s].next) result.push_back(s);
    return result;
}

// Samples that tell the old surface beneath: those of the triangles, and for one without what it refers to.
std::vector<Index> TriangleComplex::references_of(const std::vector<Index>& some) const {
    std::vector<Index> result = samples_of(some);
    for (const Index t : some)
        if (first_sample_[t] < 0) result.push_back(reference_[t]);
    return result;
}

std::vector<int> TriangleComplex::owners(const std::vector<Index>& samples, const std::vector<Corners>& made) const {
    std::vector<int> result(samples.size(), 0);
    if (made.size() == 1) return result;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < made.size(); ++k) {
            const auto& [a, b, c] = made[k];
            const double d = squared_distance(samples_[samples[i]].place, place(a), place(b), place(c));
            if (d < least) least = d, result[i] = static_cast<int>(k);
        }
    }
    return result;
}

Index TriangleComplex::nearest_sample(const std::vector<Index>& samples, const Vector& place) const {
    Index best = -1;
    double least = std::numeric_limits<double>::infinity();
    for (const Index s : samples)
        if (const double d = (samples_[s].place - place).squaredNorm(); d < least) least = d, best = s;
    return best;
}

bool TriangleComplex::lies_on_surface(const Change& change, double least_cosine) const {
    std::vector<Vector> normals;
    for (const Corners& t : change.made) {
        const Vector n = scaled_normal(t);
        const double length = n.norm();
        if (!(length > 0)) return false;
        normals.push_back(n / length);
    }
    const std::vector<Index> references = references_of(change.gone);
    const auto agrees = [&](Index s, const Vector& normal) { return samples_[s].normal.dot(normal) > least_cosine; };
    const bool all = std::all_of(references.begin(), references.end(), [&](Index s) {
        return std::all_of(normals.begin(), normals.end(), [&](const Vector& n) { return agrees(s, n); });
    });
    if (all) return true;
    const std::vector<Index> samples = samples_of(change.gone);
    const std::vector<int> owner = owners(samples, change.made);
    std::vector<bool> has(change.made.size(), false);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (!agrees(samples[i], normals[owner[i]])) return false;
        has[owner[i]] = true;
    }
    for (std::size_t k = 0; k < has.size(); ++k)
        if (!has[k] && !agrees(nearest_sample(references, middle(change.made[k])), normals[k])) return false;
    return true;
}

void TriangleComplex::remove(Index t) {
    for (const Index v : triangles[t]) star[v].erase(std::find(star[v].begin(), star[v].end(), t));
    triangles[t] = {-1, -1, -1};
}

void TriangleComplex::put(Index t, const Corners& corners) {
    triangles[t] = corners;
    for (const Index v : corners) star[v].push_back(t);
}

void TriangleComplex::apply(const Change& change) {
    const std::vector<Index> samples = samples_of(change.gone), references = references_of(change.gone);
    const std::vector<int> owner = owners(samples, change.made);
    for (const Index t : change.gone) {
        remove(t);
        first_sample_[t] = -1;
    }
    for (std::size_t k = 0; k < change.made.size(); ++k) put(change.gone[k], change.made[k]);
    for (std::size_t i = samples.size(); i-- > 0;) {
        Index& first = first_sample_[change.gone[owner[i]]];
        samples_[samples[i]].next = first;
        first = samples[i];
    }
    for (std::size_t k = 0; k < change.made.size(); ++k)
        if (first_sample_[change.gone[k]] < 0)
            reference_[change.gone[k]] = nearest_sample(references, middle(change.made[k]));
}

CurveEdge TriangleComplex::joined_curve(Index v) const {
    const CurveEdge &first = curve_edges[curves_at[v][0]], &second = curve_edges[curves_at[v][1]];
    CurveEdge result{first.a == v ? first.b : first.a, second.a == v ? second.b : second.a, first.feature, {}};
    for (const Vector& d : first.beneath) result.beneath.push_back(first.b == v ? d : Vector(-d));
    for (const Vector& d : second.beneath) result.beneath.push_back(second.a == v ? d : Vector(-d));
    return result;
}

void TriangleComplex::join_curve(Index v) {
    const Index kept = curves_at[v][0], lost = curves_at[v][1];
    curve_edges[kept] = joined_curve(v);
    auto& there = curves_at[curve_edges[kept].b];
    *std::find(there.begin(), there.end(), lost) = kept;
    curve_edges[lost] = {-1, -1, false, {}};
    curves_at[v].clear();
}

Index TriangleComplex::nearest_old_triangle(Index t) const {
    return samples_[nearest_sample(references_of({t}), middle(triangles[t]))].old_triangle;
}

}  // namespace octafield::volume::detail
