// What a front of points follows: axes and the lengths of cells along them, at any place of a tet mesh.
#pragma once

#include <vector>

#include "octafield/frames/quaternion.hpp"
#include "octafield/volume/tet_domain.hpp"

namespace octafield::volume {

struct FrontPlace {
    Index tet = -1;                                     // -1: nowhere
    Eigen::Vector4d weights = Eigen::Vector4d::Zero();  // barycentric, sum 1; exactly 0 on triangles, edges, vertices
    Index triangle = -1;                                // of domain.surface(), behind which the tet is; -1: inside
};

struct LocalAxes {
    frames::Matrix3 axes;     // columns, unit
    frames::Vector3 lengths;  // of a cell along each, input unit
    double confidence = 0;    // of InterpolatedFrames
};

// Frames in the tets and what a cell measures along each of their axes.
struct TetAxes {
    Quaternions frames;  // (m, 4)
    Points lengths;      // (m, 3)
};

class FrontField {
public:
    // of_vertices: (n, 4). All three are referred to.
    FrontField(const TetDomain& domain, const Quaternions& of_vertices, const TetAxes& of_tets, int threads);

    frames::Vector3 position(const FrontPlace& place) const;
    // Axes interpolated as by sample_frames, each with the length of the tet's axis nearest to it. Of places that are
    // nowhere: undefined.
    std::vector<LocalAxes> at(const std::vector<FrontPlace>& places) const;

private:
    const TetDomain& domain_;
    const Quaternions& of_vertices_;
    const TetAxes& of_tets_;
    int threads_;
};

}  // namespace octafield::volume
