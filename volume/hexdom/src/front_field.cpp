#include "front_field.hpp"

#include "octafield/parallel.hpp"
#include "octafield/volume/sample_frames.hpp"

namespace octafield::volume {

using frames::Matrix3;
using frames::Vector3;

FrontField::FrontField(const TetDomain& domain, const Quaternions& of_vertices, const TetAxes& of_tets, int threads)
    : domain_(domain), of_vertices_(of_vertices), of_tets_(of_tets), threads_(threads) {}

Vector3 FrontField::position(const FrontPlace& place) const {
    Vector3 at = Vector3::Zero();
    for (int k = 0; k < 4; ++k)
        at += place.weights[k] * domain_.mesh().vertices.row(domain_.mesh().tets(place.tet, k)).transpose();
    return at;
}

std::vector<LocalAxes> FrontField::at(const std::vector<FrontPlace>& places) const {
    const auto count = static_cast<std::int64_t>(places.size());
    LocatedPoints located{std::vector<Index>(count), Rows<double, 4>(count, 4)};
    for (std::int64_t i = 0; i < count; ++i) {
        located.tet[i] = places[i].tet;
        located.weights.row(i) = places[i].weights.transpose();
    }
    const InterpolatedFrames found = interpolate_frames(domain_, of_vertices_, located, threads_);
    std::vector<LocalAxes> result(count);
    parallel_for(count, threads_, [&](std::int64_t i) {
        if (located.tet[i] < 0) return;
        result[i].confidence = found.confidence[i];
        result[i].axes = frames::from_wxyz(found.frames.row(i)).toRotationMatrix();
        const Matrix3 of_tet = frames::from_wxyz(of_tets_.frames.row(located.tet[i])).toRotationMatrix();
        for (int a = 0; a < 3; ++a) {
            Eigen::Index nearest;
            (of_tet.transpose() * result[i].axes.col(a)).cwiseAbs().maxCoeff(&nearest);
            result[i].lengths[a] = of_tets_.lengths(located.tet[i], nearest);
        }
    });
    return result;
}

}  // namespace octafield::volume
