#include "phase_unknowns.hpp"

#include "axis_numbers.hpp"
#include "octafield/disjoint_sets.hpp"
#include "tet_corners.hpp"

namespace octafield::volume {

PhaseUnknowns::PhaseUnknowns(const TetMesh& mesh, const FaceMatchings& faces) : codes_(mesh.tets.rows(), 12) {
    // Member 6 (4 tet + corner) + axis number, of both directions of each axis.
    DisjointSets sets(24 * static_cast<std::size_t>(mesh.tets.rows()));
    for (Eigen::Index f = 0; f < faces.tets.rows(); ++f) {
        const Index first = faces.tets(f, 0), second = faces.tets(f, 1);
        for (int k = 0; k < 3; ++k) {
            const Index v = faces.triangles(f, k);
            const Index one = 6 * (4 * first + corner_of(mesh, first, v)),
                        other = 6 * (4 * second + corner_of(mesh, second, v));
            // q1 o is close to q2: axis i of the second is o e_i in the first.
            for (int i = 0; i < axis_count; ++i) sets.join(one + turned_axis(faces.matching[f], i), other + i);
        }
    }
    // A set and that of the opposites: the one with the lowest member comes first and is the positive one.
    Index sets_count = 0;
    const std::vector<Index> set = std::move(sets).numbers(sets_count);
    std::vector<Index> code(sets_count, 0);
    for (Index t = 0; t < mesh.tets.rows(); ++t)
        for (int c = 0; c < 4; ++c)
            for (int i = 0; i < 3; ++i) {
                const Index plus = set[6 * (4 * t + c) + i], minus = set[6 * (4 * t + c) + i + 3];
                if (code[plus] == 0) {
                    held_.push_back(plus == minus);
                    code[minus] = -static_cast<Index>(held_.size());
                    code[plus] = static_cast<Index>(held_.size());
                }
                codes_(t, 3 * c + i) = code[plus];
            }
}

}  // namespace octafield::volume
