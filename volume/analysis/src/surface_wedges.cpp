#include "surface_wedges.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <tuple>

#include "octafield/parallel.hpp"
#include "octafield/volume/triangle_table.hpp"

namespace octafield::volume {
namespace {

// A triangle of the surface, the tet on one of its sides, and one of its edges.
struct Beginning {
    Eigen::Index row;
    Index tet;
    Index a, b;
};

class Walk {
public:
    Walk(const TetMesh& mesh, const TriangleTable& table, const std::vector<std::uint8_t>& on_surface)
        : mesh_(mesh), table_(table), on_surface_(on_surface) {}

    // Positive about b - a from the beginning's triangle into its tet, or nothing.
    Wedge from(const Beginning& beginning) const {
        Wedge wedge{beginning.a, beginning.b, {}, {}};
        Index first = -1, second = -1;
        std::tie(first, second) = across(beginning.row, beginning.tet, wedge.a, wedge.b);
        if (!positive(wedge.a, wedge.b, first, second)) return wedge;
        wedge.link = {first, second};
        wedge.tets = {beginning.tet};
        Eigen::Index row = row_opposite(beginning.tet, first);
        Index tet = beginning.tet;
        while (!on_surface_[row]) {
            tet = table_.sides(row, table_.sides(row, 0) / 4 == tet ? 1 : 0) / 4;
            const Index next = across(row, tet, wedge.a, wedge.b).second;
            row = row_opposite(tet, wedge.link.back());
            wedge.link.push_back(next);
            wedge.tets.push_back(tet);
        }
        return wedge;
    }

private:
    // The vertex of the triangle that is not a or b, and that of the tet which is not in the triangle.
    std::pair<Index, Index> across(Eigen::Index row, Index tet, Index a, Index b) const {
        std::pair<Index, Index> found{-1, -1};
        for (int k = 0; k < 3; ++k)
            if (const Index v = table_.triangles(row, k); v != a && v != b) found.first = v;
        for (int k = 0; k < 4; ++k)
            if (const Index v = mesh_.tets(tet, k); v != a && v != b && v != found.first) found.second = v;
        return found;
    }
    Eigen::Index row_opposite(Index tet, Index vertex) const {
        int k = 0;
        while (mesh_.tets(tet, k) != vertex) ++k;
        return table_.tet_triangles(tet, k);
    }
    // By the order of the ids in the tet, which is positively oriented.
    bool positive(Index a, Index b, Index first, Index second) const {
        const auto p = [&](Index v) -> Eigen::Vector3d { return mesh_.vertices.row(v).transpose(); };
        return (p(b) - p(a)).dot((p(first) - p(a)).cross(p(second) - p(a))) > 0;
    }

    const TetMesh& mesh_;
    const TriangleTable& table_;
    const std::vector<std::uint8_t>& on_surface_;
};

}  // namespace

std::vector<Wedge> surface_wedges(const TetDomain& domain, const std::vector<std::pair<Index, Index>>& edges,
                                  int threads) {
    const TriangleTable& table = domain.triangles();
    const std::vector<Index>& rows = domain.surface_rows();
    std::vector<std::uint8_t> on_surface(table.triangles.rows(), 0);
    for (Eigen::Index t = 0; t < table.triangles.rows(); ++t) on_surface[t] = table.sides(t, 1) < 0;
    for (const Index row : rows) on_surface[row] = 1;
    std::vector<Beginning> beginnings;
    for (const Index row : rows)
        for (const Index side : {table.sides(row, 0), table.sides(row, 1)})
            for (int k = 0; k < 3 && side >= 0; ++k) {
                const Index v = table.triangles(row, k), w = table.triangles(row, (k + 1) % 3);
                const std::pair<Index, Index> edge = std::minmax(v, w);
                if (std::binary_search(edges.begin(), edges.end(), edge))
                    beginnings.push_back({row, side / 4, edge.first, edge.second});
            }
    std::sort(beginnings.begin(), beginnings.end(), [](const Beginning& x, const Beginning& y) {
        return std::tie(x.a, x.b, x.row, x.tet) < std::tie(y.a, y.b, y.row, y.tet);
    });
    std::vector<Wedge> wedges(beginnings.size());
    const Walk walk(domain.mesh(), table, on_surface);
    parallel_for(static_cast<std::int64_t>(beginnings.size()), threads,
                 [&](std::int64_t i) { wedges[i] = walk.from(beginnings[i]); });
    std::erase_if(wedges, [](const Wedge& w) { return w.link.empty(); });
    return wedges;
}

}  // namespace octafield::volume
