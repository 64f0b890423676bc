#include "boundary_lengths.hpp"

#include <cmath>

namespace octafield::surface::detail {
namespace {

// int exp(-H) over the first `fraction` of a straight line of length 1 on which H is linear.
double linear_length(double from, double to, double fraction) {
    const double x = (to - from) * fraction;
    const double mean = std::abs(x) < 1e-6 ? 1 - x / 2 : -std::expm1(-x) / x;
    return std::exp(-from) * fraction * mean;
}

class Boundary {
public:
    Boundary(const ImposedField& field, const Charts& charts, const LayoutPoints& points, const CutSurface& cut)
        : field_(field), charts_(charts), points_(points), cut_(cut) {
        next_.assign(charts.mesh().vertices.rows(), -1);
        for (Index e = 0; e < charts.topology().edges.rows(); ++e)
            if (is_boundary(e)) next_[ends(e).first] = e;
    }

    std::vector<std::vector<CurveNode>> curves(const std::function<bool(Index)>& starts) const {
        std::vector<std::vector<CurveNode>> result;
        std::vector<bool> done(charts_.topology().edges.rows(), false);
        for (Index e = 0; e < charts_.topology().edges.rows(); ++e) {
            if (!is_boundary(e) || done[e]) continue;
            std::vector<CurveNode> nodes = {{ends(e).first, 0}};
            for (Index at = e; !done[at]; at = next_[ends(at).second]) {
                done[at] = true;
                add_edge(at, nodes);
            }
            result.push_back(started(std::move(nodes), starts));
        }
        return result;
    }

private:
    bool is_boundary(Index e) const { return charts_.topology().edge_triangles.row(e).minCoeff() < 0; }
    bool forward(Index e) const { return charts_.topology().edge_triangles(e, 0) >= 0; }
    std::pair<Index, Index> ends(Index e) const {
        const auto edge = charts_.topology().edges.row(e);
        return forward(e) ? std::pair(edge[0], edge[1]) : std::pair(edge[1], edge[0]);
    }

    // Up to `fraction` of the edge; by the power of the distance next to a point.
    double length(Index e, double fraction) const {
        const auto [a, b] = ends(e);
        const double ha = field_.log_size[a], hb = field_.log_size[b];
        const Index pa = points_.of_vertex[a], pb = points_.of_vertex[b];
        const double whole = charts_.domain().edge_lengths()[e];
        if (pa >= 0 && pb >= 0) return whole * fraction * std::exp(-(ha + hb) / 2);
        if (pa >= 0) {
            const double power = points_.points[pa].power;
            return whole * std::exp(-hb) / power * std::pow(fraction, power);
        }
        if (pb >= 0) {
            const double power = points_.points[pb].power;
            return whole * std::exp(-ha) / power * (1 - std::pow(1 - fraction, power));
        }
        return whole * linear_length(ha, hb, fraction);
    }

    void add_edge(Index e, std::vector<CurveNode>& nodes) const {
        const auto [a, b] = ends(e);
        const double start = nodes.back().length;
        const double whole = (cut_.positions.row(b) - cut_.positions.row(a)).norm();  // in space
        const auto& inner = cut_.edge_nodes[e];
        for (std::size_t i = 0; i < inner.size(); ++i) {
            const Index node = forward(e) ? inner[i] : inner[inner.size() - 1 - i];
            const double fraction = (cut_.positions.row(node) - cut_.positions.row(a)).norm() / whole;
            nodes.push_back({node, start + length(e, fraction)});
        }
        nodes.push_back({b, start + length(e, 1)});
    }

    static std::vector<CurveNode> started(std::vector<CurveNode> nodes, const std::function<bool(Index)>& starts) {
        std::size_t first = 0;
        while (first + 1 < nodes.size() && !starts(nodes[first].node)) ++first;
        if (first == 0 || first + 1 == nodes.size()) return nodes;
        const double whole = nodes.back().length, shift = nodes[first].length;
        std::vector<CurveNode> result(nodes.begin() + static_cast<std::ptrdiff_t>(first), nodes.end());
        for (std::size_t i = 1; i <= first; ++i) result.push_back({nodes[i].node, nodes[i].length + whole});
        for (CurveNode& node : result) node.length -= shift;
        return result;
    }

    const ImposedField& field_;
    const Charts& charts_;
    const LayoutPoints& points_;
    const CutSurface& cut_;
    std::vector<Index> next_;  // edge from each vertex of the boundary
};

}  // namespace

std::vector<std::vector<CurveNode>> boundary_nodes(const ImposedField& field, const Charts& charts,
                                                   const LayoutPoints& points, const CutSurface& cut,
                                                   const std::function<bool(Index)>& starts) {
    return Boundary(field, charts, points, cut).curves(starts);
}

}  // namespace octafield::surface::detail
