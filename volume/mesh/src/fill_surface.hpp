// The ways in which TetGen is asked to fill a surface: where one fails on a rare coincidence of coordinates, another may
// not.
#pragma once

#include <string>
#include <vector>

#include "tetgen_run.hpp"

namespace octafield::volume {

// Why an attempt gave nothing to use: a clause for messages.
struct Failed {
    std::string why;
};

// turned: the surface is turned in space first, so that what is aligned with the axes, coplanar or cocircular in
// TetGen's arithmetic no longer is; the tets are turned back, and the surface's own coordinates put in.
struct Attempt {
    const char* what;  // ends the sentence "it could ..."
    bool turned;
    double tolerance, ratio_factor, volume_factor;
};

// In the order in which they are made; the first is what was asked for.
const std::vector<Attempt>& attempts();

// A sound surface of a size near 1 filled in one way; holes of `asked` are set here. The result keeps the surface
// triangle by triangle, its vertices first and with the same bits. Throws Failed, Cancelled, SolverError.
TetMesh fill_surface(const surface::TriangleMesh& mesh, const TetgenParameters& asked, const Attempt& attempt,
                     const Progress& progress);

}  // namespace octafield::volume
