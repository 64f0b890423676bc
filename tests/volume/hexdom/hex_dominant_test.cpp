#include "octafield/volume/hex_dominant.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>

#include "../../surface/mesh_fixtures.hpp"
#include "hex_dominant_checks.hpp"
#include "map_fixtures.hpp"
#include "octafield/error.hpp"
#include "octafield/volume/computed_field.hpp"
#include "octafield/volume/tetrahedralize.hpp"

namespace octafield::volume {
namespace {

using testing::ball;
using testing::constant;
using Vector3 = Eigen::Vector3d;

HexDominantOptions with_length(double length) {
    HexDominantOptions options;
    options.edge_length = length;
    return options;
}

TEST(HexDominant, BoxesAreFilledWithHexahedraAlone) {
    const Vector3 size(1, 1.5, 0.8);
    for (const double length : {0.25, 0.19}) {
        const TetDomain domain = testing::with_detected_features(testing::jittered_box(size, 4));
        const HexDominantMesh result = hex_dominant(domain, constant(domain), with_length(length));
        Index cells = 1;
        for (int i = 0; i < 3; ++i) cells *= static_cast<Index>(std::lround(size[i] / length));
        EXPECT_EQ(result.mesh.hexahedra.rows(), cells);
        EXPECT_EQ(result.mesh.cell_count(), cells);
        EXPECT_EQ(result.counts.lattice_hexahedra, cells);
        testing::expect_mesh_of(domain, result, 1e-12);
        testing::expect_features_kept(domain, result);
        EXPECT_TRUE(result.regions.empty());
    }
}

TEST(HexDominant, ARotatedBoxWithFramesNamedByChanceToo) {
    const frames::Quaternion turn = frames::exp(frames::Vector3(0.5, -0.3, 0.2));
    const TetDomain domain = testing::with_detected_features(
        testing::moved_mesh(testing::jittered_cube(3, 0.2, 4), [&](const Vector3& x) { return Vector3(turn * x); }));
    const HexDominantMesh result = hex_dominant(domain, testing::renamed(constant(domain, turn), 2), with_length(0.2));
    EXPECT_EQ(result.mesh.hexahedra.rows(), 125);
    EXPECT_EQ(result.mesh.cell_count(), 125);
    testing::expect_mesh_of(domain, result, 1e-12);
    testing::expect_features_kept(domain, result);
}

TEST(HexDominant, AnLShape) {
    const TetDomain domain = testing::with_detected_features(
        testing::kuhn_grid(4, 4, 2, 0.25, Vector3::Zero(), [](int i, int j, int) { return i < 2 || j < 2; }));
    const HexDominantMesh result = hex_dominant(domain, constant(domain), with_length(0.125));
    EXPECT_EQ(result.mesh.hexahedra.rows(), 48 * 4);
    EXPECT_EQ(result.mesh.cell_count(), 48 * 4);
    testing::expect_mesh_of(domain, result, 1e-12);
    testing::expect_features_kept(domain, result);
}

TEST(HexDominant, ATubeAlongACylindricalField) {
    const TetDomain domain = testing::with_detected_features(testing::tube_quarter(6));
    const HexDominantMesh result =
        hex_dominant(domain, testing::sample(domain.mesh(), testing::along_cylinder), with_length(0.2));
    testing::expect_mesh_of(domain, result, 0.01);
    // Cells that grow with the radius along the circles leave a map all over; cells of one length do not.
    EXPECT_EQ(result.counts.inconsistent, 0);
    HexDominantOptions options = with_length(0.2);
    options.points = CellPoints::periodic;
    options.refinements = 0;
    options.correction = SizeCorrection::none;
    EXPECT_GT(
        hex_dominant(domain, testing::sample(domain.mesh(), testing::along_cylinder), options).counts.inconsistent, 0);
    EXPECT_GT(double(result.mesh.hexahedra.rows()) / result.mesh.cell_count(), 0.5);
}

TEST(HexDominant, RegionsAreKeptAndTheirInterfaceIsExactlyAPlane) {
    const TetMesh mesh = testing::kuhn_cube(4);
    std::vector<Index> regions;
    for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t)
        regions.push_back(testing::centroid(mesh, t).x() > 0.25 ? 5 : 3);
    for (const double length : {0.25, 0.17}) {
        const TetDomain domain = testing::with_detected_features(mesh, regions);
        const HexDominantMesh result = hex_dominant(domain, constant(domain), with_length(length));
        testing::expect_mesh_of(domain, result, 1e-12);
        ASSERT_EQ(result.regions.size(), static_cast<std::size_t>(result.mesh.cell_count()));
        std::map<Index, double> volumes;
        const Eigen::VectorXd all = cell_volumes(result.mesh);
        Index number = 0;
        testing::each_cell(result.mesh, [&](const std::vector<Index>& cell) {
            for (const Index v : cell) {
                if (result.regions[number] == 3) {
                    EXPECT_LE(result.mesh.vertices(v, 0), 0.25 + 1e-12);
                } else {
                    EXPECT_GE(result.mesh.vertices(v, 0), 0.25 - 1e-12);
                }
            }
            volumes[result.regions[number]] += all[number];
            ++number;
        });
        EXPECT_NEAR(volumes[3], 0.25, 1e-12);
        EXPECT_NEAR(volumes[5], 0.75, 1e-12);
    }
}

bool same(const HexDominantMesh& x, const HexDominantMesh& y) {
    return x.mesh.vertices == y.mesh.vertices && x.mesh.tets == y.mesh.tets && x.mesh.hexahedra == y.mesh.hexahedra &&
           x.mesh.wedges == y.mesh.wedges && x.mesh.pyramids == y.mesh.pyramids && x.support == y.support &&
           x.regions == y.regions;
}

TEST(HexDominant, ABallWithAComputedFieldAndTheSameBitsAtAnyNumberOfThreads) {
    const TetDomain domain = ball();
    const Quaternions frames = computed_field(domain).combed.frames;
    HexDominantOptions options = with_length(0.3);
    options.refinements = 1;
    options.threads = 1;
    const HexDominantMesh one = hex_dominant(domain, frames, options);
    testing::expect_mesh_of(domain, one, 0.05);
    EXPECT_GT(one.mesh.hexahedra.rows(), 20);
    options.threads = 2;
    EXPECT_TRUE(same(one, hex_dominant(domain, frames, options)));
}

TEST(HexDominant, RandomFramesStillMakeAValidMesh) {
    const TetDomain domain = testing::with_detected_features(testing::jittered_cube(4, 0.2, 6));
    for (const unsigned seed : {1u, 2u}) {
        HexDominantOptions options = with_length(0.25);
        options.refinements = static_cast<int>(seed) - 1;
        const HexDominantMesh result =
            hex_dominant(domain, testing::random_frames(domain.vertex_count(), seed), options);
        testing::expect_mesh_of(domain, result, 1e-9);
        testing::expect_features_kept(domain, result);
    }
}

// Of a field with singular curves and noise, and of no field, on both sides of an interface.
TEST(HexDominant, NoiseOrRandomFramesInTwoRegionsToo) {
    const TetMesh mesh = testing::jittered_cube(4, 0.2, 6);
    std::vector<Index> regions;
    for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t) regions.push_back(testing::centroid(mesh, t).z() > 0.5);
    const TetDomain domain = testing::with_detected_features(mesh, regions);
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    for (unsigned seed = 1; seed < 5; ++seed) {
        HexDominantOptions options = with_length(0.12);
        options.refinements = 0;
        options.improve = false;
        const Quaternions noisy = testing::sample(mesh, [&](const Vector3& x) {
            const frames::Vector3 noise(normal(random), normal(random), normal(random));
            return frames::exp(frames::Vector3(0, 0, std::atan2(x.y() - 0.47, x.x() - 0.52) / 4)) *
                   frames::exp(0.05 * (seed % 4) * noise);
        });
        testing::expect_mesh_of(domain, hex_dominant(domain, noisy, options), 1e-9);
        testing::expect_mesh_of(
            domain, hex_dominant(domain, testing::random_frames(domain.vertex_count(), seed), options), 1e-9);
    }
}

