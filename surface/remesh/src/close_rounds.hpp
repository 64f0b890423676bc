// Rounds of remeshing whose vertices are on the input at every moment.
#pragma once

#include <functional>

#include "surface_walk.hpp"

namespace octafield::surface {

class CloseRounds {
public:
    explicit CloseRounds(const Background& ground);
    // `work` has the background's triangles.
    void begin(Working& work);
    // Split, collapse, flip, relax; what is on a feature curve moves along it. alive: called now and then, may throw.
    void run(Working& work, int rounds, const std::function<void(double)>& alive);
    // After the background's lengths have changed.
    void take_lengths(Working& work);
    // Where on an edge's patch or curve, or v's, one comes nearest to a target. None where v is fixed.
    std::optional<Place> place_on(const Working& work, Edge edge, const Eigen::Vector3d& target);
    std::optional<Place> place_of(const Working& work, Vertex v, const Eigen::Vector3d& target);
    std::optional<Place> place_near(const Working& work, Face face, const Eigen::Vector3d& target);  // of its patch
    static void put(Working& work, Vertex v, const Place& place);
    // None where triangles would be turned over.
    std::optional<Vertex> split_at(Working& work, Edge edge, const Place& place);
    std::optional<Vertex> split_middle(Working& work, Edge edge);

private:
    void relax(Working& work, const std::function<void(double)>& alive, double fraction);

    const Background& ground_;
    SurfaceWalk walk_;
};

// Along its feature curve, between its two neighbours there, where their lengths would have it.
Eigen::Vector3d centre_on_curve(const Working& work, Vertex v);

}  // namespace octafield::surface
