// One curve along an axis of a frame field, from tet to tet.
#pragma once

#include <optional>

#include "octafield/volume/streamlines.hpp"
#include "octafield/volume/triangle_table.hpp"
#include "vertex_axes.hpp"

namespace octafield::volume {

class FrameTracer {
public:
    FrameTracer(const TetMesh& mesh, const VertexAxes& axes, const TriangleTable& table,
                const FrameStreamlineOptions& options)
        : mesh_(mesh), axes_(axes), table_(table), options_(options) {}

    FrameStreamline trace(const FrameStreamlineSeed& seed) const;

private:
    // Where a curve is: barycentric coordinates in a tet, and the axis of each of its vertices that it follows.
    struct Place {
        Index tet;
        Eigen::Vector4d weights;
        std::array<int, 4> axes;
    };
    // The linear interpolant in a tet.
    struct TetField {
        Eigen::Matrix<double, 3, 4> axes;       // per vertex
        Eigen::Matrix<double, 4, 3> gradients;  // of the barycentric coordinates
        double edge;                            // the longest at corner 0
    };
    struct Way {
        std::vector<Eigen::Vector3d> points;  // after the start
        std::vector<Index> tets;
        double length = 0;
        FrameStreamlineEnd end;
    };

    Index vertex(Index tet, int corner) const { return mesh_.tets(tet, corner); }
    Eigen::Vector3d position(const Place& place) const;
    std::optional<Place> start(const FrameStreamlineSeed& seed) const;
    // Crosses the face opposite `corner`. No place: the boundary, or a tet that is singular for the axis.
    std::optional<Place> cross(const Place& place, int corner, FrameStreamlineEnd& end) const;
    TetField field_in(const Place& place) const;
    int advance(Place& place, const TetField& field) const;
    Way follow(Place place) const;

    const TetMesh& mesh_;
    const VertexAxes axes_;
    const TriangleTable& table_;
    const FrameStreamlineOptions options_;
};

}  // namespace octafield::volume
