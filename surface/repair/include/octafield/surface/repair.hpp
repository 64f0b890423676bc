// Repairs in levels: only on request, and each one reported.
#pragma once

#include <string>
#include <vector>

#include "octafield/surface/triangle_mesh.hpp"
#include "octafield/surface/validate.hpp"

namespace octafield::surface {

// Each level does what those before it do, too. Up to `fill` no vertex moves, except into another one by merging.
//   none:    nothing.
//   merge:   coinciding points become one, and points on open edges that are nearer than merge_tolerance.
//   safe:    triangles that repeat a vertex or another triangle, or have no area; dangling triangles; tiny open pieces;
//            points that lie on open edges of others (T-junctions); orientation, alike and outward; holes of at most
//            small_hole_edges edges; unused vertices.
//   fill:    holes of at most max_hole_edges edges: smooth patches of new vertices where these cross nothing.
//   resolve: triangles that cross: closed pieces are united, others are smoothed, or cut out and filled anew.
//   wrap:    what is still unsound is replaced by an alpha wrap (Portaneri et al. 2022), which lies around it and is drawn
//            onto it where that leaves it sound.
enum class RepairLevel { none, merge, safe, fill, resolve, wrap };

// The word of a level, as above. Throws InvalidInput where a word is none of them.
const std::vector<std::string>& repair_level_names();
RepairLevel repair_level(const std::string& name);

struct RepairOptions {
    RepairLevel level = RepairLevel::safe;
    bool closed = true;           // false: rims of an open surface are no holes, and nothing is filled or wrapped
    double merge_tolerance = -1;  // input unit; negative: twice coordinate_precision; 0: equal points only
    int small_hole_edges = 50;    // at level safe
    int max_hole_edges = 0;       // from level fill on; 0: no bound
    double wrap_alpha = 0;        // input unit: gaps narrower than this are bridged; 0: 1/50 of the box's diagonal
    double wrap_offset = 0;       // input unit: how far outside the wrap lies; 0: 1/20 of wrap_alpha
};

struct RepairResult {
    TriangleMesh mesh;
    std::vector<std::string> actions;  // what was done, one sentence each; empty: nothing was needed
    double largest_move = 0;           // input unit: no point of one surface is farther from the other (holes filled
                                       // apart); 0: no vertex moved
};

// A sound mesh comes back as it is, bit by bit. What a level cannot repair is left for validation to name.
// Throws InvalidInput (options).
RepairResult repair(const TriangleMesh& mesh, const RepairOptions& options = {});

// What the first level above `options.level` that makes the mesh sound would do.
struct RepairAdvice {
    std::string level = "none";        // its word; none: no level does
    std::vector<std::string> actions;  // of that level and those before it
    std::vector<Defect> left;          // where there is no such level: of the last level tried
    std::string not_tried;             // why levels were left out; empty: all were tried
};

// Tries the levels above options.level in turn on a copy, and validates after each. resolve and wrap are not tried on
// more than `most_triangles`. mesh: what options.level has made already.
RepairAdvice advise_repair(const TriangleMesh& mesh, const RepairOptions& options = {}, Index most_triangles = 200000);

// The precision that the coordinates themselves show, input unit: spacing of float32 at the largest magnitude where
// all are such numbers; the last decimal there where all have at most 15 significant digits (6 at least are assumed);
// else 8 roundings of doubles. 0 without points.
double coordinate_precision(const Points& points);

}  // namespace octafield::surface
