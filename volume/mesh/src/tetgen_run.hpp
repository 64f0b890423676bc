// One run of TetGen on a closed surface. The only place that knows TetGen's data structures.
#pragma once

#include <string>
#include <vector>

#include "octafield/progress.hpp"
#include "octafield/surface/triangle_mesh.hpp"
#include "octafield/volume/tet_mesh.hpp"

namespace octafield::volume {

struct TetgenParameters {
    bool refine = true;                  // false: only fill the surface, no bounds on shape or size
    double radius_edge_ratio = 0;        // -q
    double min_dihedral = 0;             // -q, degrees; 0: TetGen's default
    double max_volume = 0;               // -a
    double tolerance = 0;                // -T, for coplanarity; 0: TetGen's default
    int most_added = 0;                  // -S, vertices; 0: no bound. Refinement ends there
    int most_seconds = 0;                // of processor time; 0: no bound
    std::vector<Eigen::Vector3d> holes;  // one point in each cavity
    Points inside{0, 3};                 // points to be vertices; those not inside are left out
    bool inside_later = false;  // they are put in by a second run, as the first may crash where it keeps the surface
};

struct TetgenOutcome {
    bool finished = false;
    bool out_of_time = false;
    TetMesh mesh;        // when finished: the surface's vertices first; tets in either orientation
    std::string reason;  // why not, otherwise: a clause for messages ("it stopped at a check of its own")
};

// What TetGen printed before it ended, in words for users: of its texts nothing is passed on, as they hold the names of
// its sources and paths of the machine that compiled it.
std::string tetgen_reason(const std::string& printed);

// TetGen 1.5 of Debian frees its memory twice when it reports an error, and it asserts on its own faults: either ends
// the process. So it runs in a copy of the process. Surface triangles are kept (-Y). Throws Cancelled, SolverError.
TetgenOutcome run_tetgen(const surface::TriangleMesh& mesh, const TetgenParameters& parameters,
                         const Progress& progress);

}  // namespace octafield::volume
