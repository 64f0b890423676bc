#include "octafield/volume/tetrahedralize.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "fill_surface.hpp"
#include "octafield/error.hpp"
#include "octafield/surface/validate.hpp"

namespace octafield::volume {
namespace {

using surface::TriangleMesh;

void require_options(const TetrahedralizeOptions& options) {
    if (!(options.radius_edge_ratio >= 1 && std::isfinite(options.radius_edge_ratio)))
        throw InvalidInput("radius_edge_ratio must be at least 1; 1.2 to 2 is usual", "radius_edge_ratio");
    if (!(options.min_dihedral >= 0 && options.min_dihedral < std::numbers::pi / 3))
        throw InvalidInput("min_dihedral is in radians, from 0 to below pi/3; above 0.3 TetGen may not finish",
                           "min_dihedral");
    if (!(options.edge_length >= 0 && std::isfinite(options.edge_length)))
        throw InvalidInput("edge_length must be positive, or 0 for the surface's mean edge length", "edge_length");
}

void require_all_vertices_used(const TriangleMesh& mesh) {
    std::vector<std::uint8_t> used(mesh.vertices.rows(), 0);
    for (const Index v : mesh.triangles.reshaped()) used[v] = 1;
    std::vector<Index> unused;
    for (std::size_t v = 0; v < used.size(); ++v)
        if (!used[v]) unused.push_back(static_cast<Index>(v));
    if (!unused.empty())
        throw InvalidInput("vertices " + first_few(unused) + " belong to no triangle; remove them", "unused_vertex",
                           unused);
}

// Inputs run from 1e-6 to 1e6, TetGen is made for sizes near 1. A power of two changes no digit, so the way back is
// exact.
double scale_to_unit(const Points& points) {
    int exponent = 0;
    std::frexp(surface::bounding_box_diagonal(points), &exponent);
    return std::ldexp(1.0, -exponent);
}

double largest_tet(const TriangleMesh& mesh, double edge_length) {
    const double edge = edge_length > 0 ? edge_length : surface::mean_edge_length(mesh);
    const double volume = 1.5 * edge * edge * edge / (6 * std::numbers::sqrt2);  // of 1.5 regular tets
    const double expected = 2 * surface::signed_volume(mesh) / volume;           // a mean tet has about half the bound
    if (!(expected < 2e8))
        throw InvalidInput("edge_length would give about " +
                               std::to_string(static_cast<std::int64_t>(std::min(expected, 1e18))) +
                               " tets; choose a larger one",
                           "edge_length");
    return volume;
}

// The usual reason. TetGen's own report is in its own numbering, so the triangles are found again here.
void require_no_crossing(const TriangleMesh& mesh) {
    for (const surface::Defect& defect : surface::find_defects(mesh))
        throw GeometryError("the surface cannot be filled with tets: " + defect.message,
                            defect.kind == "self_intersection" ? "tetgen_self_intersection" : "tetgen_failed",
                            defect.elements);
}

}  // namespace

TetMesh tetrahedralize(const TriangleMesh& mesh, const TetrahedralizeOptions& options, const Progress& progress,
                       std::vector<std::string>* notes) {
    require_options(options);
    surface::require_valid(mesh, {.closed = true, .self_intersection = false});
    require_all_vertices_used(mesh);
    const double scale = scale_to_unit(mesh.vertices);
    const TriangleMesh unit{mesh.vertices * scale, mesh.triangles};

    TetgenParameters parameters;
    parameters.radius_edge_ratio = options.radius_edge_ratio;
    parameters.min_dihedral = options.min_dihedral * 180 / std::numbers::pi;
    parameters.max_volume = largest_tet(unit, options.edge_length * scale);

    std::string why;
    for (const Attempt& attempt : attempts()) {
        try {
            TetMesh result = fill_surface(unit, parameters, attempt, progress);
            result.vertices /= scale;
            if (!why.empty() && notes)
                notes->push_back("TetGen could not fill the surface at first (" + why + "); it could " + attempt.what);
            return result;
        } catch (const Failed& failed) {
            if (!why.empty()) continue;
            why = failed.why;
            require_no_crossing(mesh);
        }
    }
    throw GeometryError("TetGen could not fill the surface, in " + std::to_string(attempts().size()) + " ways (" +
                            why + "); remesh it with other edge lengths, or raise edge_length",
                        "tetgen_failed");
}

}  // namespace octafield::volume
