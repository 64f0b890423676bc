// 1/2 int |grad f|^2 and the pull as a function of the angles of f, |f| = 1: one real unknown a_i per free edge, which
// turns f_i to f_i exp(i a_i). Equals sum_links w (1 - cos d) + pull with d the difference of the two angles across a
// corner, so the second derivative couples the same edges as the stiffness matrix, with the weights w cos d.
#pragma once

#include "free_system.hpp"
#include "start_field.hpp"

namespace octafield::surface::detail {

class AngleEnergy {
public:
    using State = Eigen::VectorXcd;  // f (E)

    // Keeps a reference to problem, whose system must not be empty.
    explicit AngleEnergy(const Problem& problem);

    struct Slope {
        double energy;
        Eigen::VectorXd gradient;  // by a, (n)
    };
    Slope slope(const Eigen::VectorXcd& values) const;

    enum class Curvature {
        exact,   // indefinite where singular points may still fall to a neighbouring triangle, and at saddle points
        convex,  // triangles in which it is not positive semidefinite have their negative weights replaced
    };
    // Second derivative by a, lower triangle, with next to nothing added that keeps it definite where turning all
    // directions of a component changes nothing. The pattern is the same on every call.
    const FreeSystem::RealMatrix& hessian(const Eigen::VectorXcd& values, Curvature curvature);

    // values with the free ones turned by `length` times `angles`.
    Eigen::VectorXcd turned(const Eigen::VectorXcd& values, const Eigen::VectorXd& angles, double length) const;
    // The square of a gradient that is nothing but rounding, over the stiffness's diagonal.
    double rounding() const { return rounding_; }

private:
    void add(Index i, Index j, double weight);

    const Problem& problem_;
    std::vector<Index> number_;  // (E), of the unknown, -1 where held
    Eigen::VectorXd shift_;      // (n)
    FreeSystem::RealMatrix matrix_;
    double rounding_;
};

}  // namespace octafield::surface::detail
