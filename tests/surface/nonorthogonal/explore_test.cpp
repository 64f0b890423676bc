#include "lines_fixtures.hpp"
#include <chrono>
namespace octafield::surface { namespace {
void show(const char* name, const TriangleMesh& mesh, const NonOrthogonalFieldOptions& o) {
    const auto t0 = std::chrono::steady_clock::now();
    const auto f = non_orthogonal_field(mesh, o);
    const double s = std::chrono::duration<double>(std::chrono::steady_clock::now() - t0).count();
    const auto p = surface_singularities(f);
    std::printf("%-28s %-11s V %5ld E %.6g start %.6g it %d conv %d min %.4f deg inv %zu lea %.2f | in %zu sum %g chi %d agree %d dev %.2g  %.2fs\n", name, o.method.c_str(),
        (long)mesh.vertices.rows(), f.energy, f.start_energy, f.iterations, f.converged, f.smallest_angle/degree, f.inverted.size(), f.freedom, inside(p).size(), p.index_sum, p.euler_characteristic, p.agree, p.boundary_deviation, s);
    for (auto& q : inside(p)) std::printf("      t %d at %.3f %.3f r %.4f\n", q.index_times_symmetry, q.position.x(), q.position.y(), q.position.norm());
}
TEST(Explore, All) {
    for (const char* m : {"angles"}) {
        NonOrthogonalFieldOptions o; o.method = m;
        for (auto w : {EdgeWeights::cotangent, EdgeWeights::unit}) {
            o.weights = w;
            for (double a : {50., 46., 44., 40., 30., 20.}) show(("trap " + std::to_string(a)).c_str(), right_trapezoid(a*degree, 0.07), o);
        }
        o.weights = EdgeWeights::cotangent;
        for (double a : {60., 50., 45., 28.65}) show(("par " + std::to_string(a)).c_str(), parallelogram(a*degree, 0.08), o);
        show("disk", disk(11), o);
        for (double a : {15., 30., 45., 60., 75.}) show(("wedge " + std::to_string(a)).c_str(), wedge(a*degree, 0.05), o);
        if (o.method != "poly_vector") {
            o.second_line = SecondLine::free;
            for (double a : {60., 50., 45., 28.65}) show(("par free " + std::to_string(a)).c_str(), parallelogram(a*degree, 0.08), o);
            for (double a : {50., 46., 44., 40., 30., 20.}) show(("trap free " + std::to_string(a)).c_str(), right_trapezoid(a*degree, 0.07), o);
            show("disk free", disk(11), o);
        }
    }
    NonOrthogonalFieldOptions o;
    show("sphere", icosphere(3), o);
    show("torus", testing::torus(40, 20, 1, 0.5), o);
}
}}
