// Boundaries of volume meshes of the HexMe data set, with the feature edges of the file.
#pragma once

#include <zlib.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>

#include "octafield/surface/surface_domain.hpp"

namespace octafield::surface {

inline std::filesystem::path shared_data() {
    const char* given = std::getenv("OCTAFIELD_SHARED_DATA");
    return given ? given : OCTAFIELD_SHARED_DATA;
}

inline std::string unpacked(const std::filesystem::path& path) {
    std::string text;
    gzFile file = gzopen(path.c_str(), "rb");
    char buffer[1 << 16];
    for (int count; file && (count = gzread(file, buffer, sizeof buffer)) > 0;) text.append(buffer, count);
    if (file) gzclose(file);
    return text;
}

// Sides of tets that no other tet has, outwards; lines of the file that are edges of those.
inline SurfaceDomain hexme_surface(const std::string& name) {
    std::istringstream in(unpacked(shared_data() / "hexme" / (name + ".vtk.gz")));
    std::string word;
    std::size_t count = 0, size = 0;
    while (in >> word && word != "POINTS") {
    }
    in >> count >> word;
    std::vector<Eigen::Vector3d> points(count);
    for (auto& p : points) in >> p[0] >> p[1] >> p[2];
    while (in >> word && word != "CELLS") {
    }
    in >> count >> size;
    std::map<std::array<Index, 3>, std::array<Index, 3>> sides;
    std::vector<std::array<Index, 2>> lines;
    for (std::size_t c = 0; c < count; ++c) {
        in >> size;
        std::vector<Index> v(size);
        for (Index& i : v) in >> i;
        if (size == 2) lines.push_back({std::min(v[0], v[1]), std::max(v[0], v[1])});
        if (size != 4) continue;
        const Eigen::Vector3d a = points[v[0]];
        if ((points[v[1]] - a).cross(points[v[2]] - a).dot(points[v[3]] - a) < 0) std::swap(v[0], v[1]);
        const std::array<Index, 3> faces[] = {
            {v[0], v[2], v[1]}, {v[0], v[1], v[3]}, {v[1], v[2], v[3]}, {v[0], v[3], v[2]}};
        for (const auto& face : faces) {
            auto key = face;
            std::sort(key.begin(), key.end());
            if (!sides.erase(key)) sides[key] = face;
        }
    }
    std::map<Index, Index> number;
    TriangleMesh mesh{Points(0, 3), Triangles(static_cast<Eigen::Index>(sides.size()), 3)};
    std::vector<Index> used;
    Eigen::Index t = 0;
    for (const auto& [key, face] : sides) {
        for (int k = 0; k < 3; ++k) {
            const auto [found, is_new] = number.emplace(face[k], static_cast<Index>(used.size()));
            if (is_new) used.push_back(face[k]);
            mesh.triangles(t, k) = found->second;
        }
        ++t;
    }
    mesh.vertices.resize(static_cast<Eigen::Index>(used.size()), 3);
    for (std::size_t v = 0; v < used.size(); ++v) mesh.vertices.row(static_cast<Eigen::Index>(v)) = points[used[v]];
    const EdgeTopology topology = edge_topology(mesh);
    std::set<std::array<Index, 2>> edges;
    for (Eigen::Index e = 0; e < topology.edges.rows(); ++e) edges.insert({topology.edges(e, 0), topology.edges(e, 1)});
    std::set<std::array<Index, 2>> features;
    for (const auto& line : lines) {
        if (!number.contains(line[0]) || !number.contains(line[1])) continue;
        std::array<Index, 2> edge = {number[line[0]], number[line[1]]};
        std::sort(edge.begin(), edge.end());
        if (edges.contains(edge)) features.insert(edge);
    }
    Edges rows(static_cast<Eigen::Index>(features.size()), 2);
    Eigen::Index i = 0;
    for (const auto& edge : features) rows.row(i++) << edge[0], edge[1];
    return SurfaceDomain(mesh, feature_graph(mesh, rows));
}

}  // namespace octafield::surface
