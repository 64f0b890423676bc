// A chart with its map to the plane, and what that is like.
#pragma once

#include "chart_mesh.hpp"
#include "octafield/surface/atlas.hpp"

namespace octafield::surface::detail {

struct MappedChart {
    ChartMesh mesh;
    PlanePoints uv{0, 2};        // of the chart's vertices, in an ellipse of area pi
    Eigen::VectorXd conformity;  // of its triangles
    Eigen::VectorXd scale;       // of its vertices: the least sqrt(plane area / area) round each, over the mean one
    AtlasChart figures;
    bool one_to_one = false;
};

// The chart is connected, of genus 0, and has a loop.
MappedChart mapped_chart(ChartMesh mesh);

}  // namespace octafield::surface::detail
