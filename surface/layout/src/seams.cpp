#include "seams.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "layout_pieces.hpp"
#include "octafield/error.hpp"

namespace octafield::surface::detail {
namespace {

constexpr double same_place = 1e-9;  // of a seam's length

// Along one edge of the whole surface, from its lower vertex, on one of its two sides.
struct Step {
    double from, to;       // lengths
    Index side;            // of the layout
    double before, after;  // lengths along that side, at from and to
    double parameters;
    Index first, last;  // vertices of the layout at its ends, -1: none
};

struct WholeEdge {
    Index low, high;
    double length = 0;
    std::vector<Step> sides[2];  // by length; [1]: the surface's boundary runs down
};

// Quad coordinates against lengths between two places of a seam, of one of its sides: over the number of sides.
struct Slope {
    double from, to, per_length;
};

class Finder {
public:
    explicit Finder(const std::vector<LayoutPart>& parts) : parts_(parts) {}

    Seams result() && {
        for (const LayoutPart& part : parts_) {
            part_ = &part;
            walk_border();
            first_side_ += static_cast<Index>(part.layout->sides.size());
            first_vertex_ += static_cast<Index>(part.layout->vertices.size());
        }
        find_nodes();
        seams_.uses.resize(first_side_);
        for (Index n = 0; n < static_cast<Index>(seams_.nodes.size()); ++n)
            for (const auto& [edge, other] : around_[seams_.nodes[n]])
                if (!used_[edge]) add_seam(seams_.nodes[n], edge);
        for (Index e = 0; e < static_cast<Index>(edges_.size()); ++e)
            if (!used_[e]) add_seam(edges_[e].low, e);
        for (auto& uses : seams_.uses)
            std::sort(uses.begin(), uses.end(), [](const SeamUse& a, const SeamUse& b) { return a.before < b.before; });
        return std::move(seams_);
    }

private:
    struct Node {
        Index node, side;  // the side of the layout that goes on from there
        double length, parameters;
    };

    const LayoutPieces& pieces() const { return *part_->layout->pieces; }
    const std::vector<Index>& origins() const { return *part_->origins; }
    bool is_original(Index node) const { return node < static_cast<Index>(origins().size()); }
    void walk_border();
    void add_loop(const std::vector<Node>& loop);
    void add_edge(const std::vector<Node>& nodes);
    void find_nodes();
    void add_seam(Index start, Index edge);
    void add_uses(const Seam& seam, const Step& step, bool forward, double from, double to, int sides);
    void add_knots(Seam& seam, const std::vector<std::pair<Index, bool>>& path, const std::vector<double>& starts,
                   const std::vector<Slope>& slopes) const;
    void add_parts(Seam& seam, const std::vector<std::pair<Index, bool>>& path, const std::vector<double>& starts);

    const std::vector<LayoutPart>& parts_;
    const LayoutPart* part_ = nullptr;         // whose border is walked
    Index first_side_ = 0, first_vertex_ = 0;  // of it, among those of all parts
    std::map<std::pair<Index, Index>, Index> edge_of_;
    std::vector<WholeEdge> edges_;
    std::map<Index, std::vector<std::pair<Index, Index>>> around_;  // edges at each vertex, and their other ends
    std::map<Index, Eigen::Vector3d> position_of_;                  // of vertices of the whole surface
    std::map<Index, Index> node_of_;
    std::vector<bool> used_;
    Seams seams_;
};

void Finder::walk_border() {
    std::map<Index, Index> chain_from;
    for (std::size_t c = 0; c < pieces().chains.size(); ++c)
        if (pieces().chains[c].curve < 0) chain_from[pieces().chains[c].nodes.front().node] = static_cast<Index>(c);
    std::set<Index> done;
    for (const auto& [start, chain] : chain_from) {
        if (done.contains(chain)) continue;
        std::vector<Node> loop;
        Index at = chain;
        while (done.insert(at).second) {
            const auto& nodes = pieces().chains[at].nodes;
            double length = 0;
            for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
                loop.push_back({nodes[i].node, at, length, nodes[i].length});
                length +=
                    (pieces().cut.positions.row(nodes[i + 1].node) - pieces().cut.positions.row(nodes[i].node)).norm();
            }
            at = chain_from.at(nodes.back().node);
        }
        add_loop(loop);
    }
}

void Finder::add_loop(const std::vector<Node>& loop) {
    std::size_t first = 0;
    while (first < loop.size() && !is_original(loop[first].node)) ++first;
    if (first == loop.size())
        throw InvalidInput("the vertices' origins are not those of the surface of the field", "bad_option");
    std::vector<Node> nodes;
    for (std::size_t i = 0; i <= loop.size(); ++i) {
        const Node& at = loop[(first + i) % loop.size()];
        nodes.push_back(at);
        if (i == 0 || !is_original(at.node)) continue;
        add_edge(nodes);
        nodes = {at};
    }
}

void Finder::add_edge(const std::vector<Node>& nodes) {
    const Index a = origins()[nodes.front().node], b = origins()[nodes.back().node];
    position_of_.emplace(a, pieces().cut.positions.row(nodes.front().node));
    position_of_.emplace(b, pieces().cut.positions.row(nodes.back().node));
    const auto [found, is_new] = edge_of_.emplace(std::minmax(a, b), static_cast<Index>(edges_.size()));
    if (is_new) {
        edges_.push_back({std::min(a, b), std::max(a, b), 0, {}});
        around_[a].emplace_back(found->second, b);
        around_[b].emplace_back(found->second, a);
    }
    WholeEdge& edge = edges_[found->second];
    const bool down = a > b;
    if (a == b || !edge.sides[down].empty())
        throw InvalidInput("the vertices' origins do not fit the surface: the edge of vertices " + std::to_string(a) +
                               " and " + std::to_string(b) + " is there more than twice",
                           "bad_option", {a, b});
    double at = 0;
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
        const auto& chain = pieces().chains[nodes[i].side].nodes;
        const double length =
            (pieces().cut.positions.row(nodes[i + 1].node) - pieces().cut.positions.row(nodes[i].node)).norm();
        const double last = nodes[i + 1].side == nodes[i].side && nodes[i + 1].parameters > nodes[i].parameters
                                ? nodes[i + 1].parameters
                                : chain.back().length;
        const auto vertex = [&](Index node) {
            const Index found = pieces().vertex_of_node[node];
            return found < 0 ? -1 : first_vertex_ + found;
        };
        edge.sides[down].push_back({at, at + length, first_side_ + nodes[i].side, nodes[i].length,
                                    nodes[i].length + length, last - nodes[i].parameters, vertex(nodes[i].node),
                                    vertex(nodes[i + 1].node)});
        at += length;
    }
    edge.length = at;
    if (!down) return;
    auto& steps = edge.sides[1];
    std::reverse(steps.begin(), steps.end());
    for (Step& step : steps) {
        std::swap(step.from, step.to);
        step.from = at - step.from;
        step.to = at - step.to;
        std::swap(step.before, step.after);
        std::swap(step.first, step.last);
    }
}

