#include "field_projector.hpp"

#include <algorithm>

#include "octafield/frames/sh4_projection.hpp"

namespace octafield::volume {

using frames::Sh4;
using frames::Vector4;

FieldProjector::FieldProjector(const ConstraintSpaces& spaces, int threads) : spaces_(spaces), threads_(threads) {
    for (Index v = 0; v < spaces.given().rows(); ++v)
        if (!spaces.is_held(v)) moving_.push_back(v);
}

template <class Row>
void FieldProjector::project_list(const std::vector<Index>& sites, const Row& row, const Sh4Field& before,
                                  Sh4Field& field, Quaternions& frames) const {
    constexpr std::size_t together = 256;
    const std::size_t blocks = (sites.size() + together - 1) / together;
    parallel_for(
        static_cast<std::int64_t>(blocks), threads_,
        [&](std::int64_t block) {
            std::vector<Index> free;
            std::vector<double> values;
            const std::size_t end = std::min<std::size_t>((block + 1) * together, sites.size());
            for (std::size_t k = block * together; k < end; ++k) {
                const Index v = sites[k];
                const Sh4::Vector wanted = row(k);
                if (spaces_.is_free(v)) {
                    free.push_back(v);
                    values.insert(values.end(), wanted.data(), wanted.data() + Sh4::dimension);
                } else {
                    field.row(v) = spaces_.nearest(v, wanted, before.row(v).transpose()).transpose();
                }
            }
            project_free(free, values, field, frames);
        },
        4);
}

void FieldProjector::project(Sh4Field& field, const Sh4Field& before, Quaternions& frames) const {
    project_list(
        moving_, [&](std::size_t k) -> Sh4::Vector { return field.row(moving_[k]).transpose(); }, before, field,
        frames);
}

void FieldProjector::project_sites(const std::vector<Index>& sites, const Sh4Field& wanted, Sh4Field& field,
                                   Quaternions& frames) const {
    project_list(
        sites, [&](std::size_t k) -> Sh4::Vector { return wanted.row(k).transpose(); }, field, field, frames);
}

void FieldProjector::project_free(const std::vector<Index>& sites, const std::vector<double>& values, Sh4Field& field,
                                  Quaternions& frames) const {
    const auto rows = static_cast<Eigen::Index>(sites.size());
    Quaternions guesses(rows, 4), nearest(rows, 4);
    Eigen::VectorXd distances(rows);
    for (Eigen::Index k = 0; k < rows; ++k) guesses.row(k) = frames.row(sites[k]);
    frames::sh4_project(values.data(), guesses.data(), rows, nearest.data(), distances.data());
    for (Eigen::Index k = 0; k < rows; ++k) {
        const Vector4 q = nearest.row(k).transpose();
        frames.row(sites[k]) = q.transpose();
        field.row(sites[k]) = Sh4::embed(frames::from_wxyz(q)).transpose();
    }
}

void FieldProjector::write_frames(const Sh4Field& field, Quaternions& frames) const {
    parallel_for(field.rows(), threads_, [&](std::int64_t row) {
        const Index v = static_cast<Index>(row);
        if (!spaces_.is_free(v) && !spaces_.is_held(v))
            frames.row(v) = frames::to_wxyz(spaces_.frame(v, field.row(v).transpose())).transpose();
    });
}

}  // namespace octafield::volume
