#include "octafield/volume/refine_tets.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <utility>

#include "field_fixtures.hpp"
#include "octafield/error.hpp"
#include "refined_count.hpp"

namespace octafield::volume {
namespace {

using Vector3 = Eigen::Vector3d;

// Features: the edges of the cube; two regions, below and above a half.
TetDomain cube_of_two_regions(const TetMesh& mesh) {
    std::vector<Index> regions;
    for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t) regions.push_back(testing::centroid(mesh, t).z() < 0.5 ? 7 : 9);
    const TetDomain plain(mesh, regions);
    const Points& v = plain.surface().mesh.vertices;
    const auto sides = [&](Index a) {
        int count = 0;
        for (int k = 0; k < 3; ++k) count += v(a, k) < 1e-9 || v(a, k) > 1 - 1e-9;
        return count;
    };
    std::set<std::pair<Index, Index>> edges;
    for (const auto& t : plain.surface().mesh.triangles.rowwise())
        for (int k = 0; k < 3; ++k) {
            const Index a = t[k], b = t[(k + 1) % 3];
            int shared = 0;
            for (int i = 0; i < 3; ++i) shared += v(a, i) == v(b, i) && (v(a, i) < 1e-9 || v(a, i) > 1 - 1e-9);
            if (shared >= 2) edges.insert(std::minmax(a, b));
        }
    surface::FeatureGraph features;
    features.edges.resize(static_cast<Eigen::Index>(edges.size()), 2);
    Eigen::Index row = 0;
    for (const auto& [a, b] : edges) features.edges.row(row++) << a, b;
    for (Index a = 0; a < v.rows(); ++a)
        if (sides(a) == 3) features.corners.push_back(a);
    return plain.with_features(features);
}

std::map<Index, double> volume_of_regions(const TetDomain& domain) {
    std::map<Index, double> volumes;
    const Eigen::VectorXd all = tet_volumes(domain.mesh());
    for (Index t = 0; t < domain.tet_count(); ++t) volumes[domain.regions()[t]] += all[t];
    return volumes;
}

double feature_length(const TetDomain& domain) {
    double length = 0;
    for (const auto& e : domain.features().edges.rowwise())
        length += (domain.surface().mesh.vertices.row(e[0]) - domain.surface().mesh.vertices.row(e[1])).norm();
    return length;
}

double area(const TetDomain& domain) {
    double sum = 0;
    for (const auto& t : domain.surface().mesh.triangles.rowwise()) {
        const Points p = domain.surface().mesh.vertices(t, Eigen::all);
        sum += Vector3(p.row(1) - p.row(0)).cross(Vector3(p.row(2) - p.row(0))).norm() / 2;
    }
    return sum;
}

// Faces by their ids: each in two tets, or in one and then on a side of the unit cube.
void expect_conforming_in_the_cube(const TetMesh& mesh) {
    std::map<std::array<Index, 3>, int> faces;
    for (const auto& t : mesh.tets.rowwise())
        for (int k = 0; k < 4; ++k) {
            std::array<Index, 3> face{t[(k + 1) % 4], t[(k + 2) % 4], t[(k + 3) % 4]};
            std::sort(face.begin(), face.end());
            ++faces[face];
        }
    for (const auto& [face, count] : faces) {
        ASSERT_LE(count, 2);
        if (count == 2) continue;
        bool on_side = false;
        for (int k = 0; k < 3; ++k)
            for (const double side : {0.0, 1.0}) {
                bool all = true;
                for (const Index v : face) all &= mesh.vertices(v, k) == side;
                on_side |= all;
            }
        ASSERT_TRUE(on_side) << "a face of one tet inside";
    }
}

void expect_refined(const TetDomain& domain, const RefinedDomain& refined) {
    const TetMesh &old = domain.mesh(), &mesh = refined.domain.mesh();
    expect_conforming_in_the_cube(mesh);
    EXPECT_EQ(mesh.vertices.topRows(old.vertices.rows()), old.vertices);
    ASSERT_EQ(refined.parents.rows(), mesh.vertices.rows());
    ASSERT_EQ(static_cast<Eigen::Index>(refined.parent.size()), mesh.tets.rows());
    EXPECT_TRUE(std::is_sorted(refined.parent.begin(), refined.parent.end()));
    std::set<std::pair<Index, Index>> edges;
    for (const auto& t : old.tets.rowwise())
        for (int a = 0; a < 4; ++a)
            for (int b = 0; b < a; ++b) edges.insert(std::minmax(t[a], t[b]));
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
        const auto [a, b] = std::pair(refined.parents(v, 0), refined.parents(v, 1));
        const bool known = v < old.vertices.rows();
        if (known) {
            EXPECT_TRUE(a == v && b == v);
        }
        if (!known) {
            ASSERT_EQ(edges.count(std::minmax(a, b)), 1u);
        }
        EXPECT_LT((mesh.vertices.row(v) - (old.vertices.row(a) + old.vertices.row(b)) / 2).norm(), 1e-14);
    }
    // Each part lies in its parent and they fill it.
    const Eigen::VectorXd volumes = tet_volumes(mesh), whole = tet_volumes(old);
    Eigen::VectorXd filled = Eigen::VectorXd::Zero(whole.size());
    for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t) {
        const Index parent = refined.parent[t];
        ASSERT_GT(volumes[t], 0);
        filled[parent] += volumes[t];
        EXPECT_EQ(refined.domain.regions()[t], domain.regions()[parent]);
        for (const Index v : mesh.tets.row(t))
            for (int side = 0; side < 2; ++side) {
                const Index corner = refined.parents(v, side);
                EXPECT_TRUE((old.tets.row(parent).array() == corner).any());
            }
    }
    EXPECT_LT((filled - whole).cwiseAbs().maxCoeff(), 1e-14);
    EXPECT_NEAR(volume_of_regions(refined.domain)[7], volume_of_regions(domain)[7], 1e-12);
    EXPECT_NEAR(area(refined.domain), area(domain), 1e-12);
    EXPECT_NEAR(feature_length(refined.domain), feature_length(domain), 1e-12);
    const auto corners = [](const TetDomain& d) {
        std::set<Index> ids;
        for (const Index c : d.features().corners) ids.insert(d.surface().vertex_map[c]);
        return ids;
    };
    EXPECT_EQ(corners(refined.domain), corners(domain));
    // Feature edges go on between old ones and their middles, along the cube's edges.
    const Points& v = refined.domain.surface().mesh.vertices;
    for (const auto& e : refined.domain.features().edges.rowwise()) {
        int along = 0;
        for (int k = 0; k < 3; ++k) along += v(e[0], k) != v(e[1], k);
        EXPECT_EQ(along, 1);
    }
}