void Finder::find_nodes() {
    std::set<Index> nodes;
    for (const auto& [vertex, edges] : around_)
        if (edges.size() != 2) nodes.insert(vertex);
    for (const LayoutPart& part : parts_)
        for (const LayoutVertex& vertex : part.layout->vertices)
            if (vertex.vertex >= 0 && vertex.vertex < static_cast<Index>(part.origins->size()) &&
                vertex.index_times_four != 0 && around_.contains((*part.origins)[vertex.vertex]))
                nodes.insert((*part.origins)[vertex.vertex]);
    for (const Index node : nodes) {
        node_of_[node] = static_cast<Index>(seams_.nodes.size());
        seams_.nodes.push_back(node);
        seams_.node_positions.push_back(position_of_.at(node));
    }
    used_.assign(edges_.size(), false);
}

// To the next node, or round.
void Finder::add_seam(Index start, Index edge) {
    std::vector<std::pair<Index, bool>> path;  // edges, upwards
    std::vector<double> starts;
    Index at = start;
    double length = 0;
    while (!used_[edge]) {
        used_[edge] = true;
        const bool up = edges_[edge].low == at;
        path.emplace_back(edge, up);
        starts.push_back(length);
        length += edges_[edge].length;
        at = up ? edges_[edge].high : edges_[edge].low;
        if (node_of_.contains(at)) break;
        const auto& next = around_[at];
        edge = next[next[0].first == edge].first;
    }
    Seam seam;
    seam.closed = at == start && !node_of_.contains(start);
    starts.push_back(length);
    seam.length = length;
    const double apart = same_place * length;
    const auto node = [&](Index v) {
        const auto found = node_of_.find(v);
        return found == node_of_.end() ? -1 : found->second;
    };
    std::vector<SeamStop> stops;
    if (!seam.closed) stops = {{0, node(start), {}}, {length, node(at), {}}};
    for (std::size_t i = 0; i < path.size(); ++i)
        for (const auto& side : edges_[path[i].first].sides)
            for (const Step& step : side)
                for (const auto& [place, vertex] : {std::pair(step.from, step.first), std::pair(step.to, step.last)})
                    if (vertex >= 0)
                        stops.push_back({path[i].second ? starts[i] + place : starts[i + 1] - place, -1, {vertex}});
    std::stable_sort(stops.begin(), stops.end(), [](const auto& a, const auto& b) { return a.at < b.at; });
    for (const SeamStop& stop : stops) {
        if (seam.stops.empty() || stop.at - seam.stops.back().at > apart) {
            seam.stops.push_back(stop);
            continue;
        }
        SeamStop& same = seam.stops.back();
        same.node = std::max(same.node, stop.node);
        same.vertices.insert(same.vertices.end(), stop.vertices.begin(), stop.vertices.end());
    }
    if (seam.closed) {
        if (seam.stops.empty()) seam.stops.push_back({0, -1, {}});
        // Stops at the start may have been found at its end as well.
        if (seam.stops.size() > 1 && seam.stops.front().at + length - seam.stops.back().at <= apart) {
            auto& into = seam.stops.front().vertices;
            into.insert(into.end(), seam.stops.back().vertices.begin(), seam.stops.back().vertices.end());
            seam.stops.pop_back();
        }
        seam.stops.push_back(seam.stops.front());
        seam.stops.back().at += length;
    }
    add_parts(seam, path, starts);
    seams_.seams.push_back(std::move(seam));
}

