// Sizes along the axes, against maps whose gradients are known.
#include "octafield/volume/scaling.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <ostream>

#include "field_fixtures.hpp"
#include "octafield/error.hpp"
#include "octafield/frames/octahedral_group.hpp"
#include "octafield/volume/integrability.hpp"
#include "tet_fixtures.hpp"

namespace octafield::volume {
namespace {

using frames::Matrix3;
using frames::Quaternion;
using frames::Vector3;
using testing::kuhn_cube;
using testing::kuhn_grid;
using testing::mixed_representatives;
using testing::sample;

// A map with orthogonal gradients h_i n_i on the image of the unit cube.
struct Known {
    const char* name;
    std::function<Vector3(const Vector3&)> place;      // of a point of the unit cube
    std::function<Matrix3(const Vector3&)> axes;       // n_i as columns, of a place
    std::function<Vector3(const Vector3&)> log_scale;  // log h_i
};

void PrintTo(const Known& known, std::ostream* out) { *out << known.name; }

double radius(const Vector3& x) { return std::hypot(x.x(), x.y()); }

Matrix3 spherical_axes(const Vector3& x) {
    const Vector3 r = x.normalized(), phi = Vector3(-x.y(), x.x(), 0).normalized();
    Matrix3 axes;
    axes << r, phi.cross(r), phi;
    return axes;
}

// Coordinates r, theta, z.
const Known polar{"polar",
                  [](const Vector3& p) -> Vector3 {
                      const double r = 1 + p.x(), t = 1.8 * p.y();
                      return {r * std::cos(t), r * std::sin(t), p.z()};
                  },
                  [](const Vector3& x) -> Matrix3 {
                      const double r = radius(x);
                      Matrix3 axes;
                      axes << x.x() / r, -x.y() / r, 0, x.y() / r, x.x() / r, 0, 0, 0, 1;
                      return axes;
                  },
                  [](const Vector3& x) { return Vector3(0, -std::log(radius(x)), 0); }};

// Coordinates r, theta (from the pole), phi.
const Known spherical{"spherical",
                      [](const Vector3& p) -> Vector3 {
                          const double r = 1 + p.x(), t = 0.7 + 0.9 * p.y(), f = 1.2 * p.z();
                          return {r * std::sin(t) * std::cos(f), r * std::sin(t) * std::sin(f), r * std::cos(t)};
                      },
                      spherical_axes,
                      [](const Vector3& x) { return Vector3(0, -std::log(x.norm()), -std::log(radius(x))); }};

// The inverse of the plane's exponential map: log h is that of |1 / z| for both axes, and 0 for the third.
const Known exponential{"exponential", polar.place, polar.axes, [](const Vector3& x) {
                            const double h = -std::log(radius(x));
                            return Vector3(h, h, 0);
                        }};

double volume_mean(const TetMesh& mesh, const std::function<double(Index)>& of_tet) {
    const Eigen::VectorXd volumes = tet_volumes(mesh);
    double sum = 0;
    for (Index t = 0; t < volumes.size(); ++t) sum += volumes[t] * of_tet(t);
    return sum / volumes.sum();
}

TetMesh image_of_grid(int n, const Known& known) {
    TetMesh mesh = kuhn_cube(n);
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
        mesh.vertices.row(v) = known.place(mesh.vertices.row(v).transpose()).transpose();
    if (tet_volumes(mesh).minCoeff() < 0) mesh.tets.col(0).swap(mesh.tets.col(1));
    return mesh;
}

Quaternions frames_of(const TetMesh& mesh, const Known& known) {
    return mixed_representatives(sample(mesh, [&](const Vector3& x) { return Quaternion(Matrix3(known.axes(x))); }));
}

// Root mean square, over tets and axes, of H_i at the centres less log h_i, each of mean 0.
double distance_to(const TetMesh& mesh, const AxisScales& found, const Known& known) {
    Points exact(mesh.tets.rows(), 3), scales(mesh.tets.rows(), 3);
    for (Index t = 0; t < exact.rows(); ++t) {
        const Vector3 x = testing::centroid(mesh, t);
        exact.row(t) = known.log_scale(x).transpose();
        // Which axis of the tet's frame is n_i.
        const Matrix3 match =
            (frames::from_wxyz(found.of_tets.row(t)).toRotationMatrix().transpose() * known.axes(x)).cwiseAbs();
        for (int i = 0; i < 3; ++i) {
            Eigen::Index k;
            match.col(i).maxCoeff(&k);
            scales(t, i) = found.log_scales(t, k);
        }
    }
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
        const double shift = volume_mean(mesh, [&](Index t) { return scales(t, i) - exact(t, i); });
        sum += volume_mean(mesh, [&](Index t) { return std::pow(scales(t, i) - exact(t, i) - shift, 2); });
    }
    return std::sqrt(sum);
}

class KnownScales : public ::testing::TestWithParam<Known> {};

TEST_P(KnownScales, PerAxisTakeTheCurlAwayAsTheMeshIsRefined) {
    double curl = 1e9, error = 1e9, jump = 1e9, before = 0;
    for (const int n : {4, 8, 16}) {
        const TetMesh mesh = image_of_grid(n, GetParam());
        const AxisScales found = axis_scales(mesh, frames_of(mesh, GetParam()));
        EXPECT_EQ(found.parts, 3);
        EXPECT_EQ(found.values.size(), 3 * mesh.vertices.rows());
        EXPECT_LT(found.after.curl_rms, 0.6 * curl);  // first order
        EXPECT_LT(distance_to(mesh, found, GetParam()), 0.6 * error);
        EXPECT_GT(found.before.curl_rms, 0.4);
        EXPECT_LT(found.after.jump_rms, 0.6 * jump);
        EXPECT_LE(found.iterations, 30);  // at any n
        jump = found.after.jump_rms;
        curl = found.after.curl_rms;
        error = distance_to(mesh, found, GetParam());
        before = found.before.curl_rms;
    }
    EXPECT_LT(curl, 0.08 * before);
    EXPECT_LT(error, 0.03);
}

INSTANTIATE_TEST_SUITE_P(Maps, KnownScales, ::testing::Values(polar, spherical),
                         [](const auto& p) { return std::string(p.param.name); });

// Only the curl counts: the polar frame has many scales that take it away, h_r = f(r) and h_theta = g(theta) / r. The
// least change along the axes picks f = 1; that of the conformal map has the same curl.
TEST(AxisScales, OfTheExponentialMapAreTheSameUpToFunctionsOfTheAxesOwnParameters) {
    const TetMesh mesh = image_of_grid(8, exponential);
    const AxisScales found = axis_scales(mesh, frames_of(mesh, exponential));
    EXPECT_LT(found.after.curl_rms, 0.2 * found.before.curl_rms);
    EXPECT_LT(distance_to(mesh, found, polar), 0.5 * distance_to(mesh, found, exponential));
}

// g = 1/2 sum (n_i . grad) n_i = -1/2 e_r / r: H = -1/2 log r, and of |curl|^2 = 1 / r^2 a half is left.
TEST(IsotropicScale, OfThePolarFrameIsHalfTheLogarithmAndLeavesHalfOfTheSquaredCurl) {
    double error = 1e9;
    for (const int n : {4, 8, 16}) {
        const TetMesh mesh = image_of_grid(n, polar);
        const IsotropicScale found = isotropic_scale(mesh, frames_of(mesh, polar));
        double mean = 0, square = 0;
        for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
            const double d = found.log_scale[v] + std::log(radius(mesh.vertices.row(v))) / 2;
            mean += d / mesh.vertices.rows();
            square += d * d / mesh.vertices.rows();
        }
        const double spread = std::sqrt(square - mean * mean);
        EXPECT_LT(spread, 0.6 * error);
        error = spread;
        EXPECT_NEAR(found.after.curl_rms / found.before.curl_rms, 1 / std::sqrt(2), 0.4 / n);
        EXPECT_NEAR(
            found.before.curl_rms,
            std::sqrt(volume_mean(mesh, [&](Index t) { return std::pow(radius(testing::centroid(mesh, t)), -2); })),
            0.5 / n);
    }
    EXPECT_LT(error, 0.01);
}