TEST(HexDominant, SizesAtVerticesAreHonoured) {
    const TetDomain domain = testing::with_detected_features(testing::jittered_box({2, 1, 1}, 6, 0.1));
    HexDominantOptions options;
    options.sizes.resize(domain.vertex_count());
    const auto wanted = [](double x) { return 0.12 + 0.06 * x; };
    for (Index v = 0; v < domain.vertex_count(); ++v) options.sizes[v] = wanted(domain.mesh().vertices(v, 0));
    const HexDominantMesh result = hex_dominant(domain, constant(domain), options);
    testing::expect_mesh_of(domain, result, 1e-9);
    std::map<int, std::pair<double, int>> lengths;  // by quarters of the box: sum of length over wanted
    for (const auto& cell : result.mesh.hexahedra.rowwise())
        for (const auto& edge : {std::array{0, 1},
                                 {1, 2},
                                 {2, 3},
                                 {3, 0},
                                 {4, 5},
                                 {5, 6},
                                 {6, 7},
                                 {7, 4},
                                 {0, 4},
                                 {1, 5},
                                 {2, 6},
                                 {3, 7}}) {
            const Vector3 p = result.mesh.vertices.row(cell[edge[0]]), q = result.mesh.vertices.row(cell[edge[1]]);
            const double x = (p.x() + q.x()) / 2;
            auto& [sum, count] = lengths[static_cast<int>(x / 0.5)];
            sum += (p - q).norm() / wanted(x), ++count;
        }
    for (const auto& [quarter, sum] : lengths) EXPECT_NEAR(sum.first / sum.second, 1, 0.3) << quarter;
    EXPECT_GE(lengths.size(), 3u);
}

