// A triangle surface with all that is derived from it: made and validated once, then shared and never changed.
#pragma once

#include <memory>
#include <vector>

#include "octafield/surface/features.hpp"
#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::surface {

// The corners round each vertex, counter-clockwise seen from outside. Corner 3t + k is corner k of triangle t.
struct VertexFans {
    // One fan per vertex in use; several where parts of the surface touch at a vertex only.
    struct Fan {
        Index vertex;
        bool closed;        // goes all the way round; otherwise it runs from boundary edge to boundary edge
        Index first, last;  // its corners are corners[first .. last)
    };
    std::vector<Fan> fans;       // by vertex
    std::vector<Index> corners;  // (3F); the next one lies across the second edge of a corner
};

// Where a direction field lives. A copy costs three pointers. What takes a SurfaceDomain takes a TriangleMesh, too, and
// makes a domain of it for that call alone, without features.
class SurfaceDomain {
public:
    SurfaceDomain();  // no triangles
    // An edge-manifold, consistently oriented surface without degenerate triangles, closed or not, any number of
    // components. features: none: no edge inside the surface is one. Near linear. Throws GeometryError naming elements:
    // "index_out_of_range", "non_finite", what edge_topology throws, "not_orientable" (one side only),
    // "degenerate_triangle", "size_out_of_range" (areas whose squares are no numbers); and what with_features throws.
    SurfaceDomain(TriangleMesh mesh, FeatureGraph features = {});

    // The same surface with other features, in any order. Throws as ordered_features.
    SurfaceDomain with_features(FeatureGraph features) const;

    // The same surface measured by other edge lengths, (E), > 0: each triangle is the flat one with these sides, and
    // edge_lengths, corner_angles, cotangents and areas are theirs. Positions, normals, mean_edge_length and size stay
    // those in space. What lives on such a surface is intrinsic to these triangles: a cross field on it has its right
    // angles there, and quads made from it are taken to space with the positions. Throws InvalidInput (kind
    // "bad_lengths", elements: edges) where they are not finite and > 0, GeometryError (kind "no_triangle", elements)
    // where a side is as long as the other two.
    SurfaceDomain with_edge_lengths(Eigen::VectorXd lengths) const;
    bool has_own_lengths() const { return metric_->own; }  // whether they are not those in space

    const TriangleMesh& mesh() const { return topology_->mesh; }
    Index vertex_count() const { return static_cast<Index>(mesh().vertices.rows()); }
    Index triangle_count() const { return static_cast<Index>(mesh().triangles.rows()); }
    Index edge_count() const { return static_cast<Index>(topology().edges.rows()); }
    const EdgeTopology& topology() const { return topology_->edges; }
    const VertexFans& fans() const { return topology_->fans; }
    const Points& normals() const { return topology_->normals; }                     // (F, 3) triangle_normals
    const Eigen::VectorXd& edge_lengths() const { return metric_->edge_lengths; }    // (E), input unit
    double mean_edge_length() const { return topology_->mean_edge_length; }          // input unit
    double size() const { return topology_->size; }                                  // shape_size
    const Rows<double, 3>& corner_angles() const { return metric_->corner_angles; }  // (F, 3) radians, in (0, pi)
    const Rows<double, 3>& cotangents() const { return metric_->cotangents; }        // (F, 3) of the corner angles
    Eigen::VectorXd areas() const;                                                   // (F)

    const FeatureGraph& features() const { return features_->graph; }
    // (E) edges of features() and of the mesh boundary.
    const std::vector<bool>& is_feature() const { return features_->is_feature; }

    // How many meshes this process has validated so far, for tests.
    static long long made();

private:
    struct Topology {
        TriangleMesh mesh;
        EdgeTopology edges;
        VertexFans fans;
        Points normals;
        double mean_edge_length = 0, size = 0;
    };
    struct Metric {
        Eigen::VectorXd edge_lengths;
        Rows<double, 3> corner_angles, cotangents;
        bool own = false;
    };
    struct Features {
        FeatureGraph graph;
        std::vector<bool> is_feature;
    };
    struct Parts {
        std::shared_ptr<const Topology> topology;
        std::shared_ptr<const Metric> metric;
    };
    static Parts parts_of(TriangleMesh mesh);
    SurfaceDomain(Parts parts, FeatureGraph features);

    std::shared_ptr<const Topology> topology_;
    std::shared_ptr<const Metric> metric_;
    std::shared_ptr<const Features> features_;
};

}  // namespace octafield::surface
