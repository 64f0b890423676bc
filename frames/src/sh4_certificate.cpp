// Branch and bound for the global maximum over SO(3)/O of F(q) = v . embed(q), |v| = 1; bounds in sh4_bound.hpp.
//
// Region. Every frame has a quaternion (1, r) / |(1, r)| with r in the cube |r_i| <= tan(pi / 8) cut by the octahedron
// |r_1| + |r_2| + |r_3| <= 1 (the Voronoi cell of the identity among the 24 rotations of the cube). A box of r with
// centre c and half width h holds rotations within the angle rho = 2 asin(sqrt(3) h / |(1, c)|) of that of c, because a
// ball of radius d about the point p is seen from the origin under the angle asin(d / |p|).
//
// Balls. Boxes inside a ball about a local maximum in which F cannot exceed that maximum are settled at once; without
// them ever smaller boxes would crowd round every maximum of nearly the highest value. Where the maximisers form a
// curve there is no such ball, and the boxes along it end at the size at which the bound is within the tolerance: it is
// the value that is certified, not the frame.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "nearest_frame.hpp"
#include "octafield/frames/sh4_projection.hpp"
#include "sh4_bound.hpp"
#include "sh4_kernel.hpp"

namespace octafield::frames {
namespace {

using sh4::LocalExpansion;

struct Ball {
    std::array<Quaternion, octahedral_order> centre;  // all rotations of the frame
    double radius;
};

struct Box {
    Vector3 centre;
    double value, bound;  // F at the centre, upper bound in the box
};

Quaternion rotation_of(const Vector3& r) { return Quaternion(1, r[0], r[1], r[2]).normalized(); }

double angle_of_box(const Vector3& centre, double half) {
    return 2 * std::asin(std::min(1.0, std::sqrt(3.0) * half / std::sqrt(1 + centre.squaredNorm())));
}

class Search {
public:
    Search(const Sh4::Vector& v, double tolerance) : kernel_(sh4::kernels().front()), tolerance_(tolerance) {
        sh4::unit_form(v.data(), form_);
    }

    // Makes q known: the best frame if it is, and the centre of a ball if it is a proper maximum. Returns F(q).
    double add(const Quaternion& q);
    // False if more than `most_boxes` would be needed.
    bool run(std::int64_t most_boxes);

    const Quaternion& best() const { return best_; }
    double best_value() const { return best_value_; }
    double bound() const { return bound_; }  // of F over all frames, once run() has ended
    std::int64_t boxes() const { return boxes_; }

private:
    LocalExpansion expansion_at(const Quaternion& q) const;
    bool inside_a_ball(const Quaternion& q, double rho) const;
    void climb_from(const Vector3& centre);
    void bound_level();
    void climb_from_highest();
    void split();

