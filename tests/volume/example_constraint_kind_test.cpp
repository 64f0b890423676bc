// The kind of constraint of docs/extend.md obeys every law that those of the library obey.
#include "../../studies/examples/new_constraint_kind/in_plane.hpp"
#include "constraint_kind_laws.hpp"

namespace octafield::volume {

INSTANTIATE_TYPED_TEST_SUITE_P(ExampleInPlane, ConstraintKindLaws, example::InPlane);

TEST(ConstraintKindList, AKindFromOutsideHasItsPlaceAndItsSpace) {
    using Four = ConstraintKindList<FreeFrame, FixedAxis, FixedFrame, example::InPlane>;
    static_assert(std::is_same_v<Four::Space, std::variant<FixedAxis::Space, example::InPlane::Space>>);
    EXPECT_EQ(Four::info[3].name, "plane");
    EXPECT_EQ(Four::info[3].unknowns, 2);
    int visited = 0;
    Four::visit(static_cast<VertexConstraint>(3), {frames::Vector3::UnitZ(), {1, 0, 0, 0}}, [&](const auto& kind) {
        visited += std::is_same_v<decltype(kind), const example::InPlane&> ? 1 : 100;
    });
    EXPECT_EQ(visited, 1);
    Four::visit(static_cast<VertexConstraint>(4), {}, [&](const auto&) { visited += 100; });
    EXPECT_EQ(visited, 1);
}

}  // namespace octafield::volume
