// The sh4 vectors that boundary constraints leave to a field (constraint_kinds.hpp), site by site.
#pragma once

#include <variant>
#include <vector>

#include "block_laplacian.hpp"
#include "octafield/frames/sh4.hpp"
#include "octafield/volume/boundary.hpp"
#include "sh4_field.hpp"

namespace octafield::volume {

// Of one field: nine unknowns at a free site, the kind's linear space at one held in part, a point at a held one. Sites
// of no tet count as held: no equation tells their frame.
class ConstraintSpaces {
    static constexpr Index free = -1, held = -2;

    template <class Visit>
    auto at(Index site, const Visit& visit) const {
        return std::visit(visit, spaces_[place_[site]]);
    }

public:
    // frames: (n, 4), on the constraints.
    ConstraintSpaces(const BoundaryConstraints& constraints, const Quaternions& frames,
                     const BlockLaplacian& laplacian);

    bool is_free(Index v) const { return place_[v] == free; }
    bool is_held(Index v) const { return place_[v] == held; }
    // The part of a field that the constraints give: centres of the linear spaces, held vectors, 0 at free sites.
    const Sh4Field& given() const { return given_; }
    // The part of v that the unknowns of a site reach (orthogonal projection; linear).
    frames::Sh4::Vector reached(Index site, const frames::Sh4::Vector& v) const {
        if (is_free(site)) return v;
        if (is_held(site)) return frames::Sh4::Vector::Zero();
        return at(site, [&](const auto& space) -> frames::Sh4::Vector { return space.reached(v); });
    }
    // Of sites held in part: the allowed vector nearest to v, `fallback`, an allowed one, where all are; and the frame
    // of an allowed one.
    frames::Sh4::Vector nearest(Index site, const frames::Sh4::Vector& v, const frames::Sh4::Vector& fallback) const {
        return at(site, [&](const auto& space) { return space.nearest(v, fallback); });
    }
    frames::Quaternion frame(Index site, const frames::Sh4::Vector& point) const {
        return at(site, [&](const auto& space) { return space.frame(point); });
    }

private:
    std::vector<Index> place_;  // in spaces_, or one of the above
    std::vector<ConstraintKinds::Space> spaces_;
    Sh4Field given_;
};

}  // namespace octafield::volume