    const sh4::Kernel& kernel_;
    double form_[sh4::form_size];
    double tolerance_;
    Quaternion best_;
    double best_value_ = -2, bound_ = -2;
    std::int64_t boxes_ = 0;
    std::vector<Ball> balls_;
    double half_ = 0;                 // half width of the boxes of this level
    std::vector<Box> level_, open_;   // all boxes of the level, those not settled
    std::vector<double> q_, values_;  // arguments and results of kernel_.expand
};

LocalExpansion unpack(const double* e, std::int64_t stride) {
    const auto at = [&](int k) { return e[k * stride]; };
    LocalExpansion x;
    x.value = at(0);
    x.gradient = {at(1), at(2), at(3)};
    x.hessian << at(4), at(9), at(8), at(9), at(5), at(7), at(8), at(7), at(6);
    return x;
}

LocalExpansion Search::expansion_at(const Quaternion& q) const {
    double in[32], out[80];
    const Vector4 c = to_wxyz(q);
    for (int k = 0; k < 32; ++k) in[k] = c[k / 8];
    kernel_.expand(form_, in, 1, 8, out);
    return unpack(out, 8);
}

double Search::add(const Quaternion& q) {
    const LocalExpansion e = expansion_at(q);
    if (e.value > best_value_) best_ = q, best_value_ = e.value;
    const double radius = sh4::radius_below(e);
    if (radius > 0) {
        Ball& ball = balls_.emplace_back();
        ball.radius = radius;
        for (int o = 0; o < octahedral_order; ++o) ball.centre[o] = q * octahedral_group()[o];
        bound_ = std::max(bound_, e.value + e.gradient.norm() * radius + sh4::rounding);
    }
    return e.value;
}

bool Search::inside_a_ball(const Quaternion& q, double rho) const {
    for (const Ball& ball : balls_) {
        if (ball.radius <= rho) continue;
        const double least = std::cos((ball.radius - rho) / 2) + 1e-14;
        for (const Quaternion& centre : ball.centre)
            if (std::abs(centre.dot(q)) >= least) return true;
    }
    return false;
}

void Search::climb_from(const Vector3& centre) {
    Vector4 q = to_wxyz(rotation_of(centre));
    kernel_.climb(form_, q.data());
    const Quaternion reached = from_wxyz(q);
    if (!inside_a_ball(reached, 0)) add(reached);
}

void Search::bound_level() {
    const auto n = static_cast<std::int64_t>(level_.size()), stride = (n + 7) / 8 * 8;
    q_.assign(4 * stride, 1.0), values_.resize(10 * stride);
    for (std::int64_t i = 0; i < n; ++i)
        for (int k = 0; k < 3; ++k) q_[(k + 1) * stride + i] = level_[i].centre[k];
    kernel_.expand(form_, q_.data(), n, stride, values_.data());
    boxes_ += n;
    const std::int64_t highest = std::max_element(values_.begin(), values_.begin() + n) - values_.begin();
    // The frame of sh4_project is not the best, and this box shows it.
    if (n > 0 && values_[highest] > best_value_ + sh4::rounding) climb_from(level_[highest].centre);
    open_.clear();
    for (std::int64_t i = 0; i < n; ++i) {
        Box& box = level_[i];
        const double rho = angle_of_box(box.centre, half_);
        box.value = values_[i];
        box.bound = sh4::upper_bound(unpack(&values_[i], stride), rho, best_value_ + tolerance_);
        if (box.bound <= best_value_ + tolerance_)
            bound_ = std::max(bound_, box.bound);
        else if (!inside_a_ball(rotation_of(box.centre), rho))
            open_.push_back(box);
    }
}

// Other maxima of nearly the highest value get balls of their own.
void Search::climb_from_highest() {
    constexpr int most_climbs = 3;
    constexpr std::size_t most_balls = 16;
    for (int times = 0; times < most_climbs && !open_.empty() && balls_.size() < most_balls; ++times) {
        const auto higher = [](const Box& a, const Box& b) { return a.value < b.value; };
        const std::size_t before = balls_.size();
        climb_from(std::max_element(open_.begin(), open_.end(), higher)->centre);
        if (balls_.size() == before) return;
        std::erase_if(open_, [&](const Box& box) {
            return inside_a_ball(rotation_of(box.centre), angle_of_box(box.centre, half_));
        });
    }
}

void Search::split() {
    level_.clear();
    half_ /= 2;
    for (const Box& box : open_)
        for (int corner = 0; corner < 8; ++corner) {
            const Vector3 step(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
            const Vector3 child = box.centre + half_ * step;
            if ((child.cwiseAbs().array() - half_).max(0).sum() <= 1 + 1e-12) level_.push_back({child, 0, 0});
        }
}

bool Search::run(std::int64_t most_boxes) {
    half_ = std::tan(std::numbers::pi / 8) * (1 + 1e-12);
    open_ = {{Vector3::Zero(), 0, 0}};
    for (int times = 0; times < 2; ++times) {  // boxes too large for the bounds to settle any
        split();
        open_ = level_;
    }
    while (!open_.empty()) {
        if (boxes_ + 8 * static_cast<std::int64_t>(open_.size()) > most_boxes) {
            for (const Box& box : open_) bound_ = std::max(bound_, boxes_ > 0 ? box.bound : 1.0);
            return false;
        }
        split();
        bound_level();
        climb_from_highest();
    }
    return true;
}

}  // namespace

CertifiedProjection sh4_project_certified(const Sh4::Vector& v, double gap_tolerance, std::int64_t most_boxes) {
    if (!(gap_tolerance > 0 && gap_tolerance < 1))
        throw InvalidInput("gap_tolerance is " + std::to_string(gap_tolerance) + "; it must lie between 0 and 1",
                           "bad_tolerance");
    CertifiedProjection result;
    result.projection = Sh4::project(v);
    if (v.isZero(0)) {  // all frames are equally near
        result.certified = true;
        return result;
    }
    const double tolerance = std::max(gap_tolerance, 10 * sh4::rounding);
    Search search(v, tolerance);
    const double value = search.add(result.projection.frame);
    result.certified = search.run(most_boxes);
    result.boxes = search.boxes();
    result.improved = search.best_value() > value + tolerance;
    if (search.best_value() > value + sh4::rounding) {
        const double norm = v.stableNorm();
        const double scale = std::max(1.0, norm);
        const Sh4::Vector difference = v / scale - Sh4::embed(search.best()) / scale;
        result.projection = {search.best(), scale * difference.norm()};
    }
    result.gap = std::max(0.0, search.bound() - std::max(value, search.best_value()));
    return result;
}

}  // namespace octafield::frames
