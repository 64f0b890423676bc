// The representation of docs/add_representation.md obeys every law that those of the library obey.
#include "../../studies/examples/new_representation/sh6.hpp"
#include "representation_laws.hpp"

namespace octafield::frames {

INSTANTIATE_TYPED_TEST_SUITE_P(ExampleSh6, RepresentationLaws, example::Sh6);

}  // namespace octafield::frames