// x / |x|^2 is conformal with the factor 1 / |x|^2.
TEST(IsotropicScale, OfAnInversionIsThatOfTheMap) {
    double curl = 1e9, error = 1e9, jump = 1e9;
    for (const int n : {4, 8, 16}) {
        const TetMesh mesh = kuhn_cube(n);
        const Vector3 shift(1, 1.2, 1.4);
        const IsotropicScale found = isotropic_scale(mesh, mixed_representatives(sample(mesh, [&](const Vector3& x) {
                                                         const Vector3 d = (x + shift).normalized();
                                                         return Quaternion(0, d.x(), d.y(), d.z());
                                                     })));
        const Eigen::VectorXd exact =
            -2 * (mesh.vertices.rowwise() + shift.transpose()).rowwise().norm().array().log().matrix();
        Eigen::VectorXd difference = found.log_scale - exact;
        difference.array() -= difference.mean();
        const double spread = difference.norm() / std::sqrt(double(difference.size()));
        EXPECT_LT(spread, 0.6 * error);
        EXPECT_LT(found.after.curl_rms, 0.6 * curl);
        EXPECT_LT(found.after.jump_rms, 0.6 * jump);
        jump = found.after.jump_rms;
        error = spread;
        curl = found.after.curl_rms;
        EXPECT_GT(found.before.curl_rms, 0.8);
    }
    EXPECT_LT(curl, 0.08);
    EXPECT_LT(error, 0.005);
}

