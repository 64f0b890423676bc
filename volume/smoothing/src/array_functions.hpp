// The functions of an ArrayScheme with their derivatives by world rotation vectors, what they give being checked.
#pragma once

#include <vector>

#include "octafield/frames/quaternion.hpp"
#include "octafield/volume/array_scheme.hpp"

namespace octafield::volume {

ArrayValues embedded(const ArrayScheme& scheme, const Quaternions& frames);                             // (k, d)
ArrayValues residuals(const ArrayScheme& scheme, const Quaternions& first, const Quaternions& second);  // (k, d)

// Of embed: (k, 3 d), row-major (d, 3) for each frame.
struct EmbeddingDerivatives {
    ArrayValues differentials;
    std::vector<frames::Matrix3> curvatures;  // Hessian of image . embed(exp(w) q) at w = 0
};
// values: of embed there. images: (k, d).
EmbeddingDerivatives derivatives(const ArrayScheme& scheme, const Quaternions& frames, const ArrayValues& values,
                                 const ArrayValues& images, int threads);

// Of residual: (k, 6 d), row-major (d, 6) for each pair, by the first frame's vector and by the second's.
ArrayValues residual_differentials(const ArrayScheme& scheme, const Quaternions& first, const Quaternions& second,
                                   int threads);

}  // namespace octafield::volume
