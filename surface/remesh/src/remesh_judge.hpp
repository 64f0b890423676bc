// Whether a remeshed surface is still the input's.
#pragma once

#include <optional>
#include <string>

#include "marked_surface.hpp"

namespace octafield::surface {

constexpr double kVolumeTold = 0.01;  // relative change of the volume that a default length may make

// One attempt at remeshing, sound.
struct Attempt {
    RemeshResult result;
    double length = 0, volume_change = 0;             // the latter relative
    Eigen::Vector3d place = Eigen::Vector3d::Zero();  // of the largest deviation
};

// Compares with the input, which must outlive it.
class RemeshJudge {
public:
    RemeshJudge(const TriangleMesh& mesh, const FeatureGraph& features);

    // None where the result is unsound: fault and crossing say why. Patches do not matter.
    std::optional<RemeshResult> sound(Marked& marked);
    // And how far it departs, by patches, which are the input's.
    std::optional<Attempt> judge(Marked& marked, double length);
    double excess_of(const Attempt& attempt) const;  // above 1: the surface is not followed
    std::string departure(const Attempt& attempt) const;
    bool closed() const { return topology_.closed; }
    const Marked& input() const { return input_; }

    std::string fault;
    std::vector<Index> crossing;  // triangles of the last result
    // (V) distances of the input's vertices from the last sound result, over what is told.
    Eigen::VectorXd excess;

private:
    struct Topology {
        int euler = 0;
        Index pieces = 0;
        bool closed = true;
        bool operator==(const Topology&) const = default;
    };
    static Topology topology_of(const TriangleMesh& mesh);
    void measure(const Marked& marked, Attempt& attempt);

    const TriangleMesh& mesh_;
    Topology topology_;
    double told_;
    Marked input_;
};

}  // namespace octafield::surface
