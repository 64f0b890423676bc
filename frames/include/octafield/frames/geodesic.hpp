// Quaternion and matching, without an embedding: the geometry of SO(3)/O itself.
//
// The tangent vector from frame p to frame q is the rotation vector w (world axes, radians) of the smallest rotation
// with exp(w) p = q as frames. All functions accept any of the 48 quaternions of a frame.
#pragma once

#include "octafield/frames/octahedral_group.hpp"

namespace octafield::frames {

// exp(w) q.
Quaternion frame_exp(const Quaternion& q, const Vector3& w);

// Smallest rotation vector from p to q: |frame_log| = distance(p, q) <= 62.7994 degrees; frame_exp(p, w) is q as a
// frame. On the cut locus one of the equally short ones, that of matching(p, q).
Vector3 frame_log(const Quaternion& p, const Quaternion& q);

// The frame at fraction t of the shortest path from p (t = 0) to q (t = 1); t outside [0, 1] extrapolates.
Quaternion slerp(const Quaternion& p, const Quaternion& q, double t);

struct FrameMean {
    Quaternion frame;
    double variance = 0;     // weighted mean of the squared distances to `frame`
    bool converged = false;  // gradient below the tolerance
    int iterations = 0;
};

// Karcher mean: the frame that minimises sum_i w_i distance(frame, q_i)^2 / sum_i w_i. Weights not negative, empty for
// equal ones. Unique if all frames lie within about 20 degrees of one another; else the best of the descents from the
// projected mean of the sh4 vectors and from up to 8 of the frames, spread over the list. Throws InvalidInput: no
// frames, wrong number of weights, negative or zero total weight.
FrameMean frame_mean(const Quaternions& frames, const Eigen::VectorXd& weights = {});

}  // namespace octafield::frames
