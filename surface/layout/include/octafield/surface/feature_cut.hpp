// A surface cut open along its feature edges, so that a field that follows the boundary follows them as well.
#pragma once

#include "octafield/surface/surface_domain.hpp"

namespace octafield::surface {

struct FeatureCut {
    SurfaceDomain domain;        // triangles as before; a vertex for each sector between features
    std::vector<Index> origins;  // (V) of each vertex: that of the whole surface
};

// Edges inside that are features become two of the boundary. Near linear. Vertices in no triangle are left out.
FeatureCut cut_along_features(const SurfaceDomain& domain);

}  // namespace octafield::surface
