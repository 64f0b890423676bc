// Tet meshes as functions take them: a TetDomain, shared, or a TetMesh, of which one is made for that call.
#pragma once

#include <pybind11/stl.h>

#include <memory>
#include <variant>

#include "checks.hpp"
#include "octafield/volume/tet_domain.hpp"

namespace octafield::bindings {

using DomainOrMesh = std::variant<volume::TetMesh, volume::TetDomain>;

// Throws InvalidInput for arrays that are no mesh, GeometryError for an unsound one.
inline volume::TetDomain domain_of(const DomainOrMesh& given) {
    if (const auto* domain = std::get_if<volume::TetDomain>(&given)) return *domain;
    const auto& mesh = std::get<volume::TetMesh>(given);
    check(mesh, false);
    return mesh;
}

}  // namespace octafield::bindings
