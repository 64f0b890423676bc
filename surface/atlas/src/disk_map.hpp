// The linear system of mean value coordinates on a chart.
#pragma once

#include "chart_mesh.hpp"
#include "octafield/surface/disk_parameterization.hpp"

namespace octafield::surface::detail {

// Calls add(i, j, weight) for what each triangle adds to the mean value weights.
template <class Add>
void for_each_weight(const ChartMesh& chart, const Add& add) {
    for (Index t = 0; t < chart.triangle_count(); ++t)
        for (int k = 0; k < 3; ++k) {
            const Index i = chart.triangles(t, k);
            add(i, chart.triangles(t, (k + 1) % 3), chart.half_tangents(t, k) / chart.lengths(t, k));
            add(i, chart.triangles(t, (k + 2) % 3), chart.half_tangents(t, k) / chart.lengths(t, (k + 2) % 3));
        }
}

// (V, 2) of a connected chart of genus 0 with a loop at least: the first loop on the unit circle. Throws SolverError.
PlanePoints disk_map(const ChartMesh& chart, bool fill_holes);

// J^T J of the map from plane to triangle t, entries uu, uv, vv, up to rounding. corners: u, v of its corners.
Eigen::Vector3d pulled_metric(const ChartMesh& chart, Index t, const Eigen::Matrix<double, 3, 2>& corners);

// Its singular values, the larger first; the smaller one is negative where the triangle is turned over.
Eigen::Vector2d stretches(const ChartMesh& chart, Index t, const Eigen::Matrix<double, 3, 2>& corners);

inline Eigen::Matrix<double, 3, 2> corners_of(const PlanePoints& uv, const Triangles& triangles, Index t) {
    Eigen::Matrix<double, 3, 2> corners;
    for (int k = 0; k < 3; ++k) corners.row(k) = uv.row(triangles(t, k));
    return corners;
}

}  // namespace octafield::surface::detail
