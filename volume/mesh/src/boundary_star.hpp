// What surrounds a boundary vertex: its feature edges and its smooth sectors.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "octafield/surface/features.hpp"
#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::volume {

class BoundaryStars {
public:
    // Throws InvalidInput where triangles or features refer to vertices that do not exist.
    BoundaryStars(const surface::TriangleMesh& boundary, const surface::FeatureGraph& features);

    Index vertex_count() const { return static_cast<Index>(boundary_.vertices.rows()); }

    // Unit vectors from v along its feature edges, in the order of the edges.
    std::vector<Eigen::Vector3d> feature_directions(Index v) const;

    // Triangles round v, ascending.
    std::span<const Index> triangles(Index v) const {
        return {triangles_.data() + triangle_begin_[v], triangles_.data() + triangle_begin_[v + 1]};
    }

    // Sectors: sets of triangles round v joined across edges that are no features and belong to exactly two triangles.
    // Per triangle of triangles(v): place there of the lowest triangle of its sector.
    std::vector<int> sectors(Index v) const;

    // Unit normals of the sectors, weighted by triangle area, in the order of each sector's lowest triangle.
    std::vector<Eigen::Vector3d> sector_normals(Index v) const;

private:
    bool is_feature(Index v, Index w) const;
    Eigen::Vector3d area_vector(Index triangle) const;

    const surface::TriangleMesh& boundary_;
    std::vector<std::int64_t> triangle_begin_, neighbour_begin_;
    std::vector<Index> triangles_, neighbours_;  // per vertex: incident triangles; other ends of its feature edges
};

}  // namespace octafield::volume
