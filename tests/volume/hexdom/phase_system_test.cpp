#include "phase_system.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <numbers>
#include <random>

#include "axis_numbers.hpp"
#include "edge_fans.hpp"
#include "field_fixtures.hpp"
#include "phase_unknowns.hpp"

namespace octafield::volume {
namespace {

using testing::corner_of;
using Complex = std::complex<double>;
using Coupling = PhaseSystem::Coupling;

struct System {
    Index count;
    std::vector<std::uint8_t> held;
    std::vector<Coupling> couplings;
};

// Couplings of both kinds at random, moduli up to 1, that connect all.
System random_system(Index count, int held, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    System system{count, std::vector<std::uint8_t>(count, 0), {}};
    for (int k = 0; k < held; ++k) system.held[3 * k] = 1;
    const auto couple = [&](Index a, Index b) {
        system.couplings.push_back({a, b, uniform(random) < 0.5, 0.1 + uniform(random),
                                    std::polar(0.5 + uniform(random) / 2, 2 * std::numbers::pi * uniform(random))});
    };
    for (Index k = 1; k < count; ++k) couple(k, static_cast<Index>(random() % k));
    for (Index k = 0; k < 2 * count; ++k) {
        const Index a = random() % count, b = random() % count;
        if (a != b) couple(a, b);
    }
    return system;
}

// Two reals per unknown: weight |z_b - turn z_a|^2 written out as squares of real rows, with |turn| as if it were 1 on
// the diagonal, as the form has it: |z_b|^2 + |z_a|^2 - 2 Re(conj(z_b) turn z_a).
struct Dense {
    Eigen::MatrixXd quadratic;
    explicit Dense(const System& s) : quadratic(Eigen::MatrixXd::Zero(2 * s.count, 2 * s.count)) {
        for (const Coupling& c : s.couplings) {
            Eigen::Matrix2d turn;
            turn << c.turn.real(), -c.turn.imag(), c.turn.imag(), c.turn.real();
            if (c.conjugate) turn.col(1) *= -1;
            const auto block = [&](Index i, Index j) { return quadratic.block<2, 2>(2 * i, 2 * j); };
            block(c.a, c.a) += c.weight * Eigen::Matrix2d::Identity();
            block(c.b, c.b) += c.weight * Eigen::Matrix2d::Identity();
            block(c.b, c.a) -= c.weight * turn;
            block(c.a, c.b) -= c.weight * turn.transpose();
        }
    }
    // (L + shift D) z = shift D start, with the held ones 1.
    Phases solution(const System& s, double shift, const Phases& start) const {
        Eigen::MatrixXd a = quadratic;
        Eigen::VectorXd right = Eigen::VectorXd::Zero(a.rows());
        for (Eigen::Index i = 0; i < a.rows(); ++i) {
            const Complex z = start[i / 2];
            right[i] = shift * quadratic(i, i) * (i % 2 ? z.imag() : z.real());
            a(i, i) += shift * quadratic(i, i);
        }
        for (Eigen::Index i = 0; i < a.rows(); ++i)
            if (s.held[i / 2]) {
                a.row(i).setZero();
                a(i, i) = 1;
                right[i] = i % 2 == 0;
            }
        const Eigen::VectorXd x = a.fullPivLu().solve(right);
        Phases z;
        for (Index k = 0; k < s.count; ++k) z.emplace_back(x[2 * k], x[2 * k + 1]);
        return z;
    }
};

double largest_difference(const Phases& x, const Phases& y) {
    double largest = 0;
    for (std::size_t k = 0; k < x.size(); ++k) largest = std::max(largest, std::abs(x[k] - y[k]));
    return largest;
}

TEST(PhaseSystem, DiffusionSolvesTheDenseSystemWithBothKindsOfCouplings) {
    for (unsigned seed = 0; seed < 10; ++seed)
        for (const double shift : {0.0, 0.03, 1.0}) {
            const System s = random_system(30, 4, seed);
            const PhaseSystem system(s.count, s.held, s.couplings);
            EXPECT_EQ(system.free_count(), 26);
            Phases start = system.start();
            if (shift > 0)
                for (Index k = 0; k < s.count; ++k)
                    if (!s.held[k]) start[k] = std::polar(1.0, 0.7 * k);
            Phases z = start;
            system.diffuse(shift, 1e-12, z, 1);
            EXPECT_LT(largest_difference(z, Dense(s).solution(s, shift, start)), 1e-8);
            for (Index k = 0; k < s.count; ++k)
                if (s.held[k]) {
                    EXPECT_EQ(z[k], Complex(1));
                }
        }
}

TEST(PhaseSystem, SameBitsWithAnyNumberOfThreads) {
    const System s = random_system(3000, 30, 4);
    const PhaseSystem system(s.count, s.held, s.couplings);
    Phases one = system.start(), two = one;
    system.diffuse(0, 1e-9, one, 1);
    system.diffuse(0, 1e-9, two, 2);
    EXPECT_EQ(one, two);
}

TEST(PhaseSystem, OnePhaseOfEachPartWithoutHeldOnesIsArbitrary) {
    // 0 - 1 held; 2 - 3 - 4; 5 alone.
    const std::vector<Coupling> couplings{{0, 1, false, 1, 1}, {4, 3, true, 1, 1}, {3, 2, false, 1, 1}};
    const PhaseSystem system(6, {0, 1, 0, 0, 0, 0}, couplings);
    EXPECT_EQ(system.arbitrary(), (std::vector<Index>{2, 5}));
    EXPECT_TRUE(PhaseSystem(6, {0, 1, 1, 0, 0, 1}, couplings).arbitrary().empty());
}

TEST(PhaseSystem, PhasesAreOfModulusOneAfterNormalizationAndOneWhereNothingIsCoupled) {
    const PhaseSystem system(3, {1, 0, 0}, {{0, 1, false, 2, std::polar(0.5, 1.0)}});
    Phases z = system.start();
    system.diffuse(0, 1e-12, z, 1);
    system.normalize(z);
    EXPECT_LT(std::abs(z[1] - std::polar(1.0, 1.0)), 1e-12);
    EXPECT_EQ(z[2], Complex(1));
}

// Fans and unknowns, on a field that turns by `turns` quarter turns round the z axis through the middle of the cube.
struct Turning {
    TetDomain domain;
    Quaternions frames;
    FaceMatchings faces;
    explicit Turning(int quarter_turns, int n = 3) : domain(testing::kuhn_cube(n)) {
        frames = testing::sample_in_tets(domain.mesh(), [&](const frames::Vector3& x) {
            const double angle = std::atan2(x.y() - 0.47, x.x() - 0.52);
            return frames::exp(frames::Vector3(0, 0, quarter_turns * angle / 4));
        });
        faces = face_matchings(domain, frames);
    }
};

// The axes of the tets of a fan, carried to its first, are where geometry has them: within 45 degrees.
TEST(EdgeFans, CarryAxesToThoseThatPointTheSameWay) {
    const Turning field(0, 3);
    // A field that turns gently, named anew in each tet.
    Quaternions renamed = testing::sample_in_tets(field.domain.mesh(), [&](const frames::Vector3& x) {
        const auto number = static_cast<std::size_t>(1000 * std::abs(x.x() + 3 * x.y() + 7 * x.z()));
        return frames::exp(frames::Vector3(0.1 * x.x(), 0.2 * x.y(), 0.1)) *
               frames::octahedral_group()[number % frames::octahedral_order];
    });
    const TriangleTable& table = field.domain.triangles();
    const std::vector<std::uint8_t> matching = triangle_matchings(table, renamed, 1);
    std::vector<int> seen(6 * field.domain.tet_count(), 0);
    int fans = 0;
    for_each_fan(tets_at_edges(field.domain.mesh(), table, 1), table, matching, [&](const EdgeFan& fan) {
        ++fans;
        const auto frame = [&](Index tet) { return frames::from_wxyz(renamed.row(tet)); };
        for (const FanTet& at : fan.tets) {
            ASSERT_GE(corner_of(field.domain.mesh(), at.tet, fan.a), 0);
            ASSERT_GE(corner_of(field.domain.mesh(), at.tet, fan.b), 0);
            for (int i = 0; i < 3; ++i) {
                const frames::Vector3 here = frame(at.tet) * axis_unit(i),
                                      there = frame(fan.tets[0].tet) * axis_unit(at.axes[i]);
                EXPECT_GT(here.dot(there), 0.9);
            }
            ++seen[at.tet];
        }
        for (std::size_t k = 0; k + 1 < fan.tets.size(); ++k) EXPECT_EQ(fan.tets[k].exit, fan.tets[k + 1].entry);
        EXPECT_EQ(fan.closed, table.sides(fan.tets[0].entry, 1) >= 0);
        if (fan.closed) {
            EXPECT_EQ(fan.tets.back().exit, fan.tets[0].entry);
        }
        for (int i = 0; i < 3; ++i) EXPECT_TRUE(fan.returns(i));
    });
    for (Index t = 0; t < field.domain.tet_count(); ++t) EXPECT_EQ(seen[t], 6);
    EXPECT_GT(fans, 0);
}

// Counter-clockwise about z the frame turns by a quarter turn: x comes back as y, and -y as x.
TEST(EdgeFans, AnAxisRoundASingularCurveComesBackAsTheFieldTurns) {
    for (const int turns : {1, -1}) {
        const Turning field(turns);
        const TriangleTable& table = field.domain.triangles();
        const Points& v = field.domain.mesh().vertices;
        int singular = 0;
        for_each_fan(tets_at_edges(field.domain.mesh(), table, 1), table, triangle_matchings(table, field.frames, 1),
                     [&](const EdgeFan& fan) {
                         if (fan.returns(0) && fan.returns(1) && fan.returns(2)) return;
                         ++singular;
                         const int way = v(fan.b, 2) > v(fan.a, 2) ? turns : -turns;
                         const CarriedAxes expected = way == 1 ? CarriedAxes{4, 0, 2} : CarriedAxes{1, 3, 2};
                         EXPECT_EQ(fan.round, expected);
                     });
        EXPECT_GE(singular, 3);
    }
}

TEST(EdgeFans, TetsThatTouchInAnEdgeAloneAreFansOfTheirOwn) {
    TetMesh mesh;
    mesh.vertices.resize(6, 3);
    mesh.vertices << 0, 0, 0, 0, 0, 1, 1, 0, 0, 1, 1, 0, -1, 0, 0, -1, -1, 0;
    mesh.tets.resize(2, 4);
    mesh.tets << 0, 1, 3, 2, 0, 1, 5, 4;
    if (tet_volumes(mesh)[0] < 0) mesh.tets.col(2).swap(mesh.tets.col(3));
    const TriangleTable table = triangle_table(mesh);
    int at_edge = 0;
    const std::vector<std::uint8_t> matching(table.triangles.rows(), 0);
    for_each_fan(tets_at_edges(mesh, table, 1), table, matching, [&](const EdgeFan& fan) {
        EXPECT_EQ(fan.tets.size(), 1u);
        EXPECT_FALSE(fan.closed);
        at_edge += fan.a == 0 && fan.b == 1;
    });
    EXPECT_EQ(at_edge, 2);
}

// Of the same axis at a vertex, carried through any triangle, the unknown is the same up to the sign that it turns by.
TEST(PhaseUnknowns, AgreeAcrossEveryTriangle) {
    for (const int turns : {0, 1, 2}) {
        const Turning field(turns);
        const TetMesh& mesh = field.domain.mesh();
        const PhaseUnknowns unknowns(mesh, field.faces);
        for (Eigen::Index f = 0; f < field.faces.tets.rows(); ++f) {
            const Index one = field.faces.tets(f, 0), other = field.faces.tets(f, 1);
            const frames::Quaternion o = frames::octahedral_group()[field.faces.matching[f]];
            for (const Index v : field.faces.triangles.row(f))
                for (int i = 0; i < 3; ++i) {
                    const int axis = nearest_axis_number(o * axis_unit(i));
                    const SignedUnknown x = unknowns.at(one, corner_of(mesh, one, v), axis % 3),
                                        y = unknowns.at(other, corner_of(mesh, other, v), i);
                    ASSERT_EQ(x.unknown, y.unknown);
                    if (!unknowns.held(x.unknown)) {
                        ASSERT_EQ(x.sign * (axis < 3 ? 1 : -1), y.sign);
                    }
                }
        }
    }
}

TEST(PhaseUnknowns, ThreePerVertexWithoutSingularCurvesAndNoneHeld) {
    const Turning field(0);
    const PhaseUnknowns unknowns(field.domain.mesh(), field.faces);
    EXPECT_EQ(unknowns.count(), 3 * field.domain.vertex_count());
    for (Index k = 0; k < unknowns.count(); ++k) EXPECT_FALSE(unknowns.held(k));
}

// At vertices of edges round which axes are exchanged these are held, and nothing else is.
TEST(PhaseUnknowns, AxesThatComeBackAsTheirOppositesAreHeld) {
    for (const int turns : {1, 2}) {
        const Turning field(turns);
        const TetMesh& mesh = field.domain.mesh();
        const TriangleTable& table = field.domain.triangles();
        std::vector<std::uint8_t> singular(mesh.vertices.rows(), 0);
        for_each_fan(tets_at_edges(mesh, table, 1), table, triangle_matchings(table, field.frames, 1),
                     [&](const EdgeFan& fan) {
                         if (!fan.returns(0)) singular[fan.a] = singular[fan.b] = 1;
                     });
        ASSERT_GE(std::count(singular.begin(), singular.end(), 1), 4);
        const PhaseUnknowns unknowns(mesh, field.faces);
        for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t)
            for (int c = 0; c < 4; ++c)
                for (int i = 0; i < 3; ++i) {
                    const bool expected = singular[mesh.tets(t, c)] && i < 2;
                    EXPECT_EQ(unknowns.held(unknowns.at(static_cast<Index>(t), c, i).unknown), expected);
                }
    }
}

}  // namespace
}  // namespace octafield::volume
