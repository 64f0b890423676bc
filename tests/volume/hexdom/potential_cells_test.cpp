// The search for hexahedra and wedges finds what trying everything finds.
#include "potential_cells.hpp"

#include <gtest/gtest.h>

#include "cell_choice.hpp"
#include "delaunay_mesh.hpp"
#include "mixed_grids.hpp"

namespace octafield::volume {
namespace {

using testing::CubeGrid;
using testing::Filled;
using Ids = std::vector<Index>;

// Every way to name vertices as a cell's corners, edges of the mesh only, then every set of tets on them.
class Oracle {
public:
    Oracle(const MixedMesh& mesh, int corners, double least) : mesh_(mesh), corners_(corners), least_(least) {
        testing::each_cell(mesh, [&](const Ids& tet) {
            for (const Index a : tet)
                for (const Index b : tet)
                    if (a != b) edges_.insert({a, b});
            for (int without = 0; without < 4; ++without) triangles_.insert(without_one(tet, without));
        });
        for (const auto& face : testing::reference(corners).faces)
            for (std::size_t k = 0; k < face.size(); ++k) {
                const int a = face[k], b = face[(k + 1) % face.size()];
                joined_.insert({std::min(a, b), std::max(a, b)});
            }
    }

    std::set<Ids> run() {
        for (Index v = 0; v < mesh_.vertices.rows(); ++v) extend({v});
        return found_;
    }

private:
    static Ids without_one(Ids ids, int k) {
        ids.erase(ids.begin() + k);
        std::sort(ids.begin(), ids.end());
        return ids;
    }

    void extend(const Ids& ids) {
        const int at = static_cast<int>(ids.size());
        if (at == corners_) return test(ids);
        for (Index v = ids[0] + 1; v < mesh_.vertices.rows(); ++v) {
            if (std::find(ids.begin(), ids.end(), v) != ids.end()) continue;
            bool fits = true;
            for (int k = 0; k < at; ++k) fits = fits && (!joined_.count({k, at}) || edges_.count({ids[k], v}));
            if (!fits) continue;
            Ids more = ids;
            more.push_back(v);
            extend(more);
        }
    }

    void test(const Ids& ids) {
        // One of the cell's names with the lowest vertex first: of a hexahedron three, of a wedge one.
        if (corners_ == 8 && (ids[1] > ids[3] || ids[1] > ids[4])) return;
        MixedMesh one;
        one.vertices = mesh_.vertices;
        if (corners_ == 8)
            one.hexahedra = Eigen::Map<const Eigen::Matrix<Index, 1, 8>>(ids.data());
        else
            one.wedges = Eigen::Map<const Eigen::Matrix<Index, 1, 6>>(ids.data());
        if (!(scaled_jacobians(one)[0] >= least_)) return;
        std::vector<Ids> quads;
        for (const auto& face : testing::reference(corners_).faces) {
            Ids round;
            for (const int k : face) round.push_back(ids[k]);
            quads.push_back(round);
        }
        if (filled(ids, quads)) found_.insert(ids);
    }

    bool filled(const Ids& ids, const std::vector<Ids>& faces) const {
        std::vector<std::set<Ids>> tets;  // the triangles of those on the cell's vertices, but on those of one face
        testing::each_cell(mesh_, [&](const Ids& tet) {
            const auto on = [&](const Ids& some) {
                return std::all_of(tet.begin(), tet.end(),
                                   [&](Index v) { return std::find(some.begin(), some.end(), v) != some.end(); });
            };
            if (!on(ids) || std::any_of(faces.begin(), faces.end(), on)) return;
            tets.emplace_back();
            for (int k = 0; k < 4; ++k) tets.back().insert(without_one(tet, k));
        });
        std::set<std::set<Ids>> boundaries{{}};
        for (const Ids& face : faces) {
            std::set<std::set<Ids>> next;
            for (const auto& boundary : boundaries)
                for (int turn = 0; turn < (face.size() == 4 ? 2 : 1); ++turn) {
                    std::set<Ids> more = boundary;
                    if (face.size() == 3) more.insert(without_one({face[0], face[1], face[2], -1}, 3));
                    if (face.size() == 4)
                        for (const int without : {turn + 1, (turn + 3) % 4}) more.insert(without_one(face, without));
                    next.insert(more);
                }
            boundaries = next;
        }
        for (unsigned long some = 1; some < 1ul << tets.size(); ++some) {
            std::set<Ids> boundary;
            for (std::size_t t = 0; t < tets.size(); ++t)
                if (some >> t & 1)
                    for (const Ids& triangle : tets[t])
                        if (!boundary.insert(triangle).second) boundary.erase(triangle);
            if (boundaries.count(boundary)) return true;
        }
        return false;
    }

