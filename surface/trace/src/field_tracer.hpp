// Traces single curves of a direction field across the triangles of its surface.
#pragma once

#include <functional>
#include <optional>
#include <unordered_map>

#include "charted_field.hpp"
#include "octafield/surface/streamlines.hpp"

namespace octafield::surface::detail {

struct Place {
    Index triangle;
    Complex at, heading;  // in the triangle's chart; heading unit
};

class FieldTracer {
public:
    // Called for every segment with its ends and triangle; false ends the curve before the segment.
    using Admit = std::function<bool(const Eigen::Vector3d& from, const Eigen::Vector3d& to, Index triangle)>;

    struct Curve {
        std::vector<Eigen::Vector3d> points;
        std::vector<Index> triangles;
        double length = 0;
        StreamlineEnd end = StreamlineEnd::length;
        Index singularity = -1;
    };

    // Fills in the defaults of the options. Keeps references.
    FieldTracer(const ChartedField& field, const FeatureGraph& features, const SurfaceSingularities& singularities,
                const StreamlineOptions& options);

    // From the singular point `origin`, if >= 0, whose surroundings do not end the curve before it has left them.
    Curve trace(const Place& start, Index origin = -1, const Admit& admit = {}) const;

    double max_length() const { return max_length_; }
    bool is_feature(Index edge) const { return is_feature_[edge]; }

private:
    struct Run;

    void find_surroundings(const SurfaceSingularities& singularities);

    const ChartedField& field_;
    const SurfaceSingularities& singularities_;
    double max_length_, singular_radius_, close_radius_, least_headway_;
    bool stop_at_features_;
    std::vector<bool> is_feature_;                                // (E)
    std::unordered_map<Index, std::vector<Index>> surroundings_;  // triangle -> singular points near it
};

}  // namespace octafield::surface::detail
