// The triangles of a layout's surface, each in a plane with whole numbers that a tile of the T-mesh gives it.
#pragma once

#include "quarter_turn.hpp"
#include "seams.hpp"

namespace octafield::surface::detail {

// Quads along the arcs of a layout and along the parts of seams.
struct GridCounts {
    const std::vector<int>& arcs;
    const std::vector<int>& parts;
    const std::vector<Eigen::VectorXd>& along;  // SideGrids
};

struct ChartedMesh {
    // A side on the boundary: the line that it is on, in its triangle's plane, by the whole number along the seam.
    struct OnSeam {
        Index seam = -1;
        GridRay line{};
        double from = 0, to = 0;  // lengths along the seam at the side's two ends
        Index twin = -1;          // the side on the other side of the seam, -1: none
    };
    struct Fixed {
        Index corner;  // 3 t + k
        GridPoint at;  // in the plane of t
        bool singular;
    };
    std::vector<Eigen::Vector3d> positions;
    std::vector<std::array<Index, 3>> triangles;  // counter-clockwise; side 3 t + k runs from corner k to the next one
    std::vector<Index> origins;                   // of triangles: of the surface
    std::vector<int> quarters;                    // of origins: from the field's step there to the plane's first axis
    std::vector<Index> mates;                     // of sides; -1: boundary
    std::vector<QuarterTurn> across;              // of sides: from the triangle's plane to that of the mate
    std::vector<Vector2> start;                   // of corners: where the tiles' own maps have them, roughly
    std::vector<OnSeam> on_seams;                 // of sides
    std::vector<Fixed> fixed;                     // vertices inside that tiles have a corner at
    struct SeamSize {
        int count;  // of the whole number at its end
        double length;
        bool closed;
    };
    std::vector<SeamSize> seams;

    static Index next(Index side) { return side % 3 == 2 ? side - 2 : side + 1; }
    static Index before(Index side) { return side % 3 == 0 ? side + 2 : side - 1; }
    Index from(Index side) const { return triangles[side / 3][side % 3]; }
    Index side_count() const { return static_cast<Index>(mates.size()); }
    // A place on a side becomes a vertex, on both sides of it, and of the seam.
    void split(Index side, double fraction = 0.5);
    // Sides on the two sides of each seam are to end at the same places; they get to know one another.
    void match_seams();
    // The sides round corner `side` from one on the boundary on (any if there is none), counter-clockwise; all corners
    // of one vertex.
    std::vector<Index> corners_round(Index side) const;

private:
    Index halve(Index side, Index middle, double fraction);
    void split_here(Index side, double fraction);
};

// Throws GeometryError (kind "bad_subdivision").
ChartedMesh charted_mesh(const QuadLayout& layout, const Seams& seams, const GridCounts& counts);

}  // namespace octafield::surface::detail