TEST(Scales, OfAConstantFieldAreZero) {
    const TetMesh mesh = kuhn_cube(4);
    const Quaternions field = mixed_representatives(sample(mesh, [](const Vector3&) {
        return frames::exp({0.3, 0.5, -0.2});
    }));
    const IsotropicScale one = isotropic_scale(mesh, field);
    EXPECT_LT(one.log_scale.cwiseAbs().maxCoeff(), 1e-13);
    EXPECT_LT(one.after.curl_max, 1e-12);
    EXPECT_LT(one.after.jump_max, 1e-12);
    const AxisScales three = axis_scales(mesh, field);
    EXPECT_LT(three.values.cwiseAbs().maxCoeff(), 1e-13);
    EXPECT_EQ(three.parts, 3);
}

// Round a line of a quarter turn the two axes across it are exchanged, so they are one set; the third is its own.
TEST(AxisScales, OfAxesThatASingularCurveExchangesAreOneSet) {
    const int n = 6;
    const TetMesh mesh = kuhn_grid(n, n, n, 1.0 / n, Vector3(-0.5 + 0.137 / n, -0.5 + 0.071 / n, -0.5));
    const Quaternions field = mixed_representatives(sample(mesh, [](const Vector3& x) {
        return frames::exp({0, 0, std::atan2(x.y(), x.x()) / 4});
    }));
    const AxisScales found = axis_scales(mesh, field);
    EXPECT_EQ(found.parts, 2);
    EXPECT_LT(found.values.size(), 3 * mesh.vertices.rows());
    EXPECT_GE(found.values.size(), 3 * mesh.vertices.rows() - 2 * (n + 1));
    EXPECT_LT(found.after.curl_rms, found.before.curl_rms);
}

TEST(Scales, NeverAddCurlAndAgreeWithIntegrabilityBefore) {
    const TetMesh mesh = testing::jittered_cube(5, 0.2, 3);
    const Quaternions field = testing::smooth_field(mesh);
    const IsotropicScale one = isotropic_scale(mesh, field);
    const AxisScales three = axis_scales(mesh, field, {1e-3, 1});
    EXPECT_LT(one.after.curl_rms, one.before.curl_rms);
    EXPECT_LT(three.after.curl_rms, one.after.curl_rms);
    const Integrability unscaled = integrability(mesh, field);
    EXPECT_NEAR(one.before.jump_rms, unscaled.jump_rms, 1e-13);
    EXPECT_NEAR(three.before.jump_max, unscaled.jump_max, 1e-13);
    EXPECT_EQ(three.after.curl.maxCoeff(), three.after.curl_max);
    EXPECT_EQ(three.after.curl.size(), mesh.tets.rows());
    EXPECT_GE(three.after.curl_rms, unscaled.twist_rms);  // no scale takes the twist away
}

