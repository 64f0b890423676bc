// Singular points changed until whole numbers fit a T-mesh. Faces that meet along features each have a field of their
// own, and ask for numbers of quads along these that may contradict one another, or a face's own curves may miss one
// another by so little that some strip of quads closes on itself.
#pragma once

#include "octafield/surface/layout_curves.hpp"

namespace octafield::surface {

struct PatternChange {
    Index triangle;    // lowest of the face
    bool added;        // a pair of points of valence 3 and 5; else a point was moved
    Points positions;  // (1, 3) or (2, 3): where they are now
};

struct FittedPattern {
    SingularPattern pattern;             // points of each face in turn
    std::vector<PatternChange> changes;  // in their order
    double before = 0, left = 0;  // sum of arc_shortages: 0 where whole numbers fit; infinite where the curves of
                                  // a face make no quads
    int tried = 0;                // patterns of a face
};

struct FittingOptions {
    double edge_length = 0;       // of the quads wanted, as in QuantizedQuadsOptions, > 0
    int places = 6;               // tried in a face, all over it
    int more_tried = 4;           // after the first that ends a face's shortage, for less deviation
    int most_tried = 1000;        // patterns, of as many triangles as
    double most_triangles = 6e4;  // in all
};

// domain: connected parts are faces; origins: as QuantizedQuadsOptions has them. The face with the largest part of the
// shortage first: one of its points is moved to one of a few places all over it or, where that does not end its
// shortage, a pair of points of valence 3 and 5 is added there, which frees the numbers along its sides from one
// another. What leaves least missing is kept, and of those that leave nothing, what deviates least from the lengths
// wanted; until nothing is missing, nothing helps, or enough was tried. Corners stay. Always the same result for the
// same input. Throws as impose_singular_points and motorcycle_graph for the pattern that is given.
FittedPattern fitted_pattern(const SurfaceDomain& domain, const SingularPattern& pattern,
                             const std::vector<Index>& origins, const ImposedFieldOptions& imposing = {},
                             const LayoutCurveOptions& curves = {}, const FittingOptions& options = {},
                             const Progress& progress = {});

// The pattern with points moved, face by face, where that makes it admissible there; other faces keep theirs. So that
// one face whose points cannot be moved does not have the field of all others rotated. Progress: phase "move".
// Throws as impose_singular_points for what moving does not mend.
SingularPattern moved_by_faces(const SurfaceDomain& domain, const SingularPattern& pattern,
                               const ImposedFieldOptions& options = {}, const Progress& progress = {});

}  // namespace octafield::surface
