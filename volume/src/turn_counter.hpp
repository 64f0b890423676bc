// Counts hexahedra and quadrilaterals of a hex mesh by the quarter turns that a frame field leaves of an angle.
#pragma once

#include <optional>
#include <vector>

#include "axis_numbers.hpp"
#include "octafield/volume/boundary_meshability.hpp"
#include "surface_wedges.hpp"

namespace octafield::volume {

class TurnCounter {
public:
    TurnCounter(const TetMesh& mesh, const Quaternions& frames) : mesh_(mesh), axes_(frames) {}

    FeatureWedge judge(const Wedge& wedge) const;

    // Hexahedra at the singular edge on the surface between v and w, where their normals are given; 2: there is none.
    int hexahedra(Index v, Index w, const frames::Vector3& normal_v, const frames::Vector3& normal_w) const;

    // Quadrilaterals in a sector of the surface round v: the fan of triangles (v, link[i], link[i + 1]),
    // counter-clockwise from outside.
    std::optional<int> quadrilaterals(Index v, const std::vector<Index>& link) const;

private:
    double angle(const Wedge& wedge) const;
    // Hexahedra in the wedge by the frame of v, one of its ends; carried through the link and back where asked.
    int hexahedra(const Wedge& wedge, Index v, double angle, bool round_the_link) const;
    frames::Vector3 p(Index v) const { return mesh_.vertices.row(v).transpose(); }

    const TetMesh& mesh_;
    const VertexAxes axes_;
};

}  // namespace octafield::volume
