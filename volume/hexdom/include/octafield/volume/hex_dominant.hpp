// A hex-dominant mesh along a frame field.
#pragma once

#include <string>
#include <vector>

#include "octafield/progress.hpp"
#include "octafield/volume/lattice_cells.hpp"
#include "octafield/volume/mixed_mesh.hpp"
#include "octafield/volume/recombination.hpp"

namespace octafield::volume {

// How the sizes of cells give way to the turning of the field (scaling.hpp), within a factor of two.
enum class SizeCorrection { none, isotropic, axes };

// Where vertices of cells come from: the integers of a periodic map, or a front that goes from the surface inside, a
// size at a time along the axes (Baudouin, Remacle, Marchandise, Henrotte, Geuzaine 2014). best: the map, and where it
// leaves more than 2 % of the volume to other cells than hexahedra, or no mesh, a front as well; of both the mesh with
// more of the volume in hexahedra.
enum class CellPoints { best, periodic, frontal };

struct HexDominantOptions {
    double edge_length = 0;   // wanted, input unit; 0: the mean edge of the surface
    Eigen::VectorXd sizes{};  // (n) wanted at the vertices, in place of edge_length; empty: the same everywhere
    SizeCorrection correction = SizeCorrection::axes;
    CellPoints points = CellPoints::best;
    // Times that tets on which the map is of no use, and those next to them, are cut into eight and the map is made
    // anew, while the mesh stays within most_tets.
    int refinements = 2;
    Index most_tets = 1000000;
    Index most_hexahedra = 5000000;    // an edge length that asks for more is refused
    double min_scaled_jacobian = 0.3;  // of hexahedra of the lattice, and of cells made of tets
    double hold_angle = 0.7;           // of PeriodicMapOptions, radians
    bool recombine = true;             // tets between are joined to hexahedra and wedges
    bool improve = true;               // vertices are moved at the end
    int threads = 0;
};

// Cells at every step.
struct HexDominantCounts {
    Index tets = 0;               // of the mesh that the map is on
    Index inconsistent = 0;       // of them, without coordinates: jumps of edges do not sum to 0
    Index turned_over = 0;        // of them, coordinates turned over or flat
    LostCells lost;               // cells of the lattice that are no hexahedra
    Index lattice_hexahedra = 0;  // taken from the lattice
    Index crossing = 0;           // of these, left out as their faces cross others or are not in the surface
    Index recombined_hexahedra = 0, recombined_wedges = 0;
    ConformReport pyramids;
};

struct HexDominantMesh {
    MixedMesh mesh;
    CellPoints points = CellPoints::periodic;  // what they were made by: periodic or frontal
    std::vector<Index> regions;                // per cell; empty where the domain has none
    std::vector<std::uint8_t> support;  // per vertex: 0 inside, 1 on the surface, 2 on a feature curve, 3 a corner
    HexDominantCounts counts;
};

// frames: (n, 4) unit quaternions w x y z at the vertices of the domain. Faces all match, Jacobians are positive at all
// corners, the surface (and interfaces between regions) are kept up to edge_length's chords, features and corners are
// edges and vertices. Progress names the phases: "sizes", "periodic map", "lattice", "surface", "tetrahedralize",
// "recombine", "conform", "improve". Throws InvalidInput (kinds "wrong_size", "not_unit", "min_scaled_jacobian",
// "hold_angle", "refinements", "edge_length" (not above 0), "too_many_cells"), GeometryError, SolverError
// ("tetgen_time": filling what hexahedra leave takes far too long), Cancelled.
HexDominantMesh hex_dominant(const TetDomain& domain, const Quaternions& frames, const HexDominantOptions& options = {},
                             const Progress& progress = {});

}  // namespace octafield::volume
