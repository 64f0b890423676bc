// Faces between vertices on a curved surface cut its volume off or add to it: offsets of the vertices that balance
// this.
#pragma once

#include <array>
#include <vector>

#include "octafield/volume/cell_quality.hpp"
#include "surface_guide.hpp"

namespace octafield::volume::detail {

// The boundary faces of a mesh that lie on one patch of the surface, with places on them where they are held against
// it.
class SurfaceFit {
public:
    using Vector = Eigen::Vector3d;
    using Places = std::vector<SurfaceGuide::Place>;

    // `places`: of the vertices of kind surface, on their patches.
    SurfaceFit(const MixedMesh& mesh, const VertexSupport& support, const SurfaceGuide& guide, const Places& places,
               int threads);

    // Integral over the faces of the squared distance from the surface.
    double misfit(const Points& vertices) const;
    // (n, 3): per vertex of kind surface a step along the mean normal of its faces, all of them together so that the
    // integral gets least (linear least squares); 0 for others. Input unit.
    Points steps(const Points& vertices) const;

private:
    struct Face {
        std::array<Index, 4> ids;  // outward; the last of a triangle's is -1
        Index guide_vertex;        // one of kind surface
    };
    struct Sample {
        std::array<double, 4> weights;  // of the face's vertices
        Vector area;                    // part of the face's area vector
        double distance;                // to the surface along the face's normal, outward
    };
    std::vector<Sample> samples(const Points& vertices, const Face& face) const;
    std::vector<std::vector<Sample>> all_samples(const Points& vertices) const;

    const VertexSupport& support_;
    const SurfaceGuide& guide_;
    const Places& places_;
    int threads_;
    std::vector<Face> faces_;
};

}  // namespace octafield::volume::detail
