#include "curve_points.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace octafield::volume {
namespace {

using frames::Vector3;

class Curves {
public:
    Curves(const TetDomain& domain, const Edges& edges)
        : edges_(edges), first_(domain.surface().mesh.vertices.rows() + 1, 0), node_(first_.size() - 1, 0) {
        for (const Index v : edges.reshaped()) ++first_[v + 1];
        for (std::size_t v = 0; v < node_.size(); ++v) node_[v] = first_[v + 1] > 0 && first_[v + 1] != 2;
        for (const Index v : domain.features().corners) node_[v] = 1;
        std::partial_sum(first_.begin(), first_.end(), first_.begin());
        std::vector<Index> next(first_.begin(), first_.end() - 1);
        at_.resize(edges.size());
        for (Index e = 0; e < edges.rows(); ++e)
            for (const Index v : edges.row(e)) at_[next[v]++] = e;
    }

    bool node(Index v) const { return node_[v]; }
    Index vertices() const { return static_cast<Index>(node_.size()); }

    // Curves from node to node, then closed ones: vertices in order, closed ones with the first at the end again.
    std::vector<std::vector<Index>> all() const {
        std::vector<std::vector<Index>> curves;
        std::vector<std::uint8_t> seen(edges_.rows(), 0);
        for (const bool of_nodes : {true, false})
            for (Index v = 0; v < vertices(); ++v) {
                if (of_nodes && !node_[v]) continue;
                for (Index i = first_[v]; i < first_[v + 1]; ++i)
                    if (!seen[at_[i]]) curves.push_back(from(v, at_[i], seen));
            }
        return curves;
    }

private:
    std::vector<Index> from(Index v, Index edge, std::vector<std::uint8_t>& seen) const {
        std::vector<Index> curve{v};
        for (;;) {
            seen[edge] = 1;
            v = edges_(edge, 0) == v ? edges_(edge, 1) : edges_(edge, 0);
            curve.push_back(v);
            if (node_[v] || v == curve.front()) return curve;
            edge = at_[first_[v]] == edge ? at_[first_[v] + 1] : at_[first_[v]];
        }
    }

    const Edges& edges_;
    std::vector<Index> first_, at_;  // edges at each vertex
    std::vector<std::uint8_t> node_;
};

class CurvePoints {
public:
    CurvePoints(const TetDomain& domain, const SurfaceWalker& walker, const FrontField& field)
        : mesh_(domain.surface().mesh), walker_(walker), field_(field) {}

    // `part` of the way from one vertex to the other.
    FrontPlace on_edge(Index from, Index to, double part) const {
        for (const Index t : walker_.round(walker_.at_vertex(from))) {
            Vector3 weights = Vector3::Zero();
            for (int k = 0; k < 3; ++k) {
                if (mesh_.triangles(t, k) == from) weights[k] = 1 - part;
                if (mesh_.triangles(t, k) == to) weights[k] = part;
            }
            if (weights.sum() > 0.999) return walker_.place(t, weights);
        }
        return walker_.at_vertex(from);  // not reached: curves are edges of triangles
    }

    void between(const std::vector<Index>& curve, bool closed, std::vector<FrontPlace>& points) const {
        const std::vector<double> cells = lengths_in_cells(curve);
        const double whole = cells.back();
        const int parts = std::max(closed ? 3 : 1, static_cast<int>(std::lround(whole)));
        std::size_t edge = 0;
        for (int k = closed ? 0 : 1; k < parts; ++k) {
            const double wanted = whole * k / parts;
            while (edge + 2 < curve.size() && cells[edge + 1] <= wanted) ++edge;
            points.push_back(
                on_edge(curve[edge], curve[edge + 1], (wanted - cells[edge]) / (cells[edge + 1] - cells[edge])));
        }
    }

private:
    // Sums up to each vertex of the curve.
    std::vector<double> lengths_in_cells(const std::vector<Index>& curve) const {
        std::vector<FrontPlace> middles;
        for (std::size_t i = 0; i + 1 < curve.size(); ++i) middles.push_back(on_edge(curve[i], curve[i + 1], 0.5));
        const std::vector<LocalAxes> axes = field_.at(middles);
        std::vector<double> sums{0};
        for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
            const Vector3 edge = (mesh_.vertices.row(curve[i + 1]) - mesh_.vertices.row(curve[i])).transpose();
            Eigen::Index nearest;
            (axes[i].axes.transpose() * edge).cwiseAbs().maxCoeff(&nearest);
            sums.push_back(sums.back() + edge.norm() / axes[i].lengths[nearest]);
        }
        return sums;
    }

    const surface::TriangleMesh& mesh_;
    const SurfaceWalker& walker_;
    const FrontField& field_;
};

}  // namespace

std::vector<FrontPlace> curve_points(const TetDomain& domain, const Edges& edges, const SurfaceWalker& walker,
                                     const FrontField& field) {
    const Curves curves(domain, edges);
    const CurvePoints maker(domain, walker, field);
    std::vector<FrontPlace> points;
    for (Index v = 0; v < curves.vertices(); ++v)
        if (curves.node(v)) points.push_back(walker.at_vertex(v));
    for (const std::vector<Index>& curve : curves.all()) maker.between(curve, !curves.node(curve.front()), points);
    return points;
}

}  // namespace octafield::volume