void Finder::add_parts(Seam& seam, const std::vector<std::pair<Index, bool>>& path, const std::vector<double>& starts) {
    const double length = starts.back();
    seam.first_part = static_cast<Index>(seams_.parts.size());
    for (Index i = 0; i < seam.part_count(); ++i) seams_.parts.push_back({seam.stops[i].at, seam.stops[i + 1].at, 0});
    std::vector<Slope> slopes;
    for (std::size_t i = 0; i < path.size(); ++i) {
        const WholeEdge& edge = edges_[path[i].first];
        const bool up = path[i].second;
        const int sides = !edge.sides[0].empty() + !edge.sides[1].empty();
        for (int s = 0; s < 2; ++s)
            for (const Step& step : edge.sides[s]) {
                const double from = up ? starts[i] + step.from : starts[i + 1] - step.to;
                const double to = up ? starts[i] + step.to : starts[i + 1] - step.from;
                slopes.push_back({from, to, step.parameters / sides / std::max(to - from, 1e-300)});
                for (const double shift : {0.0, length}) {
                    if (shift > 0 && !seam.closed) break;
                    add_uses(seam, step, up == (s == 0), from + shift, to + shift, sides);
                }
            }
    }
    add_knots(seam, path, starts, slopes);
}

// What of the step, from `from` to `to` along the seam, lies in which part.
void Finder::add_uses(const Seam& seam, const Step& step, bool forward, double from, double to, int sides) {
    const auto next = std::upper_bound(seam.stops.begin(), seam.stops.end(), from,
                                       [](double a, const SeamStop& stop) { return a < stop.at; });
    auto i = std::max<std::ptrdiff_t>(0, next - seam.stops.begin() - 1);
    for (; i < seam.part_count() && seam.stops[i].at < to; ++i) {
        const double low = std::max(from, seam.stops[i].at), high = std::min(to, seam.stops[i + 1].at);
        if (!(high - low > same_place * seam.length)) continue;
        const auto part = seam.first_part + static_cast<Index>(i);
        seams_.parts[part].parameters += step.parameters / sides * (high - low) / (to - from);
        const double before = std::min(step.before, step.after) + (forward ? low - from : to - high);
        auto& uses = seams_.uses[step.side];
        const auto known = std::find_if(uses.begin(), uses.end(),
                                        [&](const SeamUse& u) { return u.part == part && u.forward == forward; });
        if (known == uses.end()) {
            uses.push_back({static_cast<Index>(seams_.seams.size()), part, forward, before});
        } else {
            known->before = std::min(known->before, before);
        }
    }
}

void Finder::add_knots(Seam& seam, const std::vector<std::pair<Index, bool>>& path, const std::vector<double>& starts,
                       const std::vector<Slope>& slopes) const {
    std::vector<double> places = starts;
    for (const Slope& slope : slopes) places.insert(places.end(), {slope.from, slope.to});
    std::sort(places.begin(), places.end());
    for (const double at : places) {
        if (!seam.knots.empty() && at - seam.knots.back().at <= same_place * starts.back()) continue;
        const auto after = std::upper_bound(starts.begin() + 1, starts.end() - 1, at);
        const auto i = static_cast<std::size_t>(after - starts.begin()) - 1;
        const WholeEdge& edge = edges_[path[i].first];
        const Eigen::Vector3d a = position_of_.at(path[i].second ? edge.low : edge.high);
        const Eigen::Vector3d b = position_of_.at(path[i].second ? edge.high : edge.low);
        const double fraction = (at - starts[i]) / (starts[i + 1] - starts[i]);
        seam.knots.push_back({at, 0, (1 - fraction) * a + fraction * b});
    }
    for (const Slope& slope : slopes) {
        const auto first =
            std::lower_bound(seam.knots.begin(), seam.knots.end(), slope.from - same_place * starts.back(),
                             [](const Seam::Knot& k, double at) { return k.at < at; });
        for (auto k = first; k + 1 < seam.knots.end() && k->at < slope.to - same_place * starts.back(); ++k)
            (k + 1)->parameters += slope.per_length * ((k + 1)->at - k->at);
    }
    for (std::size_t k = 1; k < seam.knots.size(); ++k) seam.knots[k].parameters += seam.knots[k - 1].parameters;
}

}  // namespace

Seams find_seams(const QuadLayout& layout, const std::vector<Index>& origins) {
    return find_seams(std::vector<LayoutPart>{{&layout, &origins}});
}

Seams find_seams(const std::vector<LayoutPart>& parts) {
    for (const LayoutPart& part : parts)
        if (static_cast<Index>(part.origins->size()) > part.layout->domain.vertex_count())
            throw InvalidInput("there are more origins than vertices", "bad_option");
    return Finder(parts).result();
}

}  // namespace octafield::surface::detail
