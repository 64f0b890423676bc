// Singular points and corners, and where their separatrices start.
#pragma once

#include <limits>

#include "local_field.hpp"

namespace octafield::surface::detail {

struct LayoutPoint {
    Index vertex;
    int index_times_four;  // t
    int quads;             // that meet there: 4 - t, on the boundary 2 - t
    bool boundary;
    double angle = 0;                 // of the surface there, radians
    double power = 0;                 // p: parameters go as r^p
    std::vector<Index> corners = {};  // counter-clockwise, 3 t + k
    std::vector<double> starts = {};  // of each corner, angle from the first one's first edge
    std::vector<double> slots = {};   // ascending angles of its separatrices
    // End tolerances of its separatrices, in parameters, are no larger.
    double most_tolerance = std::numeric_limits<double>::infinity();
};

struct LayoutPoints {
    std::vector<LayoutPoint> points;  // by vertex
    std::vector<Index> of_vertex;     // (V), -1: none
    bool near = false;  // whether curves see points nearer than three tolerances, if they miss them by next to nothing
};

// Throws InvalidInput (kinds "infinite_corner", "bad_option"), SolverError (kind "unclear_directions").
LayoutPoints layout_points(const ImposedField& field, const LocalField& local,
                           const std::vector<Index>& cut_vertices = {}, bool cuts_inside = false);

}  // namespace octafield::surface::detail
