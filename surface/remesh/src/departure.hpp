// How far a surface that is remeshed and its input are from one another, and where.
#pragma once

#include "close_rounds.hpp"

namespace octafield::surface {

struct Departure {
    double most = 0;  // distance, input unit
    Places places;    // where lengths must become shorter, so that it falls
    // told: the distance that is allowed, 0: any.
    void add(double distance, double told, const auto& vertices) {
        most = std::max(most, distance);
        if (told == 0 || distance <= kNear * told) return;
        for (const Index v : vertices) places.emplace_back(v, shorter(distance / told));
    }

private:
    static constexpr double kNear = 0.75;  // of the distance allowed: where lengths become shorter, when it is exceeded
    static double shorter(double excess) { return std::clamp(std::sqrt(0.8 * kNear / excess), 0.4, 0.95); }
};

// Of the triangles' middles and their sides' from the input.
Departure departure_of_mesh(const Working& work, CloseRounds& rounds, const Background& ground, double told);
// Of the input's vertices, which are the first of the ground's, from the triangles.
Departure departure_of_input(const TriangleMesh& input, const Background& ground, const Working& work, double told);
// The farthest vertex from the input, by nearest points, which have nothing to do with how vertices were placed.
double off_surface(const Working& work, const Background& ground);

}  // namespace octafield::surface
