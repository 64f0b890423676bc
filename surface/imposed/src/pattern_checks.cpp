#include "pattern_checks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "octafield/error.hpp"
#include "short_number.hpp"

namespace octafield::surface::detail {
namespace {

using std::numbers::pi;
constexpr double blunt = 0.2;  // exponent of the size at a corner up to which it gets no rings

// Where the point is, as BisectedMesh puts it.
struct Where {
    Place place;
    Index vertex = -1;  // -1: at none
    bool boundary = false;
};

Where where(const SurfaceDomain& domain, const Structure& structure, const ImposedPoint& point) {
    Where result{snapped({point.triangle, point.weights})};
    const Vector& weights = result.place.weights;
    const auto zeros = (weights.array() == 0).count();
    int most = 0, zero = 0;
    weights.maxCoeff(&most);
    weights.minCoeff(&zero);
    if (zeros == 2) {
        result.vertex = domain.mesh().triangles(point.triangle, most);
        result.boundary = structure.on_boundary[result.vertex];
    } else if (zeros == 1) {
        const Index edge = domain.topology().triangle_edges(point.triangle, (zero + 1) % 3);
        result.boundary = domain.topology().edge_triangles.row(edge).minCoeff() < 0;
    }
    return result;
}

void require_on_surface(const SurfaceDomain& domain, const std::vector<ImposedPoint>& points) {
    std::vector<Index> bad;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const ImposedPoint& p = points[i];
        if (p.triangle < 0 || p.triangle >= domain.triangle_count() || !p.weights.allFinite() ||
            p.weights.minCoeff() < 0 || std::abs(p.weights.sum() - 1) > 1e-6)
            bad.push_back(static_cast<Index>(i));
    }
    if (!bad.empty())
        throw InvalidInput(
            "singular points " + first_few(bad) +
                " are not on the surface: they need a triangle of it and barycentric weights of at least "
                "0 that sum to 1",
            "outside_surface", bad);
}

void require_corners(const SurfaceDomain& domain, const Structure& structure, const std::vector<CornerQuads>& corners) {
    std::vector<Index> bad;
    for (const CornerQuads& corner : corners)
        if (corner.vertex < 0 || corner.vertex >= domain.vertex_count() || !structure.on_boundary[corner.vertex])
            bad.push_back(corner.vertex);
    if (!bad.empty())
        throw InvalidInput(
            "vertices " + first_few(bad) +
                " have a number of quads but are not on the boundary; inside, impose a point of index (4 "
                "- valence) / 4",
            "not_on_boundary", bad);
}

// Interior valence 4 - t and quads of corners 2 - t.
void require_valences(const SingularPattern& pattern, const std::vector<Where>& places, bool allow_zero_quads) {
    const int most = allow_zero_quads ? 2 : 1;
    const std::string remedy =
        allow_zero_quads ? "" : "; a corner of 0 quads can be split into one of 1 quad and a point of valence 3 inside";
    std::vector<Index> bad;
    for (std::size_t i = 0; i < places.size(); ++i)
        if (pattern.points[i].index_times_four > (places[i].boundary ? most : 3)) bad.push_back(static_cast<Index>(i));
    if (!bad.empty())
        throw InvalidInput(
            "singular points " + first_few(bad) +
                " leave no quad round them: the index of a point inside is at most 3/4, on the boundary " +
                std::to_string(most) + "/4" + remedy,
            "bad_valence", bad);
    for (const CornerQuads& corner : pattern.corners)
        if (2 - corner.quads > most) bad.push_back(corner.vertex);
    if (!bad.empty())
        throw InvalidInput("corners at vertices " + first_few(bad) + " have fewer than " + std::to_string(2 - most) +
                               " quads" + remedy,
                           "bad_valence", bad);
}

void require_index_sums(const Structure& structure, const Imposed& imposed, std::size_t points,
                        const SurfaceDomain& domain) {
    std::vector<int> sums(structure.components.size(), 0);
    for (const auto& [vertex, index] : imposed.corners) sums[structure.of_vertex[vertex]] += index;
    for (std::size_t i = 0; i < points; ++i) {
        const Index vertex = domain.mesh().triangles(imposed.places[i].triangle, 0);
        sums[structure.of_vertex[vertex]] += imposed.indices[i];
    }
    for (std::size_t c = 0; c < sums.size(); ++c) {
        const auto& component = structure.components[c];
        const int deficit = 4 * component.euler_characteristic - sums[c];
        if (deficit == 0) continue;
        const std::string part =
            sums.size() > 1 ? " of the part with triangle " + std::to_string(component.triangle) : std::string();
        const std::string count = std::to_string(std::abs(deficit));
        const std::string points = count + (count == "1" ? " point" : " points");
        const bool little = deficit > 0;
        throw InvalidInput("the indices" + part + ", corners included, sum to " + std::to_string(sums[c]) +
                               "/4, but must sum to the Euler characteristic, " +
                               std::to_string(4 * component.euler_characteristic) + "/4: " + count + "/4 too " +
                               (little ? "little; add " : "much; remove ") + points + " of valence 3, or " +
                               (little ? "remove" : "add") + " as many of valence 5" +
                               (component.curves.empty() ? ""
                                : little                 ? ", or give corners fewer quads"
                                                         : ", or give corners more quads"),
                           "index_sum", {component.triangle});
    }
}

void require_options(const ImposedFieldOptions& options) {
    if (!(options.tolerance > 0) || options.sectors < 6 || options.rings < 1 || !(options.ring_ratio > 1) ||
        options.ring_ratio > 100 || options.rings > 100 || options.sectors > 10000 || options.max_steps < 0)
        throw InvalidInput(
            "imposing singular points needs a tolerance above 0, 6 to 10000 sectors, 1 to 100 rings, a ring ratio "
            "above "
            "1 (up to 100) and a number of steps of at least 0",
            "bad_option");
}

// A vertex of the boundary as a place.
Place place_of_vertex(const SurfaceDomain& domain, Index vertex) {
    const ImposedPoint point = imposed_at_vertex(domain, vertex, 0);
    return {point.triangle, point.weights};
}

}  // namespace

