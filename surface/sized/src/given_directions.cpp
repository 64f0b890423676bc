#include "given_directions.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "octafield/error.hpp"

namespace octafield::surface::detail {
namespace {

using std::numbers::pi;
constexpr double least_tangent = 1e-3;  // part of a direction in the tangent plane

bool inside(const SurfaceDomain& domain, Index e) { return domain.topology().edge_triangles.row(e).minCoeff() >= 0; }

// The mean of what the edges to follow at each vertex ask for, with the most careful of their alignments.
class EdgesToFollow {
public:
    EdgesToFollow(const SurfaceDomain& domain, const VertexCharts& charts, const SizedFieldOptions& options)
        : domain_(domain), options_(options), vertices_(domain.vertex_count()) {
        const auto& corners = domain.fans().corners;
        for (const auto& fan : domain.fans().fans)
            for (Index i = fan.first; i < fan.last; ++i) {
                const Index t = corners[i] / 3, k = corners[i] % 3;
                add(fan.vertex, domain.topology().triangle_edges(t, k), charts.leaving(corners[i]), true);
                if (fan.closed || i + 1 < fan.last) continue;
                add(fan.vertex, domain.topology().triangle_edges(t, (k + 2) % 3), charts.total(fan.vertex), false);
            }
    }

    Alignment of(Index e) const {
        if (!domain_.is_feature()[e]) return Alignment::none;
        return inside(domain_, e) ? options_.feature_alignment : options_.boundary_alignment;
    }

    void give(GivenDirections& given) const {
        for (std::size_t v = 0; v < vertices_.size(); ++v) {
            const Wanted& wanted = vertices_[v];
            if (wanted.edges == 0) continue;
            const double length = std::abs(wanted.sum) / wanted.edges;
            if (length <= std::cos(options_.corner_tolerance * pi / 2)) continue;
            const Complex value = wanted.sum / std::abs(wanted.sum);
            if (wanted.weakly)
                given.source[v] = value;
            else
                given.held[v] = value;
            given.is_held[v] = !wanted.weakly;
        }
    }

private:
    struct Wanted {
        Complex sum = 0;
        int edges = 0;
        bool weakly = false;
    };

    // With odd N the boundary is run with the surface on its left: the edge that arrives has the opposite direction.
    void add(Index v, Index e, double angle, bool leaves) {
        const Alignment how = of(e);
        if (how == Alignment::none) return;
        if (options_.symmetry % 2 == 1 && inside(domain_, e)) {
            const Index low = domain_.topology().edges(e, 0), high = domain_.topology().edges(e, 1);
            throw InvalidInput("edge " + std::to_string(low) + "-" + std::to_string(high) +
                                   " is a feature inside the surface: it has no sense to run in, so the symmetry must "
                                   "be even, or feature_alignment none",
                               "odd_symmetry", {low, high});
        }
        vertices_[v].sum += std::polar(1.0, options_.symmetry * (angle + (leaves ? 0 : pi)));
        vertices_[v].edges += 1;
        vertices_[v].weakly = vertices_[v].weakly || how == Alignment::weak;
    }

    const SurfaceDomain& domain_;
    const SizedFieldOptions& options_;
    std::vector<Wanted> vertices_;
};

void require_rows(Eigen::Index rows, Eigen::Index expected, const char* what) {
    if (rows == 0 || rows == expected) return;
    throw InvalidInput(std::string(what) + " must hold one row per vertex, " + std::to_string(expected) + ", not " +
                           std::to_string(rows),
                       "wrong_size");
}

void give_directions(const SurfaceDomain& domain, const VertexCharts& charts, const SizedFieldOptions& options,
                     GivenDirections& given) {
    require_rows(options.directions.rows(), domain.vertex_count(), "directions");
    require_rows(options.weights.size(), domain.vertex_count(), "weights");
    if (options.directions.rows() == 0) {
        if (options.weights.size() > 0) throw InvalidInput("weights are given without directions", "wrong_size");
        return;
    }
    const Points normals = vertex_normals(domain.mesh());
    std::vector<Index> unusable, upright;
    for (Index v = 0; v < domain.vertex_count(); ++v) {
        const double weight = options.weights.size() == 0 ? 1 : options.weights[v];
        const Eigen::RowVector3d direction = options.directions.row(v);
        if (!(weight >= 0)) unusable.push_back(v);
        if (!(weight > 0) || !charts.used(v)) continue;
        if (!direction.allFinite()) {
            unusable.push_back(v);
            continue;
        }
        const Eigen::RowVector3d along = direction.stableNormalized(), normal = normals.row(v);
        if (!((along - along.dot(normal) * normal).norm() > least_tangent)) {
            upright.push_back(v);
            continue;
        }
        const Complex value = std::polar(1.0, options.symmetry * charts.lowered(v, along));
        given.is_held[v] = std::isinf(weight);
        given.held[v] = given.is_held[v] ? value : 0;
        given.source[v] = given.is_held[v] ? 0 : weight * value;
    }
    if (!unusable.empty())
        throw InvalidInput(
            "directions must be finite and their weights at least 0; they are not at vertices " + first_few(unusable),
            "not_finite", unusable);
    if (!upright.empty())
        throw InvalidInput("the directions at vertices " + first_few(upright) +
                               " are zero or stand upright on the surface; give tangents, or weight 0 there",
                           "not_tangent", upright);
}

}  // namespace

GivenDirections given_directions(const SurfaceDomain& domain, const VertexCharts& charts,
                                 const SizedFieldOptions& options) {
    const Index vertices = domain.vertex_count(), edges = domain.edge_count();
    GivenDirections given{std::vector<bool>(vertices, false), Eigen::VectorXcd::Zero(vertices),
                          Eigen::VectorXcd::Zero(vertices), std::vector<bool>(edges, false)};
    const EdgesToFollow follow(domain, charts, options);
    follow.give(given);
    for (Index e = 0; e < edges; ++e) given.followed[e] = follow.of(e) == Alignment::strong;
    give_directions(domain, charts, options, given);
    return given;
}

}  // namespace octafield::surface::detail
