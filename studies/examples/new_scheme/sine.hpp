// A scheme outside the library (docs/extend.md): the vector part of the rotation between matched frames, whose length is
// 2 sin(angle / 2). It needs no logarithm, and counts large angles less.
#pragma once

#include "frame_difference.hpp"
#include "octafield/frames/octahedral_group.hpp"

namespace example {

using octafield::frames::Matrix3;
using octafield::frames::Quaternion;
using octafield::frames::Vector3;

// --8<-- [start:scheme]
// d = 2 vec(q (p o)^-1), o the matching.
struct SineScheme {
    static constexpr int dimension = 3;
    using Vertex = Quaternion;  // nothing to compute per site
    static SineScheme made(const octafield::volume::SmoothOptions&) { return {}; }
    static Vertex at(const Quaternion& q, bool) { return q; }

    octafield::volume::Difference<3> difference(std::size_t, const Vertex& p, const Vertex& q, bool derivatives) const {
        const Quaternion r = q * octafield::frames::closest_representative(p, q).conjugate();
        octafield::volume::Difference<3> d;
        d.value = 2 * r.vec();
        if (!derivatives) return d;
        // q -> exp(w) q turns r to exp(w) r, p -> exp(w) p turns it to r exp(-w).
        const Vector3 v = r.vec();
        Matrix3 cross;
        cross << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
        d.by_second = r.w() * Matrix3::Identity() - cross;
        d.by_first = -r.w() * Matrix3::Identity() - cross;
        return d;
    }
};
// --8<-- [end:scheme]

static_assert(octafield::volume::DifferenceScheme<SineScheme>);

}  // namespace example
