// Frames in the tets: their coupling, the same solvers on it, boundary, conversion.

#include "octafield/volume/sampling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "field_fixtures.hpp"
#include "octafield/volume/frame_field.hpp"
#include "octafield/volume/integrability.hpp"
#include "octafield/volume/locking.hpp"
#include "tet_fixtures.hpp"

namespace octafield::volume {
namespace {

using frames::Quaternion;
using frames::Vector3;
using testing::centroid;
using testing::jittered_cube;
using testing::kuhn_cube;
using testing::largest_distance;
using testing::sample_in_tets;

Quaternion smooth_at(const Vector3& x) {
    return frames::exp({0.4 * std::sin(2 * x.y()), 0.5 * x.x() * x.z(), 0.6 * x.x() - 0.3 * x.z()});
}

// Any tangents will do.
Points tangents(const BoundarySurface& surface) {
    const Points normals = surface::triangle_normals(surface.mesh);
    Points result(normals.rows(), 3);
    for (Eigen::Index f = 0; f < result.rows(); ++f)
        result.row(f) = Vector3(normals.row(f).transpose()).unitOrthogonal().transpose();
    return result;
}

// The tets at the boundary held at the frames of a field, or one axis of each.
BoundaryConstraints held_on_boundary(const TetMesh& mesh, const Quaternions& field, VertexConstraint kind) {
    const BoundarySurface surface = boundary_surface(mesh);
    BoundaryConstraints c = tet_boundary_constraints(mesh, tangents(surface), {.mode = BoundaryMode::none});
    for (Eigen::Index t = 0; t < field.rows(); ++t) {
        if (!c.on_boundary[t]) continue;
        c.kind[t] = kind;
        c.frames.row(t) = field.row(t);
        if (kind == VertexConstraint::axis)
            c.axis.row(t) =
                (frames::from_wxyz(frames::Vector4(field.row(t).transpose())) * Vector3::UnitZ()).transpose();
    }
    return c;
}

TEST(TetSampling, CouplesTwoTetsByAreaOverDistanceOfTheirCentroids) {
    TetMesh mesh{Points(5, 3), Tets(2, 4)};
    mesh.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0.3, 0.3, 2, 0.3, 0.3, -1;
    mesh.tets << 0, 1, 2, 3, 0, 2, 1, 4;
    const Sampling sampling = tet_sampling(mesh);
    const double weight = 0.5 / 0.75;  // centroids at the heights 2/4 and -1/4
    EXPECT_EQ(sampling.sites, Sites::tets);
    EXPECT_NEAR(sampling.stiffness.coeff(0, 1), -weight, 1e-14);
    EXPECT_NEAR(sampling.stiffness.coeff(0, 0), weight, 1e-14);
    EXPECT_NEAR(sampling.mass[0], 1.0 / 3, 1e-14);
    EXPECT_NEAR(sampling.mass[1], 1.0 / 6, 1e-14);
}

TEST(TetSampling, IsASymmetricSumOverPairsOfNeighbours) {
    const TetMesh mesh = jittered_cube(4, 0.2, 1);
    const Sampling sampling = tet_sampling(mesh);
    EXPECT_NEAR(sampling.mass.sum(), 1, 1e-12);
    EXPECT_NEAR(sampling.body_radius, 3.0 / 6, 1e-12);
    EXPECT_LT((sampling.stiffness * Eigen::VectorXd::Ones(sampling.count())).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_EQ((SparseMatrix(sampling.stiffness.transpose()) - sampling.stiffness).norm(), 0);
    Eigen::Index off_diagonal = 0;
    for (Index t = 0; t < sampling.count(); ++t)
        for (SparseMatrix::InnerIterator entry(sampling.stiffness, t); entry; ++entry)
            if (entry.row() != entry.col()) {
                EXPECT_LT(entry.value(), 0);
                ++off_diagonal;
            }
    EXPECT_EQ(off_diagonal, 4 * mesh.tets.rows() - boundary_surface(mesh).mesh.triangles.rows());
}

TEST(TetSampling, OfOneTetHasNoNeighboursAndSolversLeaveItAlone) {
    const TetMesh mesh{kuhn_cube(1).vertices, kuhn_cube(1).tets.topRows(1)};
    const Sampling sampling = tet_sampling(mesh);
    const BoundarySurface surface = boundary_surface(mesh);
    const BoundaryConstraints c = tet_boundary_constraints(mesh, tangents(surface), {.mode = BoundaryMode::none});
    const Quaternions start = frames::random_rotations(1, 3);
    EXPECT_EQ(dirichlet_energy(sampling, start), 0);
    EXPECT_LT(largest_distance(frame_field(sampling, c).smooth.frames, initial_frames(sampling, c)), 1e-7);
    EXPECT_LT(largest_distance(smooth(sampling, c, start).frames, start), 1e-7);
}

TEST(VertexSampling, HasTheEnergyOfTheTables) {
    const TetMesh mesh = jittered_cube(5, 0.2, 2);
    const Quaternions field = frames::random_rotations(mesh.vertices.rows(), 3);
    const double energy = dirichlet_energy(mesh, field);
    EXPECT_NEAR(dirichlet_energy(vertex_sampling(mesh), field), energy, 1e-12 * energy);
    EXPECT_THROW(dirichlet_energy(vertex_sampling(mesh), field.topRows(3)), InvalidInput);
}

// LM, L-BFGS and the trust region are independent of each other down to how they sum the energy.
class EverySolver : public ::testing::TestWithParam<std::tuple<Sites, SmoothSolver, VertexConstraint>> {};

TEST_P(EverySolver, ReachesTheSameMinimum) {
    const auto [sites, solver, kind] = GetParam();
    const TetMesh mesh = jittered_cube(4, 0.2, 4);
    const bool tets = sites == Sites::tets;
    const Sampling sampling = tets ? tet_sampling(mesh) : vertex_sampling(mesh);
    const BoundaryConstraints constraints = tets
                                                ? held_on_boundary(mesh, sample_in_tets(mesh, smooth_at), kind)
                                                : testing::constraints_on(mesh, kind, testing::sample(mesh, smooth_at));
    const Quaternions start = initial_frames(sampling, constraints);
    SmoothOptions options;
    options.tolerance = 1e-7;  // Gauss-Newton steps creep along soft modes: less would take them thousands
    const SmoothResult reference = smooth(sampling, constraints, start, options);
    options.solver = solver;
    const SmoothResult result = smooth(sampling, constraints, start, options);
    EXPECT_TRUE(result.converged) << result.message;
    EXPECT_NEAR(result.energy, reference.energy, 1e-4 * reference.energy);
    if (kind == VertexConstraint::fixed) {  // free twists leave soft modes
        EXPECT_LT(largest_distance(result.frames, reference.frames), 0.02);
    }
    EXPECT_NEAR(result.energy, result.objective, 1e-9 * result.energy);
    EXPECT_NEAR(result.energy, dirichlet_energy(sampling, result.frames), 1e-12 * result.energy);
}

INSTANTIATE_TEST_SUITE_P(Smooth, EverySolver,
                         ::testing::Combine(::testing::Values(Sites::vertices, Sites::tets),
                                            ::testing::Values(SmoothSolver::trust_region,
                                                              SmoothSolver::levenberg_marquardt, SmoothSolver::lbfgs),
                                            ::testing::Values(VertexConstraint::fixed, VertexConstraint::axis)));

TEST(FrameField, EndsWithAnySolverWhereThereIsNoEnergy) {
    const TetMesh mesh = kuhn_cube(3);
    const Quaternions constant = testing::sample(mesh, [](const Vector3&) { return Quaternion::Identity(); });
    const BoundaryConstraints constraints = testing::constraints_on(mesh, VertexConstraint::fixed, constant);
    for (const char* representation : {"sh4", "geodesic", "odeco_lengths"})
        for (const SmoothSolver solver : {SmoothSolver::levenberg_marquardt, SmoothSolver::lbfgs}) {
            FrameFieldOptions options;
            options.smooth.representation = representation;
            options.smooth.solver = solver;
            const SmoothResult result = frame_field(mesh, constraints, options).smooth;
            EXPECT_LT(result.energy, 1e-12);
            EXPECT_FALSE(result.energy_history.empty());
        }
}

TEST(TetField, RecoversAConstantFieldFromARandomStart) {
    const TetMesh mesh = jittered_cube(5, 0.2, 5);
    const Sampling sampling = tet_sampling(mesh);
    const Quaternion q = frames::exp({0.4, -0.7, 0.1});
    const Quaternions constant = sample_in_tets(mesh, [&](const Vector3&) { return q; });
    const BoundaryConstraints constraints = held_on_boundary(mesh, constant, VertexConstraint::fixed);
    EXPECT_LT(largest_distance(initial_frames(sampling, constraints), constant), 1e-6);
    FrameFieldOptions options;
    options.seed = 6;
    EXPECT_LT(largest_distance(frame_field(sampling, constraints, options).smooth.frames, constant), 1e-4);
}

TEST(TetField, IsSmoothedInMetricsToo) {
    const TetMesh mesh = jittered_cube(4, 0.2, 7);
    const Sampling sampling = tet_sampling(mesh);
    const BoundaryConstraints constraints =
        held_on_boundary(mesh, sample_in_tets(mesh, smooth_at), VertexConstraint::fixed);
    const FrameFieldResult sh4 = frame_field(sampling, constraints);
    FrameFieldOptions options;
    options.smooth.representation = "geodesic";
    const FrameFieldResult geodesic = frame_field(sampling, constraints, options);
    // The metric is what sh4's becomes, over 20/3, where neighbours differ little.
    EXPECT_NEAR(geodesic.smooth.objective, 3.0 / 20 * sh4.smooth.energy, 0.02 * sh4.smooth.energy);
    EXPECT_LT(largest_distance(geodesic.smooth.frames, sh4.smooth.frames), 0.1);
}

TEST(TetField, GivesTheSameBitsAtAnyThreadCount) {
    const TetMesh mesh = jittered_cube(8, 0.2, 8);
    const Sampling sampling = tet_sampling(mesh);
    const BoundaryConstraints constraints =
        held_on_boundary(mesh, sample_in_tets(mesh, smooth_at), VertexConstraint::axis);
    FrameFieldOptions options;
    options.threads = 1;
    const Quaternions one = frame_field(sampling, constraints, options).smooth.frames;
    options.threads = 3;
    EXPECT_EQ(one, frame_field(sampling, constraints, options).smooth.frames);
    EXPECT_EQ(vertex_frames(mesh, one, 1), vertex_frames(mesh, one, 3));
    EXPECT_EQ(dirichlet_energy(sampling, one, 1), dirichlet_energy(sampling, one, 3));
}

TEST(TetField, RefusesConstraintsOfTheVertices) {
    const TetMesh mesh = kuhn_cube(3);
    const Quaternions field = testing::sample(mesh, smooth_at);
    const BoundaryConstraints constraints = testing::constraints_on(mesh, VertexConstraint::fixed, field);
    EXPECT_THROW(initial_frames(tet_sampling(mesh), constraints), InvalidInput);
    EXPECT_THROW(smooth(tet_sampling(mesh), constraints, field), InvalidInput);
    EXPECT_THROW(diffuse(tet_sampling(mesh), constraints, field), InvalidInput);
}

TEST(TetBoundary, HoldsTheNormalOfEachTriangleExactly) {
    const TetMesh mesh = kuhn_cube(4);
    const BoundarySurface surface = boundary_surface(mesh);
    const BoundaryConstraints c = tet_boundary_constraints(mesh, tangents(surface));
    EXPECT_TRUE(c.released_corners.empty());
    const Edges sides = TetDomain(mesh).sides();
    std::vector<int> triangles(mesh.tets.rows(), 0);
    for (Eigen::Index f = 0; f < sides.rows(); ++f) ++triangles[sides(f, 0)];
    for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t) {
        EXPECT_EQ(c.on_boundary[t], triangles[t] > 0);
        const VertexConstraint expected = triangles[t] == 0   ? VertexConstraint::free
                                          : triangles[t] == 1 ? VertexConstraint::axis
                                                              : VertexConstraint::fixed;
        EXPECT_EQ(c.kind[t], expected);
    }
    EXPECT_EQ(*std::max_element(triangles.begin(), triangles.end()), 2);
    const FrameFieldResult result = frame_field(tet_sampling(mesh), c);
    EXPECT_LT(result.smooth.energy, 1e-12);
    EXPECT_LT(tet_alignment_angles(mesh, result.smooth.frames).maxCoeff(), 1e-7);
    EXPECT_EQ(tet_alignment_angles(mesh, result.smooth.frames).size(), surface.mesh.triangles.rows());
}

TEST(TetBoundary, FollowsTheModes) {
    const TetMesh mesh = kuhn_cube(3);
    const BoundarySurface surface = boundary_surface(mesh);
    const Points directions = tangents(surface);
    const auto with = [&](BoundaryMode mode) { return tet_boundary_constraints(mesh, directions, {.mode = mode}); };
    const BoundaryConstraints fixed = with(BoundaryMode::fixed), none = with(BoundaryMode::none);
    EXPECT_EQ(fixed.frames, none.frames);
    for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t) {
        EXPECT_EQ(none.kind[t], VertexConstraint::free);
        EXPECT_EQ(fixed.kind[t], fixed.on_boundary[t] ? VertexConstraint::fixed : VertexConstraint::free);
    }
    // Normal and direction of a tet with one triangle are axes of its frame.
    const Edges sides = TetDomain(mesh).sides();
    const Points normals = surface::triangle_normals(surface.mesh);
    for (Eigen::Index f = 0; f < normals.rows(); ++f) {
        const Index t = sides(f, 0);
        const Quaternion q = frames::from_wxyz(frames::Vector4(fixed.frames.row(t).transpose()));
        EXPECT_NEAR((q.conjugate() * Vector3(normals.row(f).transpose())).cwiseAbs().maxCoeff(), 1, 1e-12);
    }
}

// Sheared by 45 degrees, normals at the edges of the cube fit no frame within 20 degrees. Splitting what joins the
// surface to itself leaves no tet with two triangles.
TEST(TetBoundary, ReleasesTetsWhoseNormalsFitNoFrameUntilTheyAreSplit) {
    TetMesh mesh = kuhn_cube(3);
    mesh.vertices.col(0) += mesh.vertices.col(1);
    const BoundarySurface surface = boundary_surface(mesh);
    const BoundaryConstraints c = tet_boundary_constraints(mesh, tangents(surface));
    EXPECT_FALSE(c.released_corners.empty());
    for (const Index t : c.released_corners) EXPECT_EQ(c.kind[t], VertexConstraint::free);
    const BoundaryConstraints loose = tet_boundary_constraints(mesh, tangents(surface), {.feature_tolerance = 0.5});
    EXPECT_TRUE(loose.released_corners.empty());

    const TetMesh split = split_locking(mesh).mesh;
    const BoundarySurface of_split = boundary_surface(split);
    const BoundaryConstraints held = tet_boundary_constraints(split, tangents(of_split));
    EXPECT_TRUE(held.released_corners.empty());
    EXPECT_EQ(std::count(held.kind.begin(), held.kind.end(), VertexConstraint::axis), of_split.mesh.triangles.rows());
    const SmoothResult field = frame_field(tet_sampling(split), held).smooth;
    EXPECT_LT(tet_alignment_angles(split, field.frames).maxCoeff(), 1e-7);
}

TEST(TetBoundary, HoldsBothSidesOfAnInterface) {
    const TetMesh mesh = kuhn_cube(4);
    std::vector<Index> regions(mesh.tets.rows());
    for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t) regions[t] = centroid(mesh, t).z() > 0.5;
    const TetDomain domain(mesh, regions);
    const BoundaryConstraints c = tet_boundary_constraints(domain, tangents(domain.surface()));
    for (Eigen::Index f = 0; f < domain.sides().rows(); ++f)
        for (const Index t : {domain.sides()(f, 0), domain.sides()(f, 1)})
            EXPECT_TRUE(t < 0 || c.kind[t] != VertexConstraint::free);
    const Quaternions frames = frame_field(tet_sampling(mesh), c).smooth.frames;
    const Eigen::VectorXd angles = tet_alignment_angles(domain, frames);
    EXPECT_EQ(angles.size(), domain.sides().rows() + domain.interface_triangles());
    EXPECT_LT(angles.maxCoeff(), 1e-7);
}

