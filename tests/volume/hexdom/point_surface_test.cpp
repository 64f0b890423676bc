#include <gtest/gtest.h>
#include <cstdio>
#include "octafield/volume/point_surface.hpp"
#include "patched_surfaces.hpp"
#include "surface_facts.hpp"
using namespace octafield; using namespace octafield::volume; using namespace octafield::volume::testing;
#include <chrono>
TEST(X, Explore) {
    struct C { const char* name; std::vector<Map> maps; double side; bool features; };
    for (const C& c : {C{"box", box_maps({0,0,0},{1,1,1}), 1, true}, {"sphere", sphere_maps(), 1.57, false}, {"torus", torus_maps(), 1, false}, {"cylinder", cylinder_maps(), 1.3, true}})
        for (auto [n, m] : {std::pair{16, 16}, {16, 15}, {16, 17}, {16, 32}, {16, 31}, {16,33}, {16, 8}, {16, 7}, {17,8}, {16,5}}) {
            Patched p = patched_surface(c.maps, {n, m});
            surface::FeatureGraph fg;
            if (c.features) fg = surface::detect_features(p.mesh);
            std::vector<Index> groups(p.groups.size(), 0);
            auto t0 = std::chrono::steady_clock::now();
            PointSurface s = point_surface(p.mesh, fg, groups, p.points, p.quads, c.side / m);
            double sec = std::chrono::duration<double>(std::chrono::steady_clock::now() - t0).count();
            int found = 0; for (auto f : s.quad_found) found += f;
            std::printf("%-9s n=%d m=%d T=%d p=%d -> V extra=%d F=%d  quads %d/%d  %.3f  euler %d/%d closed %d vol %.4f/%.4f  %.2fs\n", c.name, n, m, (int)p.mesh.triangles.rows(), (int)p.points.triangle.size(),
               (int)(s.mesh.vertices.rows() - p.points.triangle.size()), (int)s.mesh.triangles.rows(), found, (int)p.quads.rows(), double(found)/p.quads.rows(), euler(s.mesh), euler(p.mesh), closed_and_oriented(s.mesh), volume_inside(s.mesh), volume_inside(p.mesh), sec);
        }
}
