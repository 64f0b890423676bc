// The axes of a field with one frame per vertex, and how matchings carry them from vertex to vertex.
#pragma once

#include "axis_numbers.hpp"
#include "stretched_directions.hpp"

namespace octafield::volume {

// Axes of a field with one frame per vertex. stretch: none, or of axes S Q; directions are those in space then, and
// matchings those of Q.
class VertexAxes {
public:
    explicit VertexAxes(const Quaternions& frames, const Stretches* stretch = nullptr)
        : frames_(frames), stretch_(stretch) {}

    frames::Quaternion frame(Index v) const { return frames::from_wxyz(frames_.row(v)); }
    frames::Vector3 direction(Index v, int axis) const {
        const frames::Vector3 turned = frame(v) * axis_unit(axis);
        return stretch_ ? (unpacked(stretch_->row(v)) * turned).normalized() : turned;
    }
    int nearest(Index v, const frames::Vector3& direction) const {
        if (stretch_)
            return nearest_axis_number(frame(v).conjugate() * stretched_directions(*stretch_, v).tangent(direction));
        return nearest_axis_number(frame(v).conjugate() * direction);
    }

    // The element o for which q_v o is near q_w. Edges are matched from their lower to their higher vertex, as in
    // singular_graph, so that all agree also in a tie.
    int matching(Index v, Index w) const {
        return v < w ? frames::matching(frame(v), frame(w))
                     : frames::octahedral_inverse(frames::matching(frame(w), frame(v)));
    }
    // The axis of w that continues the axis of v.
    int carried(Index v, Index w, int axis) const {
        return turned_axis(frames::octahedral_inverse(matching(v, w)), axis);
    }

private:
    const Quaternions& frames_;
    const Stretches* stretch_;
};

}  // namespace octafield::volume
