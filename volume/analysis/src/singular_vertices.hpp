// Where curves of a singular graph end, and what is the same of frames at vertices and in tets there.
#pragma once

#include <cstdint>
#include <vector>

#include "octafield/frames/quaternion.hpp"
#include "octafield/volume/meshability.hpp"

namespace octafield::volume {

// vertices (without about_normal, one_axis and meshable), curve_ends and closed_curves. on_boundary: per point of the
// graph. A closed curve that passes its first point with one type ends nowhere.
Meshability singular_vertices(const SingularGraph& graph, const std::vector<std::uint8_t>& on_boundary);

// No curve there is complex, or of valence 1 or 2.
inline bool all_curves_meshable(const SingularVertex& v) {
    return v.complex == 0 && v.valence1 == 0 && v.valence2 == 0;
}

// hex_vertex_exists of the curves at it.
bool hex_vertex_exists(const SingularVertex& v);

// Of curves at a node that all turn about one axis: whether every curve that comes along it can go on as one of its
// type. axes: along which each leaves, numbers of axis_numbers.hpp; turns: quarter turns of each.
bool curves_pass(const std::vector<int>& axes, const std::vector<int>& turns);

// Direction of a smoothed curve at one end, over three of its segments, but not beyond its middle.
frames::Vector3 end_direction(const Points& smoothed, const std::vector<Index>& curve, bool backwards);

double angle_between(const frames::Vector3& a, const frames::Vector3& b);

// Once the vertices are judged: the junctions, then the counts.
void find_junctions(const SingularGraph& graph, Meshability& result);
void add_totals(const SingularGraph& graph, Meshability& result);

}  // namespace octafield::volume
