// The input surface with edges no longer than the longest that is wanted: where lengths are known.
#pragma once

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <memory>
#include <vector>

#include "octafield/surface/size_field.hpp"

namespace octafield::surface {

struct Background {
    TriangleMesh mesh;  // its first vertices are those of the input
    FeatureGraph features;
    std::vector<Index> pinned;  // vertices that stay where they are, besides the corners
    std::vector<int> patch;     // (F) between features
    int patches = 0;
    Eigen::VectorXd bend;     // (F) the larger principal curvature, its size
    Eigen::VectorXd length;   // (V) bounds of the length so far
    Eigen::VectorXd depth;    // (F) to the surface opposite, inward; 0: not looked at
    double longest = 0, shortest = 0;
};

// Numbers patches as mark() does. options: longest and shortest are those that count.
Background background_of(const TriangleMesh& mesh, const FeatureGraph& features, double longest, double shortest);

// Lowers the lengths.
void bound_by_curvature(Background& ground, double angle);
void bound_by_curves(Background& ground, double angle);
void bound_by_widths(Background& ground);   // walls and gaps; sets depth
void bound_by_strips(Background& ground);   // between feature curves
void limit_growth(Background& ground, double growth);

// Triangles at these lengths, and tets inside a closed surface.
struct Cells {
    double triangles = 0, tets = 0;
    double most() const { return std::max(triangles, tets); }
};
Cells expected_cells(const Background& ground, double volume, double scale);

// Nearest points of a patch and the length there.
class GroundTrees {
public:
    explicit GroundTrees(const Background& ground);
    struct Nearest {
        Eigen::Vector3d point;
        Index triangle;
    };
    Nearest nearest(int patch, const Eigen::Vector3d& point) const;
    double length(const Nearest& found) const;

private:
    using Flat = CGAL::Simple_cartesian<double>;
    using Primitive = CGAL::AABB_triangle_primitive<Flat, std::vector<Flat::Triangle_3>::const_iterator>;
    using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Flat, Primitive>>;
    const Background& ground_;
    std::vector<std::vector<Flat::Triangle_3>> triangles_;
    std::vector<std::vector<Index>> ids_;
    std::vector<std::unique_ptr<Tree>> trees_;
};

}  // namespace octafield::surface