    const MixedMesh& mesh_;
    const int corners_;
    const double least_;
    std::set<std::pair<Index, Index>> edges_;
    std::set<Ids> triangles_;
    std::set<std::pair<int, int>> joined_;  // corners
    std::set<Ids> found_;
};

// Within the pairs of triangles that the cell's tets end at.
double volume_within(const Points& vertices, const Ids& ids, unsigned inner_pairs) {
    static const std::map<std::size_t, std::vector<Ids>> outward{
        {8, {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}},
        {6, {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}}};
    double total = 0;
    const auto add = [&](Index a, Index b, Index c) {
        const Eigen::Vector3d x = vertices.row(ids[a]), y = vertices.row(ids[b]), z = vertices.row(ids[c]);
        total += x.cross(y).dot(z) / 6;
    };
    for (std::size_t f = 0; f < outward.at(ids.size()).size(); ++f) {
        const Ids& q = outward.at(ids.size())[f];
        const std::size_t k = inner_pairs >> f & 1u;
        add(q[k], q[k + 1], q[(k + 2) % q.size()]);
        if (q.size() == 4) add(q[k], q[k + 2], q[(k + 3) % 4]);
    }
    return total;
}

std::set<Ids> searched(const MixedMesh& mesh, int corners, double least) {
    const detail::TetTopology topology(mesh.tets, static_cast<Index>(mesh.vertices.rows()));
    const std::vector<std::uint8_t> taken;
    const std::vector<std::uint8_t> none;
    const detail::TetSearch search{topology, mesh.vertices, mesh.tets, least, taken, 1, none};
    const detail::PotentialCells cells =
        corners == 8 ? detail::potential_hexahedra(search) : detail::potential_wedges(search);
    std::set<Ids> found;
    const Eigen::VectorXd volumes =
        cell_volumes({mesh.vertices, mesh.tets, Hexahedra(0, 8), Wedges(0, 6), Pyramids(0, 5)});
    for (Index c = 0; c < cells.count(); ++c) {
        const Ids ids(cells.ids[c].begin(), cells.ids[c].begin() + corners);
        EXPECT_TRUE(found.insert(ids).second) << "found twice";
        MixedMesh one;
        one.vertices = mesh.vertices;
        if (corners == 8)
            one.hexahedra = Eigen::Map<const Eigen::Matrix<Index, 1, 8>>(ids.data());
        else
            one.wedges = Eigen::Map<const Eigen::Matrix<Index, 1, 6>>(ids.data());
        EXPECT_NEAR(scaled_jacobians(one)[0], cells.quality[c], 1e-12);
        double inside = 0;
        for (const Index tet : cells.tets_of(c)) inside += volumes[tet];
        EXPECT_NEAR(inside, volume_within(mesh.vertices, ids, cells.inner_pairs[c]), 1e-12);
    }
    return found;
}

void expect_all_found(const MixedMesh& mesh, double least, std::size_t hexahedra, std::size_t wedges) {
    const std::set<Ids> eight = searched(mesh, 8, least), six = searched(mesh, 6, least);
    EXPECT_EQ(Oracle(mesh, 8, least).run(), eight);
    EXPECT_EQ(Oracle(mesh, 6, least).run(), six);
    EXPECT_GE(eight.size(), hexahedra);
    EXPECT_GE(six.size(), wedges);
}

TEST(PotentialCells, OfGridsInSixTetsAreAllFound) {
    const auto kind = [](int, int, int) { return Filled::kuhn; };
    expect_all_found(CubeGrid({1, 1, 1}, kind, 0, 1).mesh(), 0.3, 1, 2);
    expect_all_found(CubeGrid({2, 2, 1}, kind, 0.2, 1).mesh(), 0.1, 8, 8);
}

TEST(PotentialCells, OfRandomDelaunayMeshesAreAllFound) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int trial = 0; trial < 8; ++trial) {
        Points points(12, 3);
        for (Eigen::Index i = 0; i < points.size(); ++i) points.data()[i] = uniform(random);
        expect_all_found(testing::delaunay_mesh(points), 0.02, 1, 10);
    }
}

TEST(PotentialCells, OfDelaunayMeshesOfGridsAreAllFoundWithFlatTetsOnTheirQuads) {
    for (unsigned seed = 0; seed < 16; ++seed) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> uniform(-0.05, 0.05);
        const int cubes = seed < 3 ? 2 : 1;  // of one, both diagonals are there on all six quads
        Points points = CubeGrid(
                            {cubes, 1, 1}, [](int, int, int) { return Filled::kuhn; }, 0, 1)
                            .mesh()
                            .vertices;
        for (Eigen::Index i = 0; i < points.size(); ++i) points.data()[i] += uniform(random);
        expect_all_found(testing::delaunay_mesh(points), 0.2, cubes, 0);
    }
}

TEST(ClaimTable, CellsThatShareATetAreInEachOthersWayUntilOneIsRemoved) {
    const MixedMesh mesh = CubeGrid(
                               {1, 1, 1}, [](int, int, int) { return Filled::kuhn; }, 0, 1)
                               .mesh();
    const detail::TetTopology topology(mesh.tets, 8);
    detail::ClaimTable table(topology);
    const std::vector<Index> first{0, 1}, second{1, 2}, third{2, 3};
    const detail::CellClaims nothing{};
    std::vector<Index> found;
    table.add(7, first, nothing);
    table.conflicts(second, nothing, found);
    EXPECT_EQ(found, std::vector<Index>{7});
    table.conflicts(third, nothing, found);
    EXPECT_TRUE(found.empty());
    table.remove(7, first, nothing);
    table.conflicts(second, nothing, found);
    EXPECT_TRUE(found.empty());
}

}  // namespace
}  // namespace octafield::volume
