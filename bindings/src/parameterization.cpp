// What parameterizations ask of a frame field: matchings, combed axes, boundary conditions, sizes.
#include <algorithm>

#include "arrays.hpp"
#include "bind.hpp"
#include "domain.hpp"
#include "interruptible.hpp"
#include "octafield/volume/alignment_tables.hpp"
#include "octafield/volume/combing.hpp"
#include "octafield/volume/scaling.hpp"
#include "record.hpp"

namespace octafield::bindings {

using namespace volume;
using py::literals::operator""_a;
using surface::FeatureGraph;

namespace {

std::string digits_of(double x) { return py::str(py::float_(x)).cast<std::string>(); }

void bind_combing_types(py::module_& m) {
    Record<FaceMatchings>(m, "FaceMatchings", "Matchings of frames in the tets across every triangle between two.")
        .field("triangles", &FaceMatchings::triangles,
               "(f, 3) int32 vertex ids, ascending in each row, rows in lexicographic order.")
        .field("tets", &FaceMatchings::tets, "(f, 2) int32: the tets on its sides, lower first.")
        .field("matching", &FaceMatchings::matching,
               "(f,) uint8: number of the element o of the octahedral group for which q1 o is close to q2, q1 and q2 "
               "the frames of the first and second tet. An axis a of the first, in that frame's coordinates, is o^-1 a "
               "in the second.")
        .finish([](const FaceMatchings& faces) { return count(faces.tets.rows(), "triangle"); });

    Record<CombedField>(m, "CombedField",
                        "A field in the tets whose axes correspond by number and sign across all triangles but a cut.")
        .field("frames", &CombedField::frames,
               "(m, 4) float64 quaternions w x y z: q o, with signs that agree along the spanning tree.")
        .field("element", &CombedField::element,
               "(m,) uint8: o, an element of the octahedral group; 0 in the lowest tet of each part.")
        .field("faces", &CombedField::faces, "FaceMatchings of `frames`: 0 but on the cut, where it may be 0 too.")
        .field("cut", &CombedField::cut, "(f,) uint8, 1: the triangle is of the cut.")
        .field("parts", &CombedField::parts, "Parts of the mesh that triangles connect.")
        .finish([](const CombedField& field) {
            std::ptrdiff_t cut = 0;
            for (const auto c : field.cut) cut += c;
            return count(field.frames.rows(), "tet") + ", " + count(cut, "triangle") + " cut";
        });

    Record<CombedVertices>(
        m, "CombedVertices",
        "A field at the vertices whose axes correspond by number and sign but across a cut that singular curves end.")
        .field("frames", &CombedVertices::frames,
               "(n, 4) float64 quaternions w x y z: q o, with signs that agree where the axes do.")
        .field("element", &CombedVertices::element, "(n,) uint8: o, an element of the octahedral group.")
        .field("agree", &CombedVertices::agree, "(m,) uint8: axes_agree of `frames`.")
        .field("parts", &CombedVertices::parts, "Parts of the mesh that edges connect.")
        .finish([](const CombedVertices& field) {
            const std::ptrdiff_t cut = std::count(field.agree.begin(), field.agree.end(), 0);
            return count(field.frames.rows(), "frame") + ", axes agree in all tets but " + std::to_string(cut);
        });

    Record<AlignmentTables>(m, "AlignmentTables",
                            "Which axes of a combed field the surface and its feature curves hold. Axes are 1, 2, 3 "
                            "for x, y, z of the frame of the tet named, negative for their opposites.")
        .field("triangle_tet", &AlignmentTables::triangle_tet,
               "(F,) int32, per triangle of the surface: tet behind it.")
        .field("triangle_axis", &AlignmentTables::triangle_axis, "(F,) int32: axis nearest to its outward normal.")
        .field("triangle_angle", &AlignmentTables::triangle_angle, "(F,) float64: radians between the two.")
        .field("triangle_patch", &AlignmentTables::triangle_patch,
               "(F,) int32: patch, triangles joined across edges that are no features and have two of them.")
        .field("patch_one_axis", &AlignmentTables::patch_one_axis,
               "(patches,) uint8, 1: one axis is normal all over, once matchings on the cut are applied.")
        .field("feature_edges", &AlignmentTables::feature_edges,
               "(E, 2) int32, per feature edge: tet-mesh vertices a, b.")
        .field("feature_tet", &AlignmentTables::feature_tet, "(E,) int32: the lowest tet at it.")
        .field("feature_axis", &AlignmentTables::feature_axis, "(E,) int32: axis nearest to b - a.")
        .field("feature_angle", &AlignmentTables::feature_angle, "(E,) float64: radians between the two.")
        .finish([](const AlignmentTables& t) {
            return count(static_cast<std::ptrdiff_t>(t.triangle_tet.size()), "triangle") + ", " +
                   count(static_cast<std::ptrdiff_t>(t.patch_one_axis.size()), "patch", "patches") + ", " +
                   count(t.feature_edges.rows(), "feature edge");
        });
}

void bind_scaling_types(py::module_& m) {
    Record<ScaledIntegrability>(m, "ScaledIntegrability",
                                "How far axes h_i n_i of given lengths h_i are from the gradients of a map.")
        .field("curl_rms", &ScaledIntegrability::curl_rms,
               "Of curl(h_i n_i) / h_i, root of the sum over the axes; root mean square weighted by volume, 1 / input "
               "unit.")
        .field("curl_max", &ScaledIntegrability::curl_max, "The largest.")
        .field("jump_rms", &ScaledIntegrability::jump_rms,
               "As of Integrability, each axis's divided by its mean length on both sides.")
        .field("jump_max", &ScaledIntegrability::jump_max, "The largest.")
        .field("curl", &ScaledIntegrability::curl, "(m,) float64, per tet.")
        .finish([](const ScaledIntegrability& s) {
            return "curl " + digits_of(s.curl_rms) + ", at most " + digits_of(s.curl_max) + "; jump " + digits_of(s.jump_rms) +
                   ", at most " + digits_of(s.jump_max);
        });

    Record<IsotropicScale>(m, "IsotropicScale", "One log-density H for all axes: grid cells of size exp(-H).")
        .field("log_scale", &IsotropicScale::log_scale,
               "(n,) float64 H at the vertices, of mean 0 in each part of the mesh.")
        .field("before", &IsotropicScale::before, "ScaledIntegrability of the unit axes.")
        .field("after", &IsotropicScale::after, "ScaledIntegrability of the axes times exp(H).")
        .field("parts", &IsotropicScale::parts, "Parts of the mesh.")
        .field("iterations", &IsotropicScale::iterations, "Of conjugate gradients.")
        .finish([](const IsotropicScale& s) {
            return "curl " + digits_of(s.before.curl_rms) + " before, " + digits_of(s.after.curl_rms) + " after";
        });

    Record<AxisScales>(m, "AxisScales", "One log-density H_i per axis: grid cells of sizes exp(-H_i).")
        .field("values", &AxisScales::values,
               "(k,) float64 H per unknown, of mean 0 in each set of axes that matchings connect.")
        .field("unknowns", &AxisScales::unknowns,
               "(m, 12) int32, column 3 c + i: place in `values` of axis i of the tet's frame at its corner c.")
        .field("log_scales", &AxisScales::log_scales,
               "(m, 3) float64 H_i at the centres, for the axes of the tets' frames.")
        .field("of_tets", &AxisScales::of_tets, "(m, 4) float64: those frames, of tet_frames.")
        .field("before", &AxisScales::before, "ScaledIntegrability of the unit axes.")
        .field("after", &AxisScales::after, "ScaledIntegrability of the axes times exp(H_i).")
        .field("parts", &AxisScales::parts,
               "Sets of axes: three per part of the mesh, less where singular curves exchange them.")
        .field("iterations", &AxisScales::iterations, "Of conjugate gradients.")
        .finish([](const AxisScales& s) {
            return "curl " + digits_of(s.before.curl_rms) + " before, " + digits_of(s.after.curl_rms) + " after; " +
                   count(s.parts, "set") + " of axes";
        });
}

void bind_combing(py::module_& m) {
    m.def(
        "face_matchings",
        [](const DomainOrMesh& mesh, const ArrayLike& of_tets, int threads) {
            threads_option(threads);
            return run_interruptible([=, rows = from_python<Quaternions>(of_tets, "of_tets")](Job&) mutable {
                const TetDomain domain = domain_of(mesh);
                check_unit(rows, domain.tet_count(), "of_tets");
                return face_matchings(domain, rows, threads);
            });
        },
        "domain"_a, "of_tets"_a, py::kw_only(), "threads"_a = 0,
        "Matchings of (m, 4) frames in the tets across every triangle between two, as FaceMatchings.");
    m.def(
        "comb_vertices",
        [](const DomainOrMesh& mesh, const ArrayLike& frames, int threads) {
            threads_option(threads);
            return run_interruptible([=, rows = from_python<Quaternions>(frames, "frames")](Job&) mutable {
                const TetDomain domain = domain_of(mesh);
                check_unit(rows, domain.vertex_count(), "frames");
                return comb_vertices(domain, rows, threads);
            });
        },
        "domain"_a, "frames"_a, py::kw_only(), "threads"_a = 0,
        "Representatives of (n, 4) frames at the vertices, so that axes of neighbours correspond by number and sign but "
        "across a cut that ends at the singular curves that turn them, as CombedVertices. Results of octafield are "
        "combed already. A combed field stays as it is.");
    m.def(
        "axes_agree",
        [](const DomainOrMesh& mesh, const ArrayLike& frames, int threads) {
            threads_option(threads);
            return own(run_interruptible([=, rows = from_python<Quaternions>(frames, "frames")](Job&) mutable {
                const TetDomain domain = domain_of(mesh);
                check_unit(rows, domain.vertex_count(), "frames");
                return axes_agree(domain, rows, threads);
            }));
        },
        "domain"_a, "frames"_a, py::kw_only(), "threads"_a = 0,
        "(m,) uint8 per tet, 1: the axes of its four frames, (n, 4) at the vertices, correspond by number and sign, so "
        "that each may be interpolated by itself; 0: use sample_frames there.");
    m.def(
        "comb",
        [](const DomainOrMesh& mesh, const ArrayLike& of_tets, int threads) {
            threads_option(threads);
            return run_interruptible([=, rows = from_python<Quaternions>(of_tets, "of_tets")](Job&) mutable {
                const TetDomain domain = domain_of(mesh);
                check_unit(rows, domain.tet_count(), "of_tets");
                return comb(domain, rows, threads);
            });
        },
        "domain"_a, "of_tets"_a, py::kw_only(), "threads"_a = 0,
        "(m, 4) frames in the tets with representatives chosen so that the axes of neighbours correspond but across a "
        "cut, which leaves each part of the mesh simply connected and touches every singular edge, as CombedField.");
    m.def(
        "alignment_tables",
        [](const DomainOrMesh& mesh, const CombedField& combed) {
            return run_interruptible([=](Job&) {
                const TetDomain domain = domain_of(mesh);
                return alignment_tables(domain, combed);
            });
        },
        "domain"_a, "combed"_a,
        "Which axes of a combed field the triangles of a surface, boundary_surface(mesh) or region_surface's, and its "
        "feature edges hold, as AlignmentTables: the boundary conditions of a parameterization.");
}

void bind_scaling(py::module_& m) {
    const AxisScaleOptions defaults;
    m.def(
        "isotropic_scale",
        [](const DomainOrMesh& mesh, const ArrayLike& frames, int threads) {
            threads_option(threads);
            return run_interruptible([=, rows = from_python<Quaternions>(frames, "frames")](Job&) mutable {
                const TetDomain domain = domain_of(mesh);
                check_unit(rows, domain.vertex_count(), "frames");
                return isotropic_scale(domain, rows, threads);
            });
        },
        "domain"_a, "frames"_a, py::kw_only(), "threads"_a = 0,
        "The log-density H, one for all axes, for which (n, 4) frames at the vertices times exp(H) have the least curl "
        "(after Beaufort 2019, conclusion, section 2), as IsotropicScale. The same bits at any thread count.");
    m.def(
        "axis_scales",
        [](const DomainOrMesh& mesh, const ArrayLike& frames, double along, int threads) {
            threads_option(threads);
            const AxisScaleOptions options{along, threads};
            return run_interruptible([=, rows = from_python<Quaternions>(frames, "frames")](Job&) mutable {
                const TetDomain domain = domain_of(mesh);
                check_unit(rows, domain.vertex_count(), "frames");
                return axis_scales(domain, rows, options);
            });
        },
        "domain"_a, "frames"_a, py::kw_only(), "along"_a = defaults.along, "threads"_a = 0,
        "The same with one log-density per axis, as AxisScales. along: weight in (0, 1] of the change of H_i along its "
        "own axis, which no curl sees.");
}

}  // namespace

void bind_parameterization_types(py::module_& m) {
    bind_combing_types(m);
    bind_scaling_types(m);
}

void bind_parameterization(py::module_& m) {
    bind_combing(m);
    bind_scaling(m);
}

}  // namespace octafield::bindings
