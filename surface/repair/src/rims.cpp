#include "rims.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "half_edges.hpp"

namespace octafield::surface {
namespace {

struct Step {
    Index to, beyond, triangle;
};

bool bounds_one_triangle(const std::vector<Step>& loop) {
    return std::ranges::all_of(loop, [&](const Step& step) { return step.triangle == loop.front().triangle; });
}

Rim rim_of(std::vector<Index> vertices, const std::vector<Step>& steps) {
    const auto lowest = std::ranges::min_element(vertices) - vertices.begin();
    Rim rim;
    for (std::size_t k = 0; k < vertices.size(); ++k) {
        const std::size_t i = (k + static_cast<std::size_t>(lowest)) % vertices.size();
        rim.vertices.push_back(vertices[i]);
        rim.beyond.push_back(steps[i].beyond);
    }
    return rim;
}

}  // namespace

std::vector<Rim> hole_rims(const TriangleMesh& mesh) {
    std::map<Index, std::vector<Step>> from;  // the hole's side of each open edge
    for_each_edge(sorted_half_edges(mesh.triangles), [&](auto first, auto last) {
        if (last - first != 1) return;
        const auto corner = [&](int k) { return mesh.triangles(first->triangle, (first->corner + k) % 3); };
        from[corner(1)].push_back({corner(0), corner(2), first->triangle});
    });
    std::vector<Rim> rims;
    std::map<Index, int> passes;
    for (auto start = from.begin(); start != from.end();) {
        if (start->second.empty()) {
            ++start;
            continue;
        }
        // A walk; where it comes to a vertex again, the loop since then is cut off.
        std::vector<Index> path = {start->first};
        std::vector<Step> steps;
        while (!path.empty()) {
            const auto here = from.find(path.back());
            if (here == from.end() || here->second.empty()) {  // a dead end
                path.pop_back();
                if (!steps.empty()) steps.pop_back();
                continue;
            }
            steps.push_back(here->second.back());
            here->second.pop_back();
            const auto again = std::ranges::find(path, steps.back().to);
            if (again == path.end()) {
                path.push_back(steps.back().to);
                continue;
            }
            const auto at = again - path.begin();
            const std::vector<Index> loop(again, path.end());
            const std::vector<Step> taken(steps.begin() + at, steps.end());
            path.resize(at + 1);
            steps.resize(at);
            if (loop.size() < 3 || bounds_one_triangle(taken)) continue;
            rims.push_back(rim_of(loop, taken));
            for (const Index v : loop) ++passes[v];
        }
    }
    for (Rim& rim : rims)
        rim.pinched = std::ranges::any_of(rim.vertices, [&](Index v) { return passes[v] > 1; });
    std::ranges::stable_sort(rims, {}, [](const Rim& rim) { return rim.vertices.front(); });
    return rims;
}

bool wants_lid(const TriangleMesh& mesh, const Rim& rim) {
    const auto count = static_cast<Eigen::Index>(rim.vertices.size());
    Eigen::MatrixX3d points(count, 3);
    for (Eigen::Index k = 0; k < count; ++k) points.row(k) = mesh.vertices.row(rim.vertices[k]);
    const Eigen::RowVector3d centre = points.colwise().mean();
    points.rowwise() -= centre;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(points.transpose() * points);
    const Eigen::Vector3d normal = axes.eigenvectors().col(0);
    const double extent = points.rowwise().norm().maxCoeff();
    if ((points * normal).cwiseAbs().maxCoeff() > 0.01 * extent) return false;
    double sum = 0;
    for (Eigen::Index k = 0; k < count; ++k) {
        const Eigen::RowVector3d a = mesh.vertices.row(rim.vertices[k]);
        const Eigen::RowVector3d b = mesh.vertices.row(rim.vertices[(k + 1) % count]);
        const Eigen::RowVector3d c = mesh.vertices.row(rim.beyond[k]);
        const Eigen::RowVector3d cross = (b - a).cross(c - a);
        sum += std::acos(std::min(1.0, std::abs(cross.normalized().dot(normal.transpose()))));
    }
    return sum / static_cast<double>(count) > std::numbers::pi / 3;
}

}  // namespace octafield::surface
