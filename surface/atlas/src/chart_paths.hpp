// Shortest paths along the edges of a chart, and the cuts made of them.
#pragma once

#include <vector>

#include "chart_mesh.hpp"

namespace octafield::surface::detail {

// By edge of the surface: its length, more where the surface bends there, so that cuts keep to where it is smooth.
Eigen::VectorXd cut_costs(const SurfaceDomain& domain);

// Of edges of the surface, those on a cycle or between cycles.
std::vector<Index> without_dead_ends(const SurfaceDomain& domain, std::vector<Index> edges);

class ChartPaths {
public:
    // costs: by edge of the surface. Kept by reference: all of them.
    ChartPaths(const SurfaceDomain& domain, const ChartMesh& chart, const Eigen::VectorXd& costs);

    struct Tree {
        std::vector<double> distance;  // of each vertex
        std::vector<Index> from;       // side of the chart (3 t + k) to the vertex nearer to the sources; -1: a source
    };
    // Sides of the boundary cost next to nothing: they are cut already.
    Tree tree(const std::vector<Index>& sources) const;

    double cost(Index side) const { return side_costs_[side]; }
    Index edge(Index side) const;                          // of the surface
    Index mate(Index side) const { return mates_[side]; }  // the side of the other triangle; -1: boundary
    Index start(Index side) const { return chart_.triangles(side / 3, side % 3); }
    Index end(Index side) const { return chart_.triangles(side / 3, (side % 3 + 1) % 3); }
    Index other_end(Index side, Index vertex) const { return start(side) == vertex ? end(side) : start(side); }
    // Sides from a vertex to the sources.
    std::vector<Index> path(const Tree& tree, Index vertex) const;

private:
    const SurfaceDomain& domain_;
    const ChartMesh& chart_;
    std::vector<double> side_costs_;    // (3 F)
    std::vector<Index> mates_;          // (3 F)
    std::vector<Index> first_, sides_;  // of each vertex, sides that start there, and those of the boundary that end
};

// Edges of the surface along which a chart without a boundary or with handles is to be cut to have one and none: the
// loops of a shortest system through one vertex (Erickson, Whittlesey 2005), the best of some vertices; for a chart
// that is a sphere, a path between two vertices far apart, of two edges at least. Empty: none are needed.
std::vector<Index> opening_cuts(const SurfaceDomain& domain, const ChartPaths& paths, const ChartMesh& chart,
                                const Eigen::VectorXd& costs);

// Edges of the surface on the shortest paths to the outer loop from where the map is smallest: from vertices where
// `scale`, by vertex, is least round them and below `bound`; most: paths.
std::vector<Index> relieving_cuts(const ChartPaths& paths, const ChartMesh& chart, const Eigen::VectorXd& scale,
                                  double bound, int most);

}  // namespace octafield::surface::detail
