// Schemes of the user's: minimised as the compiled ones are, with the derivatives that are given and without.
#include "octafield/volume/array_scheme.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "array_functions.hpp"
#include "array_model.hpp"
#include "field_fixtures.hpp"
#include "frame_difference.hpp"
#include "octafield/frames/sh4.hpp"
#include "octafield/frames/sh469.hpp"
#include "octafield/volume/frame_field.hpp"

namespace octafield::volume {
namespace {

using frames::Quaternion;
using frames::Vector3;
using testing::constraints_on;
using testing::jittered_cube;
using testing::largest_distance;
using testing::smooth_field;

Quaternion at(const Quaternions& frames, Eigen::Index v) {
    return frames::from_wxyz(frames::Vector4(frames.row(v).transpose()));
}

template <frames::Representation R>
std::shared_ptr<ArrayScheme> embedding_of(bool with_differential) {
    auto scheme = std::make_shared<ArrayScheme>();
    scheme->name = "own";
    scheme->dimension = R::dimension;
    scheme->embed = [](const Quaternions& frames) {
        ArrayValues values(frames.rows(), R::dimension);
        for (Eigen::Index v = 0; v < frames.rows(); ++v) values.row(v) = R::embed(at(frames, v)).transpose();
        return values;
    };
    if (with_differential)
        scheme->differential = [](const Quaternions& frames) {
            ArrayValues values(frames.rows(), 3 * R::dimension);
            for (Eigen::Index v = 0; v < frames.rows(); ++v)
                Eigen::Map<Rows<double, 3>>(values.row(v).data(), R::dimension, 3) = R::differential(at(frames, v));
            return values;
        };
    return scheme;
}

std::shared_ptr<ArrayScheme> geodesic(bool with_differential) {
    auto scheme = std::make_shared<ArrayScheme>();
    scheme->name = "own";
    scheme->dimension = 3;
    scheme->residual = [](const Quaternions& p, const Quaternions& q) {
        ArrayValues values(p.rows(), 3);
        for (Eigen::Index e = 0; e < p.rows(); ++e)
            values.row(e) = GeodesicScheme{}.difference(0, at(p, e), at(q, e), false).value.transpose();
        return values;
    };
    if (with_differential)
        scheme->residual_differential = [](const Quaternions& p, const Quaternions& q) {
            ArrayValues values(p.rows(), 18);
            for (Eigen::Index e = 0; e < p.rows(); ++e) {
                const auto d = GeodesicScheme{}.difference(0, at(p, e), at(q, e), true);
                Eigen::Map<Rows<double, 6>>(values.row(e).data(), 3, 6) << d.by_first, d.by_second;
            }
            return values;
        };
    return scheme;
}

SmoothOptions minimising(std::shared_ptr<const ArrayScheme> scheme, double tolerance = 1e-10) {
    SmoothOptions options;
    options.own_scheme = std::move(scheme);
    options.tolerance = tolerance;
    return options;
}

SmoothOptions minimising(const char* name, double tolerance = 1e-10) {
    SmoothOptions options;
    options.representation = name;
    options.tolerance = tolerance;
    return options;
}

template <class R>
void expect_the_compiled_one(const char* name, VertexConstraint kind) {
    const TetMesh mesh = jittered_cube(5, 0.2, 4);
    const Sampling sampling = vertex_sampling(mesh);
    const BoundaryConstraints constraints = constraints_on(mesh, kind, smooth_field(mesh));
    const Quaternions start = frames::random_rotations(sampling.count(), 3);
    const SmoothResult compiled = smooth(sampling, constraints, start, minimising(name));
    for (const bool with_differential : {true, false}) {
        const auto scheme = embedding_of<R>(with_differential);
        const SmoothResult own = smooth(sampling, constraints, start, minimising(scheme));
        EXPECT_TRUE(own.converged);
        EXPECT_NEAR(own.objective, compiled.objective, 1e-7 * compiled.objective);
        EXPECT_NEAR(own.objective, array_energy(*scheme, sampling, own.frames), 1e-12 * own.objective);
        EXPECT_LT(largest_distance(own.frames, compiled.frames), 1e-3);
        EXPECT_GT(largest_distance(own.frames, start), 0.1);
    }
}

TEST(ArrayScheme, EmbeddingReachesTheMinimumOfTheCompiledRepresentation) {
    expect_the_compiled_one<frames::Sh4>("sh4", VertexConstraint::fixed);
    expect_the_compiled_one<frames::Sh4>("sh4", VertexConstraint::axis);
    expect_the_compiled_one<frames::Sh469>("sh469", VertexConstraint::fixed);
}

TEST(ArrayScheme, ResidualsReachTheFieldOfTheCompiledGeodesic) {
    const TetMesh mesh = testing::kuhn_cube(5);
    const Sampling sampling = vertex_sampling(mesh);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::fixed, smooth_field(mesh));
    const Quaternions start = initial_frames(sampling, constraints);
    const SmoothResult compiled = smooth(sampling, constraints, start, minimising("geodesic"));
    for (const bool with_differential : {true, false}) {
        const SmoothResult own = smooth(sampling, constraints, start, minimising(geodesic(with_differential)));
        EXPECT_TRUE(own.converged);
        EXPECT_NEAR(own.objective, compiled.objective, 1e-7 * compiled.objective);
        EXPECT_LT(largest_distance(own.frames, compiled.frames), 1e-4);
        EXPECT_GT(largest_distance(own.frames, start), 1e-4);
    }
}

TEST(ArrayScheme, DifferencesAreTheDerivatives) {
    const Quaternions frames = frames::random_rotations(20, 5), others = frames::random_rotations(20, 6);
    const auto exact = embedding_of<frames::Sh469>(true), differences = embedding_of<frames::Sh469>(false);
    const ArrayValues values = embedded(*exact, frames), images = embedded(*exact, others);
    const EmbeddingDerivatives a = derivatives(*exact, frames, values, images, 1),
                               b = derivatives(*differences, frames, values, images, 1);
    EXPECT_LT((a.differentials - b.differentials).cwiseAbs().maxCoeff(), 1e-8);
    for (Eigen::Index v = 0; v < 20; ++v) {
        const frames::Matrix3 hessian = frames::Sh469::hessian(at(frames, v), images.row(v).transpose());
        EXPECT_LT((a.curvatures[v] - hessian).norm(), 1e-3 * hessian.norm());
        EXPECT_LT((b.curvatures[v] - hessian).norm(), 1e-3 * hessian.norm());
    }
}

TEST(ArrayScheme, HessianIsTheDerivativeOfTheGradient) {
    const TetMesh mesh = jittered_cube(3, 0.2, 4);
    const Sampling sampling = vertex_sampling(mesh);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::axis, smooth_field(mesh));
    const auto scheme = embedding_of<frames::Sh4>(false);
    ArrayEmbeddingModel model(*scheme, sampling, constraints, 1);
    Quaternions frames = smooth_field(mesh);
    Tangents w(frames.rows(), 3), y(frames.rows(), 3);
    const auto energy_at = [&](float t) {
        Quaternions turned = frames;
        for (Eigen::Index v = 0; v < frames.rows(); ++v)
            turned.row(v) =
                frames::to_wxyz(model.turns().turned(v, at(frames, v), t * w.row(v).transpose().cast<double>()))
                    .transpose();
        return array_energy(*scheme, sampling, turned);
    };
    const double energy = model.evaluate(frames);
    model.linearise(frames);
    for (Index v = 0; v < frames.rows(); ++v) {
        w.row(v) << std::sin(v), std::cos(2.0 * v), std::sin(3.0 * v + 1);
        w.row(v) = model.turns().allowed<float>(v, w.row(v).transpose()).transpose();
        model.turn(v, w.row(v).transpose());
    }
    const double slope = (model.gradient().array() * w.cast<double>().array()).sum(), bend = model.hessian_times(w, y);
    const float h = 1e-2f;
    const double up = energy_at(h), down = energy_at(-h);
    EXPECT_NEAR((up - down) / (2 * h), slope, 2e-3 * std::abs(slope));
    EXPECT_NEAR((up + down - 2 * energy) / (h * h), bend, 2e-3 * std::abs(bend));
}

