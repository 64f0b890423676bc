// Surfaces of mapped unit squares, each triangulated irregularly, with a lattice of quads on them: the lattice knows
// nothing of the triangles.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <random>
#include <tuple>
#include <vector>

#include "octafield/volume/point_surface.hpp"

namespace octafield::volume::testing {

using Map = std::function<Eigen::Vector3d(double, double)>;

struct Patched {
    surface::TriangleMesh mesh;
    std::vector<Index> groups;  // the number of the square
    SurfacePoints points;
    Quads quads;
    Points exact;  // (p) where the lattice is on the mapped squares
};

struct Fineness {
    int cells;            // of the triangulation, along a side of a square
    int lattice;          // of the lattice
    double jitter = 0.3;  // of inner vertices, part of a cell
    unsigned seed = 1;
    double skip_lattice = 0;  // part of the lattice points left out, with their quads
};

class Welder {  // one id per place
public:
    Index id(const Eigen::Vector3d& p) {
        const auto key = std::tuple(std::llround(p[0] * 1e8), std::llround(p[1] * 1e8), std::llround(p[2] * 1e8));
        const auto [found, fresh] = ids_.try_emplace(key, static_cast<Index>(places.size()));
        if (fresh) places.push_back(p);
        return found->second;
    }
    std::vector<Eigen::Vector3d> places;

private:
    std::map<std::tuple<long long, long long, long long>, Index> ids_;
};

inline Points rows_of(const std::vector<Eigen::Vector3d>& list) {
    Points result(list.size(), 3);
    for (std::size_t i = 0; i < list.size(); ++i) result.row(i) = list[i];
    return result;
}

inline Patched patched_surface(const std::vector<Map>& maps, const Fineness& f) {
    Patched result;
    Welder vertices, places;
    std::vector<std::array<Index, 3>> triangles;
    std::vector<std::array<Index, 4>> quads;
    std::vector<Eigen::Vector3d> weights;
    std::mt19937 random(f.seed);
    const auto uniform = [&] { return random() / 4294967296.0; };
    const int n = f.cells, m = f.lattice;
    for (std::size_t patch = 0; patch < maps.size(); ++patch) {
        std::vector<Eigen::Vector2d> uv;
        std::vector<Index> global;
        for (int j = 0; j <= n; ++j)
            for (int i = 0; i <= n; ++i) {
                const bool inner = i > 0 && i < n && j > 0 && j < n;
                const double du = uniform() - 0.5, dv = uniform() - 0.5, s = inner ? 2 * f.jitter / n : 0;
                uv.emplace_back(double(i) / n + s * du, double(j) / n + s * dv);
                global.push_back(vertices.id(maps[patch](uv.back()[0], uv.back()[1])));
            }
        const Index first = static_cast<Index>(triangles.size());
        std::vector<std::array<int, 3>> local;
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                const int a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
                const auto cross = [&](int p, int q, int r) {
                    const Eigen::Vector2d x = uv[q] - uv[p], y = uv[r] - uv[p];
                    return x[0] * y[1] - x[1] * y[0];
                };
                const bool ac = std::min(cross(a, b, c), cross(a, c, d)) > 0.2 / n / n &&
                                (uniform() < 0.5 || std::min(cross(b, c, d), cross(b, d, a)) < 0.2 / n / n);
                if (ac)
                    local.insert(local.end(), {{a, b, c}, {a, c, d}});
                else
                    local.insert(local.end(), {{b, c, d}, {b, d, a}});
            }
        for (const auto& [a, b, c] : local) {
            triangles.push_back({global[a], global[b], global[c]});
            result.groups.push_back(static_cast<Index>(patch));
        }
        const auto locate = [&](double u, double v) {
            Index best = -1;
            Eigen::Vector3d best_weights = Eigen::Vector3d::Zero();
            double most = -1e9;
            const int ci = std::min(n - 1, int(u * n)), cj = std::min(n - 1, int(v * n));
            for (int j = std::max(0, cj - 1); j <= std::min(n - 1, cj + 1); ++j)
                for (int i = std::max(0, ci - 1); i <= std::min(n - 1, ci + 1); ++i)
                    for (int h = 0; h < 2; ++h) {
                        const int t = 2 * (j * n + i) + h;
                        Eigen::Matrix3d corners;
                        for (int k = 0; k < 3; ++k) corners.col(k) << uv[local[t][k]], 1;
                        const Eigen::Vector3d w = corners.inverse() * Eigen::Vector3d(u, v, 1);
                        if (w.minCoeff() > most) most = w.minCoeff(), best = t, best_weights = w;
                    }
            best_weights = (best_weights.array() < 1e-9).select(0, best_weights);
            return std::pair<Index, Eigen::Vector3d>(first + best, best_weights / best_weights.sum());
        };
        std::vector<Index> lattice;
        for (int j = 0; j <= m; ++j)
            for (int i = 0; i <= m; ++i) {
                const double u = double(i) / m, v = double(j) / m;
                const bool border = i == 0 || j == 0 || i == m || j == m;
                if (!border && uniform() < f.skip_lattice) {
                    lattice.push_back(-1);
                    continue;
                }
                const std::size_t before = places.places.size();
                lattice.push_back(places.id(maps[patch](u, v)));
                if (places.places.size() == before) continue;
                const auto [t, w] = locate(u, v);
                result.points.triangle.push_back(t);
                weights.push_back(w);
            }
        for (int j = 0; j < m; ++j)
            for (int i = 0; i < m; ++i) {
                const int a = j * (m + 1) + i;
                const std::array<Index, 4> q{lattice[a], lattice[a + 1], lattice[a + m + 2], lattice[a + m + 1]};
                if (std::min({q[0], q[1], q[2], q[3]}) >= 0) quads.push_back(q);
            }
    }
    result.mesh.vertices = rows_of(vertices.places);
    result.mesh.triangles.resize(triangles.size(), 3);
    for (std::size_t t = 0; t < triangles.size(); ++t)
        for (int k = 0; k < 3; ++k) result.mesh.triangles(t, k) = triangles[t][k];
    result.points.weights = rows_of(weights);
    result.exact = rows_of(places.places);
    result.quads.resize(quads.size(), 4);
    for (std::size_t q = 0; q < quads.size(); ++q)
        for (int k = 0; k < 4; ++k) result.quads(q, k) = quads[q][k];
    return result;
}

