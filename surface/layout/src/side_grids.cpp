#include "side_grids.hpp"

#include <algorithm>
#include <cmath>

namespace octafield::surface::detail {
namespace {

constexpr double next_to_nothing = 0.05;  // quads: sides without any keep their place on the border of patches

// Vertices between the ends, whose ids are given, in equal steps of parameters.
void add_plain(const LayoutSide& side, int count, Index first, Index last, std::size_t number, SideGrids& grids) {
    std::vector<Index> ids = {first};
    Eigen::Index part = 0;
    for (int i = 1; i < count; ++i) {
        const double at = side.length() * i / count;
        while (part + 2 < side.parameters.size() && side.parameters[part + 1] < at) ++part;
        const double step = side.parameters[part + 1] - side.parameters[part];
        const double fraction = step > 0 ? std::clamp((at - side.parameters[part]) / step, 0.0, 1.0) : 0.0;
        ids.push_back(static_cast<Index>(grids.positions.size()));
        grids.positions.push_back((1 - fraction) * side.points.row(part) + fraction * side.points.row(part + 1));
    }
    if (count > 0) ids.push_back(last);
    if (count == 0) grids.same.emplace_back(first, last);
    grids.vertices[number] = std::move(ids);
    const double extent = std::max<double>(count, next_to_nothing);
    grids.along[number] = side.parameters * (extent / side.length());
    grids.along[number][side.parameters.size() - 1] = extent;
}

// The vertices of one seam.
struct SeamGrid {
    std::vector<int> at_stop;    // of each stop, its place counted in quads
    std::vector<double> places;  // of each vertex, length along the seam
    std::vector<Index> ids;
};

// Linear in between knots, by `from`.
template <class From, class To>
auto between_knots(const Seam& seam, double value, const From& from, const To& to) {
    const auto after = std::upper_bound(seam.knots.begin() + 1, seam.knots.end() - 1, value,
                                        [&](double v, const Seam::Knot& k) { return v < from(k); });
    const Seam::Knot &a = *(after - 1), &b = *after;
    const double step = from(b) - from(a);
    const double fraction = step > 0 ? std::clamp((value - from(a)) / step, 0.0, 1.0) : 0.0;
    return std::decay_t<decltype(to(a))>((1 - fraction) * to(a) + fraction * to(b));
}

double length_at(const Seam::Knot& k) { return k.at; }
double parameters_at(const Seam::Knot& k) { return k.parameters; }

// Closed seams go on behind their end.
double parameters_of(const Seam& seam, double at) {
    if (at <= seam.length || !seam.closed) return between_knots(seam, at, length_at, parameters_at);
    return seam.knots.back().parameters + between_knots(seam, at - seam.length, length_at, parameters_at);
}

double place_of(const Seam& seam, double parameters) {
    const double whole = seam.knots.back().parameters;
    if (parameters <= whole || !seam.closed) return between_knots(seam, parameters, parameters_at, length_at);
    return seam.length + between_knots(seam, parameters - whole, parameters_at, length_at);
}

}  // namespace

Eigen::Vector3d position_on(const Seam& seam, double at) {
    if (seam.closed) at -= seam.length * std::floor(at / seam.length);
    return between_knots(seam, at, length_at, [](const Seam::Knot& k) { return k.position; });
}

namespace {

// Stops that become one vertex meet at a node, or in their middle.
SeamGrid lay_out(const Seams& seams, Index number, const std::vector<int>& part_counts, SideGrids& grids) {
    const Seam& seam = seams.seams[number];
    SeamGrid result;
    result.at_stop = {0};
    for (Index i = 0; i < seam.part_count(); ++i)
        result.at_stop.push_back(result.at_stop.back() + part_counts[seam.first_part + i]);
    const int count = result.at_stop.back();
    result.places.assign(count + 1, 0);
    result.ids.assign(count + 1, -1);
    std::vector<int> fixed;
    for (std::size_t i = 0; i < seam.stops.size();) {
        std::size_t end = i;
        double sum = 0;
        Index node = -1;
        for (; end < seam.stops.size() && result.at_stop[end] == result.at_stop[i]; ++end) {
            sum += seam.stops[end].at;
            if (seam.stops[end].node < 0) continue;
            node = seam.stops[end].node;
            result.places[result.at_stop[i]] = seam.stops[end].at;
        }
        if (node < 0) result.places[result.at_stop[i]] = sum / static_cast<double>(end - i);
        result.ids[result.at_stop[i]] = node;
        fixed.push_back(result.at_stop[i]);
        i = end;
    }
    if (seam.closed) {  // where it closes, stops before and after the start are one vertex
        const double shift = (result.places.front() + seam.length - result.places.back()) / 2;
        result.places.back() += shift;
        result.places.front() = result.places.back() - seam.length;
    }
    for (std::size_t f = 0; f + 1 < fixed.size(); ++f) {
        const double low = parameters_of(seam, std::max(0.0, result.places[fixed[f]]));
        const double high = parameters_of(seam, result.places[fixed[f + 1]]);
        for (int i = fixed[f] + 1; i < fixed[f + 1]; ++i)
            result.places[i] = place_of(seam, low + (high - low) * (i - fixed[f]) / (fixed[f + 1] - fixed[f]));
    }
    for (int i = 0; i <= count; ++i) {
        if (result.ids[i] >= 0) continue;
        if (i == count && seam.closed) {
            result.ids[i] = result.ids[0];
            continue;
        }
        result.ids[i] = static_cast<Index>(grids.positions.size());
        grids.positions.push_back(position_on(seam, result.places[i]));
        grids.on_seams.push_back({number, result.places[i]});
    }
    return result;
}

// A side of the layout on seams: its points by length between the vertices on it, as far as those are in order.
void add_seamed(const LayoutSide& side, std::size_t number, const std::vector<SeamUse>& uses, const Seams& seams,
                const std::vector<SeamGrid>& laid_out, SideGrids& grids) {
    std::vector<double> lengths = {0};
    for (Eigen::Index i = 1; i < side.points.rows(); ++i)
        lengths.push_back(lengths.back() + (side.points.row(i) - side.points.row(i - 1)).norm());
    const double whole = lengths.back(), apart = 1e-6 * whole;
    std::vector<std::pair<double, double>> anchors = {{0, 0}};
    std::vector<Index>& ids = grids.vertices[number];
    int before = 0;
    for (const SeamUse& use : uses) {
        const Seam& seam = seams.seams[use.seam];
        const SeamGrid& grid = laid_out[use.seam];
        const Index i = use.part - seam.first_part;
        const int low = grid.at_stop[i], high = grid.at_stop[i + 1];
        if (ids.empty()) ids.push_back(grid.ids[use.forward ? low : high]);
        for (int k = 1; k <= high - low; ++k) {
            const int at = use.forward ? low + k : high - k;
            ids.push_back(grid.ids[at]);
            const double off =
                use.forward ? grid.places[at] - seam.stops[i].at : seam.stops[i + 1].at - grid.places[at];
            const double x = use.before + off;
            if (x > anchors.back().first + apart && x < whole - apart) anchors.emplace_back(x, before + k);
        }
        before += high - low;
    }
    while (anchors.size() > 1 && anchors.back().second >= before) anchors.pop_back();
    anchors.emplace_back(whole, std::max<double>(before, next_to_nothing));
    Eigen::VectorXd& along = grids.along[number];
    along.resize(side.points.rows());
    std::size_t a = 0;
    for (Eigen::Index i = 0; i < along.size(); ++i) {
        while (a + 2 < anchors.size() && anchors[a + 1].first < lengths[i]) ++a;
        const double fraction = (lengths[i] - anchors[a].first) / (anchors[a + 1].first - anchors[a].first);
        along[i] = anchors[a].second + fraction * (anchors[a + 1].second - anchors[a].second);
    }
}

}  // namespace

SideGrids side_grids(const QuadLayout& layout, const std::vector<int>& counts) {
    SideGrids grids;
    for (const LayoutVertex& vertex : layout.vertices) grids.positions.push_back(vertex.position);
    grids.vertices.resize(layout.sides.size());
    grids.along.resize(layout.sides.size());
    for (std::size_t s = 0; s < layout.sides.size(); ++s)
        add_plain(layout.sides[s], counts[s], layout.sides[s].first, layout.sides[s].last, s, grids);
    return grids;
}

SideGrids seamed_grids(const QuadLayout& layout, const Seams& seams, const std::vector<int>& counts,
                       const std::vector<int>& part_counts) {
    SideGrids grids;
    grids.positions = seams.node_positions;
    grids.on_seams.assign(seams.nodes.size(), {-1, 0});
    grids.vertices.resize(layout.sides.size());
    grids.along.resize(layout.sides.size());
    std::vector<Index> id_of(layout.vertices.size(), -1);
    std::vector<SeamGrid> laid_out;
    for (std::size_t n = 0; n < seams.seams.size(); ++n) {
        const Seam& seam = seams.seams[n];
        laid_out.push_back(lay_out(seams, static_cast<Index>(n), part_counts, grids));
        for (std::size_t i = 0; i < seam.stops.size(); ++i)
            for (const Index v : seam.stops[i].vertices) id_of[v] = laid_out.back().ids[laid_out.back().at_stop[i]];
    }
    for (std::size_t v = 0; v < id_of.size(); ++v) {
        if (id_of[v] >= 0) continue;
        id_of[v] = static_cast<Index>(grids.positions.size());
        grids.positions.push_back(layout.vertices[v].position);
        if (layout.vertices[v].index_times_four != 0)
            grids.held.emplace_back(id_of[v], 4 - layout.vertices[v].index_times_four);
    }
    for (std::size_t s = 0; s < layout.sides.size(); ++s) {
        const LayoutSide& side = layout.sides[s];
        if (seams.uses[s].empty()) {
            add_plain(side, counts[s], id_of[side.first], id_of[side.last], s, grids);
        } else {
            add_seamed(side, s, seams.uses[s], seams, laid_out, grids);
        }
    }
    return grids;
}

}  // namespace octafield::surface::detail
