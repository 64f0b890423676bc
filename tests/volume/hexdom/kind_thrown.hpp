// What a call throws, for the tests of hexdom.
#pragma once

#include <string>

#include "octafield/error.hpp"

namespace octafield::volume::testing {

// The kind of the error of class Thrown; "nothing" where none is thrown. Others pass.
template <class Thrown = Error, class Call>
std::string kind_thrown(const Call& call) {
    try {
        call();
    } catch (const Thrown& error) {
        return error.kind();
    }
    return "nothing";
}

}  // namespace octafield::volume::testing
