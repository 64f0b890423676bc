// A cross field that quads are drawn to.
#pragma once

#include "octafield/surface/surface_domain.hpp"

namespace octafield::surface::detail {

// values: as of DirectionField (symmetry 4) on the domain, (E); empty: there is none. Both are kept by reference.
// Directions are those in space, also where the domain has own lengths.
class FollowedField {
public:
    FollowedField() = default;
    FollowedField(const SurfaceDomain& domain, const Eigen::VectorXcd& values)
        : domain_(&domain), values_(values.size() > 0 ? &values : nullptr) {}
    explicit operator bool() const { return values_; }

    // One of the four at a place of the triangle, linear in fourth powers from the middles of the sides: of length 1,
    // in the triangle's plane; 0 where they cancel, as at a singular point.
    Eigen::Vector3d direction(Index triangle, const Eigen::Vector3d& place) const;

private:
    const SurfaceDomain* domain_ = nullptr;
    const Eigen::VectorXcd* values_ = nullptr;
};

}  // namespace octafield::surface::detail