TEST(ArrayScheme, RecipeMinimisesItAfterItsRoundsWithTheSameBitsAtAnyThreadCount) {
    const TetMesh mesh = jittered_cube(4, 0.2, 4);
    const Sampling sampling = vertex_sampling(mesh);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::fixed, smooth_field(mesh));
    const auto scheme = embedding_of<frames::Sh469>(false);
    FrameFieldOptions options;
    options.smooth = minimising(scheme);
    options.threads = 1;
    const FrameFieldResult one = frame_field(sampling, constraints, options);
    options.threads = 2;
    const FrameFieldResult two = frame_field(sampling, constraints, options);
    EXPECT_EQ(one.smooth.frames, two.smooth.frames);
    EXPECT_DOUBLE_EQ(one.smooth.objective, array_energy(*scheme, sampling, one.smooth.frames, 2));
    EXPECT_LT(one.smooth.objective_history.back(), one.smooth.objective_history.front());
}

TEST(ArrayScheme, SitesOfNoTetStayWhereTheyAre) {
    TetMesh mesh = testing::kuhn_cube(2);
    mesh.vertices.conservativeResize(mesh.vertices.rows() + 1, 3);
    mesh.vertices.bottomRows(1).setConstant(0.4);
    const Sampling sampling = vertex_sampling(mesh);
    BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::free, smooth_field(mesh));
    const Quaternions start = frames::random_rotations(sampling.count(), 7);
    for (const auto& scheme : {embedding_of<frames::Sh4>(false), geodesic(false)}) {
        const SmoothResult own = smooth(sampling, constraints, start, minimising(scheme));
        EXPECT_EQ(own.frames.bottomRows(1), start.bottomRows(1));
        EXPECT_TRUE(own.frames.allFinite());
        EXPECT_LT(own.objective, array_energy(*scheme, sampling, start));
    }
}

