// An atlas: a surface of any kind as few one-to-one charts (after Beaufort's thesis, chapter 2, with cuts in place of
// most splits as in Gu, Gortler, Hoppe, "Geometry images", 2002).
#pragma once

#include <vector>

#include "octafield/progress.hpp"
#include "octafield/surface/disk_parameterization.hpp"

namespace octafield::surface {

struct AtlasOptions {
    // Least conformity (MapDistortion) of each chart, but for 5 % of its area, in [0, 1). 0: none is asked for.
    double conformity = 0.1;
    Index max_triangles = 100000;  // of a chart, at least 1
    // Coarse faces whose charts miss the conformity get vertices inside, by longest-edge bisection.
    bool bisect = true;
};

struct AtlasChart {
    Index triangles = 0;
    double area = 0;                                   // input unit squared
    int loops = 1;                                     // boundary curves; all but the one on the ellipse are holes
    double conformity = 0;                             // that of AtlasOptions: 5 % of the area have less
    double least_conformity = 0, mean_conformity = 0;  // the mean by area
    double evenness = 0;   // the least sqrt(area in the plane / area) over its mean, but for 5 % of the area
    bool as_asked = true;  // whether it has the conformity asked for
};

struct AtlasFace {  // connected part between features
    int genus = 0, loops = 0;
    Index triangles = 0;
};

struct Atlas {
    SurfaceDomain domain;          // the input, or with triangles bisected; its features are the input's
    std::vector<Index> parents;    // (F) of the input, the triangle that each is part of
    std::vector<Index> faces;      // (F) place in face_list
    std::vector<Index> charts;     // (F) place in chart_list; the first triangles of charts ascend
    PlanePoints uv{0, 2};          // (n, 2) of the charts' vertices, chart by chart, each round its own origin
    Triangles uv_triangles{0, 3};  // (F, 3) rows of uv
    std::vector<Index> origins;    // (n) vertex of the domain of each
    Edges cuts{0, 2};              // (c, 2) edges across which charts or u, v end, but for features and the boundary
    Eigen::VectorXd conformity;    // (F)
    std::vector<AtlasFace> face_list;
    std::vector<AtlasChart> chart_list;
};

// Faces between features are charts where they can be. What has handles, or no boundary, is cut open along short
// curves; both sides of a cut are in the same chart. Where the map is uneven, more cuts go to where it is smallest;
// what still misses `conformity`, or has more than max_triangles, is split in two by a short curve half way between its
// ends, and so on. A chart is the unit disk stretched to the ellipse of the same area that has the best conformity.
// Features that end inside a face are no boundary of its chart. Every chart is one-to-one in exact arithmetic. Close to
// linear. Throws InvalidInput (kind "bad_option"), GeometryError ("empty"), Cancelled.
Atlas atlas(const SurfaceDomain& domain, const AtlasOptions& options = {}, const Progress& progress = {});

// The charts' u, v, (n, 2), side by side in the unit square without overlap, at one scale: lengths there are lengths on
// the surface times the number returned in `scale` (if given), on average over each chart.
PlanePoints packed_uv(const Atlas& atlas, double* scale = nullptr);

}  // namespace octafield::surface
