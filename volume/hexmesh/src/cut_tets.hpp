// Tets with parameters that can be cut along walls: neighbours, transitions, triangles that are walls.
#pragma once

#include <array>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "block_arcs.hpp"
#include "map_transitions.hpp"

namespace octafield::volume::detail {

struct CutTet {
    Index root;  // the tet of the given mesh that it is part of
    std::array<Index, 4> vertices;
    std::array<Eigen::Vector3d, 4> at;  // parameters of the corners
    std::array<Index, 4> next;          // tet across the triangle opposite a corner; -1: the boundary
    std::array<Index, 4> over;          // transition into that tet's parameters; -1: the same parameters
    std::array<Index, 4> wall;          // number of the wall there; -1: none
    int corner(Index vertex) const {
        for (int k = 0; k < 3; ++k)
            if (vertices[k] == vertex) return k;
        return 3;
    }
};

// A triangle of a wall with the segment that its wall started from, in the parameters of `tet`.
struct WallTriangle {
    Index tet;
    int face;  // opposite this corner of the tet
    int axis;  // constant parameter
    std::array<Eigen::Vector3d, 2> source;
    bool kept = true;
};

// A tet at an edge, between the triangles of the edge with `from` and `to`.
struct Wedge {
    Index tet, from, to;
};

struct EdgeRing {
    std::vector<Wedge> wedges;  // each begins where the one before ends
    bool closed;                // no boundary triangle at the edge
};

class CutTets {
public:
    // `map` has to be seamless.
    explicit CutTets(const SeamlessMap& map);

    const CutTet& tet(Index t) const { return tets_[t]; }
    Index tet_count() const { return static_cast<Index>(tets_.size()); }
    Index vertex_count() const { return static_cast<Index>(points_.size()); }
    const std::vector<WallTriangle>& walls() const { return walls_; }
    const std::set<EdgeKey>& features() const { return features_; }
    double tolerance() const { return tolerance_; }  // of parameters: nearer than this is the same

    Index tet_at(Index vertex) const { return vertex_tet_[vertex]; }
    Index tet_at(const EdgeKey& edge) const;  // -1: there is no such edge
    EdgeRing ring(const EdgeKey& edge) const;
    EdgeRing ring(const EdgeKey& edge, Index tet) const;
    // Vertices of the triangle opposite a corner.
    std::array<Index, 3> triangle(Index tet, int face) const;
    const Transition& over(Index tet, int face) const { return transitions_[tets_[tet].over[face] + 1]; }
    // Corner of the neighbour across a face that lies opposite it.
    int back(Index tet, int face) const;

    // Cuts the tets at an edge where `share` of its way from its first to its second vertex is gone. The new vertex.
    Index split(const EdgeKey& edge, double share);
    // Moves a vertex so that its parameter `axis`, as the tet has it, is `value`. False, and nothing is done, where it
    // lies on the boundary or an irregular edge, would leave a wall, or where a tet would lose most of its volume.
    bool slide(Index tet, Index vertex, int axis, double value);
    // Makes a triangle a wall; source and axis in the tet's parameters. Its number.
    Index add_wall(Index tet, int face, int axis, const std::array<Eigen::Vector3d, 2>& source);
    void remove_wall(Index wall);

    // Sides of walls that are new since the last call, also because an edge was split.
    struct WallEdge {
        Index wall;
        EdgeKey edge;
    };
    std::vector<WallEdge> take_new_edges() { return std::exchange(new_edges_, {}); }
    // Edges that splits made of edges of this set, which is kept up to date.
    std::set<EdgeKey> irregular;
    std::vector<EdgeKey> take_new_irregular() { return std::exchange(new_irregular_, {}); }

    SeamlessMap map(const std::vector<Index>& corners) const;

private:
    void link(const SeamlessMap& map);
    Index split_wall(Index wall, Index end, Index middle, Index other, Index tet, int face);

    std::vector<CutTet> tets_;
    std::vector<Eigen::Vector3d> points_;
    std::vector<Index> vertex_tet_;
    std::vector<Transition> transitions_{Transition{}};  // the first: none
    std::vector<WallTriangle> walls_;
    std::set<EdgeKey> features_;
    std::vector<WallEdge> new_edges_;
    std::vector<EdgeKey> new_irregular_;
    double tolerance_ = 0;
};

}  // namespace octafield::volume::detail
