// The steps of remeshing, and when they may be taken: none turns a triangle over, joins feature curves or changes the
// topology (Botsch, Kobbelt 2004; lengths that vary: Dunyach and others 2013).
#pragma once

#include <optional>

#include "working_surface.hpp"

namespace octafield::surface {

constexpr double kLong = 4. / 3, kShort = 4. / 5;  // of the wanted length: edges are split, collapsed

enum Kind { free_vertex, on_curve, fixed_vertex };
Kind kind_of(const Working& work, Vertex v);

struct Shape {
    Eigen::Vector3d normal;  // of twice the area's length
    double quality;          // 1 for equilateral triangles
};
Shape shape_of(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

// By more than 60 degrees.
bool turned(const Eigen::Vector3d& before, const Eigen::Vector3d& after);

// Whether the triangles round a vertex stay as they lie when it moves, other than those at `with`.
bool may_move(const Working& work, Vertex v, const Eigen::Vector3d& to, Vertex with);

// Where the triangles round a free vertex would have it, in its tangent plane.
std::optional<Eigen::Vector3d> centre_of_star(const Working& work, Vertex v);

// Ends of an edge become one: in the middle where both are free, or always at one of them.
enum class Collapse { to_middle, to_end };

// Makes `gone` one with `kept`, at `to`, whatever becomes of the triangles' shapes. False, and nothing is done, where
// the topology or the features would change.
bool join(Working& work, Vertex gone, Vertex kept, const Eigen::Vector3d& to, double length);
// Whether `gone` may go into `kept` as far as features are concerned.
bool may_join(const Working& work, Edge edge, Vertex gone, Vertex kept);

// Collapses edges of less than kShort times their length, the shortest first.
void collapse_short(Working& work, Collapse where);

// Whether an edge has two triangles and neither is a feature nor its flip there already.
bool may_flip(const Working& work, Edge edge);
// The shapes that its triangles have, and would have.
struct Flip {
    Shape left, right, first, second;
    double before() const { return std::min(left.quality, right.quality); }
    double after() const { return std::min(first.quality, second.quality); }
    bool turns() const;  // one of the new is turned from one of the old
};
Flip flip_of(const Working& work, Edge edge);
// Flips edges where numbers of neighbours come nearer to 6, or thin triangles become better.
void flip_better(Working& work);

}  // namespace octafield::surface
