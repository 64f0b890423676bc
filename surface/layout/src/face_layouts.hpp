// Faces of a surface, which are its connected parts, with a T-mesh each.
#pragma once

#include <optional>

#include "octafield/surface/quad_layout.hpp"

namespace octafield::surface::detail {

struct Face {
    SurfaceDomain domain;
    std::vector<Index> triangles, vertices;  // of the whole surface, ascending
    std::vector<Index> origins;
    SingularPattern pattern;           // on the face
    std::optional<QuadLayout> layout;  // none where its curves make no quads
};

struct FaceTracing {
    ImposedFieldOptions imposing;
    LayoutCurveOptions curves;
};

// By lowest triangle, layouts empty, measured as the domain is. origins: of each vertex of the domain.
std::vector<Face> faces_of(const SurfaceDomain& domain, const SingularPattern& pattern,
                           const std::vector<Index>& origins);

// The T-mesh; points come to where they were moved. Throws as impose_singular_points and motorcycle_graph, and as
// layout_quads where a patch is no quad.
QuadLayout traced(const Face& face, SingularPattern& pattern, const FaceTracing& tracing, const Progress& progress);

struct Fit {
    std::vector<double> shortages;  // arc_shortages, of each side of the layouts in turn
    double missing = 0;             // their sum
    double deviation = 0;           // least_deviation at the size, where nothing is missing
};

// Of the faces with a layout. `other` takes the place of one face's.
Fit fit_of(const std::vector<Face>& faces, double size, const QuadLayout* other = nullptr, std::size_t place = 0);

}  // namespace octafield::surface::detail
