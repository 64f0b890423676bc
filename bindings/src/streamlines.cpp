// Curves along direction fields: streamlines, separatrices, evenly spread ones.
#include "octafield/surface/streamlines.hpp"

#include "arrays.hpp"
#include "bind.hpp"
#include "checks.hpp"
#include "interruptible.hpp"
#include "octafield/surface/non_orthogonal_streamlines.hpp"

namespace octafield::bindings {

using namespace surface;
using py::literals::operator""_a;

namespace {

// What every curve is traced in; owned by the work that traces.
template <class Field>
struct Surroundings {
    Field field;
    SurfaceSingularities singularities;

    void check_all() const {
        if constexpr (std::is_same_v<Field, DirectionField>) check(field);  // the other one's own functions do
        check(singularities, field.domain.mesh());
    }
};

StreamlineOptions tracing(double max_length, bool both_ways, bool stop_at_features, double singular_radius) {
    return {.max_length = finite(max_length, "max_length"),
            .both_ways = both_ways,
            .stop_at_features = stop_at_features,
            .singular_radius = finite(singular_radius, "singular_radius")};
}

// Rows of the seeds' arrays side by side; no weights: the centroids.
std::vector<StreamlineSeed> seeds_of(const std::vector<Index>& triangles, const Points& directions,
                                     const std::optional<Points>& weights) {
    const auto n = static_cast<std::int64_t>(triangles.size());
    check_vectors(directions, n, "directions", "seed");
    if (weights) check_vectors(*weights, n, "weights", "seed");
    std::vector<StreamlineSeed> seeds;
    seeds.reserve(triangles.size());
    for (std::int64_t i = 0; i < n; ++i) {
        seeds.push_back({triangles[i], directions.row(i)});
        if (weights) seeds.back().weights = weights->row(i);
    }
    return seeds;
}

constexpr const char* of_seeds =
    "One curve along the field per seed, as a list of Streamline. Seed i lies in triangles[i] and takes, of the N "
    "directions there, the one nearest to directions[i]; weights: (n, 3) barycentric, the centroids if left out. "
    "max_length: input unit, from the seed each way, 0 means 4 times octafield.surface.shape_size; both_ways: "
    "against "
    "the direction as well; singular_radius: a curve ends that near to a singular point, 0 means half the mean "
    "edge length. Raises InvalidInput naming the seeds that are outside the mesh or have no direction in their "
    "triangle's plane.";
constexpr const char* of_seeds_non_orthogonal =
    "Of a non-orthogonal field: its lines are two families, and each of the four directions at a seed may be given.";
constexpr const char* of_points =
    "From every singular point one curve for each direction that runs straight away from it, as a list of "
    "Streamline: N - k for index k/N inside the surface (3 for index +1/4 and 5 for -1/4 of a cross field), the "
    "directions between the two boundary edges for a point on the boundary. A feature edge along such a direction "
    "is that separatrix itself and not traced. Options as for streamlines. Raises InvalidInput, Cancelled.";
constexpr const char* of_points_non_orthogonal =
    "Of a non-orthogonal field: 4 - t curves from a point of index t/4 inside the surface, quads - 1 from a boundary "
    "vertex.";

template <class Field>
void bind_seeded(py::module_& m, const char* doc) {
    const StreamlineOptions defaults;
    m.def(
        "streamlines",
        [](const Field& field, const SurfaceSingularities& singularities, const ArrayLike& triangles,
           const ArrayLike& directions, const std::optional<ArrayLike>& weights, double max_length, bool both_ways,
           bool stop_at_features, double singular_radius) {
            std::optional<Points> barycentric;
            if (weights) barycentric = from_python<Points>(*weights, "weights");
            return run_interruptible(
                [on = Surroundings<Field>{field, singularities},
                 seeds = seeds_of(from_python<std::vector<Index>>(triangles, "triangles"),
                                  from_python<Points>(directions, "directions"), barycentric),
                 options = tracing(max_length, both_ways, stop_at_features, singular_radius)](Job&) {
                    on.check_all();
                    return streamlines(on.field, on.singularities, seeds, options);
                });
        },
        "field"_a, "singularities"_a, "triangles"_a, "directions"_a, "weights"_a = py::none(), py::kw_only(),
        "max_length"_a = defaults.max_length, "both_ways"_a = defaults.both_ways,
        "stop_at_features"_a = defaults.stop_at_features, "singular_radius"_a = defaults.singular_radius, doc);
}

template <class Field>
void bind_separatrices(py::module_& m, const char* doc) {
    const StreamlineOptions defaults;
    m.def(
        "separatrices",
        [](const Field& field, const SurfaceSingularities& singularities, double max_length, bool stop_at_features,
           double singular_radius, const std::optional<ProgressCallable>& progress) {
            return run_interruptible(
                [on = Surroundings<Field>{field, singularities},
                 options = tracing(max_length, false, stop_at_features, singular_radius)](Job& job) {
                    on.check_all();
                    return separatrices(on.field, on.singularities, options, job.progress());
                },
                progress);
        },
        "field"_a, "singularities"_a, py::kw_only(), "max_length"_a = defaults.max_length,
        "stop_at_features"_a = defaults.stop_at_features, "singular_radius"_a = defaults.singular_radius,
        "progress"_a = py::none(), doc);
}

void bind_even(py::module_& m) {
    const EvenStreamlineOptions defaults;
    m.def(
        "even_streamlines",
        [](const DirectionField& field, const SurfaceSingularities& singularities, double spacing, double stop_ratio,
           double min_length, double max_length, bool both_ways, bool stop_at_features, double singular_radius,
           const std::optional<ProgressCallable>& progress) {
            const EvenStreamlineOptions options{
                .spacing = finite(spacing, "spacing"),
                .stop_ratio = finite(stop_ratio, "stop_ratio"),
                .min_length = finite(min_length, "min_length"),
                .tracing = tracing(max_length, both_ways, stop_at_features, singular_radius)};
            return run_interruptible(
                [on = Surroundings<DirectionField>{field, singularities}, options](Job& job) {
                    on.check_all();
                    return even_streamlines(on.field, on.singularities, options, job.progress());
                },
                progress);
        },
        "field"_a, "singularities"_a, py::kw_only(), "spacing"_a = defaults.spacing,
        "stop_ratio"_a = defaults.stop_ratio, "min_length"_a = defaults.min_length,
        "max_length"_a = defaults.tracing.max_length, "both_ways"_a = defaults.tracing.both_ways,
        "stop_at_features"_a = defaults.tracing.stop_at_features,
        "singular_radius"_a = defaults.tracing.singular_radius, "progress"_a = py::none(),
        "Curves that cover the surface at an even distance, one family per direction (2 for crosses; after Jobard and "
        "Lefer 1997), as a list of Streamline. spacing: between neighbours, input unit, 0 means 1/60 of "
        "octafield.surface.shape_size; stop_ratio: a curve ends nearer to another one than this part of it, in (0, 1]; "
        "min_length: "
        "shorter curves are dropped unless closed, 0 means the spacing; the others as for streamlines. Raises "
        "InvalidInput, Cancelled.");
}

}  // namespace

void bind_streamlines(py::module_& m) {
    bind_seeded<DirectionField>(m, of_seeds);
    bind_seeded<NonOrthogonalField>(m, of_seeds_non_orthogonal);
    bind_separatrices<DirectionField>(m, of_points);
    bind_separatrices<NonOrthogonalField>(m, of_points_non_orthogonal);
    bind_even(m);
}

}  // namespace octafield::bindings
