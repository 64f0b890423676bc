// Enumerations as words: options take and default to the C++ enumerator's name.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "octafield/error.hpp"
#include "octafield/surface/direction_field.hpp"
#include "octafield/surface/fixed_boundary_quads.hpp"
#include "octafield/surface/imposed_field.hpp"
#include "octafield/surface/non_orthogonal_field.hpp"
#include "octafield/surface/quantized_quads.hpp"
#include "octafield/surface/streamlines.hpp"
#include "octafield/volume/boundary.hpp"
#include "octafield/volume/computed_field.hpp"
#include "octafield/volume/hex_dominant.hpp"
#include "octafield/volume/sampling.hpp"
#include "octafield/volume/schemes.hpp"
#include "octafield/volume/smooth.hpp"
#include "octafield/volume/streamlines.hpp"

namespace octafield::bindings {

template <class Enum>
struct Words;

template <>
struct Words<surface::Alignment> {
    using E = surface::Alignment;
    static constexpr std::array<std::pair<const char*, E>, 3> list{
        {{"strong", E::strong}, {"weak", E::weak}, {"none", E::none}}};
};

template <>
struct Words<surface::SecondLine> {
    using E = surface::SecondLine;
    static constexpr std::array<std::pair<const char*, E>, 2> list{{{"fixed", E::fixed}, {"free", E::free}}};
};

template <>
struct Words<surface::EdgeWeights> {
    using E = surface::EdgeWeights;
    static constexpr std::array<std::pair<const char*, E>, 2> list{{{"cotangent", E::cotangent}, {"unit", E::unit}}};
};

template <>
struct Words<surface::StreamlineEnd> {
    using E = surface::StreamlineEnd;
    static constexpr std::array<std::pair<const char*, E>, 8> list{{{"singularity", E::singularity},
                                                                    {"boundary", E::boundary},
                                                                    {"feature", E::feature},
                                                                    {"closed", E::closed},
                                                                    {"length", E::length},
                                                                    {"near_line", E::near_line},
                                                                    {"seed", E::seed},
                                                                    {"stuck", E::stuck}}};
};

template <>
struct Words<volume::FrameStreamlineEnd> {
    using E = volume::FrameStreamlineEnd;
    static constexpr std::array<std::pair<const char*, E>, 6> list{{{"boundary", E::boundary},
                                                                    {"singular", E::singular},
                                                                    {"closed", E::closed},
                                                                    {"length", E::length},
                                                                    {"seed", E::seed},
                                                                    {"stuck", E::stuck}}};
};

template <>
struct Words<surface::Inadmissible> {
    using E = surface::Inadmissible;
    static constexpr std::array<std::pair<const char*, E>, 3> list{
        {{"fail", E::fail}, {"move", E::move}, {"rotate", E::rotate}}};
};

template <>
struct Words<surface::LayoutVertexKind> {
    using E = surface::LayoutVertexKind;
    static constexpr std::array<std::pair<const char*, E>, 5> list{{{"singular", E::singular},
                                                                    {"corner", E::corner},
                                                                    {"crossing", E::crossing},
                                                                    {"boundary", E::boundary},
                                                                    {"t_joint", E::t_joint}}};
};

template <>
struct Words<surface::ArcWeights> {
    using E = surface::ArcWeights;
    static constexpr std::array<std::pair<const char*, E>, 2> list{{{"equal", E::equal}, {"relative", E::relative}}};
};

template <>
struct Words<surface::ArcMeasure> {
    using E = surface::ArcMeasure;
    static constexpr std::array<std::pair<const char*, E>, 2> list{
        {{"parameters", E::parameters}, {"lengths", E::lengths}}};
};

template <>
struct Words<surface::Blocks> {
    using E = surface::Blocks;
    static constexpr std::array<std::pair<const char*, E>, 2> list{{{"few", E::few}, {"fine", E::fine}}};
};

template <>
struct Words<surface::OddLoops> {
    using E = surface::OddLoops;
    static constexpr std::array<std::pair<const char*, E>, 3> list{
        {{"refuse", E::refuse}, {"split_one", E::split_one}, {"split_all", E::split_all}}};
};

template <>
struct Words<surface::PatchKind> {
    using E = surface::PatchKind;
    static constexpr std::array<std::pair<const char*, E>, 4> list{
        {{"quad", E::quad}, {"polygon", E::polygon}, {"annulus", E::annulus}, {"other", E::other}}};
};

template <>
struct Words<volume::BoundaryMode> {
    using E = volume::BoundaryMode;
    static constexpr std::array<std::pair<const char*, E>, 3> list{
        {{"aligned", E::aligned}, {"fixed", E::fixed}, {"none", E::none}}};
};

template <>
struct Words<volume::Axes> {
    using E = volume::Axes;
    static constexpr std::array<std::pair<const char*, E>, 2> list{{{"orthogonal", E::orthogonal}, {"free", E::free}}};
};

template <>
struct Words<volume::Sites> {
    using E = volume::Sites;
    static constexpr std::array<std::pair<const char*, E>, 2> list{{{"vertices", E::vertices}, {"tets", E::tets}}};
};

template <>
struct Words<volume::Start> {
    using E = volume::Start;
    static constexpr std::array<std::pair<const char*, E>, 2> list{
        {{"constraints", E::constraints}, {"cross_field", E::cross_field}}};
};

template <>
struct Words<volume::SmoothSolver> {
    using E = volume::SmoothSolver;
    static constexpr std::array<std::pair<const char*, E>, 4> list{{{"default", E::default_},
                                                                    {"trust_region", E::trust_region},
                                                                    {"levenberg_marquardt", E::levenberg_marquardt},
                                                                    {"lbfgs", E::lbfgs}}};
};

template <>
struct Words<volume::SchemeSort> {
    using E = volume::SchemeSort;
    static constexpr std::array<std::pair<const char*, E>, 3> list{
        {{"embedding", E::embedding}, {"embedding_with_lengths", E::embedding_with_lengths}, {"metric", E::metric}}};
};

template <>
struct Words<volume::LinearSolver> {
    using E = volume::LinearSolver;
    static constexpr std::array<std::pair<const char*, E>, 3> list{
        {{"default", E::default_}, {"cholesky", E::cholesky}, {"conjugate_gradients", E::conjugate_gradients}}};
};

template <>
struct Words<volume::SizeCorrection> {
    using E = volume::SizeCorrection;
    static constexpr std::array<std::pair<const char*, E>, 3> list{
        {{"none", E::none}, {"isotropic", E::isotropic}, {"axes", E::axes}}};
};

template <>
struct Words<volume::CellPoints> {
    using E = volume::CellPoints;
    static constexpr std::array<std::pair<const char*, E>, 3> list{
        {{"best", E::best}, {"periodic", E::periodic}, {"frontal", E::frontal}}};
};

template <class Enum>
std::string to_word(Enum value) {
    for (const auto& [word, meaning] : Words<Enum>::list)
        if (meaning == value) return word;
    return {};
}

template <class Enum>
std::vector<std::string> words_of() {
    std::vector<std::string> words;
    for (const auto& [word, meaning] : Words<Enum>::list) words.emplace_back(word);
    return words;
}

template <class Enum>
Enum from_word(std::string_view word, std::string_view name) {
    std::string allowed;
    for (const auto& [known, meaning] : Words<Enum>::list) {
        if (word == known) return meaning;
        allowed += (allowed.empty() ? "" : ", ") + std::string(known);
    }
    throw InvalidInput(std::string(name) + ": unknown word '" + std::string(word) + "'; use one of " + allowed,
                       "unknown_word");
}

}  // namespace octafield::bindings
