#include "octafield/volume/seamless_map.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>

#include "map_transitions.hpp"
#include "octafield/error.hpp"
#include "wound_edges.hpp"

namespace octafield::volume {
namespace {

constexpr double torn = 1e-6;  // residual of a transition, of the tet's extent

void require_arrays(const SeamlessMap& map) {
    if (map.parameters.rows() != map.mesh.tets.rows())
        throw InvalidInput("parameters: " + std::to_string(map.parameters.rows()) + " rows, the mesh has " +
                               std::to_string(map.mesh.tets.rows()) + " tets; give twelve numbers for each",
                           "wrong_size");
    std::vector<Index> lost;
    for (Index t = 0; t < map.parameters.rows(); ++t)
        if (!map.parameters.row(t).allFinite()) lost.push_back(t);
    if (!lost.empty())
        throw InvalidInput("parameters of tets " + first_few(lost) + " are not finite; give numbers",
                           "non_finite_parameter", lost);
    const auto in_range = [&](const auto& ids, const char* name) {
        std::vector<Index> bad;
        for (Index r = 0; r < ids.rows(); ++r)
            if (ids.row(r).minCoeff() < 0 || ids.row(r).maxCoeff() >= map.mesh.vertices.rows()) bad.push_back(r);
        if (!bad.empty())
            throw InvalidInput(std::string(name) + ": rows " + first_few(bad) +
                                   " name vertices that the mesh does not have; ids are 0-based",
                               "index_out_of_range", bad);
    };
    in_range(map.walls, "walls");
    in_range(map.features, "features");
    in_range(Eigen::Map<const Eigen::Matrix<Index, Eigen::Dynamic, 1>>(map.corners.data(),
                                                                       static_cast<Index>(map.corners.size())),
             "corners");
}

}  // namespace

SeamlessReport seamless_report(const SeamlessMap& map) {
    using namespace detail;
    require_valid(map.mesh);
    require_arrays(map);
    const TriangleTable table = triangle_table(map.mesh);
    SeamlessReport report;
    for (Index t = 0; t < map.mesh.tets.rows(); ++t) {
        Eigen::Matrix3d edges;
        for (int k = 0; k < 3; ++k)
            edges.col(k) = parameters_at(map.parameters, t, k + 1) - parameters_at(map.parameters, t, 0);
        const double volume = edges.determinant() / 6;
        report.volume += volume;
        if (!(volume > 0)) report.flipped.push_back(t);
    }
    for (Index f = 0; f < table.triangles.rows(); ++f) {
        const auto here = triangle_parameters(map.parameters, map.mesh.tets, table, f, 0);
        if (table.sides(f, 1) < 0) {
            bool constant = false;
            for (int i = 0; i < 3; ++i) constant |= here[0][i] == here[1][i] && here[0][i] == here[2][i];
            report.unaligned += !constant;
            continue;
        }
        const auto there = triangle_parameters(map.parameters, map.mesh.tets, table, f, 1);
        const double residual = transition(here, there).residual;
        report.residual = std::max(report.residual, residual);
        const Index first = table.sides(f, 0) / 4, second = table.sides(f, 1) / 4;
        if (residual > torn * std::min(extent(map.parameters, first), extent(map.parameters, second)))
            report.torn.insert(report.torn.end(), {first, second});
    }
    std::sort(report.torn.begin(), report.torn.end());
    report.torn.erase(std::unique(report.torn.begin(), report.torn.end()), report.torn.end());
    report.wound = wound_edges(map, table);
    return report;
}

void detail::require_seamless(const SeamlessMap& map) {
    const SeamlessReport report = seamless_report(map);
    if (!report.flipped.empty())
        throw GeometryError("the map turns tets " + first_few(report.flipped) +
                                " over, or flattens them; only maps without such tets have blocks",
                            "flipped_tet", report.flipped);
    if (!report.torn.empty())
        throw GeometryError("parameters do not go on by a rotation of the cube and a translation between tets " +
                                first_few(report.torn) + "; only seamless maps have blocks",
                            "torn_map", report.torn);
}

TetDomain map_domain(const SeamlessMap& map) {
    require_arrays(map);
    const TetDomain domain(map.mesh);
    const BoundarySurface& surface = domain.surface();
    if (map.features.rows() == 0 && map.corners.empty())
        return domain.with_features(surface::detect_features(surface.mesh));
    std::vector<Index> number(map.mesh.vertices.rows(), -1);
    for (std::size_t v = 0; v < surface.vertex_map.size(); ++v) number[surface.vertex_map[v]] = static_cast<Index>(v);
    const auto known = [&](Index vertex) {
        if (number[vertex] < 0)
            throw InvalidInput("features: vertex " + std::to_string(vertex) + " is not on the boundary",
                               "index_out_of_range", {vertex});
        return number[vertex];
    };
    Edges edges(map.features.rows(), 2);
    for (Index e = 0; e < edges.rows(); ++e)
        for (int k = 0; k < 2; ++k) edges(e, k) = known(map.features(e, k));
    surface::FeatureGraph features = surface::feature_graph(surface.mesh, edges);
    for (const Index corner : map.corners) features.corners.push_back(known(corner));
    return domain.with_features(std::move(features));
}

}  // namespace octafield::volume
