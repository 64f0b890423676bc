#include "folded_tets.hpp"

#include <algorithm>
#include <string>

#include "octafield/error.hpp"

namespace octafield::volume {
namespace {

// Whether the triangle, seen from outside the tet, runs through its vertices in ascending cyclic order.
bool ascending(const Tets& tets, Index side) {
    const auto& face = tet_face[side % 4];
    const Index t = side / 4, a = tets(t, face[0]), b = tets(t, face[1]), c = tets(t, face[2]);
    return (a < b) + (b < c) + (c < a) == 2;
}

// For tets of positive volume: their fourth vertices are on one side of the triangle's plane.
bool on_one_side(const Tets& tets, const TriangleTable& table, Eigen::Index triangle) {
    const Index first = table.sides(triangle, 0), second = table.sides(triangle, 1);
    return second >= 0 && ascending(tets, first) == ascending(tets, second);
}

// Sheets of one connected part: crossing a triangle with both tets on one side changes the sheet.
struct Part {
    std::vector<Index> tets[2];
    bool contradicts = false;
};

Part part_of(const TetMesh& mesh, const TriangleTable& table, Index start, std::vector<signed char>& sheet) {
    Part part;
    std::vector<Index> open{start};
    sheet[start] = 0;
    while (!open.empty()) {
        const Index t = open.back();
        open.pop_back();
        part.tets[static_cast<int>(sheet[t])].push_back(t);
        for (int k = 0; k < 4; ++k) {
            const Index triangle = table.tet_triangles(t, k);
            if (table.sides(triangle, 1) < 0) continue;
            const Index beyond = table.sides(triangle, table.sides(triangle, 0) / 4 == t ? 1 : 0) / 4;
            const auto wanted = static_cast<signed char>(sheet[t] ^ (on_one_side(mesh.tets, table, triangle) ? 1 : 0));
            if (sheet[beyond] < 0) {
                sheet[beyond] = wanted;
                open.push_back(beyond);
            }
            part.contradicts |= sheet[beyond] != wanted;
        }
    }
    return part;
}

// Of each part the smaller sheet; where sheets contradict each other, both tets of the triangles concerned.
std::vector<Index> folded(const TetMesh& mesh, const TriangleTable& table) {
    std::vector<signed char> sheet(mesh.tets.rows(), -1);
    std::vector<Index> found;
    bool contradicts = false;
    for (Index t = 0; t < mesh.tets.rows(); ++t) {
        if (sheet[t] >= 0) continue;
        const Part part = part_of(mesh, table, t, sheet);
        contradicts |= part.contradicts;
        const auto& fewer = part.tets[part.tets[1].size() <= part.tets[0].size() ? 1 : 0];
        found.insert(found.end(), fewer.begin(), fewer.end());
    }
    if (contradicts)
        for (Eigen::Index i = 0; i < table.triangles.rows(); ++i)
            if (on_one_side(mesh.tets, table, i))
                for (int k = 0; k < 2; ++k) found.push_back(table.sides(i, k) / 4);
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

}  // namespace

void require_unfolded(const TetMesh& mesh, const TriangleTable& table) {
    Eigen::Index triangle = 0;
    while (triangle < table.triangles.rows() && !on_one_side(mesh.tets, table, triangle)) ++triangle;
    if (triangle == table.triangles.rows()) return;
    require_valid(mesh);  // what follows is about tets of positive volume
    const std::vector<Index> ids = folded(mesh, table);
    throw GeometryError(std::to_string(ids.size()) + (ids.size() == 1 ? " tet is" : " tets are") +
                            " folded over neighbours: they lie on the same side of a triangle they share, so that the mesh "
                            "overlaps itself (tets " +
                            first_few(ids) + "); untangle or remesh there",
                        "folded_tet", ids);
}

}  // namespace octafield::volume
