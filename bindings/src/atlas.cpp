// Maps of surfaces to the plane, one-to-one: disks and atlases.
#include "octafield/surface/atlas.hpp"

#include "arrays.hpp"
#include "bind.hpp"
#include "checks.hpp"
#include "domain.hpp"
#include "interruptible.hpp"
#include "octafield/surface/bisected_edges.hpp"
#include "options.hpp"

namespace octafield::bindings {

using namespace surface;
using py::literals::operator""_a;

void check(const AtlasOptions& options) { finite(options.conformity, "conformity"); }

namespace {

void check_plane(const PlanePoints& uv) {
    if (!uv.allFinite()) throw InvalidInput("uv: not finite", "non_finite");
}

void bind_map_types(py::module_& m) {
    Record<DiskParameterization>(m, "DiskParameterization", "A surface mapped to the unit disk by parameterize_disk.")
        .field("uv", &DiskParameterization::uv, "(V, 2) float64.")
        .field("loops", &DiskParameterization::loops,
               "List of int32 arrays: boundary curves, surface on the left; the first one is on the circle.")
        .finish([](const DiskParameterization& p) {
            return count(p.uv.rows(), "vertex", "vertices") + ", " +
                   count(static_cast<std::ptrdiff_t>(p.loops.size()), "loop");
        });
    Record<MapDistortion>(m, "MapDistortion", "What a map to the plane does to each triangle.")
        .field("singular_values", &MapDistortion::singular_values,
               "(F, 2) float64: lengths on the surface over lengths in the plane, the larger first; infinite and 0 for "
               "flat triangles.")
        .field("conformity", &MapDistortion::conformity,
               "(F,) float64: second over first, 1 where circles stay circles.")
        .finish([](const MapDistortion& d) { return count(d.conformity.size(), "triangle"); });
    Record<BisectedEdges>(m, "BisectedEdges", "A surface with long edges halved.")
        .field("domain", &BisectedEdges::domain, "SurfaceDomain: the input's vertices first.")
        .field("parents", &BisectedEdges::parents, "(F,) int32: triangle of the input that each is part of.")
        .finish([](const BisectedEdges& b) { return count(b.domain.triangle_count(), "triangle"); });
}

void bind_atlas_records(py::module_& m) {
    Record<AtlasOptions>(m, "AtlasOptions", "Options of atlas: its keyword arguments, with their defaults.")
        .field("conformity", &AtlasOptions::conformity,
               "Least conformity (MapDistortion) of each chart, but for 5 % of its area, in [0, 1).")
        .field("max_triangles", &AtlasOptions::max_triangles, "Of a chart, at least 1.")
        .field("bisect", &AtlasOptions::bisect, "Whether coarse faces that miss the conformity get vertices inside.")
        .finish([](const AtlasOptions& o) {
            return "conformity=" + number(o.conformity) + ", max_triangles=" + std::to_string(o.max_triangles);
        });
    Record<AtlasChart>(m, "AtlasChart", "One chart of an Atlas in figures.")
        .field("triangles", &AtlasChart::triangles, "How many it has.")
        .field("area", &AtlasChart::area, "Input unit squared.")
        .field("loops", &AtlasChart::loops, "Boundary curves; all but the outer one are holes.")
        .field("conformity", &AtlasChart::conformity, "5 % of the area have less.")
        .field("least_conformity", &AtlasChart::least_conformity, "Of its triangles.")
        .field("mean_conformity", &AtlasChart::mean_conformity, "By area.")
        .field("evenness", &AtlasChart::evenness,
               "The least sqrt(area in the plane / area) over its mean; 5 % of the area have less.")
        .field("as_asked", &AtlasChart::as_asked, "Whether it has the conformity asked for.")
        .finish([](const AtlasChart& c) {
            return count(c.triangles, "triangle") + ", conformity " + number(c.conformity);
        });
    Record<AtlasFace>(m, "AtlasFace", "One connected part of a surface between features.")
        .field("genus", &AtlasFace::genus, "Handles.")
        .field("loops", &AtlasFace::loops, "Boundary curves.")
        .field("triangles", &AtlasFace::triangles, "How many it has.")
        .finish([](const AtlasFace& f) { return "genus " + std::to_string(f.genus) + ", " + count(f.loops, "loop"); });
    Record<Atlas>(m, "Atlas", "A surface as one-to-one charts, as atlas makes it.")
        .field("domain", &Atlas::domain, "SurfaceDomain: the input, or with triangles bisected.")
        .field("parents", &Atlas::parents, "(F,) int32: triangle of the input that each is part of.")
        .field("faces", &Atlas::faces, "(F,) int32: place in face_list.")
        .field("charts", &Atlas::charts, "(F,) int32: place in chart_list.")
        .field("uv", &Atlas::uv, "(n, 2) float64 of the charts' vertices, each chart round its own origin.")
        .field("uv_triangles", &Atlas::uv_triangles, "(F, 3) int32 rows of uv.")
        .field("origins", &Atlas::origins, "(n,) int32: vertex of the domain of each row of uv.")
        .field("cuts", &Atlas::cuts,
               "(c, 2) int32: edges across which charts or u, v end, but for features and the boundary.")
        .field("conformity", &Atlas::conformity, "(F,) float64.")
        .field("face_list", &Atlas::face_list, "List of AtlasFace.")
        .field("chart_list", &Atlas::chart_list, "List of AtlasChart.")
        .finish([](const Atlas& a) {
            return count(static_cast<std::ptrdiff_t>(a.chart_list.size()), "chart") + " of " +
                   count(static_cast<std::ptrdiff_t>(a.face_list.size()), "face") + ", " +
                   count(a.domain.triangle_count(), "triangle");
        });
}

void bind_disks(py::module_& m) {
    m.def(
        "mean_value_weights",
        [](const SurfaceOrMesh& surface) {
            auto [places, weights] = run_interruptible([surface](Job&) {
                const auto matrix = mean_value_weights(domain_of(surface));
                std::pair<Edges, Eigen::VectorXd> result{Edges(matrix.nonZeros(), 2), matrix.nonZeros()};
                Eigen::Index n = 0;
                for (Eigen::Index i = 0; i < matrix.outerSize(); ++i)
                    for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator at(matrix, i); at; ++at, ++n) {
                        result.first.row(n) << static_cast<Index>(at.row()), static_cast<Index>(at.col());
                        result.second[n] = at.value();
                    }
                return result;
            });
            return std::pair(own(std::move(places)), own(std::move(weights)));
        },
        "surface"_a,
        "Mean value weights lambda_ij (Floater 2003) as ((n, 2) int32 i, j, sorted, (n,) float64): (tan(theta/2) + "
        "tan(theta'/2)) / l_ij, of the triangles beside each edge, with their angles at i. Positive, not symmetric.");
    m.def(
        "boundary_loops",
        [](const SurfaceOrMesh& surface) {
            auto loops = run_interruptible([surface](Job&) { return boundary_loops(domain_of(surface)); });
            std::vector<py::array_t<Index>> arrays;
            for (auto& loop : loops) arrays.push_back(own(std::move(loop)));
            return arrays;
        },
        "surface"_a,
        "Boundary curves as a list of int32 arrays of vertices, surface on the left, the longest first. Raises "
        "GeometryError "
        "(kind \"non_manifold_vertex\") where two touch.");
    m.def(
        "parameterize_disk",
        [](const SurfaceOrMesh& surface, bool fill_holes) {
            return run_interruptible(
                [=](Job&) { return parameterize_disk(domain_of(surface), {.fill_holes = fill_holes}); });
        },
        "surface"_a, py::kw_only(), "fill_holes"_a = DiskOptions{}.fill_holes,
        "The one-to-one map of a connected surface without handles, with a boundary, to the unit disk, as a "
        "DiskParameterization: mean value coordinates (Floater 2003), the longest boundary curve on the circle by its "
        "lengths. Every triangle is positive in exact arithmetic.\n\n"
        "fill_holes: triangles with a vertex in the middle are imagined in each hole; False: the images of holes are "
        "convex. Raises GeometryError (kinds \"not_connected\", \"closed\", \"not_planar\", \"non_manifold_vertex\", "
        "\"not_one_to_one\": doubles do not show some triangles as positive).");
    m.def(
        "not_positive",
        [](const ArrayLike& uv, const ArrayLike& triangles) {
            auto plane = from_python<PlanePoints>(uv, "uv");
            auto corners = from_python<Triangles>(triangles, "triangles");
            return own(run_interruptible([plane = std::move(plane), corners = std::move(corners)](Job&) {
                check_plane(plane);
                if (corners.rows() > 0 && (corners.minCoeff() < 0 || corners.maxCoeff() >= plane.rows()))
                    throw InvalidInput("triangles: names rows of uv that do not exist", "index_out_of_range");
                return not_positive(plane, corners);
            }));
        },
        "uv"_a, "triangles"_a,
        "(k,) int32: triangles of (n, 2) points of the plane that are not positive (flat or turned over), in exact "
        "arithmetic.");
}

void bind_distortion(py::module_& m) {
    m.def(
        "map_distortion",
        [](const SurfaceOrMesh& surface, const ArrayLike& uv, const ArrayLike& uv_triangles) {
            auto plane = from_python<PlanePoints>(uv, "uv");
            auto corners = from_python<Triangles>(uv_triangles, "uv_triangles");
            return run_interruptible([surface, plane = std::move(plane), corners = std::move(corners)](Job&) {
                check_plane(plane);
                return map_distortion(domain_of(surface), plane, corners);
            });
        },
        "surface"_a, "uv"_a, "uv_triangles"_a,
        "Singular values and conformity of a map of each triangle to the plane, as a MapDistortion. uv_triangles: (F, "
        "3) "
        "rows of uv for the corners of each triangle.");
    m.def(
        "plane_metric",
        [](const SurfaceOrMesh& surface, const ArrayLike& uv, const ArrayLike& uv_triangles, double h) {
            auto plane = from_python<PlanePoints>(uv, "uv");
            auto corners = from_python<Triangles>(uv_triangles, "uv_triangles");
            return own(run_interruptible([surface, plane = std::move(plane), corners = std::move(corners), h](Job&) {
                check_plane(plane);
                return plane_metric(domain_of(surface), plane, corners, h);
            }));
        },
        "surface"_a, "uv"_a, "uv_triangles"_a, "h"_a,
        "(F, 3) float64: entries uu, uv, vv of J^T J / h^2 of each triangle, the metric of the plane for edges of "
        "length h "
        "on the surface.");
    m.def(
        "bisected_edges",
        [](const SurfaceOrMesh& surface, const ArrayLike& longest, Index most_triangles) {
            auto lengths = from_python<Eigen::VectorXd>(longest, "longest");
            return run_interruptible([surface, lengths = std::move(lengths), most_triangles](Job&) {
                return bisected_edges(domain_of(surface), lengths, most_triangles);
            });
        },
        "surface"_a, "longest"_a, py::kw_only(), "most_triangles"_a = 50000000,
        "The surface with edges longer than longest, (F,) > 0 (infinity: any), halved, the longest first, with the "
        "triangles "
        "beside them, as BisectedEdges: the geometry is the same. Raises InvalidInput (kind \"too_many\").");
}

void bind_atlases(py::module_& m) {
    m.def(
        "atlas",
        [](const SurfaceOrMesh& surface, const std::optional<ProgressCallable>& progress, const py::kwargs& given) {
            const auto [options] = options_of<AtlasOptions>("atlas", given);
            return run_interruptible(
                [surface, options = options](Job& job) {
                    return surface::atlas(domain_of(surface), options, job.progress());
                },
                progress);
        },
        "surface"_a, py::kw_only(), "progress"_a = py::none(),
        "A surface of any kind as few one-to-one charts, as an Atlas: mean value coordinates of the faces between "
        "features, "
        "cut open along short curves where they are closed, have handles or are mapped too unevenly, and split where "
        "that is "
        "not enough. Every triangle of every chart is positive in exact arithmetic.\n\n"
        "conformity: least ratio of the two stretches that all but 5 % of a chart's area have; max_triangles: of a "
        "chart; "
        "bisect: coarse faces that miss the conformity get vertices inside, the geometry stays. Raises InvalidInput, "
        "GeometryError.");
    list_options<AtlasOptions>(m, "atlas");
    m.def(
        "packed_uv",
        [](const Atlas& atlas) {
            auto [uv, scale] = run_interruptible([atlas](Job&) {
                double scale = 0;
                PlanePoints uv = packed_uv(atlas, &scale);
                return std::pair(std::move(uv), scale);
            });
            return std::pair(own(std::move(uv)), scale);
        },
        "atlas"_a,
        "((n, 2) float64, float): u, v of an Atlas' charts side by side in the unit square, and the scale: lengths "
        "there over "
        "those on the surface, on average over each chart.");
}

}  // namespace

void bind_atlas_types(py::module_& m) {
    bind_map_types(m);
    bind_atlas_records(m);
}

void bind_atlas(py::module_& m) {
    bind_disks(m);
    bind_distortion(m);
    bind_atlases(m);
}

}  // namespace octafield::bindings
