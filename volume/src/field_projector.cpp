#include "field_projector.hpp"

#include <algorithm>

#include "octafield/frames/sh4_projection.hpp"

namespace octafield::volume {

using frames::Sh4;
using frames::Vector4;

FieldProjector::FieldProjector(const ConstraintSpaces& spaces, int threads) : spaces_(spaces), threads_(threads) {
    for (Index v = 0; v < spaces.given().rows(); ++v)
        if (spaces.kind(v) == VertexConstraint::free) free_.push_back(v);
}

void FieldProjector::project(Sh4Field& field, const Sh4Field& before, Quaternions& frames) const {
    const std::size_t blocks = (free_.size() + sum_block - 1) / sum_block;
    parallel_for(
        static_cast<std::int64_t>(blocks), threads_,
        [&](std::int64_t k) {
            project_block(k * sum_block, std::min<std::size_t>((k + 1) * sum_block, free_.size()), field, frames);
        },
        1);
    parallel_for(field.rows(), threads_, [&](std::int64_t row) {
        const Index v = static_cast<Index>(row);
        if (spaces_.kind(v) == VertexConstraint::axis)
            field.row(v) = spaces_.circle(v).nearest(field.row(v).transpose(), before.row(v).transpose()).transpose();
    });
}

void FieldProjector::project_block(std::size_t first, std::size_t last, Sh4Field& field, Quaternions& frames) const {
    const auto rows = static_cast<Eigen::Index>(last - first);
    Sh4Field values(rows, Sh4::dimension);
    Quaternions guesses(rows, 4), nearest(rows, 4);
    Eigen::VectorXd distances(rows);
    for (Eigen::Index k = 0; k < rows; ++k) {
        values.row(k) = field.row(free_[first + k]);
        guesses.row(k) = frames.row(free_[first + k]);
    }
    frames::sh4_project(values.data(), guesses.data(), rows, nearest.data(), distances.data());
    for (Eigen::Index k = 0; k < rows; ++k) {
        const Vector4 q = nearest.row(k).transpose();
        frames.row(free_[first + k]) = q.transpose();
        field.row(free_[first + k]) = Sh4::embed(frames::from_wxyz(q)).transpose();
    }
}

void FieldProjector::twist(const Sh4Field& field, Quaternions& frames) const {
    parallel_for(field.rows(), threads_, [&](std::int64_t row) {
        const Index v = static_cast<Index>(row);
        if (spaces_.kind(v) == VertexConstraint::axis)
            frames.row(v) = frames::to_wxyz(spaces_.circle(v).frame(field.row(v).transpose())).transpose();
    });
}

}  // namespace octafield::volume
