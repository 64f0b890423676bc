#include "octafield/volume/computed_field.hpp"

#include <string>
#include <utility>

#include "octafield/error.hpp"
#include "octafield/surface/directions.hpp"

namespace octafield::volume {
namespace {

bool is_cut(const TetDomain& domain) {
    return domain.interface_triangles() > 0 || domain.sheets().cuts.rows() > 0 ||
           domain.sheets().mesh.vertices.rows() > domain.surface().mesh.vertices.rows();
}

// Of values at the vertices of the sheets, those at the vertices of the surface: of the first copy each.
Points at_surface_vertices(const TetDomain& domain, const Points& of_sheets) {
    const std::vector<Index>& map = domain.sheets().vertex_map;
    Points result(domain.surface().mesh.vertices.rows(), 3);
    for (Index v = static_cast<Index>(map.size()) - 1; v >= 0; --v) result.row(map[v]) = of_sheets.row(v);
    return result;
}

void require_unstretched(bool holds, const char* what, const char* kind) {
    if (!holds) throw InvalidInput(std::string("axes at any angle ") + what + "; take axes at right angles", kind);
}

// The stretch of free axes, without rows where nothing is stretched.
AxesStretch stretch_of(const TetDomain& domain, const FieldOptions& options) {
    if (options.axes == Axes::orthogonal) return {};
    require_unstretched(options.solve.smooth.representation != "odeco_lengths",
                        "have lengths that follow from their stretch, and odeco_lengths has lengths of its own",
                        "stretched_axes");
    AxesStretch found = axes_stretch(domain, options.stretch);
    if (found.sharp.empty()) found.values.resize(0, 6);
    return found;
}

// The parts that both kinds of sites have in common. `where`: what the frames are smoothed on.
template <class Result>
void solve(const TetDomain& domain, const Sampling& where, Sites sites, const FieldOptions& options,
           const Stretches& stretch, const Progress& progress, Result& result) {
    FrameFieldOptions how = options.solve;
    if (options.boundary.mode == BoundaryMode::none) how.start = Start::cross_field;
    result.cross_field = surface::direction_field(sheet_domain(domain), {.seed = how.seed}, progress);
    result.constraints = surface_constraints(domain, result.cross_field, sites, options.boundary, stretch);
    if (!options.given.vertices.empty())
        result.constraints = with_constraints(std::move(result.constraints), options.given);
    result.solved = frame_field(where, result.constraints, how, progress);
}

}  // namespace

surface::SurfaceDomain sheet_domain(const TetDomain& domain) {
    if (!is_cut(domain)) return {domain.surface().mesh, domain.features()};
    return {domain.sheets().mesh, features_on_sheets(domain.features(), domain.sheets())};
}

BoundaryConstraints surface_constraints(const TetDomain& domain, const surface::DirectionField& cross, Sites sites,
                                        const BoundaryOptions& options, const Stretches& stretch) {
    const surface::TriangleMesh& sheets = domain.sheets().mesh;
    if (cross.domain.vertex_count() != sheets.vertices.rows() || cross.domain.mesh().triangles != sheets.triangles)
        throw InvalidInput(
            "the cross field lives on another surface than that of the tets; compute it on "
            "sheet_domain(domain)",
            "wrong_mesh");
    if (sites == Sites::tets) {
        require_unstretched(stretch.rows() == 0, "are those of frames at the vertices", "wrong_sampling");
        return tet_boundary_constraints(domain, surface::triangle_directions(cross), options);
    }
    const Points directions = at_surface_vertices(domain, surface::vertex_directions(cross));
    if (stretch.rows() > 0) return boundary_constraints(domain, directions, stretch, options);
    return boundary_constraints(domain, directions, options);
}

ComputedField computed_field(const TetDomain& domain, const FieldOptions& options, const Progress& progress) {
    ComputedField result;
    result.stretch = stretch_of(domain, options);
    solve(domain, domain, Sites::vertices, options, result.stretch.values, progress, result);
    result.combed = comb_vertices(domain, result.solved.smooth.frames, options.solve.threads);
    result.analysis = analyse_field(domain, result.combed.frames, options.solve.threads, result.stretch.values);
    return result;
}

ComputedTetField computed_tet_field(const TetDomain& domain, const FieldOptions& options, const Progress& progress) {
    ComputedTetField result;
    require_unstretched(options.axes == Axes::orthogonal, "are those of frames at the vertices", "wrong_sampling");
    const Sampling sampling = tet_sampling(domain);
    solve(domain, sampling, Sites::tets, options, {}, progress, result);
    result.analysis = analyse_tet_field(domain, sampling, result.solved.smooth.frames, options.solve.threads);
    result.combed = comb_vertices(domain, result.analysis.vertex_frames, options.solve.threads);
    return result;
}

}  // namespace octafield::volume
