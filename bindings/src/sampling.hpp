// Where fields live, as functions take it: a tet mesh (its vertices) or a Sampling.
#pragma once

#include <pybind11/stl.h>

#include <memory>
#include <variant>

#include "checks.hpp"
#include "octafield/volume/sampling.hpp"

namespace octafield::bindings {

using MeshOrSampling = std::variant<volume::TetMesh, std::shared_ptr<volume::Sampling>>;

// Samplings are only made by functions of volume/, so they are sound; a mesh is checked.
inline std::shared_ptr<const volume::Sampling> sampling_of(const MeshOrSampling& where) {
    if (const auto* sampling = std::get_if<std::shared_ptr<volume::Sampling>>(&where)) return *sampling;
    const auto& mesh = std::get<volume::TetMesh>(where);
    check(mesh);
    return std::make_shared<volume::Sampling>(volume::vertex_sampling(mesh));
}

}  // namespace octafield::bindings
