#include "octafield/volume/tet_domain.hpp"

#include <algorithm>
#include <atomic>
#include <string>
#include <utility>

#include "octafield/error.hpp"
#include "surface_of_tets.hpp"

namespace octafield::volume {
namespace {

std::atomic<long long> domains_made = 0;

void require_fitting(const surface::FeatureGraph& features, const surface::TriangleMesh& mesh) {
    const Index count = static_cast<Index>(mesh.vertices.rows());
    std::vector<Index> bad;
    for (Index e = 0; e < features.edges.rows(); ++e)
        if (features.edges.row(e).minCoeff() < 0 || features.edges.row(e).maxCoeff() >= count) bad.push_back(e);
    if (!bad.empty())
        throw InvalidInput("feature edges " + first_few(bad) + " refer to vertices that the surface does not have",
                           "index_out_of_range", bad);
    std::vector<std::pair<Index, Index>> known;
    if (features.edges.rows() > 0)
        for (const auto triangle : mesh.triangles.rowwise())
            for (int k = 0; k < 3; ++k) known.push_back(std::minmax({triangle[k], triangle[(k + 1) % 3]}));
    std::sort(known.begin(), known.end());
    for (Index e = 0; e < features.edges.rows(); ++e) {
        const std::pair<Index, Index> edge = std::minmax({features.edges(e, 0), features.edges(e, 1)});
        if (!std::binary_search(known.begin(), known.end(), edge)) bad.push_back(e);
    }
    if (!bad.empty())
        throw InvalidInput("feature edges " + first_few(bad) + " are no edges of the surface", "not_an_edge", bad);
    for (const Index v : features.corners)
        if (v < 0 || v >= count)
            throw InvalidInput("corner " + std::to_string(v) + " is no vertex of the surface", "index_out_of_range",
                               {v});
}

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
    require_fitting(features, surface().mesh);
    features_ = std::make_shared<const surface::FeatureGraph>(std::move(features));
}

TetDomain TetDomain::with_features(surface::FeatureGraph features) const { return {topology_, std::move(features)}; }

const BoundarySurface& TetDomain::boundary() const {
    return topology_->interface_triangles > 0 ? topology_->boundary : topology_->surface;
}

long long TetDomain::made() { return domains_made; }

}  // namespace octafield::volume
