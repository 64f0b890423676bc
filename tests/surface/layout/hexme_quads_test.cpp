// Quads on the boundaries of real parts.
#include "hexme_surface.hpp"
#include "layout_fixtures.hpp"
#include "octafield/error.hpp"
#include "octafield/surface/feature_cut.hpp"
#include "octafield/surface/quantized_quads.hpp"
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
            const SingularPattern pattern = singular_pattern(direction, surface_singularities(direction));
            stage = "impose";
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
