// The laws that every kind of constraint obeys (volume/constraint_kinds.hpp), as one typed suite. The library's kinds
// join by themselves (constraint_kinds_test.cpp), another by INSTANTIATE_TYPED_TEST_SUITE_P(Name, ConstraintKindLaws,
// Type).
#pragma once

#include <gtest/gtest.h>
#include "ceres_manifold_matchers.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "frame_manifolds.hpp"
#include "octafield/frames/octahedral_group.hpp"
#include "octafield/volume/constraint_kinds.hpp"

namespace octafield::volume {

inline frames::Quaternion row_quaternion(const Quaternions& rows, Eigen::Index i) {
    return frames::from_wxyz(frames::Vector4(rows.row(i).transpose()));
}

// An orthonormal basis whose first columns are those of `basis`.
template <int Unknowns>
frames::Matrix3 completed(const TangentBasis<Unknowns>& basis) {
    frames::Matrix3 all = Eigen::HouseholderQR<Eigen::MatrixXd>(Eigen::MatrixXd(basis)).householderQ();
    all.leftCols<Unknowns>() = basis;
    return all;
}

template <class Kind>
class ConstraintKindLaws : public ::testing::Test {
protected:
    struct Case {
        Kind kind;
        frames::Quaternion on;     // a frame that the kind allows
        frames::Quaternion start;  // one that it may not allow
    };
    static std::vector<Case> cases() {
        const Quaternions random = frames::random_rotations(60, 11);
        std::vector<Case> list;
        for (Eigen::Index i = 0; i < random.rows(); i += 3) {
            const SiteConstraint given{row_quaternion(random, i) * frames::Vector3::UnitX(),
                                       random.row(i + 1).transpose()};
            const Kind kind(given);
            const frames::Quaternion start = row_quaternion(random, i + 2);
            list.push_back({kind, kind.moved(start), start});
        }
        return list;
    }
    // Of a frame from the set: what moved() moves it by (radians).
    static double off(const Kind& kind, const frames::Quaternion& q) { return frames::distance(kind.moved(q), q); }
};

TYPED_TEST_SUITE_P(ConstraintKindLaws);

TYPED_TEST_P(ConstraintKindLaws, MovingTwiceIsMovingOnceAndGivesAUnitQuaternion) {
    for (const auto& [kind, on, start] : this->cases()) {
        EXPECT_NEAR(on.norm(), 1, 1e-14);
        EXPECT_LT(this->off(kind, on), 1e-7);
    }
}

// A frame is a class of 24 rotations.
TYPED_TEST_P(ConstraintKindLaws, AFrameIsAllowedWhicheverRotationStandsForIt) {
    for (const auto& [kind, on, start] : this->cases())
        for (const frames::Quaternion& o : frames::octahedral_group()) {
            const frames::Quaternion other = (on * o).normalized();
            EXPECT_LT(this->off(kind, other), 1e-7);
            const auto columns = kind.length_columns(on), turned = kind.length_columns(other);
            EXPECT_EQ(std::multiset<int>(columns.begin(), columns.end()),
                      std::multiset<int>(turned.begin(), turned.end()));
        }
}

TYPED_TEST_P(ConstraintKindLaws, HoldsAsManyLengthsAsItSays) {
    for (const auto& [kind, on, start] : this->cases()) {
        const auto columns = kind.length_columns(on);
        EXPECT_EQ(std::count_if(columns.begin(), columns.end(), [](int column) { return column >= 0; }),
                  TypeParam::held_lengths);
        for (const int column : columns) EXPECT_TRUE(column >= -1 && column < 3);
    }
}

// Tangents are tangent, what is orthogonal to them is not: the dimension is the number of unknowns.
TYPED_TEST_P(ConstraintKindLaws, UnknownsAreTheDimensionOfWhatIsAllowed) {
    constexpr int unknowns = TypeParam::unknowns;
    const double h = 1e-3;
    for (const auto& [kind, on, start] : this->cases()) {
        frames::Matrix3 basis = frames::Matrix3::Identity();
        if constexpr (PartialConstraintKind<TypeParam>) {
            const TangentBasis<unknowns> tangents = kind.tangents(on);
            EXPECT_TRUE((tangents.transpose() * tangents).isIdentity(1e-12));
            basis = completed<unknowns>(tangents);
        }
        for (int k = 0; k < 3; ++k) {
            const double left = this->off(kind, frames::exp(h * basis.col(k)) * on);
            if (k < unknowns)
                EXPECT_LT(left, 5 * h * h);
            else
                EXPECT_GT(left, 0.1 * h);
        }
    }
}

TYPED_TEST_P(ConstraintKindLaws, TheChartStaysOnWhatIsAllowedAndFollowsTheTangents) {
    if constexpr (PartialConstraintKind<TypeParam>) {
        constexpr int unknowns = TypeParam::unknowns;
        for (const auto& [kind, on, start] : this->cases())
            for (int k = 0; k < unknowns; ++k) {
                Turn<unknowns> turn = Turn<unknowns>::Zero();
                EXPECT_LT(frames::log(kind.turned(on, turn) * on.conjugate()).norm(), 1e-12);
                turn[k] = 1.3;
                EXPECT_LT(this->off(kind, kind.turned(on, turn)), 1e-7);
                const double h = 1e-4;
                turn[k] = h;
                const frames::Vector3 ahead = frames::log(kind.turned(on, turn) * on.conjugate());
                turn[k] = -h;
                const frames::Vector3 behind = frames::log(kind.turned(on, turn) * on.conjugate());
                EXPECT_LT(((ahead - behind) / (2 * h) - kind.tangents(on).col(k)).norm(), 1e-7);
            }
    }
}

TYPED_TEST_P(ConstraintKindLaws, ItsManifoldObeysCeresInvariants) {
    if constexpr (PartialConstraintKind<TypeParam>) {
        using namespace ceres;  // its matchers
        for (const auto& [kind, on, start] : this->cases()) {
            const ConstraintManifold<TypeParam> manifold(kind);
            using Small = Turn<TypeParam::unknowns>;
            const Eigen::VectorXd x = frames::to_wxyz(on), delta = Small::Constant(0.7),
                                  y = frames::to_wxyz(kind.turned(on, Small::Constant(-0.4)));
            // All of Ceres' but the derivative of Minus off the set, where Minus has no meaning.
            EXPECT_THAT(manifold, XPlusZeroIsXAt(x, 1e-8));
            EXPECT_THAT(manifold, XMinusXIsZeroAt(x, 1e-8));
            EXPECT_THAT(manifold, MinusPlusIsIdentityAt(x, delta, 1e-8));
            EXPECT_THAT(manifold, PlusMinusIsIdentityAt(x, y, 1e-8));
            EXPECT_THAT(manifold, HasCorrectPlusJacobianAt(x, 1e-8));
            EXPECT_THAT(manifold, MinusPlusJacobianIsIdentityAt(x, 1e-8));
            EXPECT_THAT(manifold, HasCorrectRightMultiplyByPlusJacobianAt(x, 1e-8));
        }
    }
}

// The sh4 vectors of what is allowed are in the affine space, and nearest() finds the nearest of them.
TYPED_TEST_P(ConstraintKindLaws, ItsSpaceHoldsTheSh4VectorsOfWhatIsAllowed) {
    using frames::Sh4;
    if constexpr (PartialConstraintKind<TypeParam>) {
        constexpr int unknowns = TypeParam::unknowns;
        std::mt19937_64 generator(5);
        const auto random = [&] { return 2 * frames::uniform01(generator) - 1; };
        for (const auto& [kind, on, start] : this->cases()) {
            const typename TypeParam::Space space(kind, on);
            Sh4::Vector wanted, other;
            for (int c = 0; c < Sh4::dimension; ++c) wanted[c] = random(), other[c] = random();
            // An orthogonal projection.
            EXPECT_LT((space.reached(space.reached(wanted)) - space.reached(wanted)).norm(), 1e-12);
            EXPECT_NEAR(space.reached(wanted).dot(other), wanted.dot(space.reached(other)), 1e-12);

            const Sh4::Vector fallback = Sh4::embed(on), nearest = space.nearest(wanted, fallback);
            const frames::Quaternion frame = space.frame(nearest);
            EXPECT_LT((Sh4::embed(frame) - nearest).norm(), 1e-12);
            EXPECT_LT(this->off(kind, frame), 1e-7);
            EXPECT_LT((space.nearest(nearest, fallback) - nearest).norm(), 1e-7);
            frames::Quaternion q = on;
            for (int sample = 0; sample < 300; ++sample) {
                q = kind.turned(q, Turn<unknowns>(Turn<unknowns>::NullaryExpr([&](Eigen::Index) { return random(); })));
                const Sh4::Vector a = Sh4::embed(q), from_centre = a - space.centre();
                EXPECT_LT((space.reached(from_centre) - from_centre).norm(), 1e-10);
                EXPECT_GE((wanted - a).norm(), (wanted - nearest).norm() - 1e-9);
            }
        }
    }
}

REGISTER_TYPED_TEST_SUITE_P(ConstraintKindLaws, MovingTwiceIsMovingOnceAndGivesAUnitQuaternion,
                            AFrameIsAllowedWhicheverRotationStandsForIt, HoldsAsManyLengthsAsItSays,
                            UnknownsAreTheDimensionOfWhatIsAllowed, TheChartStaysOnWhatIsAllowedAndFollowsTheTangents,
                            ItsManifoldObeysCeresInvariants, ItsSpaceHoldsTheSh4VectorsOfWhatIsAllowed);

}  // namespace octafield::volume
