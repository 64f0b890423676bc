#include "octafield/volume/constraint_kinds.hpp"

#include "constraint_kind_laws.hpp"
#include "field_fixtures.hpp"
#include "octafield/error.hpp"
#include "octafield/volume/diffuse.hpp"
#include "octafield/volume/smooth.hpp"

namespace octafield::volume {
namespace {

template <class List>
struct TypesOf;
template <class... Kind>
struct TypesOf<ConstraintKindList<Kind...>> {
    using type = ::testing::Types<Kind...>;
};

struct NameOfKind {
    template <class Kind>
    static std::string GetName(int) {
        return std::string(Kind::name);
    }
};
INSTANTIATE_TYPED_TEST_SUITE_P(Library, ConstraintKindLaws, TypesOf<ConstraintKinds>::type, NameOfKind);

// By place in ConstraintKinds: a new kind joins by itself.
class EveryKind : public ::testing::TestWithParam<int> {
protected:
    const VertexConstraint kind = static_cast<VertexConstraint>(GetParam());
    const TetMesh mesh = testing::jittered_cube(5, 0.2, 3);
    const Sampling sampling = vertex_sampling(mesh);
    BoundaryConstraints constraints = testing::constraints_on(mesh, kind, testing::smooth_field(mesh));
    const Quaternions start = frames::random_rotations(sampling.count(), 4);

    EveryKind() {
        for (Index v = 0; v < sampling.count(); ++v)
            if (constraints.on_boundary[v])
                constraints.axis.row(v) =
                    (row_quaternion(constraints.frames, v) * frames::Vector3::UnitZ()).transpose();
    }
    // Of the field from the constraints, at the worst site.
    double off(const Quaternions& frames) const {
        double worst = 0;
        for (Index v = 0; v < sampling.count(); ++v)
            ConstraintKinds::visit(constraints.kind[v], constraints.of(v), [&](const auto& allowed) {
                const frames::Quaternion q = row_quaternion(frames, v);
                worst = std::max(worst, frames::distance(allowed.moved(q), q));
            });
        return worst;
    }
    void expect_lower_on_the_constraints(const SmoothResult& result) const {
        EXPECT_LT(off(result.frames), 1e-6);
        EXPECT_LT(result.objective_history.back(), 0.99 * result.objective_history.front());
    }
};

TEST_P(EveryKind, IsKeptByTheLinearStart) { EXPECT_LT(off(initial_frames(sampling, constraints)), 1e-6); }

TEST_P(EveryKind, IsKeptByDiffusion) {
    expect_lower_on_the_constraints(diffuse(sampling, constraints, start));
}

TEST_P(EveryKind, IsKeptByEverySolver) {
    for (const auto solver : {SmoothSolver::trust_region, SmoothSolver::levenberg_marquardt, SmoothSolver::lbfgs})
        for (const std::string representation : {"sh4", "su2", "geodesic", "odeco_lengths"}) {
            const bool embedding = representation == "sh4" || representation == "su2";
            if (solver == SmoothSolver::trust_region && !embedding) continue;
            if (representation == "odeco_lengths" && info(kind).held_lengths == 0) continue;
            SCOPED_TRACE(representation + " " + std::to_string(static_cast<int>(solver)));
            expect_lower_on_the_constraints(
                smooth(sampling, constraints, start,
                       {.representation = representation, .solver = solver, .max_iterations = 15}));
        }
}

// Where the solver stops, the energy is stationary in what is allowed: no small turn along the tangents lowers it.
TEST_P(EveryKind, IsMinimisedOver) {
    const Quaternions found =
        smooth(sampling, constraints, testing::smooth_field(mesh), {.max_iterations = 100, .tolerance = 1e-12}).frames;
    const double energy = dirichlet_energy(sampling, found);
    const double h = 1e-3;
    for (Index v = 0; v < sampling.count(); v += 7)
        ConstraintKinds::visit(constraints.kind[v], constraints.of(v), [&]<class Kind>(const Kind& allowed) {
            if constexpr (PartialConstraintKind<Kind>)
                for (int k = 0; k < Kind::unknowns; ++k)
                    for (const double length : {h, -h}) {
                        Turn<Kind::unknowns> turn = Turn<Kind::unknowns>::Zero();
                        turn[k] = length;
                        Quaternions moved = found;
                        moved.row(v) = frames::to_wxyz(allowed.turned(row_quaternion(found, v), turn)).transpose();
                        EXPECT_GT(dirichlet_energy(sampling, moved), energy);
                    }
        });
}

INSTANTIATE_TEST_SUITE_P(Library, EveryKind, ::testing::Range(0, static_cast<int>(ConstraintKinds::info.size())),
                         [](const auto& info) { return std::string(ConstraintKinds::info[info.param].name); });

TEST(ConstraintKinds, OneThatIsUnknownIsRefusedWithItsSite) {
    const TetMesh mesh = testing::kuhn_cube(2);
    BoundaryConstraints constraints = testing::constraints_on(mesh, VertexConstraint::axis, testing::smooth_field(mesh));
    constraints.kind[3] = static_cast<VertexConstraint>(ConstraintKinds::info.size());
    try {
        initial_frames(vertex_sampling(mesh), constraints);
        FAIL();
    } catch (const InvalidInput& error) {
        EXPECT_EQ(error.kind(), "unknown_word");
        EXPECT_EQ(error.elements(), std::vector<Index>{3});
        EXPECT_NE(std::string(error.what()).find("0 free, 1 axis, 2 fixed"), std::string::npos);
    }
}

}  // namespace
}  // namespace octafield::volume
