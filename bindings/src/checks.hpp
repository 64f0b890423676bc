// Checks at the border: what comes from Python is sound enough that no C++ function can run out of an array.
// Every failure is InvalidInput and names the argument and its elements.
#pragma once

#include <string>
#include <string_view>

#include "arrays.hpp"
#include "octafield/surface/direction_field.hpp"
#include "octafield/surface/features.hpp"
#include "octafield/surface/surface_singularities.hpp"
#include "octafield/surface/triangle_mesh.hpp"
#include "octafield/volume/boundary.hpp"
#include "octafield/volume/singularities.hpp"
#include "octafield/volume/tet_mesh.hpp"
#include "octafield/volume/vertex_constraints.hpp"

namespace octafield::surface {
struct AtlasOptions;
struct FeatureOptions;
struct RemeshOptions;
struct CloseRemeshOptions;
struct WinslowOptions;
struct SizeFieldOptions;
struct DirectionFieldOptions;
struct NonOrthogonalFieldOptions;
struct FittingOptions;
struct ImposedFieldOptions;
struct LimitCycleOptions;
struct SizeFamilyOptions;
struct SizedFieldOptions;
struct LayoutCurveOptions;
struct LayoutQuadsOptions;
struct QuantizedQuadsOptions;
struct FixedBoundaryOptions;
}  // namespace octafield::surface
namespace octafield::volume {
struct AxesStretchOptions;
struct BoundaryOptions;
struct DiffuseOptions;
struct SmoothOptions;
struct FrameFieldOptions;
struct PeriodicMapOptions;
struct RecombineOptions;
struct ImproveOptions;
struct HexDominantOptions;
struct AllHexOptions;
}  // namespace octafield::volume

namespace octafield::bindings {

double finite(double value, std::string_view name);
int threads_option(int threads);

// Numbers of options are finite (but for those that may be infinite), threads 0 or more; functions check the rest.
void check(const surface::AtlasOptions& options);
void check(const surface::FeatureOptions& options);
void check(const surface::RemeshOptions& options);
void check(const surface::CloseRemeshOptions& options);
void check(const surface::WinslowOptions& options);
void check(const surface::SizeFieldOptions& options);
void check(const surface::DirectionFieldOptions& options);
void check(const surface::NonOrthogonalFieldOptions& options);
void check(const surface::ImposedFieldOptions& options);
void check(const surface::SizedFieldOptions& options);
void check(const surface::SizeFamilyOptions& options);
void check(const surface::LimitCycleOptions& options);
void check(const surface::LayoutCurveOptions& options);
void check(const surface::LayoutQuadsOptions& options);
void check(const surface::QuantizedQuadsOptions& options);
void check(const surface::FittingOptions& options);
void check(const surface::FixedBoundaryOptions& options);
void check(const volume::AxesStretchOptions& options);
void check(const volume::BoundaryOptions& options);
void check(const volume::DiffuseOptions& options);
void check(const volume::SmoothOptions& options);
void check(const volume::FrameFieldOptions& options);
void check(const volume::PeriodicMapOptions& options);
void check(const volume::RecombineOptions& options);
void check(const volume::ImproveOptions& options);
void check(const volume::HexDominantOptions& options);
void check(const volume::AllHexOptions& options);

// Coordinates finite, vertex ids in range. `require_elements`: at least one triangle or tet.
void check(const surface::TriangleMesh& mesh, bool require_elements = true);
void check(const volume::TetMesh& mesh, bool require_elements = true);

// Edges are edges of the mesh.
void check_edges(const Edges& edges, const surface::TriangleMesh& mesh, std::string_view name);

// One finite value per edge of the field's domain.
void check(const surface::DirectionField& field);

// Edges are edges of the mesh, vertices its vertices; one finite direction each. The solver tests the rest.
void check(const surface::DirectionConstraints& constraints, const surface::TriangleMesh& mesh);

// Nothing, or one finite direction per triangle, and one weight or none.
void check(const surface::DirectionGuide& guide, const surface::TriangleMesh& mesh);

// Every point is finite and in a triangle or at a vertex of the mesh, with an index that a field can have there.
void check(const surface::SurfaceSingularities& singularities, const surface::TriangleMesh& mesh);

// vertex_map: one ascending tet-mesh id in [0, vertex_count) per boundary vertex.
void check(const volume::BoundarySurface& boundary, Index vertex_count);

// Every array has one row per vertex; frames are normalised.
void check(volume::BoundaryConstraints& constraints, Index vertex_count);

// Kinds are known words; the rest is tested where they are used.
void check(const volume::VertexConstraints& constraints);

void check(const volume::SingularGraph& graph);

// (n, 3) finite rows, one per `per`.
void check_vectors(const Points& vectors, std::int64_t rows, std::string_view name, std::string_view per = "vertex");

// Rows of unit length within 1e-6, which are then normalised. rows < 0: any number.
void check_unit(Quaternions& quaternions, std::int64_t rows, std::string_view name);

}  // namespace octafield::bindings
