// The Ginzburg-Landau functional of a direction field (thesis of Beaufort, 3.15) and its minimisation.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "crouzeix_raviart.hpp"
#include "free_system.hpp"
#include "octafield/progress.hpp"
#include "pull.hpp"

namespace octafield::surface::detail {

// E(f) = 1/2 int |grad f|^2 + sum_e m_e / (4 eps_e^2) (|f_e|^2 - 1)^2 + pull.
class GinzburgLandau {
public:
    // Keeps references to links, system and pull. `epsilon` (E).
    GinzburgLandau(const std::vector<CornerLink>& links, const Eigen::VectorXd& masses, const FreeSystem& system,
                   const Pull& pull, const Eigen::VectorXd& epsilon);

    struct Slope {
        double energy;
        Eigen::VectorXd gradient;  // of the free unknowns in real form, (2 n)
        // Norm of the gradient, relative to that of the values times the weights or, where that is less, times the
        // stiffness's diagonal: with epsilon far below the edge length the weights say nothing about the directions.
        double residual;
    };
    Slope slope(const Eigen::VectorXcd& values) const;
    // Second derivative plus `shift` times weights on the diagonal. `matrix` must be the system's real stiffness but
    // for its diagonal blocks, which are all that is written.
    void hessian(const Eigen::VectorXcd& values, double shift, FreeSystem::RealMatrix& matrix) const;
    // c with E(values + t direction) - E(values) = c[0] t + c[1] t^2 + c[2] t^3 + c[3] t^4.
    std::array<double, 4> along(const Eigen::VectorXcd& values, const Eigen::VectorXcd& direction) const;

    const Eigen::VectorXd& weights() const { return weights_; }  // (E), m_e / eps_e^2, dimensionless
    const FreeSystem& system() const { return system_; }

private:
    const std::vector<CornerLink>& links_;
    const FreeSystem& system_;
    const Pull& pull_;
    Eigen::VectorXd weights_, residual_weights_, stiffness_;
};

struct DescentOptions {
    int max_iterations = 1000;
    double tolerance = 1e-10;        // of the residual
    double energy_tolerance = 1e-6;  // of a round's gain, relative to the energy
    std::uint64_t seed = 0;          // of the directions tried to leave a saddle point, and of the disturbance
    bool to_minimum = true;          // false: saddle points will do, and a round that gains little
    bool disturb = false;            // the start, slightly
};

struct DescentResult {
    int iterations = 0;
    bool converged = false;
    double residual = 0;
    std::vector<double> energy_history;
};

// Descends from `values` to a local minimum, in place; held edges keep their values. The system must not be empty;
// `order` is its elimination order.
DescentResult minimise(const GinzburgLandau& functional, const Eigen::VectorXi& order, Eigen::VectorXcd& values,
                       const DescentOptions& options, const Progress& progress);

}  // namespace octafield::surface::detail
