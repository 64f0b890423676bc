#include "constraints.hpp"

#include <cmath>
#include <string>
#include <vector>

#include "octafield/frames/quaternion.hpp"
#include "require_frames.hpp"

namespace octafield::volume {
namespace {

using frames::Quaternion;
using frames::Vector3;
using frames::Vector4;

// The frame turned by the least rotation that puts its nearest axis on `axis`.
Quaternion aligned_to(const Quaternion& q, const Vector3& axis) {
    const Vector3 local = q.conjugate() * axis;
    int nearest = 0;
    local.cwiseAbs().maxCoeff(&nearest);
    const Vector3 from =
        q * Vector3(local[nearest] < 0 ? Vector3(-Vector3::Unit(nearest)) : Vector3(Vector3::Unit(nearest)));
    return (frames::rotation_between(from, axis) * q).normalized();
}

}  // namespace

void require_fitting(const Sampling& sampling, const BoundaryConstraints& constraints) {
    const std::size_t n = sampling.count();
    const std::string sites = sampling.sites == Sites::vertices ? "vertices" : "tets";
    const auto rows = [](const auto& array) { return static_cast<std::size_t>(array.rows()); };
    for (const std::size_t size :
         {constraints.kind.size(), constraints.on_boundary.size(), rows(constraints.axis), rows(constraints.frames)})
        if (size != n)
            throw InvalidInput("the constraints have " + std::to_string(size) + " entries for " + std::to_string(n) +
                                   " " + sites + "; build them with boundary_constraints for this mesh",
                               "wrong_size");
    for (const Index v : constraints.released_corners)
        if (v < 0 || static_cast<std::size_t>(v) >= n)
            throw InvalidInput("released corner " + std::to_string(v) + " is none of the " + sites,
                               "index_out_of_range", {v});
    require_frames(constraints.frames, sampling.count());
    if (constraints.lengths.rows() != 0 && rows(constraints.lengths) != n)
        throw InvalidInput("the constraints have " + std::to_string(constraints.lengths.rows()) +
                               " rows of lengths for " + std::to_string(n) + " " + sites + "; give one each, or none",
                           "wrong_size");
    if (!(constraints.lengths.array() > 0).all() || !constraints.lengths.allFinite())
        throw InvalidInput("lengths of constraints must be finite and above 0", "bad_length");
    std::vector<Index> bad;
    for (std::size_t v = 0; v < n; ++v)
        if (constraints.kind[v] == VertexConstraint::axis && !(std::abs(constraints.axis.row(v).norm() - 1) < 1e-6))
            bad.push_back(static_cast<Index>(v));
    if (!bad.empty())
        throw InvalidInput("the fixed axes at " + sites + " " + first_few(bad) + " are not unit vectors", "not_unit",
                           bad);
}

void require_fitting(const Sampling& sampling, const BoundaryConstraints& constraints, const Quaternions& start) {
    require_fitting(sampling, constraints);
    require_frames(start, sampling.count());
}

Quaternions constrained_start(const BoundaryConstraints& constraints, const Quaternions& start) {
    Quaternions result = start.rowwise().normalized();
    for (std::size_t v = 0; v < constraints.kind.size(); ++v) {
        if (constraints.kind[v] == VertexConstraint::fixed) result.row(v) = constraints.frames.row(v).normalized();
        if (constraints.kind[v] == VertexConstraint::axis)
            result.row(v) = frames::to_wxyz(aligned_to(frames::from_wxyz(Vector4(result.row(v).transpose())),
                                                       constraints.axis.row(v).transpose()))
                                .transpose();
    }
    return result;
}

}  // namespace octafield::volume
