// A closed surface around any triangles.
#pragma once

#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::surface {

// Alpha wrap (Portaneri, Rouxel-Labbe, Hemmer, Cohen-Steiner, Alliez 2022; CGAL): closed, oriented outward, crosses
// nothing, contains the triangles. alpha: gaps narrower than this are bridged; offset: how far outside it lies. Both
// positive, input unit. Empty where no triangle has area.
TriangleMesh alpha_wrap(const TriangleMesh& mesh, double alpha, double offset);

}  // namespace octafield::surface
