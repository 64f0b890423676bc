#include "heat_solver.hpp"

#include <algorithm>

#include "octafield/error.hpp"

namespace octafield::volume {

HeatSolver::HeatSolver(const BlockLaplacian& laplacian, const ConstraintSpaces& spaces, int threads)
    : laplacian_(laplacian), spaces_(spaces), threads_(threads) {
    const Index n = laplacian.rows();
    for (Sh4Field* field : {&load_, &residual_, &direction_, &image_}) field->setZero(n, Vector::RowsAtCompileTime);
    sum([&](Index v) {
        load_.row(v) = -spaces_.reached(v, laplacian_.row_times(v, spaces_.given())).transpose();
        return 0.0;
    });
}

template <class Body>
double HeatSolver::sum(const Body& body) const {
    return block_sum(laplacian_.rows(), threads_, [&](std::int64_t first, std::int64_t last) {
        double total = 0;
        for (std::int64_t v = first; v < last; ++v) total += body(static_cast<Index>(v));
        return total;
    });
}

HeatSolution HeatSolver::step(double time, Sh4Field& field, double tolerance, int max_iterations) {
    const auto pull = [&](Index v) { return laplacian_.mass()[v] / time; };
    // A vertex of no equation has a zero row, residual and direction.
    const auto inverse = [&](Index v) {
        const double d = laplacian_.diagonal()[v] + pull(v);
        return d > 0 ? 1 / d : 0.0;
    };
    // The unknown is the difference from `field`: the pull towards it is in the operator only.
    double squared = sum([&](Index v) {
        const Vector r = -spaces_.reached(v, laplacian_.row_times(v, field));
        residual_.row(v) = r.transpose();
        direction_.row(v) = inverse(v) * r.transpose();
        return inverse(v) * r.squaredNorm();
    });
    const double right = sum([&](Index v) {
        const Vector unknown = field.row(v).transpose() - spaces_.given().row(v).transpose();
        return inverse(v) * (load_.row(v).transpose() + pull(v) * unknown).squaredNorm();
    });

    const double small = tolerance * tolerance * std::max(right, squared);

    HeatSolution result;
    for (; squared > small; ++result.iterations) {
        if (result.iterations == max_iterations) return result;
        const double curvature = sum([&](Index v) {
            const Vector p = direction_.row(v).transpose();
            const Vector image = spaces_.reached(v, laplacian_.row_times(v, direction_)) + pull(v) * p;
            image_.row(v) = image.transpose();
            return image.dot(p);
        });
        // Rounding leaves nothing to gain, or the field is free in the whole mesh and time infinite: any will do.
        if (!(curvature > 0)) break;
        const double length = squared / curvature;
        const double next = sum([&](Index v) {
            field.row(v) += length * direction_.row(v);
            residual_.row(v) -= length * image_.row(v);
            return inverse(v) * residual_.row(v).squaredNorm();
        });
        sum([&](Index v) {
            direction_.row(v) = inverse(v) * residual_.row(v) + next / squared * direction_.row(v);
            return 0.0;
        });
        squared = next;
    }
    if (!field.allFinite())
        throw SolverError("a diffusion step failed; look for degenerate tets (octafield info)", "diffusion");
    result.converged = true;
    return result;
}

}  // namespace octafield::volume
