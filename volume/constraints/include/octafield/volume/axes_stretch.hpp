// Frames whose axes are not at right angles where the shape is not: at a sharp edge, the tangent and the two directions
// across it in its faces.
//
// Axes are the columns of A = S Q, Q the rotation of a frame (orthonormal), S a symmetric positive definite stretch
// that is given per vertex; they are orthonormal in the metric S^-2 (as lines_metric.hpp has it for surfaces). A plane
// with normal n holds two of the axes where Q has an axis along S n, a line with direction t is along one where Q has
// an axis along S^-1 t. So frames are found as ever, with normals and tangents stretched so, and their singular curves,
// matchings and meshability are those of Q. What this is not: the energy that is minimised is that of Q in space, not
// of A in its metric, whose curvature is left out.
#pragma once

#include <numbers>
#include <vector>

#include "octafield/volume/boundary.hpp"

namespace octafield::volume {

using Stretches = Rows<double, 6>;  // xx, yy, zz, yz, xz, xy of a symmetric matrix

struct AxesStretchOptions {
    // How many hexahedra an edge or a corner of a face has: one up to an interior angle of pi - corner_angle, two up to
    // pi + corner_angle, three up to 2 pi - corner_angle, four beyond (as quads of NonOrthogonalFieldOptions). In
    // (0, pi / 2), radians.
    double corner_angle = std::numbers::pi / 4;
    // Where no edge and no corner is off its right angles by more than this (radians), nothing is stretched.
    double least_deviation = 10 * std::numbers::pi / 180;
};

struct AxesStretch {
    Stretches values;             // (n, 6) S at the vertices of the tet mesh
    std::vector<Index> followed;  // vertices on features whose edges and faces give S, ascending
    std::vector<Index> sharp;     // those of them that are off right angles by more than least_deviation
    std::vector<Index> needles;   // on features with an angle of less than a degree: not followed

    frames::Matrix3 at(Index vertex) const;
};

// At a corner of three feature curves, each with one or three hexahedra, whose faces have one or three quads there, the
// axes are the directions of the curves. On a curve with one or three hexahedra they are its tangent and a direction in
// each of both faces, whose angle from the tangent goes linearly by length between the corners at its ends (a right
// angle where these ask for none, and on closed curves). All have length 1 there; log S
// is harmonic between, first on the surface, then in the tets (linear elements). Edges of interfaces between regions
// are not followed. Time like n^(4/3) (conjugate gradients); the same bits on every run. Throws InvalidInput (kind
// "bad_option"), SolverError (kind "conjugate_gradients").
AxesStretch axes_stretch(const TetDomain& domain, const AxesStretchOptions& options = {});

// (n, 9) the axes A = S Q, not of unit length: x, y, z of the first, the second and the third. frames: (n, 4) unit
// quaternions w x y z. Throws InvalidInput.
Rows<double, 9> stretched_axes(const Quaternions& frames, const Stretches& stretch);

// boundary_constraints of Q for axes S Q: normals and tangents stretched as above.
BoundaryConstraints boundary_constraints(const TetDomain& domain, const Points& directions, const Stretches& stretch,
                                         const BoundaryOptions& options = {});

// Angle (radians) between each sector normal and the normal of two axes, that pair which is nearest; between each
// feature tangent and the nearest axis. In the order of sector_normals and feature_tangents. Throws InvalidInput.
Eigen::VectorXd alignment_angles(const TetDomain& domain, const Quaternions& frames, const Stretches& stretch);
Eigen::VectorXd feature_alignment_angles(const TetDomain& domain, const Quaternions& frames, const Stretches& stretch);

}  // namespace octafield::volume
