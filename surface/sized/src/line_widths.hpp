// Widths that streamlines carry, and where streamlines cross.
#pragma once

#include <array>
#include <vector>

#include "charted_field.hpp"
#include "octafield/surface/streamlines.hpp"
#include "vertex_charts.hpp"

namespace octafield::surface::detail {

// grad alpha of a field, at vertices the mean of the triangles round them, linear between: that of single triangles has
// errors of one sign along rows of alike triangles. Near singular points, where it changes within an edge, of each
// triangle alone.
class AngleSlopes {
public:
    // Keeps a reference. Throws GeometryError (kind "non_manifold_vertex") where parts of the surface only touch.
    explicit AngleSlopes(const ChartedField& field);
    const ChartedField& field() const { return field_; }
    // By what the field's angle grows along a step from z in triangle t.
    double along(Index t, Complex z, Complex step) const;

private:
    const ChartedField& field_;
    std::vector<bool> is_smooth_;                  // (F)
    std::vector<std::array<Complex, 3>> corners_;  // (F) in the triangle's chart
};

// (points of the line) by what ln of the width has grown since the first point: the midpoint rule on each segment.
std::vector<double> width_growth(const AngleSlopes& slopes, const Streamline& line);

// A place on segment `segment` of line `line`, `part` of the way along it.
struct LinePlace {
    Index line, segment;
    double part;
};
struct LineCrossing {
    LinePlace one, other;
    Index triangle;
    Complex at;  // in the triangle's chart
};

// Lines by the triangles they pass.
class LineIndex {
public:
    explicit LineIndex(const Charts& charts) : charts_(charts), segments_(charts.mesh().triangles.rows()) {}
    void add(Index number, const Streamline& line);
    // Of a line with those added, at more than a quarter of a right angle; by segment of the line.
    std::vector<LineCrossing> crossings(Index number, const Streamline& line) const;

private:
    struct Segment {
        Index line, segment;
        Complex from, to;
    };
    const Charts& charts_;
    std::vector<std::vector<Segment>> segments_;  // (F)
};

}  // namespace octafield::surface::detail
