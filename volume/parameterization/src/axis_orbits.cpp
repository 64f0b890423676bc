#include "axis_orbits.hpp"

#include <array>
#include <utility>

#include "axis_numbers.hpp"
#include "octafield/disjoint_sets.hpp"
#include "tet_corners.hpp"

namespace octafield::volume {

AxisOrbits axis_orbits(const TetMesh& mesh, const FaceMatchings& faces) {
    DisjointSets sets(12 * static_cast<std::size_t>(mesh.tets.rows()));
    for (Eigen::Index f = 0; f < faces.tets.rows(); ++f) {
        const Index first = faces.tets(f, 0), second = faces.tets(f, 1);
        for (int k = 0; k < 3; ++k) {
            const Index v = faces.triangles(f, k);
            const Index one = 12 * first + 3 * corner_of(mesh, first, v),
                        other = 12 * second + 3 * corner_of(mesh, second, v);
            // q1 o is close to q2: axis i of the second is o e_i in the first.
            for (int i = 0; i < 3; ++i) sets.join(one + turned_axis(faces.matching[f], i) % 3, other + i);
        }
    }
    AxisOrbits orbits;
    const std::vector<Index> numbers = std::move(sets).numbers(orbits.count);
    orbits.of_tets = Eigen::Map<const Rows<Index, 12>>(numbers.data(), mesh.tets.rows(), 12);
    return orbits;
}

}  // namespace octafield::volume
