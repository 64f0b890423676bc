// Where quads meet triangles, and regions of cells that are filled anew about one point.
#pragma once

#include <optional>
#include <vector>

#include "cell_complex.hpp"
#include "cone.hpp"

namespace octafield::volume::detail {

// What lies outside a quad of a cell.
struct QuadMeeting {
    enum class Kind {
        boundary,
        quad,
        triangles,  // two, that fill it
        part        // triangles that do not
    } kind;
    std::array<Index, 4> round;  // the quad outward; the diagonal of the two triangles joins the first and the third
};

QuadMeeting quad_meeting(const CellComplex& complex, const FaceCycle& quad);

// The triangle, outward of a tet that has nothing across it, is on three vertices of a quad, outward, that has another
// cell's quad across; and it is not half of a quad that meets two triangles.
bool lies_on_matched_quad(const CellComplex& complex, const FaceCycle& triangle);

// Cells and the faces round all of them, outward.
struct Region {
    std::vector<Index> cells;
    std::vector<FaceCycle> boundary;
};

// Quads of the cell that meet two triangles count as those.
void add_to_region(const CellComplex& complex, Index cell, Region& region);

// The tets and pyramids round the diagonal of a quad that meets two triangles, and in their place the quad. Nothing
// where other cells or the mesh's boundary are between.
std::optional<Region> cells_round_diagonal(const CellComplex& complex, const std::array<Index, 4>& round);

struct Filling {
    Region region;
    Apex apex;
};

// The region as given, or with the tets and pyramids across its worst faces, while the quality is below 0.15 and that
// makes it better: the best found.
Filling best_filling(const CellComplex& complex, Region region, std::vector<Eigen::Vector3d> seeds);

void fill(CellComplex& complex, const Filling& filling);

// Moves a vertex that is no corner of a quad to where the worst cell at it is best.
void improve_apex(CellComplex& complex, Index vertex);

}  // namespace octafield::volume::detail
