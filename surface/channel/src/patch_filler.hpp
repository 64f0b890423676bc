// The best template for a polygon.
#pragma once

#include <memory>
#include <vector>

#include "octafield/surface/quad_templates.hpp"
#include "quad_shape.hpp"

namespace octafield::surface::detail {

constexpr int most_sides = 10;

// Polygon to be filled: vertices counter-clockwise.
struct Patch {
    std::vector<Vector2> corners;
    std::vector<int> least_quads;  // that each corner has to have inside: 2 where a vertex would have two quads only
    std::vector<int> outer_quads;  // that each has outside; -1: at the outline, where any number is regular
    std::vector<std::vector<char>> joined;  // whether two corners have an edge outside already; empty: none has
};

struct Filling {
    double cost = 0;                        // of the quads, the irregular corners and vertices inside
    std::vector<std::array<int, 4>> quads;  // ids as in QuadTemplate
    std::vector<Vector2> interior;          // where the vertices inside are
};

class PatchFiller {
public:
    PatchFiller();
    // Cost below `limit`; cost = limit and no quads: there is none.
    Filling fill(const Patch& patch, double limit) const;

private:
    // A template as it lies on a polygon, and the weights of corners for each vertex inside (Tutte's barycentres).
    struct Placed {
        int interior = 0;
        std::vector<std::array<int, 4>> quads;
        std::vector<int> corner_quads;
        std::vector<std::array<int, 2>> chords;  // edges between corners that are no sides
        double irregular = 0;                    // cost of the vertices inside
        Eigen::MatrixXd weights;                 // (interior, sides)
    };
    std::array<std::vector<Placed>, most_sides / 2 + 1> placed_;  // by sides / 2

    static std::vector<Placed> placed_of(int sides, int interior);
    static Placed placed(int sides, int interior, std::vector<std::array<int, 4>> quads);
    static double bound(const Patch& patch, const std::vector<double>& angles, const Placed& placed);
};

// The cost of the valence of vertices with these many quads.
inline double valence_cost(int quads) { return irregular_cost * (quads - 4) * (quads - 4); }

}  // namespace octafield::surface::detail
