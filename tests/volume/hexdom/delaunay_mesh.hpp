// Delaunay meshes of points given, by TetGen: full of flat tets where eight points lie on a sphere.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>
#ifndef TETLIBRARY
#define TETLIBRARY
#endif
#include <tetgen.h>

#include "octafield/volume/mixed_mesh.hpp"

namespace octafield::volume::testing {

// Tets of no volume, which are on the hull's planes only, are left out.
inline MixedMesh delaunay_mesh(const Points& points) {
    tetgenio in, out;
    in.numberofpoints = static_cast<int>(points.rows());
    in.pointlist = new REAL[3 * points.rows()];
    std::copy(points.data(), points.data() + points.size(), in.pointlist);
    char options[] = "Q";
    ::tetrahedralize(options, &in, &out);
    MixedMesh mesh;
    mesh.vertices = points;
    std::vector<std::array<Index, 4>> tets;
    for (int t = 0; t < out.numberoftetrahedra; ++t) {
        std::array<Index, 4> tet;
        for (int k = 0; k < 4; ++k) tet[k] = out.tetrahedronlist[4 * t + k];
        const auto edge = [&](int k) -> Eigen::Vector3d { return points.row(tet[k]) - points.row(tet[0]); };
        const double volume = edge(1).cross(edge(2)).dot(edge(3));
        if (volume < 0) std::swap(tet[0], tet[1]);
        if (std::abs(volume) > 1e-10) tets.push_back(tet);
    }
    mesh.tets.resize(tets.size(), 4);
    for (std::size_t t = 0; t < tets.size(); ++t)
        for (int k = 0; k < 4; ++k) mesh.tets(t, k) = tets[t][k];
    return mesh;
}

}  // namespace octafield::volume::testing
