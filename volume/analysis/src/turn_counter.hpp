// Counts hexahedra and quadrilaterals of a hex mesh by the quarter turns that a frame field leaves of an angle.
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "octafield/volume/boundary_meshability.hpp"
#include "surface_wedges.hpp"
#include "vertex_axes.hpp"

namespace octafield::volume {

// Normals of the first and last triangle, out of the wedge, as the frame of a vertex sees them.
std::pair<frames::Vector3, frames::Vector3> outward_normals(const TetMesh& mesh, const Wedge& wedge,
                                                            const StretchedDirections& seen = {});

class TurnCounter {
public:
    // stretch: none, or of axes S Q: then angles and directions at a vertex are counted as Q sees them, after S^-1.
    TurnCounter(const TetMesh& mesh, const Quaternions& frames, const Stretches* stretch = nullptr)
        : mesh_(mesh), axes_(frames), stretch_(stretch) {}

    FeatureWedge judge(const Wedge& wedge) const;

    // Hexahedra at the singular edge on the surface between v and w, where their normals are given; 2: there is none.
    int hexahedra(Index v, Index w, const frames::Vector3& normal_v, const frames::Vector3& normal_w) const;

    // Quadrilaterals in a sector of the surface round v: the fan of triangles (v, link[i], link[i + 1]),
    // counter-clockwise from outside.
    std::optional<int> quadrilaterals(Index v, const std::vector<Index>& link) const;

private:
    // Hexahedra in the wedge by the frame of v, one of its ends; carried through the link and back where asked.
    int hexahedra(const Wedge& wedge, Index v, bool round_the_link) const;
    StretchedDirections seen_from(Index v) const {
        return stretch_ ? stretched_directions(*stretch_, v) : StretchedDirections();
    }
    // The direction from v to w as the frame of w sees it.
    frames::Vector3 seen_way(Index v, Index w) const { return seen_from(w).tangent(p(w) - p(v)); }
    frames::Vector3 p(Index v) const { return mesh_.vertices.row(v).transpose(); }

    const TetMesh& mesh_;
    const VertexAxes axes_;
    const Stretches* stretch_;
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
    const VertexAxes axes_;                                    // of the tets
    std::map<std::pair<Index, Index>, const Wedge*> by_edge_;  // null: several
};

}  // namespace octafield::volume
