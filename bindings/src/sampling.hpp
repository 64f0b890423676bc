// Where fields live, as functions take it: a TetDomain or TetMesh (its vertices), or a Sampling.
#pragma once

#include "domain.hpp"
#include "octafield/volume/sampling.hpp"

namespace octafield::bindings {

using MeshOrSampling = std::variant<volume::TetMesh, volume::TetDomain, std::shared_ptr<volume::Sampling>>;

inline volume::TetDomain domain_of(const MeshOrSampling& where) {
    if (const auto* domain = std::get_if<volume::TetDomain>(&where)) return *domain;
    return domain_of(DomainOrMesh(std::get<volume::TetMesh>(where)));
}

// Samplings are only made by functions of volume/, so they are sound; a mesh is checked.
inline std::shared_ptr<const volume::Sampling> sampling_of(const MeshOrSampling& where) {
    if (const auto* sampling = std::get_if<std::shared_ptr<volume::Sampling>>(&where)) return *sampling;
    return std::make_shared<volume::Sampling>(volume::vertex_sampling(domain_of(where)));
}

}  // namespace octafield::bindings