TEST(RefineTets, AllMarkedMakeEightOfEach) {
    const TetDomain domain = cube_of_two_regions(testing::kuhn_cube(2));
    ASSERT_NEAR(feature_length(domain), 12, 1e-12);
    const RefinedDomain refined = refine_tets(domain, std::vector<std::uint8_t>(domain.tet_count(), 1));
    EXPECT_EQ(refined.domain.tet_count(), 8 * domain.tet_count());
    EXPECT_EQ(refined.domain.features().edges.rows(), 2 * domain.features().edges.rows());
    expect_refined(domain, refined);
}

TEST(RefineTets, NoneMarkedChangesNothing) {
    const TetDomain domain = cube_of_two_regions(testing::kuhn_cube(2));
    const RefinedDomain refined = refine_tets(domain, std::vector<std::uint8_t>(domain.tet_count(), 0));
    EXPECT_EQ(refined.domain.mesh().tets, domain.mesh().tets);
    EXPECT_EQ(refined.domain.features().edges, domain.features().edges);
    expect_refined(domain, refined);
}

TEST(RefineTets, EachOneMarkedIsCutIntoEightAndItsNeighboursFollow) {
    const TetDomain domain = cube_of_two_regions(testing::jittered_cube(2, 0.2, 3));
    for (Index t = 0; t < domain.tet_count(); ++t) {
        std::vector<std::uint8_t> marked(domain.tet_count(), 0);
        marked[t] = 1;
        const RefinedDomain refined = refine_tets(domain, marked);
        EXPECT_EQ(std::count(refined.parent.begin(), refined.parent.end(), t), 8);
        EXPECT_LT(refined.domain.tet_count(), 8 * domain.tet_count());
        expect_refined(domain, refined);
    }
}

