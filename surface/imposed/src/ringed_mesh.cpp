#include "ringed_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

namespace octafield::surface::detail {
namespace {

using std::numbers::pi;
constexpr double first_circle = 0.6;  // of the star's inner radius

class Rings {
public:
    Rings(const BisectedMesh& bisected, const RingOptions& options) : bisected_(bisected), options_(options) {
        positions_ = bisected.positions();
        sources_.assign(positions_.size(), {-1, Vector::Zero()});
        for (const auto& triangle : bisected.triangles())
            for (int k = 0; k < 3; ++k)
                if (Source& source = sources_[triangle.corners[k]]; source.first < 0)
                    source = {triangle.origin, triangle.weights[k]};
        in_star_.assign(bisected.triangles().size(), false);
    }

    void add_star(const Star& star, int index);
    void add_others();
    RingedMesh result() &&;

private:
    using Source = std::pair<Index, Vector>;
    struct Spoke {
        Index end;                  // on the star's side
        std::vector<Index> inner;   // from the centre outwards
        std::vector<double> parts;  // of the way to the end, of each
    };

    struct Sector {
        Vector centre, first, second;  // and the ends of its spokes, in one plane
    };

    Index add_vertex(Index triangle, const Vector& weights);
    void add_triangle(Index part, Index a, Index b, Index c);
    void add_feature(Index a, Index b) { features_.push_back(std::minmax(a, b)); }
    void add_chain(Index centre, const Spoke& spoke);
    Spoke spoke_to(const Star& star, const Star::Part& part, const Vector& end_weights, Index end);
    std::vector<double> radii(const Star& star, double end) const;
    void add_sector(Index part, Index centre, const Spoke& first, const Spoke& second, const Sector& sector);
    std::vector<Index> side_points(Index t, int k) const;

