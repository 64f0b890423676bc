// Meshes as functions take them: a domain, shared, or a mesh, of which one is made for that call.
#pragma once

#include <pybind11/stl.h>

#include <memory>
#include <variant>

#include "checks.hpp"
#include "octafield/surface/surface_domain.hpp"
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

using SurfaceOrMesh = std::variant<surface::TriangleMesh, surface::SurfaceDomain>;

// Throws InvalidInput for arrays that are no mesh or hold no triangle, GeometryError for an unsound one.
inline surface::SurfaceDomain domain_of(const SurfaceOrMesh& given) {
    if (const auto* mesh = std::get_if<surface::TriangleMesh>(&given)) {
        check(*mesh);
        return *mesh;
    }
    const auto& domain = std::get<surface::SurfaceDomain>(given);
    check(domain.mesh());
    return domain;
}

}  // namespace octafield::bindings
