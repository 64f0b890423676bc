// Curves along the axes of a frame field inside its tet mesh.
//
// A curve follows one axis. In each tet the axes of the four vertices that continue it, by the matchings of
// singular_graph, are interpolated linearly; across a face this interpolant is continuous. Where the matchings of a
// tet do not agree on the axis, a singular curve that turns this axis runs through it, and the curve ends at the face
// before: within a tet of the singular curve. So the labels of the axes at the vertices (write_vtk.hpp) do not matter,
// which the stream tracers of VTK and ParaView depend on. Axes along a singular curve are not turned, and are followed
// in its tets. Inside a tet the interpolant's curve is taken exactly up to the fourth order of its turn there; as a
// whole, curves are second order in the mesh width.
#pragma once

#include <vector>

#include "octafield/volume/axes_stretch.hpp"

namespace octafield::volume {

enum class FrameStreamlineEnd {
    boundary,  // left the mesh
    singular,  // the tet ahead (or that of the seed) is singular for this axis
    closed,    // came back to its first point: first and last point are the same
    length,    // max_length reached
    seed,      // the seed itself (both_ways = false)
    stuck,     // made no headway; the points up to here are good
};

struct FrameStreamline {
    Points points;            // (n, 3), n >= 1
    std::vector<Index> tets;  // (n - 1): segment i lies in tets[i], but for 1e-6 of an edge length at its ends
    double length = 0;        // input unit
    FrameStreamlineEnd first_end = FrameStreamlineEnd::seed, last_end = FrameStreamlineEnd::length;
};

struct FrameStreamlineSeed {
    Index tet;
    Eigen::Vector3d direction;  // of the axes (both senses) of the vertex of largest weight the nearest to it
    Eigen::Vector4d weights = Eigen::Vector4d::Constant(0.25);  // barycentric, >= 0, sum 1
};

struct FrameStreamlineOptions {
    double max_length = 0;  // input unit, from the seed each way; 0: 4 times the surface's shape_size
    bool both_ways = true;  // against the direction as well
    // A curve that comes back to its seed so near, in the same direction, is closed. Input unit; 0: a tenth of the
    // longest edge at a vertex of the seed's tet.
    double closing_distance = 0;
};

// One curve per seed. frames: (n, 4) unit quaternions w x y z. stretch: of axes S Q (axes_stretch.hpp), which curves
// follow then, or no rows. The same bits at any thread count. Throws InvalidInput for seeds outside the mesh or without
// a direction (elements: places of the seeds), for options that are no lengths, and GeometryError (unsound mesh).
std::vector<FrameStreamline> frame_streamlines(const TetDomain& domain, const Quaternions& frames,
                                               const std::vector<FrameStreamlineSeed>& seeds,
                                               const FrameStreamlineOptions& options = {}, int threads = 0,
                                               const Stretches& stretch = {});

// Seeds at points, one per row of directions. Throws InvalidInput (kind "outside", elements: the rows) for points
// outside the mesh. Linear in the tets.
std::vector<FrameStreamlineSeed> seeds_at(const TetDomain& domain, const Points& points, const Points& directions);

// Three seeds per point, along the axes of the frame of the nearest vertex of its tet (largest weight), in its order.
std::vector<FrameStreamlineSeed> axis_seeds_at(const TetDomain& domain, const Quaternions& frames, const Points& points,
                                               const Stretches& stretch = {});

}  // namespace octafield::volume
