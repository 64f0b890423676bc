#include "heat_solver.hpp"

#include <algorithm>
#include <cmath>

#include "octafield/error.hpp"

namespace octafield::volume {

using frames::Sh4;

namespace {

// Of the residual in every step. The right-hand side of short times is far larger: against it alone, nothing would be
// done where few sites, those of slivers, are far from equilibrium.
constexpr double least_reduction = 0.5;

}  // namespace

HeatSolver::HeatSolver(const BlockLaplacian& laplacian, const ConstraintSpaces& spaces, int threads)
    : laplacian_(laplacian), spaces_(spaces), threads_(threads) {
    const Index n = laplacian.rows();
    inverse_.resize(n);
    pull_.resize(n);
    for (Field* field : {&load_, &change_, &residual_, &direction_, &image_}) field->setZero(n, Sh4::dimension);
    laplacian_.for_rows_of_product(spaces.given(), threads, [&](Index v, const Sh4::Vector& product) {
        load_.row(v) = -spaces_.reached(v, product).cast<float>().transpose();
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

// Residual and first direction; returns the residual's squared norm.
double HeatSolver::begin(const Sh4Field& field, double& energy) {
    energy = laplacian_.multiply(field, product_, threads_) / 2;
    return sum([&](Index v) {
        const Vector r = -spaces_.reached(v, product_.row(v).transpose()).cast<float>();
        residual_.row(v) = r.transpose();
        direction_.row(v) = inverse_[v] * r.transpose();
        change_.row(v).setZero();
        return inverse_[v] * r.squaredNorm();
    });
}

// image = (P L + M / time) direction; returns direction . image.
double HeatSolver::multiply() {
    return laplacian_.for_rows_of_product(direction_, threads_, [&](Index v, const Vector& product) {
        image_.row(v) = pull_[v] * direction_.row(v);
        if (spaces_.is_free(v))
            image_.row(v) += product.transpose();
        else
            image_.row(v) += spaces_.reached(v, product.cast<double>()).cast<float>().transpose();
        return image_.row(v).dot(direction_.row(v));
    });
}

HeatSolution HeatSolver::step(double time, Sh4Field& field, double tolerance, int max_iterations) {
    const double right = sum([&](Index v) {
        const double pull = laplacian_.mass()[v] / time, diagonal = laplacian_.diagonal()[v] + pull;
        pull_[v] = static_cast<float>(pull);
        // A site of no equation has a zero row, residual and direction.
        inverse_[v] = static_cast<float>(diagonal > 0 ? 1 / diagonal : 0);
        const Vector unknown = (field.row(v) - spaces_.given().row(v)).transpose().cast<float>();
        return inverse_[v] * (load_.row(v).transpose() + pull_[v] * unknown).squaredNorm();
    });
    HeatSolution result;
    // The unknown is the change of `field`: the pull towards it is in the operator only.
    double squared = begin(field, result.energy);
    double small = tolerance * tolerance * std::max(right, squared);
    if (std::isfinite(time)) small = std::min(small, least_reduction * least_reduction * squared);
    for (; squared > small; ++result.iterations) {
        if (result.iterations == max_iterations) return result;
        const double curvature = multiply();
        // Rounding leaves nothing to gain, or the field is free in the whole mesh and time infinite: any will do.
        if (!(curvature > 0)) break;
        const float length = static_cast<float>(squared / curvature);
        const double next = sum([&](Index v) {
            change_.row(v) += length * direction_.row(v);
            residual_.row(v) -= length * image_.row(v);
            return inverse_[v] * residual_.row(v).squaredNorm();
        });
        const float ratio = static_cast<float>(next / squared);
        sum([&](Index v) {
            direction_.row(v) = inverse_[v] * residual_.row(v) + ratio * direction_.row(v);
            return 0.0;
        });
        squared = next;
    }
    sum([&](Index v) {
        field.row(v) += change_.row(v).cast<double>();
        return 0.0;
    });
    if (!field.allFinite())
        throw SolverError("a diffusion step failed; look for degenerate tets (octafield info)", "diffusion");
    result.converged = true;
    return result;
}

}  // namespace octafield::volume
