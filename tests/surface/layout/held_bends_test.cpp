// Vertices held where seams bend.
#include "held_bends.hpp"

#include <gtest/gtest.h>

#include <array>

namespace octafield::surface {
namespace {

// From (0, 0) by (1, 0) to a place 60 degrees to the left of straight on.
detail::Seams one_bend(bool with_slight_one) {
    detail::Seam seam;
    seam.length = 2;
    seam.knots = {{0, 0, {0, 0, 0}}, {1, 1, {1, 0, 0}}, {2, 2, {1.5, std::sqrt(0.75), 0}}};
    if (with_slight_one) seam.knots.insert(seam.knots.begin() + 1, {0.5, 0.5, {0.5, 0.1, 0}});
    detail::Seams seams;
    seams.seams = {seam};
    return seams;
}

// Of vertices at these lengths: where they are after, and which are held.
struct Held {
    std::vector<detail::SideGrids::OnSeam> on_seams;
    QuadMesh mesh;
};
Held held(const detail::Seams& seams, const std::vector<double>& lengths) {
    Held result;
    result.mesh.vertices = Points::Zero(static_cast<Index>(lengths.size()), 3);
    for (const double at : lengths) result.on_seams.push_back({0, at});
    detail::hold_bends(seams, result.mesh, result.on_seams);
    return result;
}

TEST(HeldBends, TakeTheNearerVertexWithThem) {
    const Held found = held(one_bend(false), {0.7, 1.2});
    EXPECT_FALSE(found.on_seams[0].held);
    EXPECT_TRUE(found.on_seams[1].held);
    EXPECT_EQ(found.on_seams[1].at, 1);
    EXPECT_TRUE(found.mesh.vertices.row(1).isApprox(Eigen::RowVector3d(1, 0, 0)));
}

TEST(HeldBends, LeaveNodesAndAQuarterOfTheEdge) {
    EXPECT_TRUE(held(one_bend(false), {1.6}).on_seams[0].held);   // the nearer one; the start is a node
    EXPECT_TRUE(held(one_bend(false), {0.2}).on_seams[0].held);   // 0.8 of 1.8
    EXPECT_FALSE(held(one_bend(false), {}).on_seams.size() > 0);  // none there
    detail::Seams late = one_bend(false);
    late.seams[0].knots[1].at = 1.9;
    EXPECT_FALSE(held(late, {0.1}).on_seams[0].held);  // the end is nearer, and 1.8 of 1.9 is too far
}

TEST(HeldBends, AreOnlyThoseOfMoreThan45Degrees) {
    EXPECT_EQ(detail::bends(one_bend(true).seams[0]), std::vector<double>{1});
}

TEST(HeldBends, OfClosedSeamsAreCountedAcrossTheirStart) {
    detail::Seams seams;
    detail::Seam square;
    square.closed = true;
    square.length = 4;
    const std::array<Eigen::Vector3d, 5> corners = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}}};
    for (int k = 0; k < 5; ++k) square.knots.push_back({double(k), double(k), corners[k]});
    seams.seams = {square};
    EXPECT_EQ(detail::bends(square), (std::vector<double>{0, 1, 2, 3}));
    const Held found = held(seams, {0.9, 1.9, 2.9, 3.9});
    for (int k = 0; k < 4; ++k) {
        EXPECT_TRUE(found.on_seams[k].held);
        EXPECT_TRUE(found.mesh.vertices.row(k).isApprox(corners[(k + 1) % 4].transpose())) << k;
    }
}

}  // namespace
}  // namespace octafield::surface
