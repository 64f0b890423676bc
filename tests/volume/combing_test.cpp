// Matchings across triangles, combed fields and their cut.
#include "octafield/volume/combing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "field_fixtures.hpp"
#include "octafield/error.hpp"
#include "octafield/frames/octahedral_group.hpp"
#include "octafield/volume/tet_singularities.hpp"
#include "tet_fixtures.hpp"

namespace octafield::volume {
namespace {

using frames::Quaternion;
using frames::Vector3;
using testing::jittered_cube;
using testing::kuhn_cube;
using testing::kuhn_grid;
using testing::mixed_representatives;
using testing::sample_in_tets;

Quaternions constant_in_tets(const TetMesh& mesh) {
    return mixed_representatives(sample_in_tets(mesh, [](const Vector3&) { return frames::exp({0.3, 0.2, -0.4}); }));
}

// A line of the given quarter turns along z, near the middle of [-1/2, 1/2]^3.
TetMesh bar(int n) { return kuhn_grid(n, n, n, 1.0 / n, Vector3(-0.5 + 0.137 / n, -0.5 + 0.071 / n, -0.5)); }
Quaternions line(const TetMesh& mesh, int turns) {
    return mixed_representatives(sample_in_tets(mesh, [&](const Vector3& x) {
        return frames::exp({0, 0, turns * std::atan2(x.y(), x.x()) / 4});
    }));
}

Quaternion frame(const Quaternions& frames, Index t) { return frames::from_wxyz(frames.row(t)); }

std::size_t cut_size(const CombedField& field) { return std::count(field.cut.begin(), field.cut.end(), 1); }

// What every combed field promises.
void expect_combed(const TetMesh& mesh, const Quaternions& of_tets, const CombedField& field) {
    const FaceMatchings faces = face_matchings(mesh, of_tets);
    ASSERT_EQ(field.faces.triangles, faces.triangles);
    ASSERT_EQ(field.faces.tets, faces.tets);
    ASSERT_EQ(field.cut.size(), faces.matching.size());
    for (Index t = 0; t < mesh.tets.rows(); ++t) {
        const Quaternion expected = frame(of_tets, t) * frames::octahedral_group()[field.element[t]];
        EXPECT_NEAR(std::abs(expected.dot(frame(field.frames, t))), 1, 1e-12);
    }
    for (std::size_t f = 0; f < field.cut.size(); ++f) {
        const Index one = faces.tets(f, 0), other = faces.tets(f, 1);
        EXPECT_LT(one, other);
        EXPECT_TRUE(field.cut[f] || field.faces.matching[f] == 0);
        // By the group: the same rotation from the first frame to the second.
        const auto& group = frames::octahedral_group();
        const Quaternion before = frame(of_tets, one) * group[faces.matching[f]] * group[field.element[other]],
                         after = frame(field.frames, one) * group[field.faces.matching[f]];
        EXPECT_NEAR(std::abs(before.dot(after)), 1, 1e-12);
        // By geometry: still the closest, but for ties.
        const Quaternion q = frame(field.frames, one) * group[field.faces.matching[f]];
        EXPECT_NEAR(2 * std::acos(std::min(1.0, std::abs(q.dot(frame(field.frames, other))))),
                    frames::distance(frame(of_tets, one), frame(of_tets, other)), 1e-6);
    }
}

// Cells inside the mesh that are not of the cut, by dimension: their alternating sum is minus the Euler characteristic
// with compact support, 1 for an open ball.
int open_cells_sum(const TetMesh& mesh, const CombedField& field) {
    std::set<std::vector<Index>> closed;
    const auto close = [&](std::vector<Index> triangle) {
        std::sort(triangle.begin(), triangle.end());
        for (int k = 0; k < 3; ++k) {
            closed.insert({triangle[k]});
            closed.insert({std::min(triangle[k], triangle[(k + 1) % 3]), std::max(triangle[k], triangle[(k + 1) % 3])});
        }
        closed.insert(std::move(triangle));
    };
    const BoundarySurface boundary = boundary_surface(mesh);
    for (const auto t : boundary.mesh.triangles.rowwise())
        close({boundary.vertex_map[t[0]], boundary.vertex_map[t[1]], boundary.vertex_map[t[2]]});
    for (std::size_t f = 0; f < field.cut.size(); ++f)
        if (field.cut[f]) {
            const auto t = field.faces.triangles.row(f);
            close({t[0], t[1], t[2]});
        }
    std::set<std::vector<Index>> open;
    for (const auto tet : mesh.tets.rowwise())
        for (int mask = 1; mask < 16; ++mask) {
            std::vector<Index> cell;
            for (int k = 0; k < 4; ++k)
                if (mask & (1 << k)) cell.push_back(tet[k]);
            std::sort(cell.begin(), cell.end());
            if (!closed.count(cell)) open.insert(std::move(cell));
        }
    int sum = 0;
    for (const auto& cell : open) sum += cell.size() % 2 == 0 ? 1 : -1;
    return sum;
}

TEST(FaceMatchings, ListEveryTriangleBetweenTwoTetsOnceWithTheClosestElement) {
    const TetMesh mesh = jittered_cube(3, 0.2, 4);
    const Quaternions field = frames::random_rotations(mesh.tets.rows(), 5);
    const FaceMatchings faces = face_matchings(mesh, field);
    EXPECT_EQ(2 * faces.triangles.rows() + boundary_surface(mesh).mesh.triangles.rows(), 4 * mesh.tets.rows());
    for (Eigen::Index f = 0; f < faces.triangles.rows(); ++f) {
        EXPECT_LT(faces.triangles(f, 0), faces.triangles(f, 1));
        EXPECT_LT(faces.triangles(f, 1), faces.triangles(f, 2));
        for (int side = 0; side < 2; ++side)
            for (int k = 0; k < 3; ++k)
                EXPECT_TRUE((mesh.tets.row(faces.tets(f, side)).array() == faces.triangles(f, k)).any());
        const Quaternion q = frame(field, faces.tets(f, 0)), r = frame(field, faces.tets(f, 1));
        double best = 0;
        for (const Quaternion& o : frames::octahedral_group()) best = std::max(best, std::abs((q * o).dot(r)));
        EXPECT_NEAR(std::abs((q * frames::octahedral_group()[faces.matching[f]]).dot(r)), best, 1e-12);
    }
    EXPECT_EQ(faces.matching, face_matchings(mesh, field, 3).matching);
}

TEST(Comb, LeavesNoCutInABallWithoutSingularEdges) {
    for (const TetMesh& mesh : {kuhn_cube(1), kuhn_cube(5), jittered_cube(5, 0.2, 8)}) {
        const Quaternions field = constant_in_tets(mesh);
        const CombedField combed = comb(mesh, field);
        expect_combed(mesh, field, combed);
        EXPECT_EQ(cut_size(combed), 0u);
        EXPECT_EQ(combed.parts, 1);
        EXPECT_LT((combed.frames.rowwise() - combed.frames.row(0)).cwiseAbs().maxCoeff(), 1e-14);  // signs too
    }
}

TEST(Comb, LeavesOneDiskInARing) {
    const TetMesh mesh =
        kuhn_grid(3, 3, 2, 1.0 / 3, Vector3::Zero(), [](int i, int j, int) { return i != 1 || j != 1; });
    const CombedField combed = comb(mesh, constant_in_tets(mesh));
    expect_combed(mesh, constant_in_tets(mesh), combed);
    EXPECT_GT(cut_size(combed), 0u);
    // Its triangles: a disk, V - E + F = 1.
    std::set<Index> vertices;
    std::set<std::pair<Index, Index>> edges;
    for (std::size_t f = 0; f < combed.cut.size(); ++f)
        for (int k = 0; combed.cut[f] && k < 3; ++k) {
            EXPECT_EQ(combed.faces.matching[f], 0);
            const Index v = combed.faces.triangles(f, k), w = combed.faces.triangles(f, (k + 1) % 3);
            vertices.insert(v);
            edges.insert(std::minmax(v, w));
        }
    EXPECT_EQ(int(vertices.size()) - int(edges.size()) + int(cut_size(combed)), 1);
    EXPECT_EQ(open_cells_sum(mesh, combed), 1);
}

class CombedLine : public ::testing::TestWithParam<int> {};

TEST_P(CombedLine, HasACutWhoseMatchingsAreTheTurnOfTheLine) {
    const TetMesh mesh = bar(5);
    const Quaternions field = line(mesh, GetParam());
    const CombedField combed = comb(mesh, field);
    expect_combed(mesh, field, combed);
    EXPECT_EQ(open_cells_sum(mesh, combed), 1);
    // One wall from the line to the boundary, so one turn all over, one way or the other.
    std::set<Index> turns;
    for (std::size_t f = 0; f < combed.cut.size(); ++f)
        if (combed.cut[f]) turns.insert(combed.faces.matching[f]);
    EXPECT_FALSE(turns.count(0));
    for (const Index o : turns) EXPECT_EQ(frames::octahedral_class(o), frames::OctahedralClass::quarter_turn);
    EXPECT_LE(turns.size(), 2u);
    // Every singular edge is on it.
    std::set<std::pair<Index, Index>> touched;
    for (std::size_t f = 0; f < combed.cut.size(); ++f)
        for (int k = 0; combed.cut[f] && k < 3; ++k)
            touched.insert(std::minmax({combed.faces.triangles(f, k), combed.faces.triangles(f, (k + 1) % 3)}));
    const SingularEdges singular = singular_edges(mesh, field);
    EXPECT_FALSE(singular.edges.empty());
    for (const SingularEdge& e : singular.edges) EXPECT_TRUE(touched.count({e.a, e.b}));
}

INSTANTIATE_TEST_SUITE_P(QuarterTurns, CombedLine, ::testing::Values(1, -1));

TEST(Comb, LeavesASimplyConnectedComplementInRandomFields) {
    const TetMesh mesh = jittered_cube(4, 0.2, 10);
    const Quaternions field = frames::random_rotations(mesh.tets.rows(), 11);
    const CombedField combed = comb(mesh, field);
    expect_combed(mesh, field, combed);
    EXPECT_EQ(open_cells_sum(mesh, combed), 1);
}

TEST(Comb, TreatsPartsOfAMeshOneByOne) {
    const TetMesh mesh = kuhn_grid(5, 2, 2, 0.2, Vector3::Zero(), [](int i, int, int) { return i != 2; });
    const CombedField combed = comb(mesh, constant_in_tets(mesh));
    EXPECT_EQ(combed.parts, 2);
    EXPECT_EQ(cut_size(combed), 0u);
}

TEST(Comb, IsTheSameAtAnyThreadCountAndRefusesBadInput) {
    const TetMesh mesh = jittered_cube(5, 0.2, 12);
    const Quaternions field = frames::random_rotations(mesh.tets.rows(), 13);
    const CombedField serial = comb(mesh, field, 1), parallel = comb(mesh, field, 5);
    EXPECT_EQ(serial.frames, parallel.frames);
    EXPECT_EQ(serial.cut, parallel.cut);
    EXPECT_EQ(serial.faces.matching, parallel.faces.matching);
    EXPECT_THROW(comb(mesh, field.topRows(3)), InvalidInput);
    EXPECT_THROW(comb(mesh, 2 * field), InvalidInput);
    EXPECT_THROW(face_matchings(mesh, field.topRows(3)), InvalidInput);
    EXPECT_THROW(comb(TetMesh{}, Quaternions(0, 4)), GeometryError);
}

}  // namespace
}  // namespace octafield::volume
