// VTK XML output for ParaView, pyvista, meshio. Files are written to a temporary name beside the target, then renamed.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "octafield/surface/surface_singularities.hpp"
#include "octafield/surface/triangle_mesh.hpp"
#include "octafield/volume/axes_stretch.hpp"
#include "octafield/volume/meshability.hpp"
#include "octafield/volume/tet_domain.hpp"

namespace octafield::volume {

// Written as FieldData, one array per entry: strings in .vtp, their bytes (UInt8) in .vtu, because meshio refuses a
// .vtu with strings (empty entries are left out there). In Python:
// bytes(pyvista.read("field.vtu").field_data["version"]).decode().
using Metadata = std::map<std::string, std::string>;

// All throw IoError, naming the file and the reason, and InvalidInput where array sizes do not match. Binary,
// compressed.

// What a field may have beside frames at the vertices; each may have no rows.
struct FieldArrays {
    Quaternions tet_frames{};  // (m, 4): cell data under the names of the point data
    Points lengths{};          // (n, 3): point data frame_lengths, of frame_u, frame_v, frame_w
    Points tet_lengths{};      // (m, 3): cell data frame_lengths
    Stretches stretch{};       // (n, 6) of axes S Q at the vertices (axes_stretch.hpp); without lengths, tet_frames
    // Other arrays by name, a row per vertex and per tet.
    std::map<std::string, Rows<double, Eigen::Dynamic>> point_data{}, cell_data{};
    Edges features{};  // (k, 2) feature edges, vertex ids: field data feature_edges
};

// .vtu with point data: frame_u, frame_v, frame_w (unit axes), quaternion (w x y z, named components), sh4 (9, named
// -4..4), boundary (0/1), and cell data axes_agree (0/1: combing.hpp) and region where the domain has any.
// frames: (n, 4) unit quaternions w x y z. Axes are labelled vertex by vertex, as these quaternions are: what is
// interpolated from frame_u, frame_v, frame_w or quaternion (slices, clips, stream tracers) mixes axes where axes_agree
// is 0. Give frames of comb_vertices, so that such tets are few; sh4 may be interpolated everywhere (sample_frames).
// With a stretch frame_u, frame_v, frame_w are unit vectors along the axes S Q and frame_lengths their lengths, stretch
// is S (6 named components) and rotation Q (w x y z); there is neither quaternion nor sh4, which readers would take for
// frames at right angles.
void write_field(const std::filesystem::path& path, const TetDomain& domain, const Quaternions& frames,
                 const Metadata& metadata = {}, const FieldArrays& more = {});

// .vtp polylines with cell data quarter_turns, index (quarter_turns / 4), curve (0-based); nodes as vertex cells with
// point data node (0/1) and smoothed (3: the point's place in smoothed_curves), their cell data 0, 0, -1. Vertex cells
// come first. With the graph's meshability, point data
// meshable (1 or 0 where curves end, -1 elsewhere) and junction (-1 elsewhere).
void write_singular_graph(const std::filesystem::path& path, const SingularGraph& graph, const Metadata& metadata = {},
                          const Meshability* meshability = nullptr);

// .vtp triangles with point data direction (3).
void write_surface_field(const std::filesystem::path& path, const surface::TriangleMesh& mesh, const Points& directions,
                         const Metadata& metadata = {});

// .vtp vertices at the singular points of a surface field, with point data index.
void write_surface_singularities(const std::filesystem::path& path,
                                 const std::vector<surface::SurfaceSingularity>& singularities,
                                 const Metadata& metadata = {});

}  // namespace octafield::volume
