#include "octafield/volume/analyse_field.hpp"

#include "octafield/volume/boundary.hpp"
#include "octafield/volume/feature_alignment.hpp"
#include "octafield/volume/operators.hpp"
#include "octafield/volume/tet_meshability.hpp"

namespace octafield::volume {

FieldAnalysis analyse_field(const TetDomain& domain, const Quaternions& frames, int threads, const Stretches& stretch) {
    const bool stretched = stretch.rows() > 0;
    FieldAnalysis found;
    found.singular_graph = singular_graph(domain, frames, threads);
    found.meshability = local_meshability(domain, frames, found.singular_graph, stretch);
    found.boundary_meshability = boundary_meshability(domain, frames, threads, stretch);
    if (!stretched) found.integrability = integrability(domain, frames, threads);
    found.alignment = stretched ? alignment_angles(domain, frames, stretch) : alignment_angles(domain, frames);
    found.feature_alignment =
        stretched ? feature_alignment_angles(domain, frames, stretch) : feature_alignment_angles(domain, frames);
    found.energy = dirichlet_energy(domain, frames, threads);
    return found;
}

TetFieldAnalysis analyse_tet_field(const TetDomain& domain, const Sampling& sampling, const Quaternions& of_tets,
                                   int threads) {
    TetFieldAnalysis found;
    found.vertex_frames = vertex_frames(domain, of_tets, threads);
    found.singular_edges = singular_edges(domain, of_tets, threads);
    found.alignment = tet_alignment_angles(domain, of_tets);
    found.feature_alignment = feature_alignment_angles(domain, found.vertex_frames);
    found.energy = dirichlet_energy(sampling, of_tets, threads);
    found.energy_at_vertices = dirichlet_energy(domain, found.vertex_frames, threads);
    found.meshability = tet_meshability(domain, of_tets, found.singular_edges);
    found.boundary_meshability = tet_boundary_meshability(domain, of_tets, threads);
    return found;
}

}  // namespace octafield::volume
