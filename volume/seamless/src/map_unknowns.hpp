// What is free in the parameters of a combed field's map: numbers of corners, equations of cut, surface and features.
#pragma once

#include "curve_split.hpp"
#include "octafield/volume/combing.hpp"
#include "related_values.hpp"

namespace octafield::volume::detail {

struct MapUnknowns {
    Tets corners;  // (m, 4): parameter i of corner k is number 3 corners(t, k) + i
    RelatedValues::Free free;
    std::vector<Index> locked;  // tets that are flat whatever the unknowns are
};

// field: combed, frames and matchings those of `combed`. Over each triangle of the cut u' = R u + t, t one for each
// part of the cut that triangles join at regular edges (a sheet). Triangles of the surface keep the parameter of the
// axis nearest to their normal, feature edges two. The first corner of each part of the mesh is at 0. Singular edges
// keep what the cut round them asks for. Throws SolverError ("no_translations").
MapUnknowns map_unknowns(const MatchedField& field, const CombedField& combed);

}  // namespace octafield::volume::detail
