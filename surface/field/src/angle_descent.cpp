#include "angle_descent.hpp"

#include "angle_energy.hpp"
#include "core_moves.hpp"
#include "newton_descent.hpp"

namespace octafield::surface::detail {
namespace {

constexpr int most_moves = 20;
constexpr double energy_tolerance = 1e-10;  // gain to be expected from a step, relative to the energy

}  // namespace

bool descend_angles(const Problem& problem, const Eigen::VectorXi& order, Eigen::VectorXcd& values, std::uint64_t seed,
                    const std::function<bool(double energy)>& told) {
    AngleEnergy energy(problem);
    NewtonDescent<AngleEnergy> descent(energy, order, values, seed, told);
    CoreMoves cores(problem);
    bool settled = descent.descend(energy_tolerance);
    for (int i = 0; i < most_moves && settled && cores.improve(values) > 0; ++i)
        settled = descent.start_anew() && descent.descend(energy_tolerance);
    return settled;
}

}  // namespace octafield::surface::detail
