// The matrices of a sized field: energy A and mass M between vertices.
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "octafield/surface/sized_field.hpp"
#include "vertex_charts.hpp"

namespace octafield::surface::detail {

// How values u pass along edges, and what is left round triangles.
struct SizedConnection {
    // (E) u at the higher vertex of a parallel field over u at the lower one: of length 1.
    std::vector<Complex> steps;
    Eigen::VectorXd holonomy;  // (F) radians, N times the turn, not wrapped

    SizedConnection(const SurfaceDomain& domain, const VertexCharts& charts, const Eigen::VectorXd& turns,
                    int symmetry);
    // Along side k of triangle t, from its corner k.
    Complex step(const SurfaceDomain& domain, Index t, int k) const;
};

// (F) N times the index of the field in each triangle.
std::vector<int> turned_triangles(const SurfaceDomain& domain, const SizedConnection& connection,
                                  const Eigen::VectorXcd& values);

struct SizedSystem {
    using Matrix = Eigen::SparseMatrix<Complex>;
    Matrix energy, mass;     // (n, n) between unknowns, lower triangles
    std::vector<Index> row;  // (V) of its unknown; -1: in no triangle
    Eigen::VectorXd shares;  // (V) a third of the areas of its triangles

    SizedSystem(const SurfaceDomain& domain, const SizedConnection& connection, double s);
};

}  // namespace octafield::surface::detail
