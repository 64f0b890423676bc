// A tet mesh with all that is derived from it: made and validated once, then shared and never changed.
#pragma once

#include <memory>
#include <vector>

#include "octafield/surface/features.hpp"
#include "octafield/volume/sheets.hpp"
#include "octafield/volume/tet_mesh.hpp"
#include "octafield/volume/triangle_table.hpp"

namespace octafield::volume {

// Where a frame field lives. A copy costs two pointers. What takes a TetDomain takes a TetMesh, too, and makes a domain
// of it for that call alone: one region, no features.
class TetDomain {
public:
    // regions: (m) an id per tet (materials, CAD volumes); empty: all are one region. features: of surface(); none: no
    // vertex or edge of the surface is one. Near linear. Throws InvalidInput (kind "wrong_size": number of ids; and
    // what with_features throws), and GeometryError naming tets as require_valid and triangle_table do.
    TetDomain(TetMesh mesh, std::vector<Index> regions = {}, surface::FeatureGraph features = {});

    // The same mesh with other feature edges. Throws InvalidInput naming edges and corners that surface() does not
    // have: kinds "index_out_of_range", "not_an_edge".
    TetDomain with_features(surface::FeatureGraph features) const;

    const TetMesh& mesh() const { return topology_->mesh; }
    std::shared_ptr<const TetMesh> shared_mesh() const { return {topology_, &topology_->mesh}; }
    Index vertex_count() const { return static_cast<Index>(mesh().vertices.rows()); }
    Index tet_count() const { return static_cast<Index>(mesh().tets.rows()); }
    const std::vector<Index>& regions() const { return topology_->regions; }  // (m), or none
    const TriangleTable& triangles() const { return topology_->triangles; }

    // The surface that a field follows: the triangles of one tet, outward, as in boundary_surface and in its order;
    // then the interfaces, those between tets of different regions, out of the region of the lower id. Edges may have
    // three triangles or more.
    const BoundarySurface& surface() const { return topology_->surface; }
    Index interface_triangles() const { return topology_->interface_triangles; }  // the last so many
    const Edges& sides() const { return topology_->sides; }  // (F, 2) tet behind each triangle, tet ahead of it or -1
    const std::vector<Index>& surface_rows() const { return topology_->surface_rows; }  // (F) in triangles()
    const BoundarySurface& boundary() const;                                            // surface() without interfaces
    const Sheets& sheets() const { return topology_->sheets; }                          // surface() cut open

    const surface::FeatureGraph& features() const { return *features_; }  // vertex ids of surface().mesh

    // How many meshes this process has validated so far, for tests.
    static long long made();

private:
    struct Topology {
        TetMesh mesh;
        std::vector<Index> regions;
        TriangleTable triangles;
        BoundarySurface surface, boundary;  // boundary: only where there are interfaces
        Index interface_triangles = 0;
        Edges sides;
        std::vector<Index> surface_rows;
        Sheets sheets;
    };
    static std::shared_ptr<const Topology> topology_of(TetMesh mesh, std::vector<Index> regions);
    TetDomain(std::shared_ptr<const Topology> topology, surface::FeatureGraph features);

    std::shared_ptr<const Topology> topology_;
    std::shared_ptr<const surface::FeatureGraph> features_;
};

}  // namespace octafield::volume
