#include "constraints.hpp"

#include <cmath>
#include <string>
#include <vector>

#include "octafield/frames/quaternion.hpp"
#include "require_frames.hpp"

namespace octafield::volume {
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
        if (!is_known(constraints.kind[v])) bad.push_back(static_cast<Index>(v));
    if (!bad.empty())
        throw InvalidInput("unknown kinds of constraints at " + sites + " " + first_few(bad) + "; there are " +
                               listed_kinds(),
                           "unknown_word", bad);
    for (std::size_t v = 0; v < n; ++v)
        if (info(constraints.kind[v]).takes_axis && !(std::abs(constraints.axis.row(v).norm() - 1) < 1e-6))
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
    for (Index v = 0; v < static_cast<Index>(constraints.kind.size()); ++v) {
        if (constraints.kind[v] == VertexConstraint::free) continue;
        const frames::Quaternion q = frames::from_wxyz(result.row(v));
        ConstraintKinds::visit(constraints.kind[v], constraints.of(v), [&](const auto& kind) {
            result.row(v) = frames::to_wxyz(kind.moved(q)).transpose();
        });
    }
    return result;
}

}  // namespace octafield::volume
