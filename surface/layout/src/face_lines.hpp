// Faces of a quad mesh between its boundary and features, and what is known of the lines of its base complex in them.
#pragma once

#include "quad_sides.hpp"

namespace octafield::surface::detail {

struct Face {
    struct Corner {
        Index side;   // of the face, that ends there
        int quads;    // of the face, other than 2
        Index loop;   // of `loops`
        Index place;  // in it, of the side
    };
    std::vector<std::vector<Index>> loops;  // sides along its boundary curves; they start at a node if there is one
    std::vector<Corner> corners;            // loop by loop
    std::vector<int> points;                // quads round each irregular vertex inside
    int euler = 0;                          // characteristic
    bool has_headings = false;              // lines keep their way, and it is known between its boundary curves

    bool is_disk() const { return euler == 1 && loops.size() == 1; }
    bool is_annulus() const { return euler == 0 && loops.size() == 2; }
    bool is_ring() const { return is_annulus() && points.empty() && corners.empty(); }
    bool is_grid() const { return is_disk() && points.empty() && count(1) == 4 && corners.size() == 4; }
    bool is_cone() const {
        return is_disk() && points.size() == 1 && count(1) == points[0] && count(1) == static_cast<int>(corners.size());
    }
    bool is_l() const { return is_disk() && points.empty() && count(1) == 5 && count(3) == 1 && corners.size() == 6; }
    int count(int quads) const;
    std::size_t next(std::size_t corner) const;
    std::size_t previous(std::size_t corner) const;
    std::vector<Index> side_after(std::size_t corner) const;  // up to the next one of its loop
};

// Darts are ways along edges: side s along it, 4 Q + s back along a side of the boundary. A node is where edges of
// features do not go on, or a line may start there.
class FaceLines {
public:
    // face_of: of each quad; where they differ there is a feature. sides: kept by reference.
    FaceLines(const QuadSides& sides, const std::vector<Index>& face_of);

    const std::vector<Face>& faces() const { return faces_; }
    Index dart_count() const { return 2 * count_; }
    Index edge_count() const { return static_cast<Index>(edge_on_boundary_.size()); }  // of features, node to node
    Index edge(Index dart) const { return edge_of_[dart]; }
    bool is_boundary(Index edge) const { return edge_on_boundary_[edge]; }
    bool is_line(Index edge) const { return edge_is_line_[edge]; }
    bool is_known(Index dart) const { return known_[dart]; }  // at a node: a line starts or goes on there
    bool starts_at_node(Index side) const { return is_node_[tail(side)]; }
    // Darts into the face from the end of a side of a feature, if that is a node.
    std::vector<Index> spokes(Index side) const;
    int heading(Index dart) const;
    bool has_corners(const std::vector<Index>& loop) const;
    bool has_lines_at_reflex_corners(const Face& face) const;
    int bend_of_hole(const std::vector<Index>& loop) const;  // quads beyond two at its corners; -1: one has less
    double crossed_nodes() const;                            // regular ones: where lines cross 1, where one ends 1 / 2

private:
    Index tail(Index dart) const;
    Index back(Index dart) const;
    Index ahead(Index dart) const;  // opposite to it at its tail, which is regular and inside
    bool is_feature(Index dart) const;
    std::vector<Index> turn(Index side) const;  // darts into the face from its end, then the next side of the feature
    void find_nodes();
    void find_edges();
    void find_known();
    void find_faces();
    void add_loops();
    void find_headings();
    bool are_forced(const Face& face) const;

    const QuadSides& sides_;
    const Index count_;  // of sides
    const std::vector<Index>& face_of_;
    std::vector<bool> is_node_, on_feature_;  // vertices
    std::vector<Index> edge_of_;              // of each dart; -1: no feature
    std::vector<bool> edge_on_boundary_, edge_is_line_, known_;
    std::vector<Index> part_of_;  // of each quad, its face
    std::vector<int> turn_of_;    // of each quad: the heading of its side 0
    std::vector<bool> turns_;     // of each face: lines come back in other ways
    std::vector<Face> faces_;
};

// Quads of each, ascending.
std::vector<std::vector<Index>> connected_parts(const Quads& quads);

}  // namespace octafield::surface::detail
