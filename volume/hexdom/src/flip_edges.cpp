#include "flip_edges.hpp"

#include <algorithm>
#include <cmath>
#include <deque>

namespace octafield::volume::detail {
namespace {

using Vector = Eigen::Vector3d;

constexpr double cos_30 = 0.8660254037844387, cos_60 = 0.5;
constexpr double least_wanted_quality = 1e-3;

// Of the three angles of a triangle, by the cosine of the least one.
double cosine_of_least_angle(const Vector& a, const Vector& b, const Vector& c) {
    const Vector ab = (b - a).normalized(), bc = (c - b).normalized(), ca = (a - c).normalized();
    return std::max({-ab.dot(ca), -bc.dot(ab), -ca.dot(bc)});
}

// Triangles (a, b, c) and (b, a, d) at the edge from a to b.
struct Diamond {
    Index a, b, c, d, left, right;
    Change flipped() const { return {{left, right}, {{a, d, c}, {d, b, c}}}; }
};

// False where the edge is of a curve, has not two triangles, or its flip is there already.
bool flippable(const TriangleComplex& complex, Index a, Index b, Diamond& diamond) {
    if (complex.curve_edge(a, b) >= 0) return false;
    Index found[2] = {-1, -1};
    int count = 0;
    const bool fewer = complex.star[b].size() < complex.star[a].size();
    const Index other = fewer ? a : b;
    for (const Index t : complex.star[fewer ? b : a]) {
        const Corners& c = complex.triangles[t];
        if (c[0] != other && c[1] != other && c[2] != other) continue;
        if (count == 2) return false;
        found[count++] = t;
    }
    if (count != 2) return false;
    Corners first = turned(complex.triangles[found[0]], a), second = turned(complex.triangles[found[1]], a);
    if (first[1] != b) std::swap(first, second), std::swap(found[0], found[1]);
    if (first[1] != b || second[2] != b) return false;
    diamond = {a, b, first[2], second[1], found[0], found[1]};
    return diamond.c != diamond.d && !complex.has_edge(diamond.c, diamond.d);
}

class Flipping {
public:
    Flipping(TriangleComplex& complex, const WantedEdges& wanted, const LengthBound& bound)
        : complex_(complex), wanted_(wanted), bound_(bound) {}

    Index run() {
        for (Index t = static_cast<Index>(complex_.triangles.size()); t-- > 0;)
            if (complex_.alive(t))
                for (int k = 0; k < 3; ++k) {
                    const Index a = complex_.triangles[t][k], b = complex_.triangles[t][(k + 1) % 3];
                    if (a < b) stack_.emplace_back(a, b);
                }
        Index count = 0;
        while (!stack_.empty()) {
            const auto [a, b] = stack_.back();
            stack_.pop_back();
            Diamond d;
            if (wanted_.has(a, b) || !flippable(complex_, a, b, d)) continue;
            if (!(wanted_.has(d.c, d.d) ? wanted_flip_fits(d) : better(d))) continue;
            complex_.apply(d.flipped());
            ++count;
            for (const auto& side : {std::pair(d.a, d.c), {d.c, d.b}, {d.b, d.d}, {d.d, d.a}}) stack_.push_back(side);
        }
        return count;
    }

private:
    bool wanted_flip_fits(const Diamond& d) const {
        const Change change = d.flipped();
        return std::min(complex_.quality(change.made[0]), complex_.quality(change.made[1])) > least_wanted_quality &&
               complex_.lies_on_surface(change, cos_60);
    }

    bool better(const Diamond& d) const {
        const Vector a = complex_.place(d.a), b = complex_.place(d.b), c = complex_.place(d.c), e = complex_.place(d.d);
        const double before = std::max(cosine_of_least_angle(a, b, c), cosine_of_least_angle(b, a, e));
        const double after = std::max(cosine_of_least_angle(a, e, c), cosine_of_least_angle(e, b, c));
        if (!(after < before - 1e-9)) return false;
        const double longest = std::max(
            {bound_(d.c, d.d), (a - b).norm(), (a - c).norm(), (b - c).norm(), (a - e).norm(), (b - e).norm()});
        return (c - e).norm() <= longest && complex_.lies_on_surface(d.flipped(), cos_30);
    }

    TriangleComplex& complex_;
    const WantedEdges& wanted_;
    const LengthBound& bound_;
    std::vector<std::pair<Index, Index>> stack_;
};

class Recovery {
public:
    Recovery(TriangleComplex& complex, const WantedEdges& wanted, Index a, Index b)
        : complex_(complex), wanted_(wanted), a_(a), b_(b) {}

