// A T-mesh of an imposed field: its motorcycle graph (Eppstein, Goodrich, Kim, Tamstorf 2008; of cross fields: Campen,
// Bommes, Kobbelt, "Quantized global parametrization", 2015).
//
// All separatrices run at the same time, at unit speed in quad coordinates. One that meets a track that was there
// before it stops, in a T-joint; so every curve is finite, also where separatrices are long, dense or closed. As in
// quad_layout, a separatrix that passes another point within the tolerance before it stops is joined with that point's
// own one; others stop at joined ones. Patches are rectangles in quad coordinates, with T-joints on their sides.
#pragma once

#include "octafield/surface/quad_layout.hpp"

namespace octafield::surface {

// The layout's sides end at T-joints, too; LayoutPatch::corner_sides tells where the four sides of a patch begin.
// There are no chords (-1), and largest_mismatch compares sums. A curve's points may go on behind the T-joint that it
// ends at, to the end of the triangle.
//
// Patches that are not disks are cut: where they have a closed curve of the boundary without vertices, from its lowest
// vertex; others from an inner vertex of theirs, in four directions (a torus without points: two closed curves, or a
// few more with T-joints). options.cut_vertices may be inside the surface here. Fields may be rotated
// (Inadmissible::rotate); sizes then disagree between opposite sides.
//
// Throws as quad_layout, but for "rotated_field".
QuadLayout motorcycle_graph(const ImposedField& field, const LayoutCurveOptions& options = {},
                            const Progress& progress = {});

}  // namespace octafield::surface
