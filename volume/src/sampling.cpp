#include "octafield/volume/sampling.hpp"

#include "block_laplacian.hpp"
#include "constraint_spaces.hpp"
#include "require_frames.hpp"

namespace octafield::volume {
namespace {

// All but what depends on the sites.
Sampling sampling_of(const TetMesh& mesh, const surface::TriangleMesh& boundary) {
    Sampling sampling;
    sampling.body_radius = 3 * tet_volumes(mesh).sum() / surface::triangle_areas(boundary).sum();
    sampling.box_diagonal = surface::bounding_box_diagonal(mesh.vertices);
    return sampling;
}

}  // namespace

Sampling vertex_sampling(const TetMesh& mesh) {
    require_valid(mesh);
    const surface::TriangleMesh boundary = boundary_surface(mesh).mesh;
    Sampling sampling = sampling_of(mesh, boundary);
    sampling.stiffness = stiffness(mesh);
    sampling.mass = lumped_mass(mesh);
    sampling.spacing = surface::mean_edge_length(boundary);
    sampling.elements = std::make_shared<const TetMesh>(mesh);
    return sampling;
}

double dirichlet_energy(const Sampling& sampling, const Quaternions& frames, int threads) {
    require_frames(frames, sampling.count());
    Sh4Field image;
    return BlockLaplacian(sampling).multiply(embedded(frames, threads), image, threads) / 2;
}

}  // namespace octafield::volume
