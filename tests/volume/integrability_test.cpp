#include "octafield/volume/integrability.hpp"

#include <gtest/gtest.h>

#include "octafield/error.hpp"
#include "octafield/frames/octahedral_group.hpp"
#include "tet_fixtures.hpp"

namespace octafield::volume {
namespace {

using frames::Quaternion;
using frames::Vector3;
using testing::kuhn_cube;
using testing::sample;

Quaternions any_representative(Quaternions frames) {
    std::mt19937_64 generator(7);
    for (Eigen::Index v = 0; v < frames.rows(); ++v)
        frames.row(v) =
            frames::to_wxyz(frames::from_wxyz(frames.row(v)) * frames::binary_octahedral_group()[generator() % 48])
                .transpose();
    return frames;
}

// The map x -> x / |x|^2 is conformal; its derivative is a reflection up to scale, minus it the half turn about x.
Quaternions inversion(const TetMesh& mesh) {
    return sample(mesh, [](const Vector3& x) {
        const Vector3 d = (x + Vector3(1, 1.2, 1.4)).normalized();
        return Quaternion(0, d.x(), d.y(), d.z());
    });
}

Quaternions screw(const TetMesh& mesh, double rate) {
    return sample(mesh, [=](const Vector3& x) { return frames::exp({0, 0, rate * x.z()}); });
}

TEST(Integrability, OfConstantFieldsIsZero) {
    const TetMesh mesh = kuhn_cube(4);
    const Quaternion q = frames::exp({0.3, 0.5, -0.2});
    const Integrability found =
        integrability(mesh, any_representative(sample(mesh, [&](const Vector3&) { return q; })));
    EXPECT_LT(found.jump_max, 1e-14);
    EXPECT_LT(found.twist_max, 1e-13);
}

TEST(Integrability, OfAConformalMapGoesToZeroWithTheMesh) {
    Integrability coarse = integrability(kuhn_cube(4), inversion(kuhn_cube(4)));
    ASSERT_GT(coarse.jump_rms, 0.01);
    for (const int n : {8, 16}) {
        const TetMesh mesh = kuhn_cube(n);
        const Integrability fine = integrability(mesh, inversion(mesh));
        EXPECT_LT(fine.jump_rms, 0.55 * coarse.jump_rms);  // first order
        EXPECT_LT(fine.jump_max, 0.65 * coarse.jump_max);
        EXPECT_LT(fine.twist_rms, 0.55 * coarse.twist_rms);  // first order
        coarse = fine;
    }
    EXPECT_LT(coarse.twist_rms, 0.05);
}

// n = (cos cz, sin cz, 0) has curl -c n; so has the second axis, and the third none.
TEST(Integrability, OfAScrewFieldTendsToItsTwistAndNotToZero) {
    double before = 1;
    for (const int n : {4, 8, 16}) {
        const TetMesh mesh = kuhn_cube(n);
        const double error = std::abs(integrability(mesh, screw(mesh, 0.8)).twist_rms - 0.8 * std::sqrt(2));
        EXPECT_LT(error, 0.55 * before);
        before = error;
    }
    EXPECT_LT(before, 1e-2);
}

// Two halves turned against each other by `angle` about the normal of the plane between them: for both axes in the
// plane the jump is a chord of length 2 sin(angle / 2), all of it tangential. Turned about another axis, only a part
// is.
TEST(Integrability, JumpIsTheTangentialPartOfTheDifferenceOfTheAxes) {
    TetMesh mesh{Points(5, 3), Tets(2, 4)};
    mesh.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0.2, 0.2, 1, 0.3, 0.3, -1;
    mesh.tets << 0, 1, 2, 3, 0, 2, 1, 4;
    for (const Vector3& axis : {Vector3(0, 0, 1), Vector3(1, 0, 0)}) {
        Quaternions frames = sample(mesh, [](const Vector3&) { return Quaternion::Identity(); });
        frames.row(4) = frames::to_wxyz(frames::exp(0.2 * axis)).transpose();
        const Quaternion between = frames::from_wxyz(tet_frames(mesh, frames).row(1));
        const double angle = 2 * std::acos(between.w());
        EXPECT_GT(angle, 0.04);
        const double chord = 2 * std::sin(angle / 2);
        // About x: (0, cos, sin) and (0, -sin, cos) move in the plane by 1 - cos and sin.
        const double expected = axis.z() > 0 ? std::sqrt(2) * chord : std::hypot(1 - std::cos(angle), std::sin(angle));
        const Integrability found = integrability(mesh, frames);
        EXPECT_NEAR(found.jump_max, expected, 1e-12);
        EXPECT_NEAR(found.jump_rms, expected, 1e-12);
    }
}

TEST(Integrability, DoesNotDependOnRepresentativesAndScalesAsItsUnits) {
    TetMesh mesh = kuhn_cube(5);
    const Quaternions field = screw(mesh, 1.1);
    const Integrability found = integrability(mesh, field), other = integrability(mesh, any_representative(field));
    EXPECT_NEAR(other.jump_rms, found.jump_rms, 1e-13);
    EXPECT_NEAR(other.twist_rms, found.twist_rms, 1e-12);
    mesh.vertices *= 1e-6;
    const Integrability small = integrability(mesh, field);
    EXPECT_NEAR(small.jump_rms, found.jump_rms, 1e-13);
    EXPECT_NEAR(small.twist_rms * 1e-6, found.twist_rms, 1e-12);
    EXPECT_NEAR(small.twist_max * 1e-6, found.twist_max, 1e-12);
}

TEST(Integrability, IsTheSameAtAnyThreadCount) {
    const TetMesh mesh = kuhn_cube(7);
    const Quaternions field = frames::random_rotations(mesh.vertices.rows(), 2);
    const Integrability serial = integrability(mesh, field, 1), parallel = integrability(mesh, field, 5);
    EXPECT_EQ(serial.jump_rms, parallel.jump_rms);
    EXPECT_EQ(serial.twist, parallel.twist);
    EXPECT_LE(serial.jump_max, std::sqrt(6));
}

TEST(Integrability, BadInputIsRefused) {
    const TetMesh mesh = kuhn_cube(2);
    EXPECT_THROW(integrability(mesh, Quaternions::Zero(mesh.vertices.rows(), 4)), InvalidInput);
    EXPECT_THROW(integrability(mesh, Quaternions::Zero(2, 4)), InvalidInput);
    EXPECT_THROW(integrability(TetMesh{}, Quaternions(0, 4)), GeometryError);
}

}  // namespace
}  // namespace octafield::volume
