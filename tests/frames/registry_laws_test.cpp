// Every representation of the registry obeys the laws.
#include "octafield/frames/registry.hpp"
#include "representation_laws.hpp"

namespace octafield::frames {

struct RepresentationName {
    template <class R>
    static std::string GetName(int) {
        return std::string(R::name);
    }
};

INSTANTIATE_TYPED_TEST_SUITE_P(Registered, RepresentationLaws, Representations::In<::testing::Types>,
                               RepresentationName);

}  // namespace octafield::frames
