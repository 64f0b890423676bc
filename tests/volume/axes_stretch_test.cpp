#include "octafield/volume/axes_stretch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "octafield/error.hpp"
#include "octafield/surface/features.hpp"
#include "octafield/volume/computed_field.hpp"
#include "octafield/volume/feature_alignment.hpp"
#include "octafield/volume/frame_field.hpp"
#include "octafield/volume/singularities.hpp"
#include "octafield/volume/streamlines.hpp"
#include "tet_fixtures.hpp"

namespace octafield::volume {
namespace {

using frames::Matrix3;
using frames::Vector3;
using testing::degree;
using testing::kuhn_cube;

TetDomain with_angle_features(TetMesh mesh, double angle = 15 * degree) {
    const TetDomain domain(std::move(mesh));
    return domain.with_features(surface::detect_features(domain.surface().mesh, {.angle = angle}));
}

// The unit cube under a linear map with these columns. angle: of its flattest edges or less.
TetDomain parallelepiped(int n, const Matrix3& columns, double angle = 15 * degree) {
    TetMesh mesh = kuhn_cube(n);
    mesh.vertices = (mesh.vertices * columns.transpose()).eval();
    return with_angle_features(std::move(mesh), angle);
}

// The half y <= x of the cube, with the edge x = y = 0 at `angle`, and right angles at x = 1, y = 0; height 0.6.
TetDomain wedge(int n, double angle) {
    const TetMesh cube = kuhn_cube(n);
    std::vector<Index> place(cube.vertices.rows(), -1), kept;
    std::vector<Eigen::RowVector4i> tets;
    for (Eigen::Index t = 0; t < cube.tets.rows(); ++t) {
        const Eigen::RowVector3d centre = cube.vertices(cube.tets.row(t), Eigen::all).colwise().mean();
        if (centre.y() > centre.x()) continue;
        Eigen::RowVector4i tet = cube.tets.row(t);
        for (Index& v : tet) {
            if (place[v] < 0) {
                place[v] = static_cast<Index>(kept.size());
                kept.push_back(v);
            }
            v = place[v];
        }
        tets.push_back(tet);
    }
    TetMesh mesh{cube.vertices(kept, Eigen::all), Tets(tets.size(), 4)};
    for (std::size_t t = 0; t < tets.size(); ++t) mesh.tets.row(t) = tets[t];
    mesh.vertices.col(1) *= std::tan(angle);
    mesh.vertices.col(2) *= 0.6;
    return with_angle_features(std::move(mesh));
}

Points any_directions(const TetDomain& domain) {
    const SectorNormals normals = sector_normals(domain);
    Points directions(domain.surface().mesh.vertices.rows(), 3);
    for (std::size_t i = 0; i < normals.vertex.size(); ++i) {
        const Vector3 n = normals.normal.row(i).transpose();
        directions.row(normals.vertex[i]) = n.unitOrthogonal().transpose();
    }
    return directions;
}

Quaternions solved(const TetDomain& domain, const AxesStretch& stretch) {
    return frame_field(domain, boundary_constraints(domain, any_directions(domain), stretch.values)).smooth.frames;
}

Matrix3 axes_at(const Rows<double, 9>& axes, Index vertex) {
    return Eigen::Map<const Matrix3>(Eigen::Matrix<double, 1, 9>(axes.row(vertex)).data());
}

// Largest angle between a direction and the nearest of the axes.
double off(const Matrix3& axes, const Matrix3& directions) {
    double worst = 0;
    for (int j = 0; j < 3; ++j) {
        double best = std::numbers::pi;
        for (int i = 0; i < 3; ++i)
            best = std::min(best, std::atan2(axes.col(i).cross(directions.col(j)).norm(),
                                             std::abs(axes.col(i).dot(directions.col(j)))));
        worst = std::max(worst, best);
    }
    return worst;
}

TEST(AxesStretch, IsNoneWhereEdgesAreAtRightAngles) {
    const TetDomain cube = with_angle_features(kuhn_cube(3));
    const AxesStretch found = axes_stretch(cube);
    EXPECT_TRUE(found.sharp.empty());
    EXPECT_TRUE(found.followed.empty());
    for (Index v = 0; v < cube.vertex_count(); ++v) EXPECT_EQ(found.at(v), Matrix3::Identity());
    const Points directions = any_directions(cube);
    const BoundaryConstraints plain = boundary_constraints(cube, directions);
    const BoundaryConstraints stretched = boundary_constraints(cube, directions, found.values);
    EXPECT_EQ(plain.kind, stretched.kind);
    EXPECT_EQ(plain.frames, stretched.frames);
    EXPECT_EQ(plain.axis, stretched.axis);
}

TEST(AxesStretch, AxesOfAParallelepipedAreItsEdgesEverywhere) {
    Matrix3 columns;
    columns << 1, 0.4, -0.2, 0, 0.9, 0.3, 0, 0, 0.8;
    const TetDomain domain = parallelepiped(4, columns);
    const AxesStretch stretch = axes_stretch(domain);
    EXPECT_EQ(stretch.followed.size(), 12u * 3 + 8);
    EXPECT_TRUE(stretch.needles.empty());
    const Quaternions frames = solved(domain, stretch);
    const Rows<double, 9> axes = stretched_axes(frames, stretch.values);
    for (Index v = 0; v < domain.vertex_count(); ++v) EXPECT_LT(off(axes_at(axes, v), columns), 1e-6) << v;
    EXPECT_LT(alignment_angles(domain, frames, stretch.values).maxCoeff(), 1e-6);
    EXPECT_LT(feature_alignment_angles(domain, frames, stretch.values).maxCoeff(), 1e-6);
    EXPECT_TRUE(singular_graph(domain, frames).curves.empty());
}

// So skew that of the axes of Q another one is nearest to the normals of some faces.
TEST(AxesStretch, EveryEdgeOfASkewParallelepipedHasOneHexahedron) {
    Matrix3 columns;
    columns << 0.95, 0.86, 0.42, -0.19, 0.38, -0.85, 0.25, 0.33, 0.3;
    const TetDomain domain = parallelepiped(3, columns, 2 * degree);
    const AxesStretch stretch = axes_stretch(domain, {.corner_angle = 2 * degree});
    const Quaternions frames = solved(domain, stretch);
    EXPECT_LT(wedge_alignment(domain, frames, 0, stretch.values).maxCoeff(), 1e-6);
    const BoundaryMeshability found = boundary_meshability(domain, frames, 0, stretch.values);
    EXPECT_EQ(found.wedges.size(), 12u * 3);
    for (const FeatureWedge& w : found.wedges) {
        EXPECT_EQ(w.hexahedra_a, 1);
        EXPECT_EQ(w.hexahedra_b, 1);
        EXPECT_EQ(w.around, 1);
    }
    EXPECT_EQ(found.corners.size(), 8u);
    for (const SurfaceCorner& corner : found.corners) EXPECT_TRUE(corner.meshable && corner.inside == 0);
    EXPECT_TRUE(found.crossings.empty());
}

TEST(AxesStretch, CurvesRunAlongTheEdgesOfAParallelepiped) {
    Matrix3 columns;
    columns << 1, 0.4, -0.2, 0, 0.9, 0.3, 0, 0, 0.8;
    const TetDomain domain = parallelepiped(4, columns);
    const AxesStretch stretch = axes_stretch(domain);
    const Quaternions frames = solved(domain, stretch);
    const Points centre = (columns * Vector3(0.45, 0.55, 0.4)).transpose();
    const auto seeds = axis_seeds_at(domain, frames, centre, stretch.values);
    ASSERT_EQ(seeds.size(), 3u);
    for (const FrameStreamline& line : frame_streamlines(domain, frames, seeds, {}, 0, stretch.values)) {
        EXPECT_EQ(line.first_end, FrameStreamlineEnd::boundary);
        EXPECT_EQ(line.last_end, FrameStreamlineEnd::boundary);
        const Vector3 way = (line.points.bottomRows<1>() - line.points.topRows<1>()).transpose();
        double best = 1, length = 0;
        for (int k = 0; k < 3; ++k)
            if (const double off = way.cross(columns.col(k)).norm() / (way.norm() * columns.col(k).norm()); off < best)
                best = off, length = columns.col(k).norm();
        EXPECT_LT(best, 1e-6);
        EXPECT_NEAR(line.length, length, 1e-6);  // from face to face
    }
}

TEST(ComputedField, FreeAxesOfASolidWithRightAnglesAreItsFramesBitByBit) {
    const TetDomain cube = with_angle_features(kuhn_cube(3));
    const ComputedField plain = computed_field(cube), free = computed_field(cube, {.axes = Axes::free});
    EXPECT_EQ(plain.combed.frames, free.combed.frames);
    EXPECT_EQ(plain.analysis.energy, free.analysis.energy);
    EXPECT_EQ(plain.analysis.integrability.twist, free.analysis.integrability.twist);
    EXPECT_EQ(free.stretch.values.rows(), 0);
}

TEST(ComputedField, FreeAxesFollowASharpEdge) {
    const TetDomain domain = wedge(6, 30 * degree);
    const ComputedField found = computed_field(domain, {.axes = Axes::free});
    EXPECT_EQ(found.stretch.values.rows(), domain.vertex_count());
    EXPECT_LT(found.analysis.alignment.maxCoeff(), 1e-6);
    EXPECT_EQ(found.analysis.boundary_meshability.non_meshable_wedges, 0);
    EXPECT_GT(computed_field(domain).analysis.alignment.maxCoeff(), 10 * degree);
}

TEST(ComputedField, FreeAxesWithLengthsOrInTetsAreRefused) {
    const TetDomain domain = wedge(3, 30 * degree);
    const auto kind_of = [](const auto& work) -> std::string {
        try {
            work();
        } catch (const InvalidInput& error) {
            return error.kind();
        }
        return "";
    };
    FieldOptions options{.axes = Axes::free};
    EXPECT_EQ(kind_of([&] { computed_tet_field(domain, options); }), "wrong_sampling");
    options.solve.smooth.representation = "odeco_lengths";
    EXPECT_EQ(kind_of([&] { computed_field(domain, options); }), "stretched_axes");
    const Stretches stretch = axes_stretch(domain).values;
    const Quaternions frames = solved(domain, axes_stretch(domain));
    EXPECT_EQ(kind_of([&] { boundary_meshability(domain, frames, 0, stretch.topRows(2)); }), "wrong_size");
    EXPECT_EQ(kind_of([&] { frame_streamlines(domain, frames, {}, {}, 0, -stretch); }), "not_positive");
    EXPECT_EQ(kind_of([&] { wedge_alignment(domain, frames, 0, 0 * stretch); }), "not_positive");
}

class SharpWedge : public ::testing::TestWithParam<double> {};

TEST_P(SharpWedge, BothFacesAreFollowedAndTheSingularCurveIsFarFromTheEdge) {
    const TetDomain domain = wedge(10, GetParam() * degree);
    const AxesStretch stretch = axes_stretch(domain);
    EXPECT_EQ(stretch.followed.size(), 9u * 9 + 6);
    const Quaternions frames = solved(domain, stretch);
    EXPECT_LT(alignment_angles(domain, frames, stretch.values).maxCoeff(), 1e-6);
    EXPECT_LT(feature_alignment_angles(domain, frames, stretch.values).maxCoeff(), 1e-6);
    const Rows<double, 9> axes = stretched_axes(frames, stretch.values);
    for (Index v = 0; v < domain.vertex_count(); ++v) {
        const Matrix3 at = axes_at(axes, v);
        EXPECT_GT(at.determinant(), 0);
        if (domain.mesh().vertices.row(v).head<2>().norm() > 1e-12) continue;
        Matrix3 edge;
        edge << Vector3::UnitZ(), Vector3::UnitX(),
            Vector3(std::cos(GetParam() * degree), std::sin(GetParam() * degree), 0);
        EXPECT_LT(off(at, edge), 1e-6) << v;
    }
    const SingularGraph graph = singular_graph(domain, frames);
    EXPECT_EQ(graph.curves.size(), 1u);
    EXPECT_TRUE(std::all_of(graph.curve_quarter_turns.begin(), graph.curve_quarter_turns.end(),
                            [](int turns) { return turns == 1; }));
    for (const SingularTriangle& triangle : graph.triangles)  // edges are 0.1 long
        EXPECT_GT(triangle.point.head<2>().norm(), 0.2);
}

TEST_P(SharpWedge, EveryFeatureEdgeHasOneHexahedronAndEveryCornerIsMeshable) {
    const TetDomain domain = wedge(10, GetParam() * degree);
    const AxesStretch stretch = axes_stretch(domain);
    const Quaternions frames = solved(domain, stretch);
    const FieldAnalysis found = analyse_field(domain, frames, 0, stretch.values);
    const BoundaryMeshability& boundary = found.boundary_meshability;
    EXPECT_EQ(boundary.wedges.size(), static_cast<std::size_t>(domain.features().edges.rows()));
    bool sharp = false;
    for (const FeatureWedge& w : boundary.wedges) {
        EXPECT_EQ(w.hexahedra_a, 1) << w.a << " " << w.b;
        EXPECT_EQ(w.hexahedra_b, 1) << w.a << " " << w.b;
        EXPECT_EQ(w.around, 1) << w.a << " " << w.b;
        sharp = sharp || std::abs(w.angle - GetParam() * degree) < 1e-9;  // that in space
    }
    EXPECT_TRUE(sharp);
    EXPECT_EQ(boundary.corners.size(), 6u);
    for (const SurfaceCorner& corner : boundary.corners) {
        EXPECT_TRUE(corner.meshable);
        EXPECT_EQ(corner.inside, 0);  // three edges of one hexahedron, three sectors of one quadrilateral
        EXPECT_EQ(corner.unclear_sectors, 0);
    }
    EXPECT_TRUE(boundary.crossings.empty());
    EXPECT_EQ(found.meshability.boundary_ends, 2);
    EXPECT_EQ(found.meshability.boundary_ends_about_normal, 2);
    EXPECT_EQ(found.integrability.twist.size(), 0);
    EXPECT_LT(found.alignment.maxCoeff(), 1e-6);
    const Rows<double, 2> off = wedge_alignment(domain, frames, 0, stretch.values);
    EXPECT_EQ(off.rows(), static_cast<Eigen::Index>(boundary.wedges.size()));
    EXPECT_LT(off.maxCoeff(), 1e-6);
}

TEST_P(SharpWedge, AtRightAnglesAxesAreOffBothFacesByHalfTheAngle) {
    const TetDomain domain = wedge(6, GetParam() * degree);
    const Quaternions frames = frame_field(domain, boundary_constraints(domain, any_directions(domain))).smooth.frames;
    const Rows<double, 2> off = wedge_alignment(domain, frames);
    const BoundaryMeshability found = boundary_meshability(domain, frames);
    const double wanted = std::min(GetParam(), 90 - GetParam()) / 2 * degree;
    for (std::size_t i = 0; i < found.wedges.size(); ++i)
        if (std::abs(found.wedges[i].angle - GetParam() * degree) < 1e-9) {
            EXPECT_GT(off(i, 0), wanted - 1e-6);
        }
}
INSTANTIATE_TEST_SUITE_P(Degrees, SharpWedge, ::testing::Values(15.0, 30.0, 45.0, 60.0, 75.0));

TEST(AxesStretch, NeedlesAreNamedAndNotFollowed) {
    const TetDomain domain = wedge(3, 0.5 * degree);
    const AxesStretch found = axes_stretch(domain);
    EXPECT_FALSE(found.needles.empty());
    for (Index v = 0; v < domain.vertex_count(); ++v) EXPECT_TRUE(found.at(v).allFinite());
}

TEST(AxesStretch, BadInputIsRefused) {
    const TetDomain cube = with_angle_features(kuhn_cube(2));
    EXPECT_THROW(axes_stretch(cube, {.corner_angle = 2}), InvalidInput);
    EXPECT_THROW(axes_stretch(cube, {.least_deviation = -1}), InvalidInput);
    Stretches stretch = axes_stretch(cube).values;
    stretch(5, 0) = -1;
    try {
        boundary_constraints(cube, any_directions(cube), stretch);
        FAIL();
    } catch (const InvalidInput& error) {
        EXPECT_EQ(error.kind(), "not_positive");
        EXPECT_EQ(error.elements(), std::vector<Index>{5});
    }
    EXPECT_THROW(boundary_constraints(cube, any_directions(cube), stretch.topRows(3)), InvalidInput);
}

}  // namespace
}  // namespace octafield::volume
