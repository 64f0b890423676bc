#include "scheme_table.hpp"

#include <algorithm>

#include "embedding_smoothing.hpp"
#include "frozen_smoothing.hpp"
#include "metric_smoothing.hpp"
#include "octafield/frames/registry.hpp"
#include "odeco_smoothing.hpp"

namespace octafield::volume {
namespace {

using enum SmoothSolver;
using enum SchemeSort;

struct Row {
    Scheme scheme;
    Minimise minimise;
};

// What is known of an embedding beyond its formulas; a representation without a line here has the defaults.
struct Measured {
    std::string_view name, meaning;
    double bytes_per_tet, seconds_per_million_tets;  // of the trust region
    std::string_view colour;
};
constexpr Measured unknown = {"", "", 650, 0, ""};
// Colours: Okabe and Ito's, told apart with any colour vision, and some of Tol's.
constexpr Measured measured[] = {
    {"sh4", "spherical harmonics of degree 4", 450, 30, "#0072B2"},
    {"tensor4", "symmetric tensors of fourth order: sh4 in other coordinates", 450, 33, "#56B4E9"},
    {"su2", "the three invariants of the quaternion, as vectors: the naive scheme", 450, 70, "#D55E00"},
    {"odeco", "orthogonally decomposable tensors, axes of length 1", 450, 33, "#009E73"},
    {"sh469", "spherical harmonics of degrees 4, 6 and 9: su2 made isotropic", 650, 70, "#E69F00"},
};

template <frames::Representation R>
Row embedding_row() {
    const auto* known = std::find_if(std::begin(measured), std::end(measured),
                                     [](const Measured& line) { return line.name == std::string_view(R::name); });
    const Measured& line = known == std::end(measured) ? unknown : *known;
    return {{.name = std::string(R::name),
             .sort = embedding,
             .equation = "1/2 sum over components c of a_c^T L a_c, a = " + std::string(R::name) + "(frame) in R^" +
                         std::to_string(R::dimension),
             .meaning =
                 line.meaning.empty() ? "an embedding in R^" + std::to_string(R::dimension) : std::string(line.meaning),
             .consistent = frames::Equivariant<R>,  // isotropic: its metric is that of angles
             .descends = true,
             .solvers = {{trust_region, line.bytes_per_tet}, {levenberg_marquardt, 4800}, {lbfgs, 2000}},
             .seconds_per_million_tets = line.seconds_per_million_tets,
             .colour = std::string(line.colour),
             .compared = true},
            &smooth_embedding};
}

Row lengths_row() {
    return {{.name = "odeco_lengths",
             .sort = embedding_with_lengths,
             .equation = "1/2 sum over components c of a_c^T L a_c, a = sum_k length_k axis_k^4",
             .meaning = "tensors with the lengths of the axes as unknowns (Palmer, Bommes, Solomon 2020)",
             .consistent = false,  // of another field: the one of its lengths
             .descends = true,
             .solvers = {{lbfgs, 2000}, {levenberg_marquardt, 2000}},
             .seconds_per_million_tets = 1000,
             .colour = "#882255",
             .compared = false},
            &smooth_odeco_lengths};
}

// `difference`: d_ij, world axes, radians (docs/su2_smoothing.md). What differs from the defaults is set by the caller.
Row metric_row(std::string name, const std::string& difference, std::string meaning, Minimise minimise) {
    return {{.name = std::move(name),
             .sort = metric,
             .equation = "1/2 sum over edges ij of w_ij d_ij . d_ij, d_ij = " + difference,
             .meaning = std::move(meaning),
             .consistent = true,
             .descends = true,
             .solvers = {{levenberg_marquardt, 4000}, {lbfgs, 2000}},
             .seconds_per_million_tets = 0,
             .colour = "",
             .compared = false},
            minimise};
}

std::vector<Row> made() {
    std::vector<Row> rows;
    frames::Representations::for_each([&]<frames::Representation R>() { rows.push_back(embedding_row<R>()); });
    rows.push_back(lengths_row());
    const auto add = [&](Row row, double seconds, const char* colour, bool compared = false) {
        row.scheme.seconds_per_million_tets = seconds;
        row.scheme.colour = colour;
        row.scheme.compared = compared;
        rows.push_back(std::move(row));
    };
    add(metric_row("geodesic", "rotation vector of the smallest rotation from frame i to frame j",
                   "the angle between frames, matched anew at every evaluation", &smooth_metric<GeodesicScheme>),
        160, "#CC79A7", true);
    add(metric_row("su2_midpoint", "2 J^+(m) (h_j - h_i), m half-way, J = dh/d(u, v)",
                   "the invariants in the metric half-way, differentiated by both ends",
                   &smooth_metric<MidpointScheme>),
        250, "text", true);
    add(metric_row("su2_geodesic", "rotation vector between the frames read from h_i and h_j",
                   "the geodesic through the invariants' inverse map", &smooth_metric<Su2GeodesicScheme>),
        0, "#AA3355");
    add(metric_row("su2_symmetric", "2 J^+ (h_j - h_i) at m = i and at m = j, root mean square",
                   "the invariants in the metrics at both ends", &smooth_metric<SymmetricScheme>),
        0, "#7b8794");
    add(metric_row("su2_surface", "rotation vector of the shortest geodesic of the model surface from h_i to h_j",
                   "points of the model surface as unknowns, with its own tangents and geodesics",
                   &smooth_metric<SurfaceScheme>),
        0, "#117733");
    Row frozen = metric_row("su2_frozen", "2 J^+(m) (h_j - h_i), m half-way, held during each step",
                            "the metric held during a step: inconsistent, kept to show how it fails", &smooth_frozen);
    frozen.scheme.consistent = frozen.scheme.descends = false;
    add(std::move(frozen), 0, "#A58A1F");
    return rows;
}

const std::vector<Row>& table() {
    static const std::vector<Row> rows = made();
    return rows;
}

const Row& row(std::string_view name) {
    for (const Row& each : table())
        if (each.scheme.name == name) return each;
    std::vector<std::string> names;
    for (const Row& each : table()) names.push_back(each.scheme.name);
    frames::throw_unknown_name("representation", name, names);
}

}  // namespace

const std::vector<Scheme>& schemes() {
    static const std::vector<Scheme> all = [] {
        std::vector<Scheme> rows;
        for (const Row& each : table()) rows.push_back(each.scheme);
        return rows;
    }();
    return all;
}

const Scheme& scheme(std::string_view name) { return row(name).scheme; }

Minimise minimise_of(std::string_view name) { return row(name).minimise; }

}  // namespace octafield::volume