    const BisectedMesh& bisected_;
    const RingOptions& options_;
    std::vector<Vector> positions_;
    std::vector<Source> sources_;
    std::vector<bool> in_star_;
    std::vector<std::array<Index, 3>> triangles_;
    std::vector<Index> origins_, parts_;
    std::vector<std::pair<Index, Index>> features_;
    std::map<std::pair<Index, Index>, std::vector<Index>> on_edges_;  // from lower to higher vertex
    double widest_ = 0;                                               // farthest end of the star at work
};

Index Rings::add_vertex(Index t, const Vector& weights) {
    const auto& triangle = bisected_.triangles()[t];
    Vector position = Vector::Zero(), source = Vector::Zero();
    for (int k = 0; k < 3; ++k) {
        position += weights[k] * positions_[triangle.corners[k]];
        source += weights[k] * triangle.weights[k];
    }
    positions_.push_back(position);
    sources_.push_back({triangle.origin, source});
    return static_cast<Index>(positions_.size() - 1);
}

void Rings::add_triangle(Index part, Index a, Index b, Index c) {
    triangles_.push_back({a, b, c});
    origins_.push_back(bisected_.triangles()[part].origin);
    parts_.push_back(part);
}

void Rings::add_chain(Index centre, const Spoke& spoke) {
    Index last = centre;
    for (const Index v : spoke.inner) {
        add_feature(last, v);
        last = v;
    }
    add_feature(last, spoke.end);
}

// Circles that grow by the ratio, then shapes between the largest one and the star's sides.
std::vector<double> Rings::radii(const Star& star, double end) const {
    const double circle = first_circle * star.inner_radius;
    std::vector<double> result;
    for (int j = options_.rings - 1; j >= 0; --j) result.push_back(circle * std::pow(options_.ratio, -j));
    const int between = std::max(0, static_cast<int>(std::ceil(std::log2(widest_ / circle) - 1e-9)) - 1);
    for (int s = 1; s <= between; ++s)
        result.push_back(std::pow(circle, 1 - s / (between + 1.0)) * std::pow(end, s / (between + 1.0)));
    return result;
}

Rings::Spoke Rings::spoke_to(const Star& star, const Star::Part& part, const Vector& end_weights, Index end) {
    Spoke spoke{end, {}, {}};
    const Vector centre = Vector::Unit((part.side + 2) % 3);
    const double length = (bisected_.place(part.triangle, end_weights) - bisected_.place(part.triangle, centre)).norm();
    for (const double radius : radii(star, length)) {
        const double fraction = radius / length;
        spoke.inner.push_back(add_vertex(part.triangle, (1 - fraction) * centre + fraction * end_weights));
        spoke.parts.push_back(fraction);
    }
    return spoke;
}

void Rings::add_sector(Index part, Index centre, const Spoke& first, const Spoke& second, const Sector& sector) {
    add_triangle(part, centre, first.inner.front(), second.inner.front());
    const auto at = [](double fraction, const Vector& from, const Vector& end) -> Vector {
        return (1 - fraction) * from + fraction * end;
    };
    const auto diagonal = [&](double on_first, double on_second) {
        return (at(on_first, sector.centre, sector.first) - at(on_second, sector.centre, sector.second)).norm();
    };
    for (std::size_t j = 0; j < first.inner.size(); ++j) {
        const bool last = j + 1 == first.inner.size();
        const Index p = first.inner[j], q = second.inner[j];
        const Index s = last ? first.end : first.inner[j + 1], r = last ? second.end : second.inner[j + 1];
        const double here = first.parts[j], there = second.parts[j];
        const double next_here = last ? 1 : first.parts[j + 1], next_there = last ? 1 : second.parts[j + 1];
        if (diagonal(here, next_there) < (1 - 1e-9) * diagonal(next_here, there)) {
            add_triangle(part, p, s, r);
            add_triangle(part, p, r, q);
        } else {
            add_triangle(part, p, s, q);
            add_triangle(part, s, r, q);
        }
    }
}

void Rings::add_star(const Star& star, int index) {
    const Index centre = star.centre;
    // The load of the vertex (see size_potential.hpp) turns the field; by an eighth of a turn per sector at most.
    const double load = (star.boundary ? pi : 2 * pi) - star.angle - pi / 2 * index;
    const double round = star.boundary ? 2 * pi : star.angle;
    const double density = std::max(options_.sectors / round, 8 * std::abs(load) / (pi * star.angle));
    widest_ = 0;
    for (const Star::Part& part : star.parts) {
        const auto [first, second, middle] = bisected_.corners_from(part.triangle, part.side);
        widest_ = std::max({widest_, (first - middle).norm(), (second - middle).norm()});
    }

    std::map<Index, Spoke> shared;  // to the ends of the sides
    for (const Star::Part& part : star.parts) {
        const auto& triangle = bisected_.triangles()[part.triangle];
        in_star_[part.triangle] = true;
        const int ka = part.side, kb = (part.side + 1) % 3;
        const auto to_corner = [&](int k) -> const Spoke& {
            auto place = shared.find(triangle.corners[k]);
            if (place == shared.end())
                place = shared.emplace(triangle.corners[k], spoke_to(star, part, Vector::Unit(k), triangle.corners[k]))
                            .first;
            return place->second;
        };
        const auto [end_a, end_b, middle] = bisected_.corners_from(part.triangle, ka);
        const Vector a = end_a - middle, b = end_b - middle;
        const double angle = std::atan2(a.cross(b).norm(), a.dot(b));
        const int count = std::max(1, static_cast<int>(std::ceil(angle * density - 0.2)));
        std::vector<Index> points;
        Vector last_end = end_a;
        Spoke last = to_corner(ka);
        if (part.first_is_feature) add_chain(centre, last);
        for (int i = 1; i <= count; ++i) {
            Spoke next;
            Vector next_end = end_b;
            if (i < count) {
                const double turned = angle * i / count;
                const double second = std::sin(turned) * a.norm(), first = std::sin(angle - turned) * b.norm();
                const Vector weights = (first * Vector::Unit(ka) + second * Vector::Unit(kb)) / (first + second);
                points.push_back(add_vertex(part.triangle, weights));
                next = spoke_to(star, part, weights, points.back());
                next_end = bisected_.place(part.triangle, weights);
            } else {
                next = to_corner(kb);
            }
            if (triangle.is_feature[ka]) add_feature(last.end, next.end);
            add_sector(part.triangle, centre, last, next, {middle, last_end, next_end});
            last = std::move(next);
            last_end = next_end;
        }
        if (part.second_is_feature) add_chain(centre, last);
        const Index from = triangle.corners[ka], to = triangle.corners[kb];
        if (from > to) std::reverse(points.begin(), points.end());
        if (!points.empty()) on_edges_[std::minmax(from, to)] = std::move(points);
    }
}

// Vertices on side k of t, from its first corner to the next one, without that.
std::vector<Index> Rings::side_points(Index t, int k) const {
    const auto& triangle = bisected_.triangles()[t];
    const Index from = triangle.corners[k], to = triangle.corners[(k + 1) % 3];
    std::vector<Index> result = {from};
    const auto found = on_edges_.find(std::minmax(from, to));
    if (found == on_edges_.end()) return result;
    if (from < to) {
        result.insert(result.end(), found->second.begin(), found->second.end());
    } else {
        result.insert(result.end(), found->second.rbegin(), found->second.rend());
    }
    return result;
}

void Rings::add_others() {
    for (Index t = 0; t < static_cast<Index>(in_star_.size()); ++t) {
        if (in_star_[t]) continue;
        const auto& triangle = bisected_.triangles()[t];
        std::vector<Index> ring;
        int split = 0, last_split = 0, starts[3];
        for (int k = 0; k < 3; ++k) {
            const std::vector<Index> side = side_points(t, k);
            starts[k] = static_cast<int>(ring.size());
            ring.insert(ring.end(), side.begin(), side.end());
            if (side.size() > 1) {
                ++split;
                last_split = k;
            }
        }
        const auto count = static_cast<int>(ring.size());
        for (int k = 0; k < 3; ++k)
            for (int i = starts[k]; i < (k < 2 ? starts[k + 1] : count); ++i)
                if (triangle.is_feature[k]) add_feature(ring[i], ring[(i + 1) % count]);
        if (split == 0) {
            add_triangle(t, ring[0], ring[1], ring[2]);
        } else if (split == 1) {  // from the corner opposite
            const int apex = starts[(last_split + 2) % 3];
            for (int i = 1; i + 1 < count; ++i)
                add_triangle(t, ring[apex], ring[(apex + i) % count], ring[(apex + i + 1) % count]);
        } else {
            const Index middle = add_vertex(t, Vector::Constant(1.0 / 3));
            for (int i = 0; i < count; ++i) add_triangle(t, middle, ring[i], ring[(i + 1) % count]);
        }
    }
}

RingedMesh Rings::result() && {
    RingedMesh result;
    const auto vertices = static_cast<Eigen::Index>(positions_.size());
    result.mesh.vertices.resize(vertices, 3);
    result.vertex_weights.resize(vertices, 3);
    for (Eigen::Index v = 0; v < vertices; ++v) {
        result.mesh.vertices.row(v) = positions_[v];
        result.vertex_triangles.push_back(sources_[v].first);
        result.vertex_weights.row(v) = sources_[v].second;
    }
    result.mesh.triangles.resize(static_cast<Eigen::Index>(triangles_.size()), 3);
    for (std::size_t t = 0; t < triangles_.size(); ++t)
        for (int k = 0; k < 3; ++k) result.mesh.triangles(static_cast<Eigen::Index>(t), k) = triangles_[t][k];
    result.features.resize(static_cast<Eigen::Index>(features_.size()), 2);
    for (std::size_t e = 0; e < features_.size(); ++e) {
        result.features(static_cast<Eigen::Index>(e), 0) = features_[e].first;
        result.features(static_cast<Eigen::Index>(e), 1) = features_[e].second;
    }
    result.origins = std::move(origins_);
    result.parts = std::move(parts_);
    result.centres = bisected_.centres();
    return result;
}

}  // namespace

RingedMesh ringed(const BisectedMesh& mesh, const std::vector<int>& indices, const RingOptions& options) {
    Rings rings(mesh, options);
    for (std::size_t i = 0; i < indices.size(); ++i) rings.add_star(star_of(mesh, mesh.centres()[i]), indices[i]);
    rings.add_others();
    return std::move(rings).result();
}

}  // namespace octafield::surface::detail
