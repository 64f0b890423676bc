// Quads of T-meshes.
#include "octafield/surface/quantized_quads.hpp"
#include "layout_fixtures.hpp"
#include "octafield/error.hpp"

namespace octafield::surface {
namespace {

void show(const char* name, const ImposedField& field, LayoutCurveOptions curves = {}) {
    for (const bool coarsest : {false, true}) {
    const QuadLayout layout = motorcycle_graph(field, curves);
    QuantizedQuadsOptions options;
    options.quad_count = 1000;
    options.coarsest = coarsest;
    const QuantizedQuads q = quantized_quads(layout, options);
    std::printf("%s: tiles %zu T %d quads %zd blocks %zd irregular %zu sj %.3f dev %.3f bound %.3f opt %d mv %d\n", name, layout.patches.size(), q.t_joints, q.mesh.quads.rows(),
                q.patch_sizes.rows(), q.irregular.size(), q.least_scaled_jacobian, q.deviation, q.bound, q.optimal, q.mean_value_patches);
    }
}

TEST(QuantizedQuads, Try) {
    show("disk", disk_field(26, four_in_disk(0.5, {0, 90, 180, 270})));
    show("L", l_shape_field(8));
    show("holed", holed_field(12));
    LayoutCurveOptions options;
    options.end_tolerance = 0.004;
    show("kite", disk_field(26, four_in_disk(0.85009, {0, 85, 180, 275})), options);
    show("kite2", disk_field(26, four_in_disk(0.85009, {0, 85, 180, 275})));
    show("annulus", impose_singular_points(SurfaceDomain(annulus(0.3, 64, 12)), {}));
}

TEST(QuantizedQuads, TryRandom) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int round = 0; round < 24; ++round) {
        std::vector<Source> sources;
        const int extra = round % 4;
        for (int i = 0; i < 4 + 2 * extra; ++i) {
            const int t = i < 4 + extra ? 1 : -1;
            sources.push_back(
                {std::polar(0.25 + 0.6 * unit(random), 2 * pi * (i + 0.7 * unit(random)) / (4 + 2 * extra)), t});
        }
        LayoutCurveOptions options;
        if (round % 2) options.end_tolerance = 0.002;
        try {
            show(("random" + std::to_string(round)).c_str(), disk_field(16, sources), options);
        } catch (const Error& e) {
            std::printf("random%d: %s %s\n", round, e.kind().c_str(), e.what());
        }
    }
}

TEST(QuantizedQuads, TryClosed) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    for (int round = 0; round < 6; ++round) {
        const SurfaceDomain domain(icosphere(4));
        SingularPattern pattern;
        for (int i = 0; i < 8; ++i) {
            Vector at(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
            if (round) at = Vector(normal(random), normal(random), normal(random));
            pattern.points.push_back(imposed_point(domain, at.normalized() * 0.999, 1));
        }
        const ImposedField field = impose_singular_points(domain, pattern);
        try {
            show("sphere", field);
            if (round == 0) show("sphere turned", turned_for_layout(field));
        } catch (const Error& e) {
            std::printf("sphere %d: %s %s\n", round, e.kind().c_str(), e.what());
        }
    }
    try {
        show("torus", impose_singular_points(SurfaceDomain(torus(60, 30, 1, 0.5)), {}));
    } catch (const Error& e) {
        std::printf("torus: %s %s\n", e.kind().c_str(), e.what());
    }
}

}  // namespace
}  // namespace octafield::surface
namespace octafield::surface {
TEST(QuantizedQuads, TorusDebug) {
    const QuadLayout l = motorcycle_graph(impose_singular_points(SurfaceDomain(torus(60, 30, 1, 0.5)), {}));
    for (auto& v : l.vertices) std::printf("v kind %d vertex %d\n", (int)v.kind, v.vertex);
    for (auto& s : l.sides) std::printf("s %d-%d curve %d length %g\n", s.first, s.last, s.curve, s.length());
    for (auto& p : l.patches) { std::printf("p chi %d corners %d:", p.euler_characteristic, p.corners); for (auto& lo : p.loops) for (auto& d : lo) std::printf(" %d%s", d.side, d.reversed ? "r" : ""); std::puts(""); }
    for (auto& c : l.curves.curves) std::printf("c %d %d len %g n %zu\n", c.first_vertex, c.last_vertex, c.points.back().length, c.points.size());
}
}
