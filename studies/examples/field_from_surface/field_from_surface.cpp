// From the file of a closed surface to a frame field for ParaView:
//
//     field_from_surface part.stl field.vtu
#include <cstdio>
#include <exception>

#include "octafield/surface/read_write.hpp"
#include "octafield/surface/remesh.hpp"
#include "octafield/surface/validate.hpp"
#include "octafield/volume/computed_field.hpp"
#include "octafield/volume/tetrahedralize.hpp"
#include "octafield/volume/write_vtk.hpp"

using namespace octafield;

void compute(const char* surface_file, const char* field_file) {
    // --8<-- [start:recipe]
    const surface::TriangleMesh input = surface::read_surface(surface_file);
    surface::require_valid(input);
    const surface::RemeshResult fine = surface::remesh(input, surface::detect_features(input));
    const volume::TetMesh tets = volume::tetrahedralize(fine.mesh, {.edge_length = fine.inner_length});
    const volume::TetDomain domain(tets, {}, fine.features);

    const volume::ComputedField found = volume::computed_field(domain);
    volume::write_field(field_file, domain, found.combed.frames);
    std::printf("%d tets, energy %g, %zu singular curves\n", domain.tet_count(), found.analysis.energy,
                found.analysis.singular_graph.curves.size());
    // --8<-- [end:recipe]
}

int main(int argc, char** argv) {
    if (argc != 3) return std::fprintf(stderr, "usage: field_from_surface SURFACE FIELD.vtu\n"), 2;
    try {
        compute(argv[1], argv[2]);
    } catch (const std::exception& error) {
        return std::fprintf(stderr, "%s\n", error.what()), 2;
    }
}
