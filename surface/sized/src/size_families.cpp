#include "octafield/surface/size_families.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "covering_lines.hpp"
#include "fitted_map.hpp"
#include "line_widths.hpp"
#include "log_factors.hpp"
#include "octafield/library_threads.hpp"

namespace octafield::surface {
namespace {

using detail::Complex;
using detail::LineCrossing;

void check(const DirectionField& field, const SizeFamilyOptions& options) {
    if (field.symmetry != 4)
        throw InvalidInput(
            "families of sizes are those of cross fields, of symmetry 4, not " + std::to_string(field.symmetry),
            "wrong_symmetry");
    for (const double length : {options.spacing, options.max_length, options.singular_radius})
        if (!(length >= 0 && std::isfinite(length)))
            throw InvalidInput("spacing, max_length and singular_radius must be lengths, or 0 for their defaults",
                               "bad_option");
    if (options.spacing > 0 && options.spacing < 1e-4 * field.domain.size())
        throw InvalidInput("spacing is below 1/10000 of the surface's size: there would be too many lines",
                           "bad_option");
    if (options.power < 1 || options.power > 8) throw InvalidInput("power must be 1 to 8; 1 is usual", "bad_option");
    if (options.max_iterations < 1) throw InvalidInput("max_iterations must be at least 1", "bad_option");
}

// Every crossing of two of the lines, once.
std::vector<LineCrossing> all_crossings(const detail::Charts& charts, const std::vector<Streamline>& lines,
                                        Index& self_crossings) {
    detail::LineIndex index(charts);
    std::vector<LineCrossing> found;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const auto number = static_cast<Index>(i);
        for (const LineCrossing& crossing : index.crossings(number, lines[i])) found.push_back(crossing);
        index.add(number, lines[i]);
        for (const LineCrossing& crossing : index.crossings(number, lines[i]))
            if (crossing.other.line == number && crossing.one.segment < crossing.other.segment) ++self_crossings;
    }
    return found;
}

double at_place(const std::vector<double>& growth, const detail::LinePlace& place) {
    return growth[place.segment] + place.part * (growth[place.segment + 1] - growth[place.segment]);
}

void set_crossings(const detail::ChartedField& field, const std::vector<LineCrossing>& crossings,
                   const std::vector<std::vector<double>>& growth, SizeFamilies& result) {
    const auto count = static_cast<Index>(crossings.size());
    result.positions.resize(count, 3);
    result.crossing_lines.resize(count, 2);
    result.log_widths.resize(count, 2);
    for (Index i = 0; i < count; ++i) {
        const LineCrossing& crossing = crossings[i];
        result.positions.row(i) = field.lift(crossing.triangle, crossing.at);
        result.triangles.push_back(crossing.triangle);
        result.crossing_lines.row(i) << crossing.one.line, crossing.other.line;
        result.log_widths.row(i) << at_place(growth[crossing.one.line], crossing.one),
            at_place(growth[crossing.other.line], crossing.other);
    }
}

// With the best factors; those of each part so that ln size has mean 0 at its crossings.
void scale_widths(const detail::LogFactors& factors, SizeFamilies& result) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(factors.x.size()), count = sum;
    for (Index i = 0; i < result.log_widths.rows(); ++i) {
        for (int k = 0; k < 2; ++k) result.log_widths(i, k) += factors.x[result.crossing_lines(i, k)];
        const Index part = factors.part[result.crossing_lines(i, 0)];
        sum[part] += result.log_widths.row(i).mean();
        count[part] += 1;
    }
    for (Index i = 0; i < result.log_widths.rows(); ++i) {
        const Index part = factors.part[result.crossing_lines(i, 0)];
        result.log_widths.row(i).array() -= sum[part] / count[part];
    }
    result.parts = static_cast<Index>((count.array() > 0).count());
}

void judge(const detail::ChartedField& field, const std::vector<LineCrossing>& crossings, SizeFamilies& result) {
    const Index count = result.log_widths.rows();
    Eigen::MatrixXd values(count, 2);
    values.col(0) = (result.log_widths.col(0) - result.log_widths.col(1)).cwiseAbs();
    values.col(1) = (result.log_widths.col(0) + result.log_widths.col(1)) / 2;
    if (count > 0) {
        result.worst_anisotropy = std::exp(values.col(0).maxCoeff());
        result.mean_anisotropy = std::exp(values.col(0).mean());
    }
    std::vector<Complex> places;
    for (const LineCrossing& crossing : crossings) places.push_back(crossing.at);
    const Eigen::MatrixXd maps = detail::fitted_map(field, result.triangles, places, values);
    result.log_anisotropy = maps.col(0).cwiseMax(0);
    result.log_sizes = maps.col(1);
}

}  // namespace

SizeFamilies size_families(const DirectionField& field, const SurfaceSingularities& singularities,
                           const SizeFamilyOptions& options, const Progress& progress) {
    calm_library_threads();
    check(field, options);
    detail::CoveringLines covering = detail::covering_lines(field, singularities, options, progress);
    SizeFamilies result;
    result.lines = std::move(covering.lines);
    result.left_out = covering.left_out;
    const detail::ChartedField charted(field, detail::corner_links(field.domain, field.symmetry));
    const auto crossings = all_crossings(charted, result.lines, result.self_crossings);
    const detail::AngleSlopes slopes(charted);
    std::vector<std::vector<double>> growth;
    for (const Streamline& line : result.lines) growth.push_back(detail::width_growth(slopes, line));
    set_crossings(charted, crossings, growth, result);
    std::vector<detail::RatioTerm> terms;
    for (Index i = 0; i < result.log_widths.rows(); ++i)
        terms.push_back({result.crossing_lines(i, 0), result.crossing_lines(i, 1),
                         result.log_widths(i, 0) - result.log_widths(i, 1)});
    const auto go_on = [&](double objective) {
        report_or_throw(progress, "anisotropy", 0.9, objective);
        return true;
    };
    const auto factors = detail::least_log_factors(terms, static_cast<Index>(result.lines.size()), options.power,
                                                   options.max_iterations, go_on);
    result.objective = factors.objective;
    result.iterations = factors.iterations;
    result.converged = factors.converged;
    scale_widths(factors, result);
    judge(charted, crossings, result);
    return result;
}

DirectionField rotated_field(const DirectionField& field, double angle) {
    DirectionField result = field;
    result.values *= std::polar(1.0, field.symmetry * angle);
    return result;
}

PhaseSearch phase_search(const DirectionField& field, int phases, const SizeFamilyOptions& options,
                         const Progress& progress) {
    if (phases < 1) throw InvalidInput("phases must be at least 1", "bad_option");
    check(field, options);
    PhaseSearch search;
    search.angles = search.worst = search.mean = Eigen::VectorXd::Zero(phases);
    for (int i = 0; i < phases; ++i) {
        report_or_throw(progress, "phases", static_cast<double>(i) / phases, NAN);
        search.angles[i] = std::numbers::pi / 2 * i / phases;
        const DirectionField turned = rotated_field(field, search.angles[i]);
        const SizeFamilies families = size_families(turned, surface_singularities(turned), options);
        search.worst[i] = families.worst_anisotropy;
        search.mean[i] = families.mean_anisotropy;
    }
    search.worst.minCoeff(&search.least_worst);
    search.mean.minCoeff(&search.least_mean);
    return search;
}

}  // namespace octafield::surface
