#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "octafield/error.hpp"
#include "streamline_tools.hpp"

namespace octafield::surface {
namespace {

using detail::Complex;
using detail::Place;
using Point = Eigen::Vector3d;

// Where curves run, in cells of a cubic grid.
class LineCover {
public:
    struct Sample {
        Point position, direction, normal;
        Index line;
        double arc;  // along its line, 0 at the seed
    };

    LineCover(double spacing, int symmetry)
        : spacing_(spacing),
          // Directions of one family differ by less than half the angle between neighbouring families.
          same_family_(std::cos(std::numbers::pi / (symmetry % 2 == 0 ? symmetry : 2 * symmetry)) - 1e-12) {}

    void add(const Sample& sample) { cells_[key(cell(sample.position))].push_back(sample); }
    void drop(Index line) {
        if (dropped_.size() <= static_cast<std::size_t>(line)) dropped_.resize(line + 1, false);
        dropped_[line] = true;
    }

    // Whether a curve of the sample's family comes nearer to it than `distance` (at most the spacing). Of its own line
    // only parts count that are further along, and not those at the seed, where it may close.
    bool is_near(const Sample& sample, double distance) const {
        const Eigen::Array3i middle = cell(sample.position);
        for (int i = 0; i < 27; ++i) {
            const auto found = cells_.find(key(middle + Eigen::Array3i(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1)));
            if (found == cells_.end()) continue;
            for (const Sample& other : found->second) {
                if (other.line == sample.line &&
                    (std::abs(other.arc - sample.arc) < 3 * spacing_ || std::abs(other.arc) < 2 * spacing_))
                    continue;
                if ((other.position - sample.position).squaredNorm() < distance * distance &&
                    std::abs(other.direction.dot(sample.direction)) >= same_family_ &&
                    other.normal.dot(sample.normal) > 0 && !is_dropped(other.line))
                    return true;
            }
        }
        return false;
    }

private:
    bool is_dropped(Index line) const { return static_cast<std::size_t>(line) < dropped_.size() && dropped_[line]; }
    Eigen::Array3i cell(const Point& p) const { return (p.array() / spacing_).floor().cast<int>(); }
    static std::uint64_t key(const Eigen::Array3i& cell) {
        std::uint64_t result = 0;
        for (int k = 0; k < 3; ++k) result = result << 21 | (static_cast<std::uint64_t>(cell[k]) & 0x1fffff);
        return result;
    }

    double spacing_, same_family_;
    std::unordered_map<std::uint64_t, std::vector<Sample>> cells_;
    std::vector<bool> dropped_;  // lines
};

// Feeds a growing curve into the cover, a sample every quarter of the spacing.
class Laying {
public:
    Laying(LineCover& cover, const Points& normals, double spacing, double least, Index line, double sense)
        : cover_(cover), normals_(normals), step_(spacing / 4), least_(least), line_(line), sense_(sense) {}

    bool operator()(const Point& from, const Point& to, Index triangle) {
        const double length = (to - from).norm();
        if (!(length > 0)) return true;
        const Point direction = (to - from) / length;
        LineCover::Sample sample{from, direction, normals_.row(triangle).transpose(), line_, 0};
        while (next_ <= arc_ + length) {
            sample.position = from + (next_ - arc_) * direction;
            sample.arc = sense_ * next_;
            if (cover_.is_near(sample, least_)) return false;
            cover_.add(sample);
            next_ += step_;
        }
        arc_ += length;
        return true;
    }

private:
    LineCover& cover_;
    const Points& normals_;
    double step_, least_;
    Index line_;
    double sense_;
    double arc_ = 0, next_ = 0;
};

// Points of a low-discrepancy sequence in the triangle, one per square of the spacing, at least one.
std::vector<Complex> candidates(const detail::ChartedField& field, Index t, double spacing) {
    const double count = std::ceil(field.twice_area(t) / (spacing * spacing));
    if (count <= 1) return {field.centroid(t)};
    std::vector<Complex> points;
    const double plastic = 1.32471795724474602596;
    double a = 0.5, b = 0.5;
    for (int i = 0; i < count; ++i) {
        a = std::fmod(a + 1 / plastic, 1.0);
        b = std::fmod(b + 1 / (plastic * plastic), 1.0);
        const bool outside = a + b > 1;
        points.push_back((outside ? 1 - a : a) * field.corners(t)[1] + (outside ? 1 - b : b) * field.corners(t)[2]);
    }
    return points;
}

// A stride that visits all of 0 .. count - 1 and spreads them early.
Index golden_stride(Index count) {
    Index stride = std::max<Index>(1, static_cast<Index>(count / std::numbers::phi));
    while (std::gcd(stride, count) != 1) ++stride;
    return stride;
}

EvenStreamlineOptions with_defaults(const SurfaceDomain& domain, EvenStreamlineOptions options) {
    for (const double length : {options.spacing, options.min_length})
        if (!(length >= 0) || !std::isfinite(length))
            throw InvalidInput("spacing and min_length must be lengths, or 0 for the default");
    if (!(options.stop_ratio > 0 && options.stop_ratio <= 1)) throw InvalidInput("stop_ratio must be in (0, 1]");
    const double size = domain.size();
    if (options.spacing == 0) options.spacing = size / 60;
    if (options.min_length == 0) options.min_length = options.spacing;
    if (options.spacing < 1e-5 * size)
        throw InvalidInput("the spacing of streamlines must be at least 1e-5 of the size (shape_size)",
                           "spacing_too_small");
    return options;
}

}  // namespace

std::vector<Streamline> even_streamlines(const DirectionField& field, const SurfaceSingularities& singularities,
                                         const EvenStreamlineOptions& given, const Progress& progress) {
    const EvenStreamlineOptions options = with_defaults(field.domain, given);
    const detail::TwoWayTracer tracer(field, singularities, options.tracing);
    const detail::ChartedField& charts = tracer.field();
    const Points& normals = field.domain.normals();
    const int symmetry = field.symmetry, families = symmetry % 2 == 0 ? symmetry / 2 : symmetry;
    LineCover cover(options.spacing, symmetry);
    std::vector<Streamline> lines;
    Index started = 0;

    const auto try_seed = [&](Index t, Complex at, int family) {
        const Complex heading = charts.direction(t, at, 1) * std::polar(1.0, 2 * std::numbers::pi * family / symmetry);
        const Place place{t, at, heading};
        const LineCover::Sample seed{charts.lift(t, at), charts.lift_vector(t, heading), normals.row(t).transpose(), -1,
                                     0};
        if (cover.is_near(seed, options.spacing)) return;
        const Index line = started++;
        const double least = options.stop_ratio * options.spacing;
        Streamline traced = tracer.trace(place, Laying(cover, normals, options.spacing, least, line, 1),
                                         Laying(cover, normals, options.spacing, least, line, -1));
        if (traced.length < options.min_length && traced.last_end != StreamlineEnd::closed) {
            cover.drop(line);
        } else {
            lines.push_back(std::move(traced));
        }
    };

    const Index count = field.domain.triangle_count();
    const Index stride = golden_stride(count);
    for (Index i = 0, t = 0; i < count; ++i, t = static_cast<Index>((t + std::int64_t{stride}) % count)) {
        if (i % 256 == 0) report_or_throw(progress, "streamlines", static_cast<double>(i) / count, NAN);
        for (const Complex at : candidates(charts, t, options.spacing))
            for (int family = 0; family < families; ++family) try_seed(t, at, family);
    }
    return lines;
}

}  // namespace octafield::surface
