// Singular curves without the zigzag of the triangles they cross, for pictures and lengths.
#pragma once

#include "octafield/volume/singularities.hpp"

namespace octafield::volume {

struct SmoothedCurves {
    Points points;            // (p, 3), in the place of SingularGraph::points
    Eigen::VectorXd lengths;  // per curve, input unit
    double length = 0;        // sum
};

// Moves every point by `steps` pairs of averaging steps with weights 0.5 and -0.53, which damp zigzag but do not shrink
// curves (Taubin 1995). First and last points of curves stay, but for those of closed curves that meet no other.
// steps = 0: the curves as they are. Throws InvalidInput for negative steps and ids out of range.
SmoothedCurves smoothed_curves(const SingularGraph& graph, int steps = 20);

}  // namespace octafield::volume
