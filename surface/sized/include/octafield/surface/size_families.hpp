// The sizes that the two families of streamlines of a cross field leave to its quads, and their least anisotropy (L.
// Simons, UC Davis 2024, chapter 4).
//
// A streamline with unit tangent t carries quads of a width w across it, and
//     d (ln w) / ds = grad alpha . (J t),    J a quarter turn counter-clockwise
// (his (4.3) and (4.4) in one). Each line's width is free up to a factor; where two lines cross, their widths are the
// two sides of a quad there. The factors are those of the least sum over crossings of
//     (sigma / tau + tau / sigma - 2)^(2 k) = (2 sinh(a / 2))^(4 k),    a = ln sigma - ln tau,
// convex in the logarithms of the factors, so that the minimum is global.
#pragma once

#include "octafield/progress.hpp"
#include "octafield/surface/streamlines.hpp"

namespace octafield::surface {

struct SizeFamilyOptions {
    double spacing = 0;          // of lines where they leave the curves they cover, input unit; 0: 1/40 of shape_size
    int power = 1;               // k, 1 to 8: the larger, the more the worst crossings count
    double max_length = 0;       // of a line each way, input unit; 0: 4 times shape_size
    double singular_radius = 0;  // lines that come nearer to a singular point are left out; 0: two mean edge lengths
    int max_iterations = 100;    // of Newton's method
    bool stop_at_features = true;
};

// (n) crossings of two different lines, (L) lines, (V) vertices.
struct SizeFamilies {
    std::vector<Streamline> lines;
    Points positions;                     // (n, 3) of crossings
    std::vector<Index> triangles;         // (n)
    Rows<Index, 2> crossing_lines{0, 2};  // (n, 2) places in `lines`
    Rows<double, 2> log_widths{0, 2};     // (n, 2) ln of the width that each of the two carries there
    double worst_anisotropy = 1;          // longer over shorter side of a quad, of all crossings
    double mean_anisotropy = 1;           // geometric mean
    double objective = 0;                 // the least sum
    int iterations = 0;
    bool converged = true;
    Index self_crossings = 0;  // of a line with itself: their ratio is fixed, they are left out
    Index parts = 0;     // of the crossed lines, connected by crossings: each has a factor of its own, mean ln size 0
    Index left_out = 0;  // lines that came too near to singular points
    // (V) maps: smooth least squares fits to |a| and (ln sigma + ln tau) / 2 at crossings.
    Eigen::VectorXd log_anisotropy, log_sizes;
};

// Lines leave, at right angles and each `spacing`, the separatrices and thinly spread streamlines until every place of
// these is nearer than half of it to a line. Traced as streamlines are. Near n log n in the crossings. Throws
// InvalidInput: kinds "wrong_symmetry" (N is not 4), "bad_option", and what streamlines throws; SolverError; Cancelled.
SizeFamilies size_families(const DirectionField& field, const SurfaceSingularities& singularities,
                           const SizeFamilyOptions& options = {}, const Progress& progress = {});

// The field with every direction turned by `angle` (radians).
DirectionField rotated_field(const DirectionField& field, double angle);

// Where nothing aligns a field its angle is free by a constant, which the streamlines depend on, and the anisotropy.
struct PhaseSearch {
    Eigen::VectorXd angles;                 // (m) radians in [0, pi / 2)
    Eigen::VectorXd worst, mean;            // (m) anisotropies of size_families of the field turned by them
    Index least_worst = 0, least_mean = 0;  // places
};

// `phases` angles at equal distances. Throws as size_families; InvalidInput (kind "bad_option") for fewer than 1.
PhaseSearch phase_search(const DirectionField& field, int phases, const SizeFamilyOptions& options = {},
                         const Progress& progress = {});

}  // namespace octafield::surface
