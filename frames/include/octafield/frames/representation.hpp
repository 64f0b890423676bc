// What every embedding of frames into R^d offers. A representation is a struct of static functions; solvers are
// templates over it, and run-time names are resolved once, at the border (registry.hpp).
#pragma once

#include <array>
#include <concepts>
#include <string_view>

#include "octafield/frames/quaternion.hpp"

namespace octafield::frames {

struct Projection {
    Quaternion frame;  // nearest frame
    double distance;   // Euclidean distance from the input to its embedding
};

// Weights of the degrees 4, 6 and 9 in the band law below.
using BandWeights = std::array<double, 3>;

// Laws (tests/frames/representation_laws.hpp):
// - embed(q o) = embed(q) for the 48 o of the binary octahedral group;
// - differential(q): column k is d/dt embed(exp(t e_k) q) at t = 0, e_k the k-th WORLD axis;
// - hessian(q, v): the 3x3 Hessian of v . embed(exp(w) q) by w at w = 0;
// - project(v, guess): the frame whose embedding is nearest to v; `guess` is one more start. project(embed(q)) is q.
//   The zero vector gives a frame like any other input; NaN or infinity throws InvalidInput;
// - band law: these maps are built from harmonics of degrees 0, 4, 6 and 9, each of which has one unit invariant a_l of
// O
//   (harmonics.hpp; a_0 is constant). So the average of |embed(g p) - embed(g q)|^2 over all rotations g is
//   sum_l band_weights_l |a_l(p) - a_l(q)|^2. Degree 8 has an invariant too, which none of them uses.
template <class R>
concept Representation = requires(const Quaternion& q, const typename R::Vector& v) {
    { R::name } -> std::convertible_to<std::string_view>;
    { R::dimension } -> std::convertible_to<int>;
    { R::band_weights } -> std::convertible_to<BandWeights>;
    { R::embed(q) } -> std::same_as<typename R::Vector>;
    { R::differential(q) } -> std::same_as<typename R::Differential>;
    { R::hessian(q, v) } -> std::same_as<Matrix3>;
    { R::project(v) } -> std::same_as<Projection>;
    { R::project(v, &q) } -> std::same_as<Projection>;
};

// A representation on which rotations from the left act linearly: embed(g q) = rotate(g, embed(q)). Its differential is
// then isotropic: a rotation of t radians about any axis moves every frame by speed t to first order (Schur).
template <class R>
concept Equivariant = Representation<R> && requires(const Quaternion& g, const typename R::Vector& v) {
    { R::rotate(g, v) } -> std::same_as<typename R::Vector>;
    { R::speed } -> std::convertible_to<double>;
};

}  // namespace octafield::frames
