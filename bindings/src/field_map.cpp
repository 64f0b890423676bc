// Seamless maps of frame fields.
#include "octafield/volume/field_map.hpp"

#include "bind.hpp"
#include "checks.hpp"
#include "domain.hpp"
#include "field_map.hpp"
#include "interruptible.hpp"

namespace octafield::bindings {

using namespace volume;
using py::literals::operator""_a;

void bind_field_map(py::module_& m) {
    Record<FieldMap>(m, "FieldMap", "A seamless map of a frame field, and how it came about.")
        .field("map", &FieldMap::map, "SeamlessMap without walls; its tets are parts of the field's.")
        .field("parent", &FieldMap::parent, "(m,) int32: the tet of the field that each is part of.")
        .field("curves", &FieldMap::curves, "(e, 2) int32 singular edges of the map's mesh.")
        .field("added_vertices", &FieldMap::added_vertices, "Of the map's mesh.")
        .field("turns", &FieldMap::turns, "Places where curves of the field go on with another type.")
        .field("unzipped", &FieldMap::unzipped, "Of these, how many are no more.")
        .field("unknowns", &FieldMap::unknowns, "That were free.")
        .field("locked", &FieldMap::locked,
               "int32 tets that are flat in every map with these singular curves and this surface.")
        .field("flipped", &FieldMap::flipped, "int32 tets turned over or flat in the end.")
        .field("flipped_at_first", &FieldMap::flipped_at_first, "Their number before unfolding.")
        .field("steps", &FieldMap::steps, "Of Newton's method.")
        .field("angle_at_first", &FieldMap::angle_at_first,
               "Between axes and gradients, radians: mean over axes, by volume; before unfolding.")
        .field("angle", &FieldMap::angle, "The same in the end.")
        .finish([](const FieldMap& made) {
            return count(made.map.mesh.tets.rows(), "tet") + ", " + count(made.flipped.size(), "flipped tet");
        });
    m.def(
        "field_map",
        [](const DomainOrMesh& mesh, const ArrayLike& frames, const std::optional<ProgressCallable>& progress,
           double edge_length, int threads) {
            finite(edge_length, "edge_length");
            threads_option(threads);
            const TetDomain domain = domain_of(mesh);
            auto rows = from_python<Quaternions>(frames, "frames");
            return run_interruptible(
                [=, rows = std::move(rows)](Job& job) mutable {
                    check_unit(rows, domain.vertex_count(), "frames");
                    return field_map(domain, rows, {edge_length, threads}, job.progress());
                },
                progress);
        },
        "domain"_a, "frames"_a, py::kw_only(), "progress"_a = py::none(),
        "edge_length"_a = FieldMapOptions{}.edge_length, "threads"_a = FieldMapOptions{}.threads,
        "The seamless map of (n, 4) frames at the vertices, as a FieldMap: singular curves become edges, parameters "
        "follow the axes as near as transitions, surface and features allow, folded tets are unfolded. Raises "
        "InvalidInput, GeometryError, SolverError, Cancelled.");
}

}  // namespace octafield::bindings
