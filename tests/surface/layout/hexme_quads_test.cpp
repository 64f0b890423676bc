// Quads on the boundaries of real parts.
#include "hexme_surface.hpp"
#include "layout_fixtures.hpp"
#include "octafield/error.hpp"
#include "octafield/surface/feature_cut.hpp"
#include "octafield/surface/quantized_quads.hpp"
#include "octafield/surface/corner_pattern.hpp"
#include <chrono>

namespace octafield::surface {
namespace {

TEST(HexmeQuads, Try) {
    std::vector<std::string> names;
    std::istringstream given(std::getenv("HEXME") ? std::getenv("HEXME") : "s01c");
    for (std::string n; given >> n;) names.push_back(n);
    for (const auto& name : names) {
        std::string stage = "read";
        auto t0 = std::chrono::steady_clock::now();
        const auto sec = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - t0).count(); };
        try {
            const SurfaceDomain whole = hexme_surface(name);
            const FeatureCut cut = cut_along_features(whole);
            stage = "field";
            const DirectionField direction = direction_field(cut.domain);
            const SingularPattern computed = singular_pattern(direction, surface_singularities(direction));
            const std::vector<CornerQuads> corners = finite_corner_quads(cut.domain, computed);
            const SingularPattern pattern = with_corner_quads(cut.domain, computed, std::getenv("ANGLE") ? default_corner_quads(cut.domain) : corners);
            stage = "impose";
            if (std::getenv("CORN")) {
                std::map<Index, int> by_angle;
                for (auto& c : default_corner_quads(cut.domain)) by_angle[c.vertex] = c.quads;
                std::map<Index, int> found;
                for (auto& c : singular_pattern(direction, surface_singularities(direction)).corners) found[c.vertex] = c.quads;
                for (auto& [v, q] : found) if (q != (by_angle.contains(v) ? by_angle[v] : 2)) std::printf("corner %d field %d angle %d\n", v, q, by_angle.contains(v) ? by_angle[v] : 2);
                for (auto& [v, q] : by_angle) if (!found.contains(v)) std::printf("corner %d field 2 angle %d\n", v, q);
            }
            ImposedFieldOptions how;
            how.inadmissible = Inadmissible::move;
            ImposedField field;
            const char* way = "move";
            try {
                field = impose_singular_points(cut.domain, pattern, how);
            } catch (const Error& e) {
                way = "rotate";
                how.inadmissible = Inadmissible::rotate;
                field = impose_singular_points(cut.domain, pattern, how);
            }
            const double t1 = sec();
            stage = "graph";
            LayoutCurveOptions curves;
            if (std::getenv("TOL")) curves.end_tolerance = std::atof(std::getenv("TOL")) * std::sqrt(triangle_areas(cut.domain.mesh()).sum());
            const QuadLayout layout = motorcycle_graph(field, curves);
            const double t2 = sec();
            if (std::getenv("DBG")) {
                double worst = 0;
                for (const auto& c : field.conditions) worst = std::max(worst, c.size_factor);
                std::printf("way %s mismatch %g size factor %g\n", way, layout.largest_mismatch, worst);
                for (std::size_t p = 0; p < layout.patches.size(); ++p) {
                    const auto& patch = layout.patches[p];
                    if (std::getenv("BAD") && patch.kind == PatchKind::quad) continue;
                    std::printf("p%zu chi %d corners %d:", p, patch.euler_characteristic, patch.corners);
                    std::size_t k = 0;
                    for (const auto& loop : patch.loops) for (std::size_t i = 0; i < loop.size(); ++i) {
                        if (k < patch.corner_sides.size() && patch.corner_sides[k] == (Index)i) { std::printf(" |"); ++k; }
                        { const auto& sd = layout.sides[loop[i].side]; const auto& v = layout.vertices[loop[i].reversed ? sd.last : sd.first]; std::printf(" k%d:v%d:t%d-%d(c%d %.4f)", (int)v.kind, v.vertex, v.index_times_four, loop[i].side, sd.curve, sd.length()); }
                    }
                    std::puts("");
                }
                for (std::size_t s = 0; s < layout.sides.size(); ++s) if (!std::getenv("BAD") && layout.sides[s].curve < 0) {
                    const auto& v = layout.sides[s];
                    std::printf("b%zu %d-%d orig %g %g %g -> %g %g %g\n", s, v.first, v.last, v.points(0,0), v.points(0,1), v.points(0,2), v.points(v.points.rows()-1,0), v.points(v.points.rows()-1,1), v.points(v.points.rows()-1,2));
                }
                for (auto& pt : pattern.points) { auto x = imposed_position(cut.domain, pt); std::printf("t %d at %g %g %g\n", pt.index_times_four, x[0], x[1], x[2]); }
            }
            stage = "quads";
            QuantizedQuadsOptions options;
            options.quad_count = std::getenv("QUADS") ? std::atoi(std::getenv("QUADS")) : 2000;
            options.coarsest = std::getenv("COARSE") != nullptr;
            options.origins = cut.origins;
            const QuantizedQuads q = quantized_quads(layout, options);
            std::printf("%s: triangles %d points %zu %s tiles %zu arcs %zu T %d quads %zd blocks %zd irregular %zu sj %.3f dev %.2f opt %d mv %d | %.2f %.2f %.2f s\n",
                        name.c_str(), whole.triangle_count(), pattern.points.size(), way, layout.patches.size(), layout.sides.size(), q.t_joints,
                        q.mesh.quads.rows(), q.patch_sizes.rows(), q.irregular.size(), q.least_scaled_jacobian,
                        q.deviation, q.optimal, q.mean_value_patches, t1, t2 - t1, sec() - t2);
        } catch (const Error& e) {
            std::printf("%s: %s: %s %s (%.2f)\n", name.c_str(), stage.c_str(), e.kind().c_str(), e.what(), sec());
        }
        std::fflush(stdout);
    }
}

}  // namespace
}  // namespace octafield::surface