TEST(RefineTets, MarksAtRandomLeaveEveryTetWholeOrInTwoFourOrEight) {
    const TetDomain domain = cube_of_two_regions(testing::jittered_cube(4, 0.25, 5));
    std::mt19937 random(1);
    for (const unsigned share : {2u, 5u, 40u}) {
        std::vector<std::uint8_t> marked(domain.tet_count(), 0);
        for (std::uint8_t& mark : marked) mark = random() % share == 0;
        const RefinedDomain refined = refine_tets(domain, marked);
        expect_refined(domain, refined);
        for (Index t = 0; t < domain.tet_count(); ++t) {
            const auto parts = std::count(refined.parent.begin(), refined.parent.end(), t);
            EXPECT_TRUE(parts == 1 || parts == 2 || parts == 4 || parts == 8);
            if (marked[t]) {
                EXPECT_EQ(parts, 8);
            }
        }
    }
}

// Bey: the octahedron is cut along its shortest diagonal, so that four rounds leave the shapes bounded.
TEST(RefineTets, IsCountedBeforeItIsDone) {
    std::mt19937 random(5);
    for (const int one_in : {1, 3, 20, 1000}) {
        const TetDomain domain = cube_of_two_regions(testing::kuhn_cube(3));
        std::vector<std::uint8_t> marked(domain.tet_count());
        for (auto& mark : marked) mark = random() % one_in == 0;
        EXPECT_EQ(refined_count(domain, marked), refine_tets(domain, marked).domain.tet_count()) << one_in;
    }
    EXPECT_THROW(refined_count(cube_of_two_regions(testing::kuhn_cube(1)), {1}), InvalidInput);
}

TEST(RefineTets, ShapesStayBoundedOverRounds) {
    TetDomain domain(testing::kuhn_cube(1));
    const auto worst = [](const TetMesh& mesh) {
        double least = 1;
        for (const auto& t : mesh.tets.rowwise()) {
            const Points p = mesh.vertices(t, Eigen::all);
            double longest = 0;
            for (int a = 0; a < 4; ++a)
                for (int b = 0; b < a; ++b) longest = std::max(longest, (p.row(a) - p.row(b)).norm());
            const Vector3 u = p.row(1) - p.row(0), v = p.row(2) - p.row(0), w = p.row(3) - p.row(0);
            least = std::min(least, u.cross(v).dot(w) / std::pow(longest, 3));
        }
        return least;
    };
    const double first = worst(domain.mesh());
    for (int round = 0; round < 3; ++round) {
        domain = refine_tets(domain, std::vector<std::uint8_t>(domain.tet_count(), 1)).domain;
        EXPECT_GT(worst(domain.mesh()), 0.99 * first);
    }
}

TEST(RefineTets, MarksOfAnotherNumberAreRefused) {
    const TetDomain domain(testing::kuhn_cube(1));
    for (const int size : {0, 5, 7}) try {
            refine_tets(domain, std::vector<std::uint8_t>(size, 1));
            FAIL();
        } catch (const InvalidInput& error) {
            EXPECT_EQ(error.kind(), "wrong_size");
        }
}

TEST(RefineTets, WithoutRegionsThereAreNone) {
    const TetDomain domain(testing::kuhn_cube(1));
    EXPECT_TRUE(refine_tets(domain, std::vector<std::uint8_t>(6, 1)).domain.regions().empty());
}

}  // namespace
}  // namespace octafield::volume
