// Faces as surfaces of their own.
#include "face_layouts.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace octafield::surface::detail {
namespace {

// Two squares, their vertices in turn, each with its diagonal.
TriangleMesh two_squares() {
    TriangleMesh mesh{Points(8, 3), Triangles(4, 3)};
    const double corners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (Index k = 0; k < 4; ++k)
        for (Index square = 0; square < 2; ++square)
            mesh.vertices.row(2 * k + square) << corners[k][0] + 3 * square, corners[k][1], 0;
    mesh.triangles << 1, 3, 5, 0, 2, 4, 0, 4, 6, 1, 5, 7;
    return mesh;
}

TEST(FaceLayouts, FacesAreMeasuredAsTheWhole) {
    const SurfaceDomain in_space(two_squares());
    Eigen::VectorXd lengths = in_space.edge_lengths();
    for (Index e = 0; e < lengths.size(); ++e) lengths[e] *= 1 + 0.01 * e;  // each another one
    std::vector<Index> origins(8);
    std::iota(origins.begin(), origins.end(), 0);
    for (const SurfaceDomain& whole : {in_space, in_space.with_edge_lengths(lengths)}) {
        const std::vector<Face> faces = faces_of(whole, {}, origins);
        ASSERT_EQ(faces.size(), 2u);
        for (const Face& face : faces) {
            EXPECT_EQ(face.domain.has_own_lengths(), whole.has_own_lengths());
            ASSERT_EQ(face.domain.edge_count(), 5);
            for (Index e = 0; e < 5; ++e) {
                const auto ends = face.domain.topology().edges.row(e);
                for (Index w = 0; w < whole.edge_count(); ++w)
                    if (whole.topology().edges(w, 0) == face.vertices[ends[0]] &&
                        whole.topology().edges(w, 1) == face.vertices[ends[1]]) {
                        EXPECT_EQ(face.domain.edge_lengths()[e], whole.edge_lengths()[w]);
                    }
            }
        }
        EXPECT_EQ(faces[0].triangles, (std::vector<Index>{0, 3}));
        EXPECT_EQ(faces[1].vertices, (std::vector<Index>{0, 2, 4, 6}));
    }
}

}  // namespace
}  // namespace octafield::surface::detail
