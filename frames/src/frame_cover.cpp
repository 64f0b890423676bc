#include <cmath>
#include <numbers>

#include "nearest_frame.hpp"

namespace octafield::frames {

// A grid in Rodrigues vectors tan(angle / 2) axis, where the frames nearer to the identity than to its 23 other
// representatives fill the cube |r_i| <= tan(pi/8) with its corners cut by the octahedron |r_1| + |r_2| + |r_3| <= 1.
const std::vector<Quaternion>& frame_cover() {
    static const auto cover = [] {
        constexpr int half = 5;  // 11^3 grid points in the cube
        const double step = std::tan(std::numbers::pi / 8) / half;
        std::vector<Quaternion> frames = {Quaternion::Identity()};
        for (int i = -half; i <= half; ++i)
            for (int j = -half; j <= half; ++j)
                for (int k = -half; k <= half; ++k) {
                    const bool inside = (std::abs(i) + std::abs(j) + std::abs(k)) * step <= 1 + step;
                    if (inside && (i || j || k))
                        frames.push_back(Quaternion(1, i * step, j * step, k * step).normalized());
                }
        return frames;
    }();
    return cover;
}

}  // namespace octafield::frames
