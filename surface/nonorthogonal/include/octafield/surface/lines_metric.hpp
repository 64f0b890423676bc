// The metric in which the lines of a non-orthogonal field are orthonormal (Panozzo, Puppo, Tarini, Sorkine-Hornung,
// "Frame fields: anisotropic and non-orthogonal cross fields", 2014). What crosses need of a surface, edge lengths and
// angles, its lines need of the surface measured so: imposed fields, layouts and quads on it are anisotropic in space.
#pragma once

#include "octafield/surface/non_orthogonal_field.hpp"

namespace octafield::surface {

struct LinesMetric {
    SurfaceDomain domain;       // the field's surface measured so
    std::vector<Index> damped;  // vertices whose metric was drawn towards that of space, ascending
    double least_part = 1;      // what is left of it at the worst, an exponent in [0, 1]
};

// At a vertex with unit vectors F = (d1, d2) along its lines the metric is g = (F F^T)^-1: both have length 1, with a
// right angle between them. The square of an edge's length is by the mean of g at its ends. So a side that a line
// follows is as long as in space, and a corner that is followed on both sides has a right angle there. Of an orthogonal
// field it is that of space, and the domain is the field's as it is.
//
// Where lines turn so fast, next to singular points, that the sides of a triangle enclose less than half the area that
// it has by any of its corners' metrics, the metrics of its vertices are drawn towards that of space: g^s with s halved
// each time and at last 0, those of vertices inside first. Throws InvalidInput ("wrong_size", "not_finite",
// "bad_quads") where the field does not fit its domain, GeometryError (kind "parallel_lines", elements: vertices) where
// two lines are less than 1e-3 radians apart.
LinesMetric lines_metric(const NonOrthogonalField& field);

}  // namespace octafield::surface
