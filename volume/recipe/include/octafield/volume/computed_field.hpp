// From a domain to a frame field with its analysis: the functions of this library in the order in which the command
// line and octafield.compute_field in Python call them (docs/frame_fields.md).
//
//     surface::SurfaceDomain sheets = sheet_domain(domain);                    // the surface
//     surface::DirectionField cross = surface::direction_field(sheets, {.seed = seed});
//     BoundaryConstraints held = surface_constraints(domain, cross);           // what it asks of the frames; with
//                                                                              // free axes as axes_stretch has them
//     FrameFieldResult solved = frame_field(domain, held, {.seed = seed});     // the field
//     FieldAnalysis found = analyse_field(domain, comb_vertices(domain, solved.smooth.frames).frames);
#pragma once

#include "octafield/surface/direction_field.hpp"
#include "octafield/volume/analyse_field.hpp"
#include "octafield/volume/axes_stretch.hpp"
#include "octafield/volume/boundary.hpp"
#include "octafield/volume/combing.hpp"
#include "octafield/volume/frame_field.hpp"
#include "octafield/volume/vertex_constraints.hpp"

namespace octafield::volume {

// The surface that a field follows, cut into sheets where it is not manifold (sheets.hpp), with the features on them:
// where the cross field lives. The vertices and triangles of domain.surface() where nothing is cut. Throws
// GeometryError as SurfaceDomain does.
surface::SurfaceDomain sheet_domain(const TetDomain& domain);

// What the surface asks of the frames: boundary_constraints, or with frames in the tets tet_boundary_constraints, with
// the directions of the cross field; at a vertex that sheets share, that of the first. stretch: of frames with axes S Q
// at the vertices (axes_stretch.hpp), or no rows. Throws InvalidInput where the field lives on another surface than
// sheet_domain(domain) (kind "wrong_mesh"), and for a stretch of frames in the tets (kind "wrong_sampling").
BoundaryConstraints surface_constraints(const TetDomain& domain, const surface::DirectionField& cross,
                                        Sites sites = Sites::vertices, const BoundaryOptions& options = {},
                                        const Stretches& stretch = {});

enum class Axes {
    orthogonal,  // at right angles
    free,        // S Q with the stretch of axes_stretch: along both faces of sharp edges
};

struct FieldOptions {
    BoundaryOptions boundary{};
    VertexConstraints given{};  // the user's own, in place of the surface's; of vertices or tets
    // Its seed is that of the cross field, too. Where boundary.mode is none, the cross field is the start whatever
    // solve.start says.
    FrameFieldOptions solve{};
    Axes axes = Axes::orthogonal;  // free: of frames at the vertices without lengths (not odeco_lengths)
    AxesStretchOptions stretch{};  // with free axes
};

struct ComputedField {
    surface::DirectionField cross_field;  // on sheet_domain(domain)
    AxesStretch stretch;                  // with free axes; values has no rows where axes are at right angles
    BoundaryConstraints constraints;
    FrameFieldResult solved;  // frames and lengths as the solver leaves them
    // Those of `solved`, named so that neighbours agree but across a cut: what files hold and is analysed.
    CombedVertices combed;
    FieldAnalysis analysis;
};

// Frames at the vertices. Progress tells the phases of the parts; cancelling throws Cancelled or keeps the best field
// as the parts do. Throws InvalidInput (kind "stretched_axes": free axes with lengths), GeometryError, SolverError.
ComputedField computed_field(const TetDomain& domain, const FieldOptions& options = {}, const Progress& progress = {});

struct ComputedTetField {
    surface::DirectionField cross_field;  // on sheet_domain(domain)
    BoundaryConstraints constraints;      // of tets
    FrameFieldResult solved;              // frames (m, 4)
    CombedVertices combed;                // of analysis.vertex_frames
    TetFieldAnalysis analysis;
};

// The same with frames in the tets, at right angles (InvalidInput, kind "wrong_sampling", for free axes).
ComputedTetField computed_tet_field(const TetDomain& domain, const FieldOptions& options = {},
                                    const Progress& progress = {});

}  // namespace octafield::volume
