// Nearest points of each connected part of a layout's surface.
#pragma once

#include <memory>
#include <utility>

#include "octafield/surface/quad_layout.hpp"

namespace octafield::surface::detail {

class SurfaceParts {
public:
    explicit SurfaceParts(const QuadLayout& layout);  // kept by reference
    SurfaceParts(SurfaceParts&&) noexcept;
    ~SurfaceParts();

    Index part_of(const LayoutPatch& patch) const;
    // And the triangle that it is in. near: a triangle of the part, the sooner found the nearer it is; -1: none known.
    std::pair<Eigen::Vector3d, Index> nearest(Index part, const Eigen::Vector3d& p, Index near = -1) const;
    Eigen::Vector3d normal(Index triangle) const;
    // In space, of what the domain measures as 1: 1, unless it has own lengths.
    double unit_area(Index triangle) const { return unit_areas_[triangle]; }

private:
    struct Trees;
    std::unique_ptr<Trees> trees_;
    Eigen::VectorXd unit_areas_;
};

}  // namespace octafield::surface::detail
