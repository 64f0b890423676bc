// What cannot be imposed is refused with its kind, place and remedy.
#include <functional>

#include "imposed_fixtures.hpp"
#include "octafield/error.hpp"

namespace octafield::surface {
namespace {

struct Refusal {
    std::string kind, message;
    std::vector<Index> elements;
};

Refusal refusal(const std::function<void()>& call) {
    try {
        call();
    } catch (const Error& error) {
        return {error.kind(), error.what(), error.elements()};
    }
    return {};
}

Refusal imposing(const SurfaceDomain& domain, const SingularPattern& pattern, const ImposedFieldOptions& options = {}) {
    return refusal([&] { impose_singular_points(domain, pattern, options); });
}

SingularPattern four(const SurfaceDomain& domain) {
    SingularPattern pattern;
    for (int i = 0; i < 4; ++i)
        pattern.points.push_back(imposed_point(domain, in_plane(std::polar(0.5, i * 1.57 + 0.2)), 1));
    return pattern;
}

TEST(ImposedBadInputs, IndexSumNamesTheDeficitAndTheRemedy) {
    const SurfaceDomain domain(disk(6));
    SingularPattern pattern = four(domain);
    pattern.points.pop_back();
    const Refusal few = imposing(domain, pattern);
    EXPECT_EQ(few.kind, "index_sum");
    EXPECT_EQ(few.elements, std::vector<Index>{0});
    EXPECT_NE(few.message.find("3/4"), std::string::npos) << few.message;
    EXPECT_NE(few.message.find("1/4 too little"), std::string::npos) << few.message;
    EXPECT_NE(few.message.find("add 1 point of valence 3"), std::string::npos) << few.message;
    pattern = four(domain);
    pattern.points.push_back(imposed_point(domain, Vector(0.1, 0, 0), 2));
    const Refusal much = imposing(domain, pattern);
    EXPECT_EQ(much.kind, "index_sum");
    EXPECT_NE(much.message.find("2/4 too much"), std::string::npos) << much.message;
    EXPECT_EQ(imposing(SurfaceDomain(icosphere(1)), {}).kind, "index_sum");
}

TEST(ImposedBadInputs, PointsOutsideTheSurface) {
    const SurfaceDomain domain(disk(6));
    for (const ImposedPoint& bad : std::vector<ImposedPoint>{{-1, {1, 0, 0}, 1},
                                                             {domain.triangle_count(), {1, 0, 0}, 1},
                                                             {0, {1.2, -0.2, 0}, 1},
                                                             {0, {0.5, 0.2, 0.2}, 1},
                                                             {0, {NAN, 0.5, 0.5}, 1}}) {
        SingularPattern pattern = four(domain);
        pattern.points[2] = bad;
        const Refusal found = imposing(domain, pattern);
        EXPECT_EQ(found.kind, "outside_surface");
        EXPECT_EQ(found.elements, std::vector<Index>{2});
    }
    EXPECT_EQ(refusal([&] { imposed_point(domain, Vector(1.03, 0, 0), 1); }).kind, "outside_surface");
    EXPECT_EQ(refusal([&] { imposed_point(domain, Vector(0, 0, 0.4), 1); }).kind, "outside_surface");
    EXPECT_EQ(refusal([&] { imposed_at_vertex(domain, 4000, 1); }).kind, "outside_surface");
}

TEST(ImposedBadInputs, ValencesBelowOne) {
    const SurfaceDomain domain(disk(6));
    SingularPattern pattern;
    pattern.points.push_back(imposed_point(domain, Vector(0.1, 0.1, 0), 4));
    EXPECT_EQ(imposing(domain, pattern).kind, "bad_valence");
    // Two corners of a square without quads, two with two.
    const SurfaceDomain square(plate(6, [](double, double) { return true; }));
    SingularPattern strip;
    std::vector<Index> corners;
    for (const CornerQuads& c : default_corner_quads(square)) corners.push_back(c.vertex);
    ASSERT_EQ(corners.size(), 4u);
    strip.corners = {{corners[0], 0}, {corners[1], 2}, {corners[2], 2}, {corners[3], 0}};
    const Refusal found = imposing(square, strip);
    EXPECT_EQ(found.kind, "bad_valence");
    EXPECT_EQ(found.elements, (std::vector<Index>{corners[0], corners[3]}));
    EXPECT_EQ(imposing(square, strip, {.allow_zero_quads = true}).kind, "");
    strip.corners[0].quads = -1;
    EXPECT_EQ(imposing(square, strip, {.allow_zero_quads = true}).kind, "bad_valence");
}

TEST(ImposedBadInputs, CornersInsideOrTwice) {
    const SurfaceDomain domain(disk(6));
    SingularPattern pattern = four(domain);
    pattern.corners = {{0, 1}};
    EXPECT_EQ(imposing(domain, pattern).kind, "not_on_boundary");
    pattern.corners = {{9000, 1}};
    EXPECT_EQ(imposing(domain, pattern).kind, "not_on_boundary");
    const Index rim = domain.vertex_count() - 1;
    pattern.corners = {{rim, 2}, {rim, 2}};
    EXPECT_EQ(imposing(domain, pattern).kind, "repeated_corner");
    pattern.corners = {{rim, 2}};
    pattern.points.push_back(imposed_at_vertex(domain, rim, 0));
    const Refusal found = imposing(domain, pattern);
    EXPECT_EQ(found.kind, "repeated_corner");
    EXPECT_EQ(found.elements, std::vector<Index>{rim});
}

TEST(ImposedBadInputs, PointsInOnePlace) {
    const SurfaceDomain domain(disk(6));
    for (const double apart : {0.0, 1e-6}) {
        SingularPattern pattern = four(domain);
        pattern.points[1] = pattern.points[3];
        pattern.points[1].weights += Vector(apart, -apart, 0);
        const Refusal found = imposing(domain, pattern);
        EXPECT_EQ(found.kind, "coincident_points") << apart;
        EXPECT_EQ(found.elements, (std::vector<Index>{1, 3}));
    }
}

TEST(ImposedBadInputs, SurfacesThatAreNone) {
    EXPECT_EQ(imposing(SurfaceDomain(), {}).kind, "empty");
    // Two triangles that touch at a vertex.
    const SurfaceDomain bow(
        make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, {{0, 1, 2}, {0, 3, 4}}));
    const Refusal found = imposing(bow, {});
    EXPECT_EQ(found.kind, "non_manifold_vertex");
    EXPECT_EQ(found.elements, std::vector<Index>{0});
    // Three triangles at an edge.
    EXPECT_EQ(refusal([] {
                  SurfaceDomain(make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}},
                                          {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}));
              }).kind,
              "non_manifold_edge");
}

