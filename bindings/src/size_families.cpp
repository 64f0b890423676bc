// Sizes along the streamlines of cross fields, their anisotropy, and closed streamlines.
#include "octafield/surface/size_families.hpp"

#include "bind.hpp"
#include "checks.hpp"
#include "domain.hpp"
#include "interruptible.hpp"
#include "octafield/surface/limit_cycles.hpp"
#include "options.hpp"

namespace octafield::bindings {

using namespace surface;
using py::literals::operator""_a;

void check(const SizeFamilyOptions& options) {
    finite(options.spacing, "spacing");
    finite(options.max_length, "max_length");
    finite(options.singular_radius, "singular_radius");
}

void check(const LimitCycleOptions& options) {
    finite(options.max_length, "max_length");
    finite(options.tolerance, "tolerance");
    finite(options.band_width, "band_width");
}

namespace {

void bind_family_results(py::module_& m) {
    Record<SizeFamilies>(m, "SizeFamilies", "The sizes that streamlines leave to quads, at their least anisotropy.")
        .field("lines", &SizeFamilies::lines, "List of Streamline.")
        .field("positions", &SizeFamilies::positions, "(n, 3) float64: crossings of two lines.")
        .field("triangles", &SizeFamilies::triangles, "(n,) int32 triangle of each.")
        .field("crossing_lines", &SizeFamilies::crossing_lines, "(n, 2) int32 places in `lines`.")
        .field("log_widths", &SizeFamilies::log_widths,
               "(n, 2) float64: logarithms of the widths that the two lines carry there, the sides of a quad.")
        .field("worst_anisotropy", &SizeFamilies::worst_anisotropy, "Longer over shorter side, of all crossings.")
        .field("mean_anisotropy", &SizeFamilies::mean_anisotropy, "Geometric mean.")
        .field("objective", &SizeFamilies::objective, "The least sum over crossings.")
        .field("iterations", &SizeFamilies::iterations, "Of Newton's method.")
        .field("converged", &SizeFamilies::converged, "Whether it came to rest.")
        .field("self_crossings", &SizeFamilies::self_crossings, "Of a line with itself, which are left out.")
        .field("parts", &SizeFamilies::parts, "Of the crossed lines, connected by crossings.")
        .field("left_out", &SizeFamilies::left_out, "Lines that came too near to singular points.")
        .field("log_anisotropy", &SizeFamilies::log_anisotropy, "(V,) float64: smooth fit to its logarithms.")
        .field("log_sizes", &SizeFamilies::log_sizes, "(V,) float64: smooth fit to those of the mean side.")
        .finish([](const SizeFamilies& f) {
            return count(static_cast<std::ptrdiff_t>(f.lines.size()), "line") + ", " +
                   count(f.positions.rows(), "crossing") + ", worst anisotropy " + number(f.worst_anisotropy);
        });
    Record<PhaseSearch>(m, "PhaseSearch", "Anisotropies of a field turned by constant angles.")
        .field("angles", &PhaseSearch::angles, "(m,) float64 radians in [0, pi/2).")
        .field("worst", &PhaseSearch::worst, "(m,) float64 worst anisotropies.")
        .field("mean", &PhaseSearch::mean, "(m,) float64 mean anisotropies.")
        .field("least_worst", &PhaseSearch::least_worst, "Place of the least of `worst`.")
        .field("least_mean", &PhaseSearch::least_mean, "Place of the least of `mean`.")
        .finish([](const PhaseSearch& s) { return count(s.angles.size(), "phase"); });
}

void bind_cycle_results(py::module_& m) {
    Record<LimitCycle>(m, "LimitCycle", "A closed streamline that others wind towards.")
        .field("line", &LimitCycle::line, "Streamline.")
        .field("flux", &LimitCycle::flux, "By what the logarithm of the width it carries grows in one round.")
        .field("crosses_itself", &LimitCycle::crosses_itself, "Then it cannot be removed.")
        .finish([](const LimitCycle& c) { return "length " + number(c.line.length) + ", flux " + number(c.flux); });
    Record<UnwoundField>(m, "UnwoundField", "A cross field without the limit cycles that could be removed.")
        .field("field", &UnwoundField::field, "DirectionField.")
        .field("removed", &UnwoundField::removed, "List of LimitCycle.")
        .field("left", &UnwoundField::left, "List of LimitCycle: forced, or their bands are blocked.")
        .finish([](const UnwoundField& f) {
            return std::to_string(f.removed.size()) + " removed, " + std::to_string(f.left.size()) + " left";
        });
}

void bind_family_options(py::module_& m) {
    Record<SizeFamilyOptions>(m, "SizeFamilyOptions",
                              "Options of size_families: its keyword arguments, with their defaults.")
        .field("spacing", &SizeFamilyOptions::spacing, "Of lines, input unit; 0: 1/40 of shape_size.")
        .field("power", &SizeFamilyOptions::power, "1 to 8: the larger, the more the worst crossings count.")
        .field("max_length", &SizeFamilyOptions::max_length, "Of a line each way; 0: 4 times shape_size.")
        .field("singular_radius", &SizeFamilyOptions::singular_radius,
               "Lines that come nearer to singular points are left out; 0: two mean edge lengths.")
        .field("max_iterations", &SizeFamilyOptions::max_iterations, "Of Newton's method.")
        .field("stop_at_features", &SizeFamilyOptions::stop_at_features, "Whether lines end there.")
        .finish([](const SizeFamilyOptions& o) {
            return "spacing=" + number(o.spacing) + ", power=" + std::to_string(o.power);
        });
    Record<LimitCycleOptions>(m, "LimitCycleOptions",
                              "Options of limit_cycles: its keyword arguments, with their defaults.")
        .field("seeds", &LimitCycleOptions::seeds, "Triangles from which lines of both families are traced.")
        .field("max_length", &LimitCycleOptions::max_length, "Of a line each way; 0: 20 times shape_size.")
        .field("tolerance", &LimitCycleOptions::tolerance, "Closed lines with a smaller flux are regular.")
        .field("band_width", &LimitCycleOptions::band_width, "Where the field is turned; 0: 8 mean edge lengths.")
        .field("most_removed", &LimitCycleOptions::most_removed, "Cycles.")
        .finish([](const LimitCycleOptions& o) {
            return "seeds=" + std::to_string(o.seeds) + ", tolerance=" + number(o.tolerance);
        });
}

template <class Options, class Function>
auto with_options(const char* name, Function function) {
    return [name, function](const DirectionField& field, const SurfaceSingularities& singularities,
                            const std::optional<ProgressCallable>& progress, const py::kwargs& given) {
        const auto [options] = options_of<Options>(name, given);
        return run_interruptible(
            [field, singularities, options = options, function](Job& job) {
                check(field);
                check(singularities, field.domain.mesh());
                return function(field, singularities, options, job.progress());
            },
            progress);
    };
}

void bind_families(py::module_& m) {
    m.def(
        "size_families",
        with_options<SizeFamilyOptions>(
            "size_families", [](const auto& field, const auto& points, const auto& options,
                                const Progress& told) { return size_families(field, points, options, told); }),
        "field"_a, "singularities"_a, py::kw_only(), "progress"_a = py::none(),
        "The sides that quads along the streamlines of a cross field can have, as SizeFamilies (Simons 2024, chapter "
        "4): each streamline carries a width that is free up to a factor; the factors make the quads at all crossings "
        "as near to squares as they can be together, a convex problem, solved to its minimum.\n\n"
        "spacing: of the lines; power: how much the worst crossings count; max_length: of a line each way; "
        "singular_radius: lines that come nearer to singular points are left out. Raises InvalidInput for symmetries "
        "other than 4.");
    list_options<SizeFamilyOptions>(m, "size_families");
    m.def("rotated_field", &rotated_field, "field"_a, "angle"_a,
          "The DirectionField with every direction turned by an angle, radians.");
    m.def(
        "phase_search",
        [](const DirectionField& field, int phases, const std::optional<ProgressCallable>& progress,
           const py::kwargs& given) {
            const auto [options] = options_of<SizeFamilyOptions>("phase_search", given);
            return run_interruptible(
                [field, phases, options = options](Job& job) {
                    check(field);
                    return phase_search(field, phases, options, job.progress());
                },
                progress);
        },
        "field"_a, "phases"_a, py::kw_only(), "progress"_a = py::none(),
        "The anisotropies of size_families of a field turned by `phases` angles in [0, pi/2), as a PhaseSearch: for "
        "fields that nothing aligns, whose angle is free by a constant. Options are those of size_families.");
    list_options<SizeFamilyOptions>(m, "phase_search");
}

void bind_cycles(py::module_& m) {
    m.def(
        "limit_cycles",
        with_options<LimitCycleOptions>(
            "limit_cycles", [](const auto& field, const auto& points, const auto& options,
                               const Progress& told) { return limit_cycles(field, points, options, told); }),
        "field"_a, "singularities"_a, py::kw_only(), "progress"_a = py::none(),
        "Closed streamlines of a cross field that others wind towards, as a list of LimitCycle: lines of both families "
        "from `seeds` triangles, followed until they close; those whose flux is at least `tolerance`.");
    list_options<LimitCycleOptions>(m, "limit_cycles");
    m.def(
        "without_limit_cycles",
        [](const DirectionField& field, const std::optional<ProgressCallable>& progress, const py::kwargs& given) {
            const auto [options] = options_of<LimitCycleOptions>("without_limit_cycles", given);
            return run_interruptible(
                [field, options = options](Job& job) {
                    check(field);
                    return without_limit_cycles(field, options, job.progress());
                },
                progress);
        },
        "field"_a, py::kw_only(), "progress"_a = py::none(),
        "The field turned by a quarter turn across a band of `band_width` round each limit cycle, as an UnwoundField: "
        "no singular point is added, and outside the bands nothing changes. Cycles that the singular points force, or "
        "whose bands reach the boundary, a feature or a singular point, are left and told. Options are those of "
        "limit_cycles.");
    list_options<LimitCycleOptions>(m, "without_limit_cycles");
}

}  // namespace

void bind_size_family_types(py::module_& m) {
    bind_family_results(m);
    bind_cycle_results(m);
}

void bind_size_families(py::module_& m) {
    bind_family_options(m);
    bind_families(m);
    bind_cycles(m);
}

}  // namespace octafield::bindings
