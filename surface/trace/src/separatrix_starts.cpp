#include "separatrix_starts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "unfolded_patch.hpp"
#include "walk_straight.hpp"

namespace octafield::surface::detail {
namespace {

using std::numbers::pi;
// Directions at a vertex nearer than this (radians) to a feature edge are the feature's.
constexpr double feature_width = 0.05;

// Round a vertex: g = N times the angle of the field from the edge that leaves it at angle phi, without jumps from one
// edge to the next; between them it runs from one value to the other. The field points away where g is a multiple of
// 2 pi.
struct Sample {
    double phi, g;
};

// Angles where g falls to each multiple of 2 pi, from 2 pi * highest to 2 pi * lowest, for the first time. Where g is
// not monotonic a level has further crossings, in pairs; the first one stands for all.
std::vector<double> first_crossings(const std::vector<Sample>& samples, int highest, int lowest) {
    std::vector<double> angles;
    std::size_t i = 0;
    for (int level = highest; level >= lowest; --level) {
        while (i + 1 < samples.size() && samples[i + 1].g > 2 * pi * level) ++i;
        if (i + 1 == samples.size()) break;
        const Sample &a = samples[i], &b = samples[i + 1];
        const double part = a.g > b.g ? (a.g - 2 * pi * level) / (a.g - b.g) : 0;
        angles.push_back(a.phi + std::clamp(part, 0.0, 1.0) * (b.phi - a.phi));
    }
    return angles;
}

// All round a vertex with features: one period of g, over which it falls by 2 pi * count, from its maximum on.
std::vector<double> crossings_round(std::vector<Sample> samples, int count) {
    if (count <= 0) return {};
    const double total = samples.back().phi;
    samples.pop_back();
    const auto top =
        std::max_element(samples.begin(), samples.end(), [](const auto& a, const auto& b) { return a.g < b.g; });
    std::vector<Sample> period(top, samples.end());
    for (auto s = samples.begin(); s <= top; ++s) period.push_back({s->phi + total, s->g - 2 * pi * count});
    const int highest = static_cast<int>(std::floor(period.front().g / (2 * pi)));
    std::vector<double> angles = first_crossings(period, highest, highest - count + 1);
    for (double& angle : angles) angle = angle >= total ? angle - total : angle;
    std::sort(angles.begin(), angles.end());
    return angles;
}

// `count` angles in [0, total), evenly spread, where phase - 2 pi * count * angle / total is a multiple of 2 pi.
std::vector<double> even_angles(double phase, int count, double total) {
    std::vector<double> angles;
    for (int i = 0; i < count; ++i) {
        const double turns = phase / (2 * pi) + i;
        angles.push_back(total * (turns - std::floor(turns / count) * count) / count);
    }
    std::sort(angles.begin(), angles.end());
    return angles;
}

// All round a vertex without features: the even spread that fits g best.
std::vector<double> fitted_round(const std::vector<Sample>& samples, int count) {
    if (count <= 0) return {};
    const double total = samples.back().phi;
    Complex sum = 0;
    for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
        const double before = i == 0 ? total - samples[samples.size() - 2].phi : samples[i].phi - samples[i - 1].phi;
        const double weight = before + samples[i + 1].phi - samples[i].phi;
        sum += weight * std::polar(1.0, samples[i].g + 2 * pi * count * samples[i].phi / total);
    }
    return even_angles(std::arg(sum), count, total);
}

}  // namespace

// Near the point the N-fold angle of the field is k phi + c plus terms that average out on circles; c is taken from the
// edge midpoints at about an edge length from it, as the values in the triangle itself depend on how the point lies in
// it. Away from the point N phi = k phi + c.
std::vector<SeparatrixStart> starts_in_triangle(const ChartedField& field, const SurfaceSingularity& point,
                                                const DirectionTracer& tracer) {
    const int symmetry = field.symmetry(), count = symmetry - point.index_times_symmetry;
    if (count <= 0) return {};
    const Index t = point.triangle;
    const Complex middle = field.centroid(t), exact = field.lower(t, point.position);
    const Complex zero = exact + 1e-3 * (middle - exact);      // so that it does not lie on a side
    const double size = 1.5 * std::sqrt(field.twice_area(t));  // edge length of an equilateral triangle
    Complex sum = 0;
    const auto is_feature = [&](Index edge) { return tracer.is_feature(edge); };
    for (const PatchValue& value : values_round(field, is_feature, t, zero, 0.4 * size, 1.6 * size))
        sum += value.weight * value.f * std::polar(1.0, -point.index_times_symmetry * std::arg(value.at - zero));
    std::vector<SeparatrixStart> starts;
    for (const double phi : even_angles(std::arg(sum), count, 2 * pi)) {
        SeparatrixStart start{{point.position}, {}, {t, zero, std::polar(1.0, phi)}};
        walk_straight(field, tracer, size, start.place, start.points, start.triangles);
        starts.push_back(std::move(start));
    }
    return starts;
}

SeparatrixStart start_in_corner(const Charts& charts, Index corner, double width, double angle) {
    const Index t = corner / 3;
    const int k = corner % 3;
    const double inside = std::clamp(angle, 1e-3 * width, (1 - 1e-3) * width);
    const Complex away = charts.side(t, k) / std::abs(charts.side(t, k)) * std::polar(1.0, inside);
    const Complex apex = charts.corners(t)[k], opposite = charts.side(t, (k + 1) % 3);
    const double reach = cross(opposite, apex - charts.corners(t)[(k + 1) % 3]) / -cross(opposite, away);
    const Complex at = apex + reach / 2 * away;
    return {{charts.lift(t, apex), charts.lift(t, at)}, {t}, {t, at, away}};
}

std::vector<SeparatrixStart> starts_at_vertex(const ChartedField& field, const std::vector<CornerLink>& links,
                                              const Eigen::VectorXcd& values, const VertexFans::Fan& fan,
                                              const DirectionTracer& tracer) {
    const VertexFans& fans = field.domain().fans();
    const int symmetry = field.symmetry();
    const CornerLink& first = links[fans.corners[fan.first]];
    std::vector<Sample> samples = {{0, std::arg(first.first_sign * values[first.first])}};
    std::vector<double> features;
    if (tracer.is_feature(first.first)) features.push_back(0);
    for (Index i = fan.first; i < fan.last; ++i) {
        const CornerLink& link = links[fans.corners[i]];
        samples.push_back(
            {samples.back().phi + link.angle, samples.back().g + turn(link, values) - symmetry * link.angle});
        if (tracer.is_feature(link.second)) features.push_back(samples.back().phi);
    }
    const double end = samples.back().g / (2 * pi);
    std::vector<double> angles;
    if (fan.closed) {
        const int count = static_cast<int>(std::lround(samples.front().g / (2 * pi) - end));
        angles = features.empty() ? fitted_round(samples, count) : crossings_round(samples, count);
    } else {  // with odd N the boundary's sense is against the last edge, which leaves the vertex
        angles = first_crossings(samples, -1, static_cast<int>(symmetry % 2 ? std::ceil(end) : std::round(end) + 1));
    }

    std::vector<SeparatrixStart> starts;
    std::size_t sector = 0;
    for (const double angle : angles) {
        if (std::any_of(features.begin(), features.end(),
                        [&](double feature) { return std::abs(angle - feature) < feature_width; }))
            continue;
        while (sector + 2 < samples.size() && samples[sector + 1].phi <= angle) ++sector;
        const Index corner = fans.corners[fan.first + sector];
        starts.push_back(start_in_corner(field, corner, links[corner].angle, angle - samples[sector].phi));
    }
    return starts;
}

}  // namespace octafield::surface::detail
