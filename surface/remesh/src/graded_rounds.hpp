// Rounds of remeshing that follow lengths given on a background.
#pragma once

#include <CGAL/AABB_segment_primitive.h>

#include <array>
#include <functional>

#include "background.hpp"
#include "working_surface.hpp"

namespace octafield::surface {

// Split, collapse, flip, relax and project (Botsch, Kobbelt 2004; lengths that vary: Dunyach and others 2013). Steps
// that would turn a triangle over, join feature curves or change the topology are not taken; crossings are not looked
// for.
class GradedRounds {
public:
    explicit GradedRounds(const Background& ground);
    // From the background's triangles. alive: called now and then, may throw.
    void run(Working& work, int rounds, const std::function<void(double)>& alive) const;
    const GroundTrees& trees() const { return trees_; }

private:
    using Flat = CGAL::Simple_cartesian<double>;
    using Segments = std::vector<Flat::Segment_3>;
    using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Flat, CGAL::AABB_segment_primitive<Flat, Segments::const_iterator>>>;

    void place_on_curve(Working& work, Vertex v) const;
    void relax(Working& work, const std::function<void(double)>& alive, double fraction) const;

    const Background& ground_;
    GroundTrees trees_;
    Segments segments_;
    std::unique_ptr<Tree> curves_;
};

}  // namespace octafield::surface