// Large enough for several threads to assemble and multiply.
TEST(Scales, HaveTheSameBitsAtAnyThreadCount) {
    const TetMesh mesh = testing::jittered_cube(20, 0.2, 3);
    const Quaternions field = testing::smooth_field(mesh);
    const IsotropicScale one = isotropic_scale(mesh, field, 1);
    const AxisScales three = axis_scales(mesh, field, {0.1, 1});
    for (const int threads : {2, 3}) {
        EXPECT_EQ(isotropic_scale(mesh, field, threads).log_scale, one.log_scale);
        EXPECT_EQ(axis_scales(mesh, field, {0.1, threads}).values, three.values);
    }
}

TEST(Scales, ChangeWithTheUnitAsDensitiesDo) {
    TetMesh mesh = kuhn_cube(4);
    const Quaternions field = testing::smooth_field(mesh);
    const IsotropicScale found = isotropic_scale(mesh, field);
    const AxisScales three = axis_scales(mesh, field);
    mesh.vertices *= 1e-6;
    const IsotropicScale small = isotropic_scale(mesh, field);
    EXPECT_LT((small.log_scale - found.log_scale).cwiseAbs().maxCoeff(), 1e-7);
    EXPECT_NEAR(small.after.curl_rms * 1e-6, found.after.curl_rms, 1e-9);
    EXPECT_LT((axis_scales(mesh, field).values - three.values).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(Scales, HaveMeanZeroInEachPartAndZeroAtVerticesOfNoTet) {
    TetMesh mesh = kuhn_grid(5, 2, 2, 0.2, Vector3(0.3, 0, 0), [](int i, int, int) { return i != 2; });
    const Eigen::Index n = mesh.vertices.rows();
    mesh.vertices.conservativeResize(n + 1, 3);
    mesh.vertices.row(n).setZero();
    const IsotropicScale found = isotropic_scale(mesh, testing::smooth_field(mesh));
    EXPECT_EQ(found.parts, 2);
    EXPECT_EQ(found.log_scale[n], 0);
    for (const bool left : {true, false}) {
        double sum = 0;
        const Eigen::VectorXd volumes = tet_volumes(mesh);
        for (Index t = 0; t < volumes.size(); ++t)
            if ((testing::centroid(mesh, t).x() < 0.8) == left)
                sum += volumes[t] * found.log_scale(mesh.tets.row(t)).mean();
        EXPECT_NEAR(sum, 0, 1e-12);
    }
    EXPECT_EQ(axis_scales(mesh, testing::smooth_field(mesh)).parts, 6);
}

TEST(Scales, AreTheSameAtAnyThreadCountAndRefuseBadInput) {
    const TetMesh mesh = testing::jittered_cube(6, 0.2, 3);
    const Quaternions field = frames::random_rotations(mesh.vertices.rows(), 2);
    EXPECT_EQ(isotropic_scale(mesh, field, 1).log_scale, isotropic_scale(mesh, field, 5).log_scale);
    const AxisScales serial = axis_scales(mesh, field, {0.1, 1}), parallel = axis_scales(mesh, field, {0.1, 5});
    EXPECT_EQ(serial.values, parallel.values);
    EXPECT_EQ(serial.after.curl_rms, parallel.after.curl_rms);
    EXPECT_THROW(isotropic_scale(mesh, Quaternions::Zero(mesh.vertices.rows(), 4)), InvalidInput);
    EXPECT_THROW(axis_scales(mesh, field.topRows(2)), InvalidInput);
    for (const double along : {0.0, -1.0, 1.5, std::nan("")})
        EXPECT_THROW(axis_scales(mesh, field, {along, 1}), InvalidInput);
    EXPECT_THROW(isotropic_scale(TetMesh{}, Quaternions(0, 4)), GeometryError);
}

}  // namespace
}  // namespace octafield::volume