// The six sides of the box from `low` to `high`, outward, without those named.
inline std::vector<Map> box_maps(const Eigen::Vector3d& low, const Eigen::Vector3d& high,
                                 const std::vector<int>& without = {}) {
    std::vector<Map> maps;
    for (int side = 0; side < 6; ++side) {
        if (std::find(without.begin(), without.end(), side) != without.end()) continue;
        const int axis = side / 2, x = (axis + 1) % 3, y = (axis + 2) % 3;
        const bool top = side % 2;
        maps.push_back([=](double u, double v) {
            Eigen::Vector3d p;
            p[axis] = top ? high[axis] : low[axis];
            p[x] = low[x] + (top ? u : v) * (high[x] - low[x]);
            p[y] = low[y] + (top ? v : u) * (high[y] - low[y]);
            return p;
        });
    }
    return maps;
}

inline std::vector<Map> sphere_maps() {
    std::vector<Map> maps;
    for (const Map& side : box_maps(Eigen::Vector3d::Constant(-1), Eigen::Vector3d::Constant(1)))
        maps.push_back([side](double u, double v) -> Eigen::Vector3d {
            const auto even = [](double x) { return (std::tan((x - 0.5) * std::numbers::pi / 2) + 1) / 2; };
            return side(even(u), even(v)).normalized();
        });
    return maps;
}

inline std::vector<Map> torus_maps() {  // of radii 1 and 0.4, in 6 x 3 squares
    std::vector<Map> maps;
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 3; ++j)
            maps.push_back([i, j](double u, double v) {
                const double a = (i + u) / 6 * 2 * std::numbers::pi, b = (j + v) / 3 * 2 * std::numbers::pi;
                return Eigen::Vector3d((1 + 0.4 * std::cos(b)) * std::cos(a), (1 + 0.4 * std::cos(b)) * std::sin(a),
                                       0.4 * std::sin(b));
            });
    return maps;
}

// Of radius 1 and height 2: four squares round it, caps of five squares each.
inline std::vector<Map> cylinder_maps() {
    std::vector<Map> maps;
    const auto rim = [](double a) { return Eigen::Vector2d(std::cos(a), std::sin(a)); };
    for (int i = 0; i < 4; ++i) {
        const auto angle = [i](double u) { return (i + u - 0.5) * std::numbers::pi / 2; };
        maps.push_back([=](double u, double v) {
            const Eigen::Vector2d p = rim(angle(u));
            return Eigen::Vector3d(p[0], p[1], 2 * v);
        });
        const auto square = [=](double u) -> Eigen::Vector2d {
            return 0.5 * ((1 - u) * rim(angle(0)) + u * rim(angle(1)));
        };
        for (const double z : {0.0, 2.0})
            maps.push_back([=](double u, double v) {
                const double w = z > 0 ? u : 1 - u;
                const Eigen::Vector2d p = v * square(w) + (1 - v) * rim(angle(w));
                return Eigen::Vector3d(p[0], p[1], z);
            });
    }
    for (const double z : {0.0, 2.0})
        maps.push_back([=](double u, double v) {
            const double s = std::sqrt(0.5) * 0.5;
            const double w = z > 0 ? u : 1 - u;
            return Eigen::Vector3d(s * (2 * w - 1), s * (2 * v - 1), z);
        });
    return maps;
}

}  // namespace octafield::volume::testing
