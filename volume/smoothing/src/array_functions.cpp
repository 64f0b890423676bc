#include "array_functions.hpp"

#include <cmath>

#include "octafield/error.hpp"
#include "octafield/parallel.hpp"

namespace octafield::volume {
namespace {

using frames::Matrix3;
using frames::Vector3;

// Radians, of central differences: fourth order leaves 1e-13 of the first derivatives of harmonics of degree 4.
constexpr double step = 1e-3;

ArrayValues checked(const ArrayScheme& scheme, const char* function, ArrayValues values, Index rows, Index columns) {
    const std::string what = "scheme '" + scheme.name + "': " + function + " gave ";
    if (values.rows() != rows || values.cols() != columns)
        throw InvalidInput(what + "an array of shape (" + std::to_string(values.rows()) + ", " +
                               std::to_string(values.cols()) + ") for " + std::to_string(rows) +
                               " rows of quaternions; (" + std::to_string(rows) + ", " + std::to_string(columns) +
                               ") is wanted",
                           "bad_scheme");
    for (Index r = 0; r < rows; ++r)
        if (!values.row(r).allFinite())
            throw InvalidInput(what + "a number that is not finite in row " + std::to_string(r) +
                                   "; it must be defined for every unit quaternion",
                               "bad_scheme");
    return values;
}

Index rows_of(const Quaternions& frames) { return static_cast<Index>(frames.rows()); }

// exp(w) q for every frame.
Quaternions turned(const Quaternions& frames, const Vector3& w, int threads) {
    const frames::Quaternion turn = frames::exp(w);
    Quaternions result(frames.rows(), 4);
    parallel_for(frames.rows(), threads, [&](std::int64_t v) {
        const frames::Quaternion q = frames::from_wxyz(frames::Vector4(frames.row(v).transpose()));
        result.row(v) = frames::to_wxyz((turn * q).normalized()).transpose();
    });
    return result;
}

// value(w): the function at frames turned by w. Columns place(c, axis) of `result` become its derivatives.
template <class Value, class Place>
void differentiate(const Value& value, const Place& place, ArrayValues& result) {
    for (int axis = 0; axis < 3; ++axis) {
        const Vector3 w = step * Vector3::Unit(axis);
        const ArrayValues near = value(w) - value(-w), far = value(2 * w) - value(-2 * w);
        for (Index c = 0; c < near.cols(); ++c)
            result.col(place(c, axis)) = (8 * near.col(c) - far.col(c)) / (12 * step);
    }
}

}  // namespace

ArrayValues embedded(const ArrayScheme& scheme, const Quaternions& frames) {
    return checked(scheme, "embed", scheme.embed(frames), rows_of(frames), scheme.dimension);
}

ArrayValues residuals(const ArrayScheme& scheme, const Quaternions& first, const Quaternions& second) {
    return checked(scheme, "residual", scheme.residual(first, second), rows_of(first), scheme.dimension);
}

EmbeddingDerivatives derivatives(const ArrayScheme& scheme, const Quaternions& frames, const ArrayValues& values,
                                 const ArrayValues& images, int threads) {
    const Index n = rows_of(frames), d = scheme.dimension;
    EmbeddingDerivatives found{ArrayValues(n, 3 * d), std::vector<Matrix3>(n, Matrix3::Zero())};
    const auto at = [&](const Vector3& w) { return embedded(scheme, turned(frames, w, threads)); };
    if (scheme.differential) {
        const auto given = [&](const Quaternions& q) {
            return checked(scheme, "differential", scheme.differential(q), rows_of(q), 3 * d);
        };
        found.differentials = given(frames);
        for (int axis = 0; axis < 3; ++axis) {
            const Vector3 w = step * Vector3::Unit(axis);
            const ArrayValues change = given(turned(frames, w, threads)) - given(turned(frames, -w, threads));
            parallel_for(n, threads, [&](std::int64_t v) {
                const Eigen::Map<const Rows<double, 3>> rows(change.row(v).data(), d, 3);
                // Rotation vectors on one another, not their sum: the symmetric part is the Hessian in exp's chart.
                const Vector3 column = rows.transpose() * images.row(v).transpose() / (2 * step);
                found.curvatures[v].col(axis) += column / 2;
                found.curvatures[v].row(axis) += column.transpose() / 2;
            });
        }
        return found;
    }
    // Both derivatives from the same values.
    const auto along = [&](const ArrayValues& a) { return Eigen::VectorXd(a.cwiseProduct(images).rowwise().sum()); };
    const Eigen::VectorXd here = along(values);
    std::vector<Eigen::VectorXd> both(3);  // at step and at -step, summed
    for (int axis = 0; axis < 3; ++axis) {
        const Vector3 w = step * Vector3::Unit(axis);
        const ArrayValues plus = at(w), minus = at(-w), far_plus = at(2 * w), far_minus = at(-2 * w);
        for (Index c = 0; c < d; ++c)
            found.differentials.col(3 * c + axis) =
                (8 * (plus.col(c) - minus.col(c)) - (far_plus.col(c) - far_minus.col(c))) / (12 * step);
        both[axis] = along(plus) + along(minus);
        const Eigen::VectorXd second =
            (16 * both[axis] - along(far_plus) - along(far_minus) - 30 * here) / (12 * step * step);
        for (Index v = 0; v < n; ++v) found.curvatures[v](axis, axis) = second[v];
    }
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < i; ++j) {
            const Vector3 w = step * (Vector3::Unit(i) + Vector3::Unit(j));
            const Eigen::VectorXd second =
                (along(at(w)) + along(at(-w)) + 2 * here - both[i] - both[j]) / (2 * step * step);
            for (Index v = 0; v < n; ++v) found.curvatures[v](i, j) = found.curvatures[v](j, i) = second[v];
        }
    return found;
}

ArrayValues residual_differentials(const ArrayScheme& scheme, const Quaternions& first, const Quaternions& second,
                                   int threads) {
    const Index n = rows_of(first), d = scheme.dimension;
    if (scheme.residual_differential)
        return checked(scheme, "differential", scheme.residual_differential(first, second), n, 6 * d);
    ArrayValues result(n, 6 * d);
    differentiate([&](const Vector3& w) { return residuals(scheme, turned(first, w, threads), second); },
                  [](Index c, int axis) { return 6 * c + axis; }, result);
    differentiate([&](const Vector3& w) { return residuals(scheme, first, turned(second, w, threads)); },
                  [](Index c, int axis) { return 6 * c + 3 + axis; }, result);
    return result;
}

}  // namespace octafield::volume
