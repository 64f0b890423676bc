// Widths that streamlines carry, and where streamlines cross.
#pragma once

#include <vector>

#include "charted_field.hpp"
#include "octafield/surface/streamlines.hpp"

namespace octafield::surface::detail {

// (points of the line) by what ln of the width has grown since the first point, by the midpoint rule on each segment.
std::vector<double> width_growth(const ChartedField& field, const Streamline& line);

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