TEST(TetBoundary, RefusesWhatIsNotOfTheMesh) {
    const TetMesh mesh = kuhn_cube(3);
    const Points directions = tangents(boundary_surface(mesh));
    EXPECT_THROW(tet_boundary_constraints(mesh, directions.topRows(2)), InvalidInput);
    EXPECT_THROW(tet_boundary_constraints(mesh, directions, {.feature_tolerance = -1}), InvalidInput);
    EXPECT_THROW(tet_alignment_angles(mesh, Quaternions(2, 4)), InvalidInput);
}

TEST(VertexFrames, FollowSmoothFieldsToFirstOrder) {
    double before = 0;
    for (const int n : {4, 8}) {
        const TetMesh mesh = kuhn_cube(n);
        const Quaternions field = testing::sample(mesh, smooth_at);
        const double error = largest_distance(vertex_frames(mesh, sample_in_tets(mesh, smooth_at)), field);
        EXPECT_LT(error, 1.2 / n);
        EXPECT_TRUE(before == 0 || error < 0.6 * before);  // first order at the boundary, whose means lie inside
        before = error;
    }
    const TetMesh mesh = kuhn_cube(3);
    const Quaternions constant = sample_in_tets(mesh, [](const Vector3&) { return frames::exp({0.2, 0.9, 0.4}); });
    EXPECT_LT(largest_distance(vertex_frames(mesh, constant), testing::sample(mesh,
                                                                              [](const Vector3&) {
                                                                                  return frames::exp({0.2, 0.9, 0.4});
                                                                              })),
              1e-7);
    EXPECT_THROW(vertex_frames(mesh, constant.topRows(4)), InvalidInput);
}

}  // namespace
}  // namespace octafield::volume
