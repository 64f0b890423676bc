// Surface files: STL (ASCII and binary), OBJ, OFF, PLY, each also gzipped (name.stl.gz).
#pragma once

#include <filesystem>

#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::surface {

// Reads by file extension, case-insensitive. STL has no shared vertices, so equal points are merged there (bit-equal
// coordinates only); other formats are kept as they are. Polygons are fan-triangulated. Nothing is repaired.
// Throws IoError (missing, unreadable, truncated, unknown extension, no triangles, an index out of range, a
// coordinate that is not finite), naming the file and, where known, the line or byte.
TriangleMesh read_surface(const std::filesystem::path& path);

// Writes by extension (.stl binary, .obj, .off, .ply; 17 significant digits where the format is text) to a temporary
// file beside the target, then renames. Throws IoError ("single_precision": triangles that have no area in STL).
void write_surface(const TriangleMesh& mesh, const std::filesystem::path& path);

}  // namespace octafield::surface
