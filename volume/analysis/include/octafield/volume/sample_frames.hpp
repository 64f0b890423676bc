// A frame field at any point of its tet mesh.
#pragma once

#include <vector>

#include "octafield/volume/locate_points.hpp"
#include "octafield/volume/tet_domain.hpp"

namespace octafield::volume {

struct SampledFrames {
    // (k, 4) unit quaternions w x y z; NaN outside. Of the 24 representatives the nearest to the frame of the tet's
    // vertex of largest weight, so that labels of axes go on as they do at the vertices.
    Quaternions frames;
    // (k) norm of the interpolated sh4 vector: 1 where the tet's frames are equal, lower the more they differ, near 0
    // at singular curves, where the frame means little; 0 outside.
    std::vector<double> confidence;
    std::vector<Index> tet;        // (k); -1: outside
    std::vector<double> distance;  // (k) input unit: from the point to the mesh; infinity: outside
};

struct SampleOptions {
    // A point outside, but no farther from the mesh, has the frame of the nearest point of the mesh. Input unit;
    // infinity: every point. Below 0: a millionth of the bounding-box diagonal.
    double tolerance = -1;
    int threads = 0;  // 0: all; the result does not depend on it
};

// Linear interpolation of the sh4 vectors in the tet that holds the point, projected to the nearest frame: second order
// in the mesh width where the field is smooth, whatever the labels of the axes. frames: (n, 4) unit quaternions w x y z
// at the vertices. Throws InvalidInput (points that are not finite, a tolerance that is NaN), GeometryError.
SampledFrames sample_frames(const TetDomain& domain, const Quaternions& frames, const Points& points,
                            const SampleOptions& options = {});

// The same where it is known already which tets hold the points; frames of rows with tet -1 are NaN, their confidence
// 0.
struct InterpolatedFrames {
    Quaternions frames;              // (k, 4) as in SampledFrames
    std::vector<double> confidence;  // (k) as there
};
InterpolatedFrames interpolate_frames(const TetDomain& domain, const Quaternions& frames, const LocatedPoints& at,
                                      int threads = 0);

}  // namespace octafield::volume
