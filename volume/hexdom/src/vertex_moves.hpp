// Better places for one vertex: for the lowest quality round it, and for all of it.
#pragma once

#include "surface_guide.hpp"
#include "vertex_star.hpp"

namespace octafield::volume::detail {

// Where a vertex may go: anywhere, along a patch of the surface, along a curve.
class Slide {
public:
    using Vector = Eigen::Vector3d;
    using Place = SurfaceGuide::Place;
    enum class Along : std::uint8_t { space, patch, curve };

    // `place` is where its piece is nearest; not used in space. A start away from there keeps its distance, until it is
    // brought nearer.
    Slide(const SurfaceGuide* guide, Along along, const Vector& start, const Place& place);

    // The displacement, of the start, nearest to x that is allowed; `place` is filled in.
    Vector allowed(const Vector& x, Place& place) const;
    // Projects vectors on the directions along the piece where it touches at `place`.
    Eigen::Matrix3d tangential(const Place& place) const;
    double distance() const { return away_.norm(); }    // of the start from its piece
    void bring_nearer(double share) { kept_ = share; }  // of the distance that is kept

private:
    const SurfaceGuide* guide_;
    Along along_;
    Vector start_, away_ = Vector::Zero();
    Place place_;
    double kept_ = 1;
};

// A vertex on its way: displacement from its start, and where that is on its piece.
struct Move {
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    SurfaceGuide::Place place;
};

// Raises the lowest quality round the vertex by steps along the shortest vector in the hull of the gradients of the
// lowest corners (Freitag, Ollivier-Gooch 1997). False if it rose by nothing to speak of; what it does never lowers it.
bool raise_lowest(const VertexStar& star, const Slide& slide, Move& move);
// The same of determinants, for vertices with corners that are flat or inverted; the way out of all of them if there is
// one.
bool untangle(const VertexStar& star, const Slide& slide, Move& move);
// One step of Newton's method for the energy; no quality below `floor`, unless it was, is let fall. Barred: that was in
// the way.
enum class Smoothed { moved, rests, barred };
Smoothed smooth(const VertexStar& star, const Slide& slide, Move& move, double floor);
// To the nearest place of its piece, or nearer to it, under the same rule.
bool snap(const VertexStar& star, Slide& slide, Move& move, double floor);

}  // namespace octafield::volume::detail
