#include "octafield/volume/periodic_map.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "integer_constraints.hpp"
#include "map_fixtures.hpp"
#include "octafield/error.hpp"

namespace octafield::volume {
namespace {

using testing::corner_of;
using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;
using frames::Quaternion;

Points equal_lengths(const TetDomain& domain, double length) { return Points::Constant(domain.tet_count(), 3, length); }

Vector3 coordinate(const PeriodicMap& map, Index tet, int corner) {
    return Vector3(map.coordinates(tet, 3 * corner), map.coordinates(tet, 3 * corner + 1),
                   map.coordinates(tet, 3 * corner + 2)) /
           periodic_unit;
}

// Rows: the gradients of the three coordinates.
Matrix3 gradient(const TetDomain& domain, const PeriodicMap& map, Index tet) {
    Matrix3 edges, rises;
    for (int k = 0; k < 3; ++k) {
        edges.col(k) = domain.mesh().vertices.row(domain.mesh().tets(tet, k + 1)) -
                       domain.mesh().vertices.row(domain.mesh().tets(tet, 0));
        rises.col(k) = coordinate(map, tet, k + 1) - coordinate(map, tet, 0);
    }
    return rises * edges.inverse();
}

double off_integer(double x) { return std::abs(x - std::round(x)); }

// Where two tets are usable: y = o^-1 x + integers, exactly, is what joined says.
void expect_agreement(const TetDomain& domain, const PeriodicMap& map) {
    const Index inner = static_cast<Index>(map.faces.tets.rows());
    ASSERT_EQ(map.joined.size(), static_cast<std::size_t>(inner));
    for (Index f = 0; f < inner; ++f) {
        const Index one = map.faces.tets(f, 0), other = map.faces.tets(f, 1);
        const Matrix3 turn = frames::octahedral_group()[map.faces.matching[f]].conjugate().toRotationMatrix();
        bool agree = map.usable[one] && map.usable[other];
        Vector3 shift;
        for (int k = 0; k < 3 && agree; ++k) {
            const Index v = map.faces.triangles(f, k);
            const Vector3 difference = coordinate(map, other, corner_of(domain.mesh(), other, v)) -
                                       turn * coordinate(map, one, corner_of(domain.mesh(), one, v));
            if (k == 0) shift = difference.array().round();
            agree = (difference - shift).norm() < 1e-9;
        }
        ASSERT_EQ(bool(map.joined[f]), agree) << f;
        if (agree) {
            ASSERT_EQ(shift, map.translation.row(f).cast<double>().transpose());
        }
    }
}

void expect_usable_are_positive(const TetDomain& domain, const PeriodicMap& map) {
    Index unusable = 0;
    for (Index t = 0; t < domain.tet_count(); ++t) {
        unusable += !map.usable[t];
        if (map.usable[t]) {
            EXPECT_GT(gradient(domain, map, t).determinant(), 0);
        }
    }
    EXPECT_EQ(unusable, map.inconsistent + map.turned_over);
}

// On a constant field the coordinates are those of the frame over the lengths, up to rounding to the unit.
void expect_affine(const TetDomain& domain, const PeriodicMap& map, const Quaternions& frames, const Vector3& lengths) {
    double shortest = 1e9;
    for (Index t = 0; t < domain.tet_count(); ++t)
        for (int a = 0; a < 4; ++a)
            for (int b = 0; b < a; ++b) {
                const Index v = domain.mesh().tets(t, a), w = domain.mesh().tets(t, b);
                shortest = std::min(shortest, (domain.mesh().vertices.row(v) - domain.mesh().vertices.row(w)).norm());
            }
    for (Index t = 0; t < domain.tet_count(); ++t) {
        ASSERT_TRUE(map.usable[t]);
        const Matrix3 expected =
            lengths.cwiseInverse().asDiagonal() * frames::from_wxyz(frames.row(t)).toRotationMatrix().transpose();
        EXPECT_LT((gradient(domain, map, t) - expected).norm(), 100.0 / periodic_unit / shortest);
    }
    for (const std::uint8_t joined : map.joined) ASSERT_TRUE(joined);
}

TEST(PeriodicMap, IsAffineOnAConstantFieldWithWholeNumbersOfCells) {
    const TetDomain domain = testing::with_detected_features(testing::jittered_box({1, 1.2, 0.9}, 3));
    Quaternions frames = Quaternions::Zero(domain.tet_count(), 4);
    frames.col(0).setOnes();
    const Points lengths = Eigen::RowVector3d(0.25, 0.2, 0.3).replicate(domain.tet_count(), 1);
    const PeriodicMap map = periodic_map(domain, frames, lengths);
    expect_affine(domain, map, frames, {0.25, 0.2, 0.3});
    expect_agreement(domain, map);
}

TEST(PeriodicMap, IsTheSameWhateverTheAxesAreCalledTetByTet) {
    const TetDomain domain = testing::with_detected_features(testing::jittered_box({1, 1, 1}, 3));
    Quaternions frames = Quaternions::Zero(domain.tet_count(), 4);
    frames.col(0).setOnes();
    frames = testing::renamed(frames, 3);
    const PeriodicMap map = periodic_map(domain, frames, equal_lengths(domain, 0.25));
    expect_affine(domain, map, frames, {0.25, 0.25, 0.25});
    expect_agreement(domain, map);
    EXPECT_TRUE(std::any_of(map.faces.matching.begin(), map.faces.matching.end(), [](int m) { return m > 3; }));
}

TEST(PeriodicMap, FollowsARotatedBox) {
    const Quaternion turn = frames::exp(frames::Vector3(0.3, -0.2, 0.4));
    const TetDomain domain = testing::with_detected_features(
        testing::moved_mesh(testing::jittered_cube(3, 0.2, 2), [&](const Vector3& x) { return Vector3(turn * x); }));
    const Quaternions frames =
        testing::renamed(testing::sample_in_tets(domain.mesh(), [&](const frames::Vector3&) { return turn; }), 5);
    expect_affine(domain, periodic_map(domain, frames, equal_lengths(domain, 0.2)), frames, {0.2, 0.2, 0.2});
}

// Where nothing is held but the surface, of two walls: the third part of a cell too much is shared by all cells.
TEST(PeriodicMap, StretchesCellsToWholeNumbersBetweenWalls) {
    for (const double cells : {3.3, 3.7}) {
        const TetDomain domain = testing::with_detected_features(testing::kuhn_cube(4));
        Quaternions frames = Quaternions::Zero(domain.tet_count(), 4);
        frames.col(0).setOnes();
        const PeriodicMap map = periodic_map(domain, frames, equal_lengths(domain, 1 / cells));
        EXPECT_EQ(map.inconsistent, 0);
        EXPECT_EQ(map.turned_over, 0);
        double sum = 0;
        for (Index t = 0; t < domain.tet_count(); ++t)
            sum += gradient(domain, map, t)(0, 0) * tet_volumes(domain.mesh())[t];
        EXPECT_NEAR(sum, std::round(cells), 0.02);
    }
}

// Normals of the surface, named independently: the axis nearest to a triangle's normal has one integer all over it.
TEST(PeriodicMap, NormalsOfTheSurfaceAreHeldOnIntegers) {
    const TetDomain domain = testing::with_detected_features(testing::tube_quarter(5));
    const Quaternions frames = testing::renamed(testing::sample_in_tets(domain.mesh(), testing::along_cylinder), 7);
    // Along the circles cells grow with the radius, so that the field has a map without jumps.
    Points lengths = equal_lengths(domain, 0.23);
    for (Index t = 0; t < domain.tet_count(); ++t) {
        const Vector3 at = testing::centroid(domain.mesh(), t);
        for (int i = 0; i < 3; ++i) {
            const Vector3 axis = frames::from_wxyz(frames.row(t)) * Vector3::Unit(i);
            if (std::abs(axis.dot(Vector3(-at.y(), at.x(), 0))) > 0.9 * at.head<2>().norm())
                lengths(t, i) *= at.head<2>().norm();
        }
    }
    const PeriodicMap map = periodic_map(domain, frames, lengths);
    expect_agreement(domain, map);
    expect_usable_are_positive(domain, map);
    EXPECT_EQ(map.inconsistent, 0);
    const BoundarySurface& surface = domain.surface();
    for (Eigen::Index f = 0; f < surface.mesh.triangles.rows(); ++f) {
        const Index tet = domain.sides()(f, 0);
        std::array<Index, 3> ids;
        for (int k = 0; k < 3; ++k) ids[k] = surface.vertex_map[surface.mesh.triangles(f, k)];
        const auto p = [&](int k) { return Vector3(domain.mesh().vertices.row(ids[k])); };
        const Vector3 normal = (p(1) - p(0)).cross(p(2) - p(0)).normalized();
        const Vector3 in_frame = frames::from_wxyz(frames.row(tet)).conjugate() * normal;
        Eigen::Index axis;
        ASSERT_GT(in_frame.cwiseAbs().maxCoeff(&axis), 0.98);
        const double first = coordinate(map, tet, corner_of(domain.mesh(), tet, ids[0]))[axis];
        EXPECT_EQ(off_integer(first), 0);
        for (int k = 1; k < 3; ++k) EXPECT_EQ(coordinate(map, tet, corner_of(domain.mesh(), tet, ids[k]))[axis], first);
    }
}

TEST(PeriodicMap, CornersAndTheDirectionsAcrossFeaturesAreHeldOnIntegers) {
    // Free surface (hold_angle 0 holds none of the normals at 20 degrees): one feature edge after another by hand.
    const TetDomain plain(testing::kuhn_cube(3));
    const TetDomain domain = testing::with_detected_features(testing::kuhn_cube(3));
    const Quaternion turn = frames::exp(frames::Vector3(0, 0, 0.1));
    const Quaternions frames = testing::sample_in_tets(domain.mesh(), [&](const frames::Vector3&) { return turn; });
    const PeriodicMap map = periodic_map(domain, frames, equal_lengths(domain, 0.31));
    for (const auto& e : domain.features().edges.rowwise()) {
        const Index a = domain.surface().vertex_map[e[0]], b = domain.surface().vertex_map[e[1]];
        const Vector3 along = domain.mesh().vertices.row(b) - domain.mesh().vertices.row(a);
        Eigen::Index axis;
        along.cwiseAbs().maxCoeff(&axis);
        for (Index t = 0; t < domain.tet_count(); ++t) {
            const int c = corner_of(domain.mesh(), t, a), d = corner_of(domain.mesh(), t, b);
            if (c < 0 || d < 0 || !map.usable[t]) continue;
            for (int i = 0; i < 3; ++i)
                if (i != axis) {
                    EXPECT_EQ(off_integer(coordinate(map, t, c)[i]), 0);
                    EXPECT_EQ(coordinate(map, t, c)[i], coordinate(map, t, d)[i]);
                }
        }
    }
    ASSERT_EQ(domain.features().corners.size(), 8u);
    for (const Index corner : domain.features().corners)
        for (Index t = 0; t < domain.tet_count(); ++t) {
            const int c = corner_of(domain.mesh(), t, domain.surface().vertex_map[corner]);
            for (int i = 0; i < 3 && c >= 0; ++i) EXPECT_EQ(off_integer(coordinate(map, t, c)[i]), 0);
        }
}

TEST(IntegerConstraints, NormalsAreHeldWithinTheAngleOnly) {
    const TetDomain domain(testing::kuhn_cube(2));
    const Quaternion turn = frames::exp(frames::Vector3(0, 0, 0.3));
    const Quaternions frames = testing::sample_in_tets(domain.mesh(), [&](const frames::Vector3&) { return turn; });
    for (const double angle : {0.29, 0.31}) {
        const IntegerConstraints constraints(domain, frames, angle);
        for (std::size_t f = 0; f < domain.surface_rows().size(); ++f) {
            const Points p = domain.surface().mesh.vertices(domain.surface().mesh.triangles.row(f), Eigen::all);
            const bool across_z = p.col(2).maxCoeff() == p.col(2).minCoeff();
            const int axis = constraints.normal_axis()[domain.surface_rows()[f]];
            if (across_z) {
                EXPECT_EQ(axis, 2);
            } else if (angle < 0.3) {
                EXPECT_EQ(axis, -1);
            } else {
                EXPECT_TRUE(axis == 0 || axis == 1);
            }
        }
    }
}

TEST(PeriodicMap, AgreesAcrossTrianglesWhereTheFieldIsSingularOrNoFieldAtAll) {
    const TetDomain domain = testing::with_detected_features(testing::jittered_cube(4, 0.2, 9));
    const Quaternions singular = testing::sample_in_tets(domain.mesh(), [](const frames::Vector3& x) {
        return frames::exp(frames::Vector3(0, 0, std::atan2(x.y() - 0.47, x.x() - 0.52) / 4));
    });
    const Quaternions by_chance = testing::random_frames(domain.tet_count(), 4);
    for (const Quaternions& frames : {singular, by_chance}) {
        const PeriodicMap map = periodic_map(domain, frames, equal_lengths(domain, 0.3));
        expect_agreement(domain, map);
        expect_usable_are_positive(domain, map);
    }
}

TEST(PeriodicMap, SameBitsWithAnyNumberOfThreads) {
    const TetDomain domain = testing::with_detected_features(testing::jittered_cube(5, 0.2, 9));
    const Quaternions frames = testing::sample_in_tets(domain.mesh(), [](const frames::Vector3& x) {
        return frames::exp(frames::Vector3(0, 0, std::atan2(x.y() - 0.47, x.x() - 0.52) / 4));
    });
    PeriodicMapOptions options;
    options.threads = 1;
    const PeriodicMap one = periodic_map(domain, frames, equal_lengths(domain, 0.2), options);
    options.threads = 2;
    const PeriodicMap two = periodic_map(domain, frames, equal_lengths(domain, 0.2), options);
    EXPECT_EQ(one.coordinates, two.coordinates);
    EXPECT_EQ(one.usable, two.usable);
    EXPECT_EQ(one.translation, two.translation);
    EXPECT_EQ(one.joined, two.joined);
}

template <class Call>
std::string kind_of(const Call& call) {
    try {
        call();
    } catch (const InvalidInput& error) {
        return error.kind();
    }
    return "nothing thrown";
}

TEST(PeriodicMap, NamesWhatIsWrongWithItsInput) {
    const TetDomain domain(testing::kuhn_cube(1));
    Quaternions frames = Quaternions::Zero(6, 4);
    frames.col(0).setOnes();
    const Points lengths = equal_lengths(domain, 0.5);
    const auto run = [&](const Quaternions& q, const Points& l, const PeriodicMapOptions& o = {}) {
        return kind_of([&] { periodic_map(domain, q, l, o); });
    };
    EXPECT_EQ(run(frames.topRows(5), lengths), "wrong_size");
    EXPECT_EQ(run(frames, lengths.topRows(5)), "wrong_size");
    EXPECT_EQ(run(2 * frames, lengths), "not_unit");
    for (const double bad :
         {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        Points wrong = lengths;
        wrong(3, 1) = bad;
        EXPECT_EQ(run(frames, wrong), "edge_length") << bad;
        PeriodicMapOptions options;
        options.hold_angle = bad == 0 ? 2 : bad;
        EXPECT_EQ(run(frames, lengths, options), "hold_angle") << bad;
    }
    PeriodicMapOptions options;
    options.rounds = -1;
    EXPECT_EQ(run(frames, lengths, options), "rounds");
}

TEST(PeriodicMap, LengthsFarTooSmallAreRefused) {
    const TetDomain domain(testing::kuhn_cube(1));
    Quaternions frames = Quaternions::Zero(6, 4);
    frames.col(0).setOnes();
    for (const double length : {5e-5, 1e-9, 1e-30, 1e-300})
        EXPECT_EQ(kind_of([&] { periodic_map(domain, frames, equal_lengths(domain, length)); }), "edge_length");
    EXPECT_NO_THROW(periodic_map(domain, frames, equal_lengths(domain, 1e-4)));
}

TEST(PeriodicMap, EndsWhereProgressSaysSo) {
    const TetDomain domain(testing::kuhn_cube(2));
    Quaternions frames = Quaternions::Zero(domain.tet_count(), 4);
    frames.col(0).setOnes();
    for (int calls = 0; calls < 13; ++calls) {
        int left = calls;
        EXPECT_THROW(periodic_map(domain, frames, equal_lengths(domain, 0.3), {},
                                  [&](std::string_view, double, double) { return left-- > 0; }),
                     Cancelled);
    }
}

}  // namespace
}  // namespace octafield::volume
