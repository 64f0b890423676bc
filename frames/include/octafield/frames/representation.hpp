// What every embedding of frames into R^d offers. A representation is a struct of static functions; solvers are
// templates over it, and run-time names are resolved once, at the border (bindings, command line).
#pragma once

#include <concepts>
#include <string_view>

#include "octafield/frames/quaternion.hpp"

namespace octafield::frames {

struct Projection {
    Quaternion frame;  // nearest frame
    double distance;   // Euclidean distance from the input to its embedding
};

// Laws (tests/frames/representation_laws.hpp): embed(q o) = embed(q) for the 48 o of the binary octahedral group;
// differential is the derivative under rotation from the left; project(embed(q)) is the frame q.
template <class R>
concept Representation = requires(const Quaternion& q, const typename R::Vector& v) {
    { R::name } -> std::convertible_to<std::string_view>;
    { R::dimension } -> std::convertible_to<int>;
    { R::embed(q) } -> std::same_as<typename R::Vector>;
    { R::differential(q) } -> std::same_as<typename R::Differential>;
    { R::project(v) } -> std::same_as<Projection>;
    { R::project(v, &q) } -> std::same_as<Projection>;
};

}  // namespace octafield::frames
