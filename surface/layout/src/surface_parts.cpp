#include "surface_parts.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <vector>

#include "layout_pieces.hpp"
#include "octafield/disjoint_sets.hpp"

namespace octafield::surface::detail {

using Flat = CGAL::Simple_cartesian<double>;
using Primitive = CGAL::AABB_triangle_primitive<Flat, std::vector<Flat::Triangle_3>::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Flat, Primitive>>;

struct SurfaceParts::Trees {
    const QuadLayout& layout;
    const TriangleMesh& mesh;
    std::vector<Index> part_of{};  // of each vertex
    std::vector<std::vector<Flat::Triangle_3>> triangles{};
    std::vector<std::vector<Index>> numbers{};
    std::vector<Index> place_of{};  // of each triangle among those of its part
    std::vector<std::unique_ptr<Tree>> trees{};
};

SurfaceParts::SurfaceParts(const QuadLayout& layout)
    : trees_(std::make_unique<Trees>(Trees{layout, layout.domain.mesh()})),
      unit_areas_(triangle_areas(layout.domain.mesh()).cwiseQuotient(layout.domain.areas())) {
    const TriangleMesh& mesh = trees_->mesh;
    DisjointSets sets(mesh.vertices.rows());
    for (Index t = 0; t < mesh.triangles.rows(); ++t)
        for (int k = 1; k < 3; ++k) sets.join(mesh.triangles(t, 0), mesh.triangles(t, k));
    Index count = 0;
    trees_->part_of = std::move(sets).numbers(count);
    trees_->triangles.resize(count);
    trees_->numbers.resize(count);
    for (Index t = 0; t < mesh.triangles.rows(); ++t) {
        const auto at = [&](int k) {
            const auto p = mesh.vertices.row(mesh.triangles(t, k));
            return Flat::Point_3(p[0], p[1], p[2]);
        };
        const Index part = trees_->part_of[mesh.triangles(t, 0)];
        trees_->place_of.push_back(static_cast<Index>(trees_->numbers[part].size()));
        trees_->triangles[part].emplace_back(at(0), at(1), at(2));
        trees_->numbers[part].push_back(t);
    }
    for (const auto& triangles : trees_->triangles)
        trees_->trees.push_back(triangles.empty() ? nullptr
                                                  : std::make_unique<Tree>(triangles.begin(), triangles.end()));
}

SurfaceParts::SurfaceParts(SurfaceParts&&) noexcept = default;
SurfaceParts::~SurfaceParts() = default;

Index SurfaceParts::part_of(const LayoutPatch& patch) const {
    const QuadLayout& layout = trees_->layout;
    const TriangleMesh& mesh = trees_->mesh;
    for (const DirectedSide& s : patch.loops[0]) {
        const Index curve = layout.sides[s.side].curve;
        if (curve >= 0) return trees_->part_of[mesh.triangles(layout.curves.curves[curve].triangles[0], 0)];
    }
    for (const CurveNode& node : layout.pieces->chains[patch.loops[0][0].side].nodes)
        if (node.node < mesh.vertices.rows()) return trees_->part_of[node.node];
    return 0;
}

std::pair<Eigen::Vector3d, Index> SurfaceParts::nearest(Index part, const Eigen::Vector3d& p, Index near) const {
    const Flat::Point_3 at(p[0], p[1], p[2]);
    const Tree& tree = *trees_->trees[part];
    const auto found = [&] {
        if (near < 0) return tree.closest_point_and_primitive(at);
        const auto triangle = trees_->triangles[part].begin() + trees_->place_of[near];
        return tree.closest_point_and_primitive(at,
                                                {Flat().construct_projected_point_3_object()(*triangle, at), triangle});
    }();
    const auto place = found.second - trees_->triangles[part].begin();
    return {Eigen::Vector3d(found.first.x(), found.first.y(), found.first.z()), trees_->numbers[part][place]};
}

Eigen::Vector3d SurfaceParts::normal(Index triangle) const { return trees_->layout.domain.normals().row(triangle); }

}  // namespace octafield::surface::detail
