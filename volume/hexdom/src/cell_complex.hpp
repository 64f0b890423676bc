// Cells that come and go, found by their vertices: the mesh while it is changed in places.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "cell_shapes.hpp"

namespace octafield::volume::detail {

// A face by its vertices in outward order, the lowest first; the last of a triangle's is -1.
struct FaceCycle {
    std::array<Index, 4> ids;
    int corners() const { return ids[3] < 0 ? 3 : 4; }
    bool operator==(const FaceCycle&) const = default;
};

FaceCycle face_cycle(std::array<Index, 4> ids);
inline FaceCycle triangle_cycle(Index a, Index b, Index c) { return face_cycle({a, b, c, -1}); }
FaceCycle opposite(const FaceCycle& face);  // as the cell across has it

class CellComplex {
public:
    // Numbers of `mesh`'s cells and vertices stay. Ids have to be in range.
    explicit CellComplex(const MixedMesh& mesh);

    Index cell_count() const { return static_cast<Index>(cells_.size()); }  // with those removed
    bool alive(Index cell) const { return cells_[cell].shape != nullptr; }
    const CellShape& shape(Index cell) const { return *cells_[cell].shape; }
    const std::array<Index, 8>& ids(Index cell) const { return cells_[cell].ids; }
    Eigen::Vector3d point(Index vertex) const { return points_[vertex]; }
    const std::vector<Index>& cells_at(Index vertex) const { return cells_at_[vertex]; }

    FaceCycle face(Index cell, const CellFace& local) const;
    Index cell_with(const FaceCycle& face) const;  // that has this outward face; -1: none
    Index cell_across(const FaceCycle& face) const { return cell_with(opposite(face)); }

    // Triangles that cells made anew do not reach through.
    void set_walls(const Triangles& walls);
    bool wall(const FaceCycle& face) const;

    Index add(const CellShape& shape, std::span<const Index> ids);
    Index add_vertex(const Eigen::Vector3d& point);
    void remove(Index cell);
    void move(Index vertex, const Eigen::Vector3d& point) { points_[vertex] = point; }
    Index vertex_count() const { return static_cast<Index>(points_.size()); }

    // Of each kind the cells in the order of their numbers. Vertices from number `first_new` on that no cell uses are
    // left out.
    MixedMesh mesh(Index first_new) const;

private:
    struct LiveCell {
        const CellShape* shape;  // null: removed
        std::array<Index, 8> ids;
    };
    std::vector<std::array<Index, 3>> walls_;  // sorted
    std::vector<Eigen::Vector3d> points_;
    std::vector<LiveCell> cells_;
    std::vector<std::vector<Index>> cells_at_;  // (vertices)
};

}  // namespace octafield::volume::detail