TEST(HexDominant, TheWorkingMeshStaysWithinItsBudget) {
    const TetDomain domain = ball();
    const Quaternions frames = testing::random_frames(domain.vertex_count(), 1);
    HexDominantOptions options = with_length(0.3);
    options.points = CellPoints::periodic;
    const Index all = hex_dominant(domain, frames, options).counts.tets;
    ASSERT_GT(all, domain.tet_count());
    for (const Index most : {domain.tet_count(), 3 * domain.tet_count(), all - 1}) {
        options.most_tets = most;
        EXPECT_LE(hex_dominant(domain, frames, options).counts.tets, most);
    }
}

TEST(HexDominant, StepsThatAreSwitchedOffLeaveValidMeshesToo) {
    const TetDomain domain = ball();
    const Quaternions frames = testing::sample(domain.mesh(), testing::along_cylinder);
    for (const bool recombine : {false, true})
        for (const SizeCorrection correction : {SizeCorrection::none, SizeCorrection::isotropic}) {
            HexDominantOptions options = with_length(0.35);
            options.recombine = recombine;
            options.improve = !recombine;
            options.correction = correction;
            options.refinements = 0;
            const HexDominantMesh result = hex_dominant(domain, frames, options);
            testing::expect_mesh_of(domain, result, 0.07);
            EXPECT_EQ(result.counts.tets, domain.tet_count());
            if (!recombine) {
                EXPECT_EQ(result.counts.recombined_hexahedra + result.counts.recombined_wedges, 0);
            }
        }
}

TEST(HexDominant, CellsLargerThanThePartLeaveAValidMesh) {
    const TetDomain box = testing::with_detected_features(testing::kuhn_cube(3));
    const TetDomain round = ball();
    for (const double length : {3.0, 1e3, 1e9}) {
        testing::expect_mesh_of(box, hex_dominant(box, constant(box), with_length(length)), 1e-9);
        const HexDominantMesh result = hex_dominant(round, constant(round), with_length(length));
        testing::expect_sound(result.mesh, 0);
    }
}