TEST(ArrayScheme, WrongShapesAndNumbersAreToldWithTheFunctionsName) {
    const TetMesh mesh = testing::kuhn_cube(2);
    const Sampling sampling = vertex_sampling(mesh);
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::fixed, smooth_field(mesh));
    const Quaternions start = initial_frames(sampling, constraints);
    const auto message_of = [&](const SmoothOptions& options) {
        try {
            smooth(sampling, constraints, start, options);
        } catch (const InvalidInput& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    auto scheme = embedding_of<frames::Sh4>(false);
    scheme->embed = [](const Quaternions& frames) { return ArrayValues(frames.leftCols<3>()); };
    EXPECT_NE(message_of(minimising(scheme)).find("embed gave an array of shape (27, 3)"), std::string::npos);
    scheme->embed = [](const Quaternions& frames) {
        ArrayValues values = ArrayValues::Zero(frames.rows(), 9);
        values(4, 2) = std::nan("");
        return values;
    };
    EXPECT_NE(message_of(minimising(scheme)).find("not finite in row 4"), std::string::npos);
    scheme->residual = [](const Quaternions& p, const Quaternions&) { return ArrayValues(p.rows(), 9); };
    EXPECT_NE(message_of(minimising(scheme)).find("one of embed and residual"), std::string::npos);
    SmoothOptions ceres = minimising(embedding_of<frames::Sh4>(false));
    ceres.solver = SmoothSolver::lbfgs;
    EXPECT_NE(message_of(ceres).find("trust region"), std::string::npos);
}

}  // namespace
}  // namespace octafield::volume
