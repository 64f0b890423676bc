// Counts hexahedra and quadrilaterals of a hex mesh by the quarter turns that a frame field leaves of an angle.
#pragma once

#include <map>
#include <optional>
#include <utility>
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
    // Hexahedra in the wedge by the frame of v, one of its ends; carried through the link and back where asked.
    int hexahedra(const Wedge& wedge, Index v, double angle, bool round_the_link) const;
    frames::Vector3 p(Index v) const { return mesh_.vertices.row(v).transpose(); }

    const TetMesh& mesh_;
    const VertexAxes axes_;
};

// The same by frames in the tets, carried from one to the next through the wedges between.
class TetTurnCounter {
public:
    // wedges: at all edges of the surface.
    TetTurnCounter(const TetMesh& mesh, const Quaternions& of_tets, const std::vector<Wedge>& wedges);

    FeatureWedge judge(const Wedge& wedge) const;

    // Hexahedra at an edge of the surface that is no feature; 2: it is not singular.
    int hexahedra(const Wedge& wedge) const;

    // As of TurnCounter; nothing also where an edge of the fan has several wedges.
    std::optional<int> quadrilaterals(Index v, const std::vector<Index>& link) const;

private:
    const Wedge* wedge_at(Index v, Index w) const;
    frames::Vector3 p(Index v) const { return mesh_.vertices.row(v).transpose(); }

    const TetMesh& mesh_;
    const VertexAxes axes_;  // of the tets
    std::map<std::pair<Index, Index>, const Wedge*> by_edge_;  // null: several
};

}  // namespace octafield::volume
