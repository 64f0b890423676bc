// Uses every installed module: a tetrahedron filled by TetGen, a constant field smoothed by Ceres.
#include <cstdio>

#include "octafield/frames/sh4.hpp"
#include "octafield/surface/direction_field.hpp"
#include "octafield/surface/directions.hpp"
#include "octafield/surface/validate.hpp"
#include "octafield/volume/operators.hpp"
#include "octafield/volume/smooth.hpp"
#include "octafield/volume/tetrahedralize.hpp"

int main() {
    octafield::surface::TriangleMesh surface;
    surface.vertices.resize(4, 3);
    surface.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
    surface.triangles.resize(4, 3);
    surface.triangles << 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3;
    octafield::surface::require_valid(surface);
    const auto features = octafield::surface::detect_features(surface);
    const auto field = octafield::surface::direction_field({surface, features});

    octafield::volume::TetrahedralizeOptions options;
    options.edge_length = 0.3;
    const octafield::volume::TetDomain domain(octafield::volume::tetrahedralize(surface, options), {}, features);
    const auto directions = octafield::surface::vertex_directions(field);
    const auto constraints = octafield::volume::boundary_constraints(domain, directions);
    const auto result =
        octafield::volume::smooth(domain, constraints, octafield::volume::initial_frames(domain, constraints));
    std::printf("%d tets, energy %g\n", domain.tet_count(), result.energy);
    return result.frames.rows() == domain.vertex_count() && result.energy >= 0 ? 0 : 1;
}