std::string kind_of(const TetDomain& domain, const Quaternions& frames, const HexDominantOptions& options) {
    try {
        hex_dominant(domain, frames, options);
    } catch (const InvalidInput& error) {
        return error.kind();
    } catch (const Error& error) {
        return std::string("not InvalidInput: ") + error.what();
    }
    return "nothing thrown";
}

TEST(HexDominant, NamesWhatIsWrongWithItsInput) {
    const TetDomain domain(testing::kuhn_cube(2));
    const Quaternions frames = constant(domain);
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    EXPECT_EQ(kind_of(domain, frames.topRows(5), {}), "wrong_size");
    Quaternions wrong = frames;
    wrong(3, 0) = 1.1;
    EXPECT_EQ(kind_of(domain, wrong, {}), "not_unit");
    wrong(3, 0) = nan;
    EXPECT_EQ(kind_of(domain, wrong, {}), "not_unit");
    const auto with = [&](const auto& change) {
        HexDominantOptions options = with_length(0.4);
        change(options);
        return kind_of(domain, frames, options);
    };
    for (const double bad : {-1.0, nan, inf}) {
        EXPECT_EQ(with([&](auto& o) { o.edge_length = bad; }), "edge_length");
        EXPECT_EQ(with([&](auto& o) { o.min_scaled_jacobian = bad; }), "min_scaled_jacobian");
        EXPECT_EQ(with([&](auto& o) { o.hold_angle = bad; }), "hold_angle");
        EXPECT_EQ(with([&](auto& o) {
                      o.sizes = Eigen::VectorXd::Constant(domain.vertex_count(), 0.4);
                      o.sizes[2] = bad;
                  }),
                  "edge_length");
    }
    EXPECT_EQ(with([&](auto& o) { o.min_scaled_jacobian = 1; }), "min_scaled_jacobian");
    EXPECT_EQ(with([&](auto& o) { o.hold_angle = 1.6; }), "hold_angle");
    EXPECT_EQ(with([&](auto& o) { o.refinements = -1; }), "refinements");
    EXPECT_EQ(with([&](auto& o) { o.refinements = 7; }), "refinements");
    EXPECT_EQ(with([&](auto& o) { o.sizes = Eigen::VectorXd::Constant(4, 0.4); }), "wrong_size");
}

TEST(HexDominant, EdgeLengthsFarTooSmallAreRefusedSoon) {
    const TetDomain domain = testing::with_detected_features(testing::kuhn_cube(2));
    for (const double length : {1e-3, 1e-4, 1e-7, 1e-200}) {
        EXPECT_EQ(kind_of(domain, constant(domain), with_length(length)), "too_many_cells") << length;
    }
}

// With random frames most tets have no coordinates: a bound on the cells of the map does not see them.
TEST(HexDominant, EdgeLengthsFarTooSmallForTheDomainAreRefusedWithoutAFieldToo) {
    const TetDomain domain = testing::with_detected_features(testing::kuhn_cube(2));
    EXPECT_EQ(kind_of(domain, testing::random_frames(domain.vertex_count(), 3), with_length(1e-3)), "too_many_cells");
}

TEST(HexDominant, EndsInEachOfItsPhasesWhereProgressSaysSo) {
    const TetDomain domain = ball();
    const Quaternions frames = testing::sample(domain.mesh(), testing::along_cylinder);
    HexDominantOptions options = with_length(0.4);
    options.refinements = 0;
    std::set<std::string> phases;
    const HexDominantMesh all = hex_dominant(domain, frames, options, [&](std::string_view phase, double, double) {
        phases.insert(std::string(phase));
        return true;
    });
    EXPECT_TRUE(same(all, hex_dominant(domain, frames, options)));
    for (const char* name :
         {"sizes", "periodic map", "lattice", "surface", "tetrahedralize", "recombine", "conform", "improve"}) {
        EXPECT_EQ(phases.count(name), 1u) << name;
        EXPECT_THROW(hex_dominant(domain, frames, options,
                                  [&](std::string_view phase, double, double) { return phase != name; }),
                     Cancelled)
            << name;
    }
}

}  // namespace
}  // namespace octafield::volume
