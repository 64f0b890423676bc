// Surfaces of mapped unit squares, each triangulated irregularly, with a lattice of quads on them: the lattice knows
// nothing of the triangles.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
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

// One square: its triangles by places in it.
class Square {
public:
    Square(const Fineness& f, std::mt19937& random) : n_(f.cells) {
        const auto uniform = [&] { return random() / 4294967296.0; };
        for (int j = 0; j <= n_; ++j)
            for (int i = 0; i <= n_; ++i) {
                const bool inner = i > 0 && i < n_ && j > 0 && j < n_;
                const double du = uniform() - 0.5, dv = uniform() - 0.5, s = inner ? 2 * f.jitter / n_ : 0;
                uv.emplace_back(double(i) / n_ + s * du, double(j) / n_ + s * dv);
            }
        for (int j = 0; j < n_; ++j)
            for (int i = 0; i < n_; ++i) {
                const int a = j * (n_ + 1) + i, b = a + 1, c = b + n_ + 1, d = a + n_ + 1;
                const double least = 0.2 / n_ / n_;  // no triangle is turned over
                const bool one = std::min(cross(a, b, c), cross(a, c, d)) > least;
                const bool other = std::min(cross(b, c, d), cross(b, d, a)) > least;
                if (one && (!other || uniform() < 0.5))
                    triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}});
                else
                    triangles.insert(triangles.end(), {{b, c, d}, {b, d, a}});
            }
    }

    // The triangle at a place and the weights in it.
    std::pair<Index, Eigen::Vector3d> locate(double u, double v) const {
        Index best = -1;
        Eigen::Vector3d weights = Eigen::Vector3d::Constant(-1e9);
        const int ci = std::min(n_ - 1, int(u * n_)), cj = std::min(n_ - 1, int(v * n_));
        for (int j = std::max(0, cj - 1); j <= std::min(n_ - 1, cj + 1); ++j)
            for (int t = 2 * (j * n_ + std::max(0, ci - 1)); t < 2 * (j * n_ + std::min(n_, ci + 2)); ++t) {
                Eigen::Matrix3d corners;
                for (int k = 0; k < 3; ++k) corners.col(k) << uv[triangles[t][k]], 1;
                const Eigen::Vector3d w = corners.inverse() * Eigen::Vector3d(u, v, 1);
                if (w.minCoeff() > weights.minCoeff()) weights = w, best = t;
            }
        weights = (weights.array() < 1e-9).select(0, weights);
        return {best, weights / weights.sum()};
    }

    std::vector<Eigen::Vector2d> uv;
    std::vector<std::array<int, 3>> triangles;

private:
    double cross(int p, int q, int r) const {
        const Eigen::Vector2d x = uv[q] - uv[p], y = uv[r] - uv[p];
        return x[0] * y[1] - x[1] * y[0];
    }
    int n_;
};

class PatchedBuilder {
public:
    explicit PatchedBuilder(const Fineness& f) : f_(f), random_(f.seed) {}

    void add(const Map& map) {
        const Square square(f_, random_);
        const Index first = static_cast<Index>(triangles_.size());
        std::vector<Index> global;
        for (const auto& p : square.uv) global.push_back(vertices_.id(map(p[0], p[1])));
        for (const auto& [a, b, c] : square.triangles) {
            triangles_.push_back({global[a], global[b], global[c]});
            result_.groups.push_back(patches_);
        }
        add_lattice(map, square, first);
        ++patches_;
    }

    Patched take() {
        result_.mesh = {rows_of(vertices_.places), rows<3>(triangles_)};
        result_.points.weights = rows_of(weights_);
        result_.exact = rows_of(places_.places);
        result_.quads = rows<4>(quads_);
        return std::move(result_);
    }

private:
    template <int N>
    static Rows<Index, N> rows(const std::vector<std::array<Index, N>>& list) {
        Rows<Index, N> result(list.size(), N);
        for (std::size_t i = 0; i < list.size(); ++i)
            for (int k = 0; k < N; ++k) result(i, k) = list[i][k];
        return result;
    }

    void add_lattice(const Map& map, const Square& square, Index first) {
        const int m = f_.lattice;
        std::vector<Index> lattice;
        for (int j = 0; j <= m; ++j)
            for (int i = 0; i <= m; ++i) lattice.push_back(lattice_point(map, square, first, i, j));
        for (int j = 0; j < m; ++j)
            for (int i = 0; i < m; ++i) {
                const int a = j * (m + 1) + i;
                const std::array<Index, 4> q{lattice[a], lattice[a + 1], lattice[a + m + 2], lattice[a + m + 1]};
                if (std::min({q[0], q[1], q[2], q[3]}) >= 0) quads_.push_back(q);
            }
    }

    // -1: left out.
    Index lattice_point(const Map& map, const Square& square, Index first, int i, int j) {
        const int m = f_.lattice;
        const bool border = i == 0 || j == 0 || i == m || j == m;
        if (!border && random_() / 4294967296.0 < f_.skip_lattice) return -1;
        const double u = double(i) / m, v = double(j) / m;
        const std::size_t before = places_.places.size();
        const Index id = places_.id(map(u, v));
        if (places_.places.size() == before) return id;  // on the border of a square before
        const auto [t, w] = square.locate(u, v);
        result_.points.triangle.push_back(first + t);
        weights_.push_back(w);
        return id;
    }

    Fineness f_;
    std::mt19937 random_;
    Index patches_ = 0;
    Patched result_;
    Welder vertices_, places_;
    std::vector<std::array<Index, 3>> triangles_;
    std::vector<std::array<Index, 4>> quads_;
    std::vector<Eigen::Vector3d> weights_;
};

inline Patched patched_surface(const std::vector<Map>& maps, const Fineness& f) {
    PatchedBuilder builder(f);
    for (const Map& map : maps) builder.add(map);
    return builder.take();
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

// All triangles in one.
inline std::vector<Index> one_group(const Patched& p) { return std::vector<Index>(p.groups.size(), 0); }

// Quads of the lattice that the surface has.
inline int found(const PointSurface& s) {
    return static_cast<int>(std::count(s.quad_found.begin(), s.quad_found.end(), 1));
}

}  // namespace octafield::volume::testing