Imposed checked_pattern(const SurfaceDomain& domain, const Structure& structure, const SingularPattern& pattern,
                        const ImposedFieldOptions& options) {
    require_options(options);
    require_on_surface(domain, pattern.points);
    require_corners(domain, structure, pattern.corners);
    std::vector<Where> places;
    for (const ImposedPoint& point : pattern.points) places.push_back(where(domain, structure, point));
    require_valences(pattern, places, options.allow_zero_quads);

    Imposed imposed{{}, {}, {}, {options.sectors, options.rings, options.ring_ratio}};
    for (const CornerQuads& corner : default_corner_quads(domain)) imposed.corners[corner.vertex] = 2 - corner.quads;
    std::map<Index, int> given;
    std::vector<Index> repeated;
    const auto give = [&](Index vertex, int index) {
        if (!given.emplace(vertex, index).second) repeated.push_back(vertex);
        imposed.corners[vertex] = index;
    };
    for (const CornerQuads& corner : pattern.corners) give(corner.vertex, 2 - corner.quads);
    for (std::size_t i = 0; i < places.size(); ++i) {
        imposed.places.push_back(places[i].place);
        imposed.indices.push_back(pattern.points[i].index_times_four);
        if (places[i].vertex >= 0 && places[i].boundary) give(places[i].vertex, pattern.points[i].index_times_four);
    }
    if (!repeated.empty())
        throw InvalidInput(
            "vertices " + first_few(repeated) +
                " of the boundary have their number of quads given twice, as corners or as points; leave one out",
            "repeated_corner", repeated);
    // Points at vertices of the boundary count as corners.
    Imposed inside = imposed;
    for (std::size_t i = 0; i < places.size(); ++i)
        if (places[i].vertex >= 0 && places[i].boundary) inside.indices[i] = 0;
    require_index_sums(structure, inside, places.size(), domain);

    std::vector<bool> has_rings(domain.vertex_count(), false);
    for (const Where& w : places)
        if (w.vertex >= 0) has_rings[w.vertex] = true;
    for (Index v = 0; v < domain.vertex_count(); ++v) {
        if (!structure.on_boundary[v] || has_rings[v]) continue;
        const auto corner = imposed.corners.find(v);
        const int index = corner == imposed.corners.end() ? 0 : corner->second;
        const double exponent = 1 - (2 - index) * pi / (2 * structure.angles[v]);  // e^H ~ r^exponent
        if (std::abs(exponent) <= blunt) continue;
        imposed.places.push_back(place_of_vertex(domain, v));
        imposed.indices.push_back(index);
    }
    return imposed;
}

}  // namespace octafield::surface::detail
