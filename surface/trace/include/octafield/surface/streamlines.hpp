// Curves along an N-direction field on its surface: from given seeds, from singular points (separatrices), or evenly
// spread, for pictures and for quad layouts.
//
// Traced in the field's own interpolant (linear in each triangle, Crouzeix-Raviart) by the midpoint rule, one step per
// triangle where the direction turns little, more near singular points; second order in the mesh width. At an edge,
// where the interpolant jumps a little, the triangle ahead decides; if both triangles lead to the edge, the curve runs
// along it until one of them leads away. Curves keep 1e-6 of an edge length away from vertices, so none is ever hit.
#pragma once

#include <vector>

#include "octafield/progress.hpp"
#include "octafield/surface/surface_singularities.hpp"

namespace octafield::surface {

enum class StreamlineEnd {
    singularity,  // within singular_radius of a singular point, or started there
    boundary,     // edge of the mesh
    feature,      // feature edge (stop_at_features)
    closed,       // came back to its first point: first and last point are the same
    length,       // max_length reached
    near_line,    // too near to another curve of the same direction (even_streamlines only)
    seed,         // the seed itself (both_ways = false)
    stuck,        // made no headway; the points up to here are good
};

struct Streamline {
    Points points;                 // (n, 3), n >= 1
    std::vector<Index> triangles;  // (n - 1): segment i, from point i to point i + 1, lies in triangles[i]
    double length = 0;             // input unit
    StreamlineEnd first_end = StreamlineEnd::seed, last_end = StreamlineEnd::length;
    Index first_singularity = -1, last_singularity = -1;  // places in SurfaceSingularities::points, -1: none
};

struct StreamlineOptions {
    double max_length = 0;         // input unit, from the seed each way; 0: 4 times the size (shape_size)
    bool both_ways = true;         // against the direction as well; separatrices run one way only
    bool stop_at_features = true;  // of the field's domain
    double singular_radius = 0;    // input unit; 0: half the mean edge length
};

struct StreamlineSeed {
    Index triangle;
    Eigen::Vector3d direction;  // of the N directions at the seed the one nearest to it; need not be unit
    Eigen::Vector3d weights = Eigen::Vector3d::Constant(1.0 / 3);  // barycentric, >= 0, sum 1
};

// One curve per seed. Throws InvalidInput for a seed outside the mesh or without a direction in its triangle's plane
// (elements: places of the seeds), for values or singular points of another mesh, and for options that are no lengths.
std::vector<Streamline> streamlines(const DirectionField& field, const SurfaceSingularities& singularities,
                                    const std::vector<StreamlineSeed>& seeds, const StreamlineOptions& options = {});

// From every singular point of index k/N inside the surface (in a triangle or at a vertex) one curve for each of the
// N - k directions that run straight away from it (none for k >= N): 3 for index +1/4, 5 for -1/4 when N = 4. In a
// triangle they are the solutions of arg f(phi) = N phi (mod 2 pi) on a small circle; at a vertex phi goes round its
// fan, and directions along a feature edge, within 0.05 radians, are left out: the feature is that separatrix. From a
// boundary point, the directions strictly between its two boundary edges: N/2 - k - 1 for even N. Points in the order
// of `singularities`, each one's curves counter-clockwise. With odd N, curves that arrive at a point are not traced
// back.
std::vector<Streamline> separatrices(const DirectionField& field, const SurfaceSingularities& singularities,
                                     const StreamlineOptions& options = {}, const Progress& progress = {});

struct EvenStreamlineOptions {
    // Between neighbouring curves of the same direction, input unit; 0: 1/60 of the size (shape_size).
    double spacing = 0;
    // A curve stops nearer to another one than this part of the spacing, in (0, 1] (Jobard and Lefer 1997: d_test).
    double stop_ratio = 0.5;
    double min_length = 0;  // shorter curves are dropped, unless closed; input unit; 0: the spacing
    StreamlineOptions tracing = {};
};

// Curves that cover the surface at an even distance, one family per direction (2 for N = 4), each curve seeded where
// its family has none yet (after Jobard and Lefer 1997). Throws InvalidInput, and Cancelled through progress.
std::vector<Streamline> even_streamlines(const DirectionField& field, const SurfaceSingularities& singularities,
                                         const EvenStreamlineOptions& options = {}, const Progress& progress = {});

}  // namespace octafield::surface
