// All that a finished frame field is judged by, in one call.
#pragma once

#include "octafield/volume/boundary_meshability.hpp"
#include "octafield/volume/integrability.hpp"
#include "octafield/volume/meshability.hpp"
#include "octafield/volume/sampling.hpp"
#include "octafield/volume/singularities.hpp"
#include "octafield/volume/tet_singularities.hpp"

namespace octafield::volume {

struct FieldAnalysis {
    double energy = 0;             // dirichlet_energy
    SingularGraph singular_graph;  // of singular_graph(domain, frames)
    Meshability meshability;
    BoundaryMeshability boundary_meshability;
    Integrability integrability;        // of frames at right angles; else 0, without rows
    Eigen::VectorXd alignment;          // radians, per sector of sector_normals: to the nearest axis
    Eigen::VectorXd feature_alignment;  // radians, per tangent of feature_tangents
};

// frames: (n, 4) unit quaternions w x y z at the vertices. stretch: of axes S Q (axes_stretch.hpp), or no rows: then
// energy and singular graph are those of Q, alignment is from normals of pairs of axes and from axes, and meshability
// is counted after S^-1. Throws InvalidInput where they do not fit the mesh.
FieldAnalysis analyse_field(const TetDomain& domain, const Quaternions& frames, int threads = 0,
                            const Stretches& stretch = {});

struct TetFieldAnalysis {
    double energy = 0;              // of tet_sampling
    double energy_at_vertices = 0;  // of vertex_frames
    Quaternions vertex_frames;      // (n, 4) the field taken to the vertices
    SingularEdges singular_edges;
    Meshability meshability;
    BoundaryMeshability boundary_meshability;
    Eigen::VectorXd alignment;          // radians, as tet_alignment_angles
    Eigen::VectorXd feature_alignment;  // radians, of vertex_frames
};

// of_tets: (m, 4) unit quaternions w x y z in the tets; sampling: tet_sampling(domain). Throws InvalidInput.
TetFieldAnalysis analyse_tet_field(const TetDomain& domain, const Sampling& sampling, const Quaternions& of_tets,
                                   int threads = 0);

}  // namespace octafield::volume