TEST(ImposedBadInputs, OptionsOutOfRange) {
    const SurfaceDomain domain(disk(6));
    for (const ImposedFieldOptions& bad : {ImposedFieldOptions{.tolerance = 0}, ImposedFieldOptions{.sectors = 3},
                                           ImposedFieldOptions{.rings = 0}, ImposedFieldOptions{.ring_ratio = 1},
                                           ImposedFieldOptions{.tolerance = NAN}, ImposedFieldOptions{.max_steps = -1}})
        EXPECT_EQ(imposing(domain, four(domain), bad).kind, "bad_option");
}

TEST(ImposedBadInputs, EditsOfPointsThatAreNot) {
    const SurfaceDomain domain(disk(6));
    const SingularPattern pattern = four(domain);
    EXPECT_EQ(refusal([&] { move_singular_point(domain, pattern, 4, Vector(0, 0, 0)); }).kind, "index_out_of_range");
    const Index twice[] = {1, 1};
    EXPECT_EQ(refusal([&] { remove_singular_points(pattern, twice); }).kind, "index_out_of_range");
    const Index all[] = {0, 1, 2, 3};
    EXPECT_EQ(refusal([&] { merge_singular_points(domain, pattern, all, Vector(0, 0, 0)); }).kind, "bad_valence");
    DirectionField hexagonal;
    hexagonal.symmetry = 6;
    EXPECT_EQ(refusal([&] { singular_pattern(hexagonal, {}); }).kind, "wrong_symmetry");
}

TEST(ImposedBadInputs, MovingThatCannotSucceedSaysSo) {
    // A torus with one pair: admissible only when the points meet.
    const SurfaceDomain domain(torus(24, 12, 1, 0.5));
    SingularPattern pattern;
    pattern = add_singular_pair(domain, {}, Vector(1.5, 0, 0), Vector(0.5, 0, 0));
    const Refusal found = imposing(domain, pattern, {.inadmissible = Inadmissible::move});
    EXPECT_EQ(found.kind, "move_failed") << found.message;
    // A quarter turn between the pair is none: no points, nothing to move.
    EXPECT_EQ(imposing(domain, {}).kind, "");
}

TEST(ImposedBadInputs, CancellingStops) {
    const SurfaceDomain domain(disk(6));
    EXPECT_THROW(
        impose_singular_points(domain, four(domain), {}, [](std::string_view, double, double) { return false; }),
        Cancelled);
}

}  // namespace
}  // namespace octafield::surface
