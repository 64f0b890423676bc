#include "built_field.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "inherited_lengths.hpp"
#include "octafield/error.hpp"
#include "size_potential.hpp"
#include "vertex_laplacian.hpp"

namespace octafield::surface::detail {
namespace {

using std::numbers::pi;
constexpr double most_turned = 0.9 * pi;  // of 4 theta between two edges of a triangle; from pi on it is lost
constexpr int most_refinements = 20;
constexpr std::size_t most_per_point = 20000;  // triangles

// Triangles, of the bisected mesh, where crosses turn too far to be told by their values.
std::set<Index> unresolved(const RingedMesh& ringed, const std::vector<double>& turns) {
    std::set<Index> result;
    for (std::size_t c = 0; c < turns.size(); ++c)
        if (!(4 * std::abs(turns[c]) < most_turned)) result.insert(ringed.parts[c / 3]);
    return result;
}

std::vector<int> vertex_indices(const RingedMesh& ringed, const Imposed& imposed) {
    std::vector<int> indices(ringed.vertex_triangles.size(), 0);
    for (const auto& [vertex, index] : imposed.corners) indices[vertex] = index;
    for (std::size_t i = 0; i < ringed.centres.size(); ++i) indices[ringed.centres[i]] = imposed.indices[i];
    return indices;
}

void solve_conditions(BuiltField& built) {
    const auto count = static_cast<Eigen::Index>(built.holonomy.conditions().size());
    built.missed = built.holonomy.missed(built.turns, built.holonomy.walked(built.turns)).unaryExpr(&within_quarter);
    built.forms = harmonic_forms(built.domain, built.structure, built.holonomy);
    built.energies.resize(count, count);
    if (count == 0) return;
    const Eigen::VectorXd weights = cotangent_weights(built.domain);
    Eigen::MatrixXd periods(count, count);
    for (Eigen::Index j = 0; j < count; ++j) {
        const std::vector<double> turns = form_turns(built.domain, built.forms[j]);
        periods.col(j) = built.holonomy.missed(turns, built.holonomy.walked(turns));
        for (Eigen::Index i = 0; i <= j; ++i)
            built.energies(i, j) = built.energies(j, i) = built.forms[i].cwiseProduct(weights).dot(built.forms[j]);
    }
    built.rotations = periods.partialPivLu().solve(built.missed);
}

}  // namespace

BuiltField built_field(const SurfaceDomain& input, const Imposed& imposed) {
    BisectedMesh mesh(input, imposed.places);
    for (int round = 0;; ++round) {
        separate_stars(mesh);
        RingedMesh rings = ringed(mesh, imposed.indices, imposed.rings);
        const SurfaceDomain domain =
            measured_alike(input, rings, SurfaceDomain(rings.mesh, {rings.features, input.features().corners}));
        const Structure structure(domain);
        Eigen::VectorXd h = size_potential(domain, structure, loads(structure, vertex_indices(rings, imposed)));
        std::vector<double> turns = conjugate_turns(domain, h);
        const std::set<Index> coarse = unresolved(rings, turns);
        if (!coarse.empty()) {
            const std::vector<Index> parts(coarse.begin(), coarse.end());
            std::set<Index> of_input;
            for (const Index part : parts) of_input.insert(mesh.triangles()[part].origin);
            const std::vector<Index> origins(of_input.begin(), of_input.end());
            const std::size_t most =
                20 * static_cast<std::size_t>(input.triangle_count()) + most_per_point * (imposed.places.size() + 1);
            if (round == most_refinements || mesh.triangles().size() > most)
                throw SolverError("crosses turn by more than an eighth of a turn in triangles " + first_few(origins) +
                                      " however they are refined; remesh the surface there",
                                  "unresolved_turns", origins);
            // A star near another point shrinks; beyond the stars sizes shrink against them.
            for (const Index part : parts) mesh.bisect(part, !mesh.at_centre(part));
            continue;
        }
        for (std::size_t c = 0; c < turns.size(); ++c)
            turns[c] -= domain.corner_angles()(static_cast<Eigen::Index>(c / 3), static_cast<Eigen::Index>(c % 3));
        Holonomy holonomy(domain, structure);
        BuiltField built{
            std::move(rings), domain, structure, std::move(holonomy), std::move(h), std::move(turns), {}, {}, {},
            Eigen::VectorXd()};
        solve_conditions(built);
        return built;
    }
}

Rotated rotated(const BuiltField& built) {
    std::vector<double> turns = built.turns;
    for (std::size_t j = 0; j < built.forms.size(); ++j) {
        const std::vector<double> form = form_turns(built.domain, built.forms[j]);
        for (std::size_t c = 0; c < turns.size(); ++c)
            turns[c] -= built.rotations[static_cast<Eigen::Index>(j)] * form[c];
    }
    Eigen::VectorXd angles = built.holonomy.walked(turns);
    const double closure = built.holonomy.closure(turns, angles);
    return {std::move(angles), closure};
}

}  // namespace octafield::surface::detail
