// Metrics on frames through their su2 invariants: what Beaufort (thesis, UCLouvain 2019, section 4.4.3) tried, and
// what is consistent.
//
// Angles are in radians of rotation of the frame, twice the length on the unit 3-sphere of quaternions.
#pragma once

#include <vector>

#include "octafield/frames/geodesic.hpp"
#include "octafield/frames/su2.hpp"

namespace octafield::frames::su2_metric {

using Matrix3c = Eigen::Matrix<Complex, 3, 3>;

// (a) Naive: |h(p) - h(q)| in C^3 (thesis 4.26). Over the angle between p and q, for small angles, anything between
// 0.151 and 4: not a distance of frames.
double naive(const Quaternion& p, const Quaternion& q);

// (b) Pulled back: 2 sqrt(dh^H M dh) with M = (J^+)^H J^+ (3 x 3, positive semidefinite, of rank 2),
// J = dh/d(u, v): twice the length of the least-squares (du, dv) for dh. In this order of factors M is a form on C^3;
// the thesis's (4.33) prints J^+ (J^+)^H, which is 2 x 2 and is none. For its rows of gradients, dh M^T dh^H. The same
// for all 48 quaternions of a frame. The angle of rotation to first order in |dh|. Taken at the midpoint of random
// frames it is (1 % and 99 % quantiles) 0.995 to 1.001 of the angle at 2 degrees, 0.967 to 1.007 at 5, 0.88 to 1.03 at
// 10, useless beyond 30; at an end already 0.90 to 1.11 at 2 degrees.
Matrix3c pulled_back(const Quaternion& at);                              // M
double pulled_back_at_end(const Quaternion& p, const Quaternion& q);     // M at p
double pulled_back_symmetric(const Quaternion& p, const Quaternion& q);  // root mean square of M at p and M at q
double pulled_back_midpoint(const Quaternion& p, const Quaternion& q);   // M at slerp(p, q, 1/2)

// (c) Geodesic on the variety, arguments and results in C^3 only: through the inverse map and matching. Points must lie
// on the model surface over SU(2) to 1e-6 (else InvalidInput: project them first). Tangent vectors at h are the images
// J (du, dv) of rotations of the frame: a real 3-space; `log` gives the one whose length is the distance.
double distance(const Complex3& h, const Complex3& k);
Complex3 log(const Complex3& h, const Complex3& k);
// The tangent is first projected orthogonally (in C^3 = R^6) onto the tangent space at h. exp(h, log(h, k)) = k.
Complex3 exp(const Complex3& h, const Complex3& tangent);
// Length of a tangent vector, projected as in exp, in the metric of rotations: the angle of the rotation it stands for.
double length(const Complex3& h, const Complex3& tangent);
// Karcher mean of points of the model surface; weights and errors as in geodesic.hpp.
Complex3 mean(const std::vector<Complex3>& points, const Eigen::VectorXd& weights = {});

}  // namespace octafield::frames::su2_metric
