#include "octafield/volume/tet_domain.hpp"

#include <atomic>
#include <string>
#include <utility>

#include "octafield/error.hpp"
#include "surface_of_tets.hpp"

namespace octafield::volume {
namespace {

std::atomic<long long> domains_made = 0;

}  // namespace

std::shared_ptr<const TetDomain::Topology> TetDomain::topology_of(TetMesh mesh, std::vector<Index> regions) {
    if (!regions.empty() && static_cast<Eigen::Index>(regions.size()) != mesh.tets.rows())
        throw InvalidInput("regions has " + std::to_string(regions.size()) + " ids; give one per tet, " +
                               std::to_string(mesh.tets.rows()) + ", or none",
                           "wrong_size");
    require_valid(mesh);
    ++domains_made;
    const auto topology = std::make_shared<Topology>();
    topology->mesh = std::move(mesh);
    topology->regions = std::move(regions);
    topology->triangles = triangle_table(topology->mesh);
    SurfaceOfTets found = surface_of_tets(topology->mesh, topology->triangles, topology->regions);
    topology->surface = std::move(found.surface);
    topology->interface_triangles = found.interface_triangles;
    topology->sides = std::move(found.sides);
    topology->surface_rows = std::move(found.rows);
    if (topology->interface_triangles > 0)
        topology->boundary = surface_of_tets(topology->mesh, topology->triangles, {}).surface;
    topology->sheets = cut_into_sheets(topology->surface.mesh);
    return topology;
}

TetDomain::TetDomain(TetMesh mesh, std::vector<Index> regions, surface::FeatureGraph features)
    : TetDomain(topology_of(std::move(mesh), std::move(regions)), std::move(features)) {}

TetDomain::TetDomain(std::shared_ptr<const Topology> topology, surface::FeatureGraph features)
    : topology_(std::move(topology)) {
    features_ =
        std::make_shared<const surface::FeatureGraph>(surface::ordered_features(std::move(features), surface().mesh));
}

TetDomain TetDomain::with_features(surface::FeatureGraph features) const { return {topology_, std::move(features)}; }

const BoundarySurface& TetDomain::boundary() const {
    return topology_->interface_triangles > 0 ? topology_->boundary : topology_->surface;
}

long long TetDomain::made() { return domains_made; }

}  // namespace octafield::volume
