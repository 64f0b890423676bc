// The vertices a hex mesh can have, by the valences of their edges.
#include <algorithm>
#include <array>
#include <cstdint>
#include <string>

#include "octafield/error.hpp"
#include "octafield/volume/meshability.hpp"

namespace octafield::volume {
namespace {

using Type = std::array<int, 3>;  // corners of degree 3, 5, 6

constexpr int enumerated_corners = 12;

// Of all triangulations of the sphere with 4 to 12 corners (1, 1, 2, 5, 14, 50, 233, 1249, 7595 of them), those with
// degrees 3 to 6 only. tests/volume/meshability_test.cpp enumerates them again.
constexpr Type types[]{
    {0, 0, 0}, {0, 0, 2}, {0, 0, 3}, {0, 0, 4},  {0, 0, 5}, {0, 0, 6}, {0, 2, 0}, {0, 2, 2}, {0, 2, 3}, {0, 2, 4},
    {0, 2, 5}, {0, 4, 0}, {0, 4, 1}, {0, 4, 2},  {0, 4, 3}, {0, 4, 4}, {0, 6, 0}, {0, 6, 1}, {0, 6, 2}, {0, 6, 3},
    {0, 8, 0}, {0, 8, 1}, {0, 8, 2}, {0, 12, 0}, {1, 1, 2}, {1, 1, 3}, {1, 1, 4}, {1, 1, 5}, {1, 1, 6}, {1, 3, 0},
    {1, 3, 1}, {1, 3, 2}, {1, 3, 3}, {1, 3, 4},  {1, 3, 5}, {1, 5, 1}, {1, 5, 2}, {1, 5, 3}, {1, 5, 4}, {1, 7, 2},
    {1, 7, 3}, {2, 0, 0}, {2, 0, 2}, {2, 0, 4},  {2, 0, 5}, {2, 0, 6}, {2, 2, 0}, {2, 2, 1}, {2, 2, 2}, {2, 2, 3},
    {2, 2, 4}, {2, 2, 5}, {2, 2, 6}, {2, 4, 1},  {2, 4, 2}, {2, 4, 3}, {2, 4, 4}, {2, 4, 5}, {2, 6, 0}, {2, 6, 2},
    {2, 6, 3}, {2, 6, 4}, {3, 1, 3}, {3, 1, 5},  {3, 1, 7}, {3, 3, 1}, {3, 3, 3}, {3, 3, 5}, {3, 3, 6}, {4, 0, 0},
    {4, 0, 4}, {4, 0, 6}, {4, 0, 8},
};

}  // namespace

bool hex_vertex_exists(int valence3, int valence5, int valence6, int valence7, int valence8) {
    if (std::min({valence3, valence5, valence6, valence7, valence8}) < 0)
        throw InvalidInput("hex_vertex_exists takes numbers of edges, but got " + std::to_string(valence3) + ", " +
                               std::to_string(valence5) + ", " + std::to_string(valence6) + ", " +
                               std::to_string(valence7) + ", " + std::to_string(valence8) + "; give 0 or more",
                           "option_out_of_range");
    if (valence7 > 0 || valence8 > 0) {
        const std::int64_t regular =
            12 + std::int64_t{valence7} + 2 * std::int64_t{valence8} - 3 * std::int64_t{valence3} - valence5;
        return regular >= 0 && regular % 2 == 0;
    }
    if (valence3 > 4 || valence5 > 12) return false;
    const int twice_regular = 12 - 3 * valence3 - valence5;
    if (twice_regular < 0 || twice_regular % 2 != 0) return false;
    if (twice_regular / 2 + valence3 + valence5 > enumerated_corners - valence6) return true;
    return std::binary_search(std::begin(types), std::end(types), Type{valence3, valence5, valence6});
}

}  // namespace octafield::volume