    bool run() {
        if (complex_.has_edge(a_, b_)) return true;
        const std::vector<Index> around = complex_.star[a_];
        for (const Index t : around) {
            if (!find_way(t)) continue;
            return flip_way();
        }
        return false;
    }

private:
    // > 0: left of the way, seen against the normal.
    double side(Index x) const { return side(a_, b_, x); }
    double side(Index p, Index q, Index x) const {
        return normal_.dot((complex_.place(q) - complex_.place(p)).cross(complex_.place(x) - complex_.place(p)));
    }

    // Of the triangles round a that are joined to this one across edges that are on no curve.
    Vector normal_round(Index first) const {
        std::vector<Index> sheet{first};
        for (std::size_t i = 0; i < sheet.size(); ++i) {
            const Corners c = turned(complex_.triangles[sheet[i]], a_);
            for (const Index x : {c[1], c[2]}) {
                if (complex_.curve_edge(a_, x) >= 0) continue;
                const Index next = complex_.across(a_, x, sheet[i]);
                if (next >= 0 && std::find(sheet.begin(), sheet.end(), next) == sheet.end()) sheet.push_back(next);
            }
        }
        Vector sum = Vector::Zero();
        for (const Index t : sheet) {
            const auto& [p, q, r] = complex_.triangles[t];
            sum += (complex_.place(q) - complex_.place(p)).cross(complex_.place(r) - complex_.place(p));
        }
        return sum.normalized();
    }

    // The edges from a to b that a straight way from this triangle crosses.
    bool find_way(Index t) {
        const Corners start = turned(complex_.triangles[t], a_);
        normal_ = normal_round(t);
        const double rounding = 1e-9 * (complex_.place(b_) - complex_.place(a_)).squaredNorm();
        Index right = start[1], left = start[2];
        if (!(side(a_, right, left) > 0) || !(side(right) < -rounding) || !(side(left) > rounding)) return false;
        crossed_.clear();
        while (crossed_.size() < 64) {
            if (complex_.curve_edge(right, left) >= 0 || wanted_.has(right, left)) return false;
            crossed_.emplace_back(right, left);
            t = complex_.across(right, left, t);
            if (t < 0) return false;
            const auto& [p, q, r] = complex_.triangles[t];
            const Index apex = p != right && p != left ? p : q != right && q != left ? q : r;
            if (apex == b_) return true;
            const double where = side(apex);
            if (std::abs(where) <= rounding) return false;
            (where > 0 ? left : right) = apex;
        }
        return false;
    }

    bool flip_way() {
        for (std::size_t left = 8 + 4 * crossed_.size() * crossed_.size(); !crossed_.empty() && left > 0; --left) {
            const auto [p, q] = crossed_.front();
            crossed_.pop_front();
            Diamond d;
            if (!flippable(complex_, p, q, d) || !convex(d) || !complex_.lies_on_surface(d.flipped(), cos_60)) {
                crossed_.emplace_back(p, q);
                continue;
            }
            complex_.apply(d.flipped());
            const bool ends = d.c == a_ || d.c == b_ || d.d == a_ || d.d == b_;
            if (!ends && side(d.c) * side(d.d) < 0) crossed_.emplace_back(d.c, d.d);
        }
        return complex_.has_edge(a_, b_);
    }

    bool convex(const Diamond& d) const {
        const double rounding = 1e-6 * (complex_.place(d.c) - complex_.place(d.d)).squaredNorm();
        return side(d.a, d.d, d.c) > rounding && side(d.d, d.b, d.c) > rounding;
    }

    TriangleComplex& complex_;
    const WantedEdges& wanted_;
    Index a_, b_;
    Vector normal_ = Vector::Zero();
    std::deque<std::pair<Index, Index>> crossed_;
};

}  // namespace

WantedEdges::WantedEdges(const Quads& quads, Index points) : first_(points + 1, 0) {
    for (const auto quad : quads.rowwise())
        for (int k = 0; k < 4; ++k) edges_.push_back(std::minmax({quad[k], quad[(k + 1) % 4]}));
    std::sort(edges_.begin(), edges_.end());
    edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
    for (const auto& edge : edges_) ++first_[edge.first + 1];
    for (Index p = 0; p < points; ++p) first_[p + 1] += first_[p];
}

bool WantedEdges::has(Index a, Index b) const {
    if (a > b) std::swap(a, b);
    if (b + 1 >= static_cast<Index>(first_.size())) return false;
    return std::any_of(edges_.begin() + first_[a], edges_.begin() + first_[a + 1],
                       [&](const auto& edge) { return edge.second == b; });
}

Index flip_edges(TriangleComplex& complex, const WantedEdges& wanted, const LengthBound& bound) {
    return Flipping(complex, wanted, bound).run();
}

bool recover_edge(TriangleComplex& complex, const WantedEdges& wanted, Index a, Index b) {
    return Recovery(complex, wanted, a, b).run() || Recovery(complex, wanted, b, a).run();
}

}  // namespace octafield::volume::detail
