// The input surface with edges no longer than the longest that is wanted: where lengths are known.
#pragma once

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <memory>
#include <set>
#include <vector>

#include "octafield/surface/size_field.hpp"

namespace octafield::surface {

struct Background {
    TriangleMesh mesh;  // its first vertices are those of the input
    FeatureGraph features;
    std::vector<Index> pinned;  // vertices that stay where they are, besides the corners
    std::vector<int> patch;     // (F) between features
    int patches = 0;
    Eigen::VectorXd bend;    // (F) the larger principal curvature, its size
    Eigen::VectorXd length;  // (V) bounds of the length so far
    Eigen::VectorXd depth;   // (F) to the surface opposite, inward; 0: not looked at
    double longest = 0, shortest = 0;
};

// lengths: (V) wanted ones, none above `longest`; edges longer than these are split. Numbers patches as mark() does.
Background background_of(const TriangleMesh& mesh, const FeatureGraph& features, const Eigen::VectorXd& lengths,
                         double longest, double shortest);

// Lowers the lengths.
void bound_by_curvature(Background& ground, double angle);
// least: strips, and curves between corners, that ask for shorter edges are not looked at, input unit.
double least_length(const Background& ground);  // that is usual
void bound_by_curves(Background& ground, double angle, double least);
void bound_by_widths(Background& ground);                // walls and gaps; sets depth
void bound_by_strips(Background& ground, double least);  // between feature curves
void bound_by_near_features(Background& ground);         // that share a triangle
void limit_growth(Background& ground, double growth);

// A place where lengths must become shorter: a vertex of the background, the factor.
using Places = std::vector<std::pair<Index, double>>;
// Multiplies lengths as far as one edge round each place, and limits growth. False where they are the shortest already.
bool lower(Background& ground, const Places& places);

// Feature curves between corners.
struct Curves {
    std::vector<Index> of_edge;            // (n) curve of each feature edge
    std::vector<std::set<Index>> corners;  // per curve: at its ends
    std::vector<double> length;
    std::vector<std::vector<Index>> edges;  // (V) feature edges at each vertex
    std::vector<bool> is_corner;            // (V)
};
Curves curves_of(const Background& ground);

// The length at a point of a triangle, between those of its corners.
double length_at(const Background& ground, Index triangle, const Eigen::Vector3d& point);

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
    double length(const Nearest& found) const { return length_at(ground_, found.triangle, found.point); }

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
