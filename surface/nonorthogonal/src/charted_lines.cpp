#include "charted_lines.hpp"

#include <cmath>
#include <string>

#include "octafield/error.hpp"

namespace octafield::surface::detail {
namespace {

constexpr int most_quads = 1000;

}  // namespace

ChartedLines::ChartedLines(const NonOrthogonalField& field, const VertexCharts& vertices)
    : Charts(field.domain), corner_sums_(mesh().triangles.rows()) {
    for (Index t = 0; t < domain().triangle_count(); ++t)
        for (int k = 0; k < 3; ++k) {
            const Index v = mesh().triangles(t, k);
            const double turn = vertices.into_triangle(*this, 3 * t + k);
            corner_sums_[t][k] = power_sums({field.angles(v, 0) + turn, field.angles(v, 1) + turn});
        }
}

PowerSums ChartedLines::sums(Index t, Complex z) const {
    const double area = twice_area(t);
    PowerSums result{0, 0};
    for (int k = 0; k < 3; ++k) {
        const int next = (k + 1) % 3;
        const double weight = cross(side(t, next), z - corners(t)[next]) / area;
        result.p1 += weight * corner_sums_[t][k].p1;
        result.p2 += weight * corner_sums_[t][k].p2;
    }
    return result;
}

Complex ChartedLines::direction(Index t, Complex z, Complex heading) const {
    const auto lines = lines_of(sums(t, z));
    if (!lines) return heading;
    const Complex a = std::polar(1.0, lines->first), b = std::polar(1.0, lines->second);
    const double along_a = dot(a, heading), along_b = dot(b, heading);
    if (std::abs(along_a) >= std::abs(along_b)) return along_a >= 0 ? a : -a;
    return along_b >= 0 ? b : -b;
}

Complex ChartedLines::singular_place(Index t) const {
    std::array<Complex, 3> values;
    for (int k = 0; k < 3; ++k) {
        const PowerSums& sums = corner_sums_[t][k];
        values[k] = 2.0 * sums.p2 - sums.p1 * sums.p1;
    }
    Eigen::Vector3d weights;
    for (int k = 0; k < 3; ++k) weights[k] = cross(values[(k + 1) % 3], values[(k + 2) % 3]);
    weights /= weights.sum();
    if (!weights.allFinite() || weights.minCoeff() < 0) return centroid(t);
    return weights[1] * corners(t)[1] + weights[2] * corners(t)[2];
}

void require_fit(const NonOrthogonalField& field) {
    const Index count = field.domain.vertex_count();
    if (field.angles.rows() != count || static_cast<Index>(field.quads.size()) != count)
        throw InvalidInput("the field has " + std::to_string(field.angles.rows()) + " rows of angles and " +
                               std::to_string(field.quads.size()) + " numbers of quads; its surface has " +
                               std::to_string(count) + " vertices: take the field as non_orthogonal_field made it",
                           "wrong_size");
    std::vector<Index> bad;
    for (Index v = 0; v < count; ++v)
        if (!field.angles.row(v).allFinite()) bad.push_back(v);
    if (!bad.empty())
        throw InvalidInput("the angles at vertices " + first_few(bad) + " are not finite", "not_finite", bad);
    for (Index v = 0; v < count; ++v)
        if (field.quads[v] < 0 || field.quads[v] > most_quads) bad.push_back(v);
    if (!bad.empty())
        throw InvalidInput(
            "the numbers of quads at vertices " + first_few(bad) + " are not in 0 .. " + std::to_string(most_quads),
            "bad_quads", bad);
}

template class FieldTracer<ChartedLines>;

}  // namespace octafield::surface::detail
