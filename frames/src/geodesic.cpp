#include "octafield/frames/geodesic.hpp"

#include "octafield/error.hpp"

namespace octafield::frames {

Quaternion frame_exp(const Quaternion& q, const Vector3& w) {
    require_unit(q);
    if (!w.allFinite()) throw InvalidInput("the rotation vector is not finite", "non_finite");
    return (exp(w) * q).normalized();
}

Vector3 frame_log(const Quaternion& p, const Quaternion& q) {
    require_unit(p), require_unit(q);
    return log(q * (p * octahedral_group()[matching(p, q)]).conjugate());
}

Quaternion slerp(const Quaternion& p, const Quaternion& q, double t) { return frame_exp(p, t * frame_log(p, q)); }

}  // namespace octafield::frames
