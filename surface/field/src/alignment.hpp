// What a direction field must or should follow: boundary, features, user constraints, guide field.
#pragma once

#include <vector>

#include "crouzeix_raviart.hpp"
#include "octafield/surface/direction_field.hpp"
#include "pull.hpp"

namespace octafield::surface::detail {

// An edge of the boundary or a feature that is followed weakly: its weight depends on epsilon, to be chosen later.
struct WeakEdge {
    Index edge;
    double length;
    Complex value;
};

struct AlignedEdges {
    std::vector<bool> is_held;  // (E)
    Eigen::VectorXcd held;      // (E), 0 where not held
    std::vector<WeakEdge> weak;
    Pull pull;  // user constraints and guide; later the weak edges too
};

// Throws InvalidInput for options, constraints and guides that do not fit the surface.
AlignedEdges aligned_edges(const SurfaceDomain& domain, const std::vector<CornerLink>& links,
                           const DirectionFieldOptions& options);

// Adds the weak edges to the pull, with weights L length / eps^2 (thesis 3.27); `epsilon` (E); L = 0: eps.
void add_weak_edges(AlignedEdges& edges, double alignment_length, const Eigen::VectorXd& epsilon);

// The edge with vertices a and b; -1 if there is none.
Index find_edge(const EdgeTopology& topology, Index a, Index b);

// The parts of aligned_edges with sources of their own.
void add_constraints(const SurfaceDomain& domain, const std::vector<CornerLink>& links, int symmetry,
                     const DirectionConstraints& constraints, const std::vector<bool>& follows_feature,
                     AlignedEdges& edges);
void add_guide(const SurfaceDomain& domain, int symmetry, const DirectionGuide& guide, AlignedEdges& edges);
// Of the edges with follows[e], those beside a sector in which no field can follow both its sides.
std::vector<bool> contradicting_edges(const SurfaceDomain& domain, const std::vector<CornerLink>& links, int symmetry,
                                      const std::vector<bool>& follows, const Eigen::VectorXcd& values,
                                      double tolerance);

}  // namespace octafield::surface::detail
