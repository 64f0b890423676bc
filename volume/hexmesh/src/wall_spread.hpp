// Walls that spread from edges along planes of constant parameters, the nearest to their source first.
#pragma once

#include <cstdint>
#include <optional>
#include <queue>
#include <tuple>

#include "cut_tets.hpp"
#include "octafield/progress.hpp"

namespace octafield::volume::detail {

// Where walls at an edge lie: quarter turns from the first one, or from the boundary.
struct WallsAround {
    struct Place {
        Index wall;   // -1: the boundary
        int quarter;  // 0 to 3; 4 is the far boundary of a slit
    };
    std::vector<Place> places;
    int quarters;  // all round, or from boundary to boundary
    bool closed;
};

// Quarters of turns of the parameters around an edge: 4 inside, 2 on the boundary are regular.
int quarters_around(const CutTets& tets, const EdgeRing& ring, const EdgeKey& edge);
WallsAround walls_around(const CutTets& tets, const EdgeKey& edge, Index tet);

class WallSpread {
public:
    WallSpread(CutTets& tets, Index most_tets, const Progress& progress)
        : tets_(tets), most_tets_(most_tets), progress_(progress) {}

    // Walls in all quarters of the irregular edges, which are the tets' set `irregular`.
    void start_at_edges();
    // Walls in the plane of constant parameter `axis` through a corner of a tet, in that tet; false: the plane only
    // touches it, or is a wall there already.
    bool start_at_corner(Index tet, int corner, int axis);
    // Until every wall ends at the boundary, at an irregular edge, or at a wall that crosses it. Throws SolverError
    // ("endless_walls").
    void spread();

private:
    // A place in a tet next to an edge, with what is known of the wall that comes there, in the tet's parameters.
    struct View {
        Index tet, from;  // a vertex of the tet beside the edge
        int axis;
        std::array<Eigen::Vector3d, 2> source;
        Eigen::Vector3d forward;  // in the plane, away from the wall
    };
    struct Found {
        enum Kind { boundary, triangle, inside } kind;
        View view;
        Index to;      // the tet's other vertex beside the edge
        bool crossed;  // by a wall between
    };
    void start_at_edge(const EdgeKey& edge);
    bool start_in(const EdgeKey& edge, const Wedge& wedge);
    void go_on(Index wall, const EdgeKey& edge);
    // Where the wall goes on over one of its edges; none: it ends there, or is there already.
    std::optional<Found> next(Index wall, const EdgeKey& edge) const;
    void push(Index wall, const EdgeKey& edge);
    Found look(View view, const EdgeKey& edge) const;
    View across(const View& view, int face) const;
    Index make(const Found& found, const EdgeKey& edge);
    double share(const View& view, Index a, Index b) const;
    double height(const View& view, Index vertex) const;
    void queue_new_edges();
    void require_end() const;

    // Distance from the source, then age.
    using Entry = std::tuple<double, std::int64_t, Index, EdgeKey>;
    CutTets& tets_;
    Index most_tets_;
    const Progress& progress_;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
    std::int64_t age_ = 0;
};

}  // namespace octafield::volume::detail
