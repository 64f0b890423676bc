// Points that spread along the axes of a field, each apart from all before.
#pragma once

#include <boost/geometry/algorithms/intersects.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <functional>
#include <utility>
#include <vector>

#include "front_field.hpp"
#include "surface_walk.hpp"

namespace octafield::volume {

class PointFront {
public:
    // end_level: called after each generation; may throw.
    PointFront(const FrontField& field, int threads, std::function<void()> end_level);

    const std::vector<FrontPlace>& places() const { return places_; }
    Index count() const { return static_cast<Index>(places_.size()); }

    // Wherever others are.
    void add(const std::vector<FrontPlace>& places);

    // The points `level`, then generation by generation those that they led to, each propose six more, a cell's length
    // along the axes and against them. A step has the direction and length of its middle (midpoint rule), so that it
    // follows the turning of the axes. A proposal with something in its way, or within 0.35 lengths along an axis, is
    // dropped, and so is one nearer than 0.7 lengths to a point that is there, in the maximum norm of its own axes and
    // lengths (Baudouin, Remacle, Marchandise, Henrotte, Geuzaine 2014). The same at any thread count.
    void advance(const TetWalker& walker, std::vector<Index> level);
    void advance(const SurfaceWalker& walker, std::vector<Index> level);

    // Points from `first` on move towards where the neighbours that they have along the axes, a cell's length away but
    // for 0.45, would have them: rows that met are evened out. Of those that come nearer than 0.5 lengths, where axes
    // fit nowhere, the later go.
    void relax(const TetWalker& walker, Index first);
    void relax(const SurfaceWalker& walker, Index first);

private:
    struct Neighbour {
        Index point;
        int way;  // axis, +3: against it
    };
    std::vector<Neighbour> neighbours(Index point) const;
    frames::Vector3 pull(Index point, const std::vector<Neighbour>& neighbours) const;
    template <class Walker>
    void even_out(const Walker& walker, Index first);
    template <class Walker>
    void spread(const Walker& walker, std::vector<Index> level);
    template <class Walker>
    std::vector<FrontPlace> proposals(const Walker& walker, const std::vector<Index>& level) const;
    template <class Walker>
    bool clear(const Walker& walker, const FrontPlace& place, const LocalAxes& axes) const;
    bool near(const frames::Vector3& at, const LocalAxes& axes, double distance) const;  // in lengths
    void drop_crowded(Index first);
    void add(const FrontPlace& place, const frames::Vector3& at, const LocalAxes& axes);

    using Point = boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;
    using Tree = boost::geometry::index::rtree<std::pair<Point, Index>, boost::geometry::index::quadratic<16>>;

    const FrontField& field_;
    int threads_;
    std::function<void()> end_level_;
    std::vector<FrontPlace> places_;
    std::vector<LocalAxes> axes_;
    std::vector<frames::Vector3> at_;
    Tree tree_;
};

}  // namespace octafield::volume
