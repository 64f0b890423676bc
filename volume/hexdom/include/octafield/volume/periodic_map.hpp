// A periodic parameterization of a tet mesh along the axes of a frame field: coordinates whose integer points are the
// vertices of hexahedra (Ray, Sokolov, Lévy 2006; Sokolov, Ray, Untereiner, Lévy 2016).
#pragma once

#include <cstdint>
#include <vector>

#include "octafield/progress.hpp"
#include "octafield/volume/combing.hpp"

namespace octafield::volume {

struct PeriodicMapOptions {
    // Triangles of the surface and feature edges are held on integer coordinates where an axis is within this angle of
    // their normal or direction; radians.
    double hold_angle = 0.7;
    int rounds = 12;  // of diffusion and normalization, from far to near
    int threads = 0;  // 0: all; the result does not depend on it
};

// Coordinates in units of a cell, tet by tet. They are exact: multiples of 1 / periodic_unit that agree across
// triangles, where both tets are usable and the triangle is joined, up to a rotation of the cube and integers.
inline constexpr std::int32_t periodic_unit = 1 << 16;

struct PeriodicMap {
    Quaternions frames;                       // (m, 4) those the axes of which the coordinates follow
    Rows<std::int32_t, 12> coordinates;       // (m, 12) column 3 c + i: coordinate i of corner c, times periodic_unit
    std::vector<std::uint8_t> usable;         // (m) 1: its edges' jumps sum to 0, and it is positively oriented
    FaceMatchings faces;                      // x of the first tet is o^-1 x + translation in the second
    Rows<std::int32_t, 3> translation;        // (f) in cells
    std::vector<std::uint8_t> joined;         // (f) 1: both tets are usable and agree on the triangle
    Index inconsistent = 0, turned_over = 0;  // tets whose jumps do not sum to 0; whose orientation is not positive
};

// Three phases per vertex, one for each of the axes there: those that a singular curve exchanges, the normals of the
// surface and the two directions across a feature curve are 0. The others minimise the sum over edges of
// w |z_b - exp(2 pi i d) z_a|^2, d the length of the edge along the axis in cells: as complex numbers first, then by
// rounds of diffusion and normalization. An edge's jump is the integer that makes the phases' difference nearest to d.
// of_tets: (m, 4) unit quaternions w x y z in the tets; lengths: (m, 3) of a cell along each of their axes, input unit.
// Near linear. Throws InvalidInput (kinds "wrong_size", "not_unit", "hold_angle", "rounds"; "edge_length": lengths not
// above 0, or an edge of more than 15000 cells), Cancelled.
PeriodicMap periodic_map(const TetDomain& domain, const Quaternions& of_tets, const Points& lengths,
                         const PeriodicMapOptions& options = {}, const Progress& progress = {});

}  // namespace octafield::volume
