// Validity of cells by the Bernstein coefficients of their Jacobian determinants (Johnen, Remacle, Geuzaine 2013,
// "Geometrical validity of curvilinear finite elements"), with bounds for what doubles round.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "cell_shapes.hpp"
#include "octafield/error.hpp"
#include "octafield/parallel.hpp"
#include "octafield/volume/cell_quality.hpp"

namespace octafield::volume {
namespace {

using detail::Cell;
using Vector = Eigen::Vector3d;

constexpr int power_of_3(int exponent) { return exponent == 0 ? 1 : 3 * power_of_3(exponent - 1); }

// Of a polynomial of degree 2 in each of D variables on the unit cube: coefficient (i, j, k) at i + 3 j + 9 k.
template <int D>
using Coefficients = std::array<double, power_of_3(D)>;

constexpr int degree_of(int at, int axis) { return at / power_of_3(axis) % 3; }

template <int D>
constexpr bool at_corner(int at) {
    for (int axis = 0; axis < D; ++axis)
        if (degree_of(at, axis) == 1) return false;
    return true;
}

// Whether the polynomial is above 0 wherever coefficients above `rounding` show it, halved so many times; the axes take
// turns.
template <int D>
bool is_positive(const Coefficients<D>& all, double rounding, int halvings, int axis = 0) {
    bool shown = true;
    for (int at = 0; at < power_of_3(D); ++at) {
        if (all[at] > rounding) continue;
        if (at_corner<D>(at)) return false;  // a value of the polynomial, so no halving helps
        shown = false;
    }
    if (shown) return true;
    if (halvings == 0) return false;
    Coefficients<D> lower = all, upper = all;
    const int step = power_of_3(axis);
    for (int at = 0; at < power_of_3(D); ++at) {
        if (degree_of(at, axis) != 0) continue;
        const double first = (all[at] + all[at + step]) / 2, last = (all[at + step] + all[at + 2 * step]) / 2;
        lower[at + step] = first;
        upper[at + step] = last;
        lower[at + 2 * step] = upper[at] = (first + last) / 2;
    }
    const int next = (axis + 1) % D;
    return is_positive<D>(lower, rounding, halvings - 1, next) && is_positive<D>(upper, rounding, halvings - 1, next);
}

// Of a product of two linear factors with the coefficients i and j: its part of the coefficient i + j.
double share(int i, int j) { return i + j == 1 ? 0.5 : 1; }

// What the coefficients may be off. Each is a mean of up to 8 determinants with weights that are powers of 2. The terms
// of a determinant, products of three differences, sum up to the product of the vectors' 1-norms at most, and each goes
// through 16 roundings: 3 of differences, 2 of products, 3 of sums, 8 of the mean. A halving adds two, of means that do
// not grow. (An epsilon is two roundings: bounded amply, since the norms are rounded, too.)
double rounding_of(double norms, int halvings) {
    return std::numeric_limits<double>::epsilon() * (32 + 4 * halvings) * norms + std::numeric_limits<double>::min();
}

template <std::size_t N>
double largest_norm(const std::array<Vector, N>& vectors) {
    double most = 0;
    for (const Vector& v : vectors) most = std::max(most, v.lpNorm<1>());
    return most;
}

// A cell of about unit size: differences are rounded once, powers of 2 scale them exactly, and no product overflows.
class CellEdges {
public:
    CellEdges(const MixedMesh& mesh, const Cell& cell) : mesh_(mesh), cell_(cell) {
        double most = 0;
        for (int k = 1; k < cell.shape.vertices; ++k) most = std::max(most, difference(k, 0).cwiseAbs().maxCoeff());
        for (int k = 1; k < cell.shape.vertices; ++k)
            if (!difference(k, 0).allFinite()) most = std::numeric_limits<double>::quiet_NaN();
        if (most > 0) scale_ = std::ldexp(1.0, -std::ilogb(most));
    }
    bool usable() const { return scale_ > 0 && std::isfinite(scale_); }
    Vector operator()(int to, int from) const { return scale_ * difference(to, from); }

private:
    Vector difference(int to, int from) const {
        return mesh_.vertices.row(cell_.ids[to]) - mesh_.vertices.row(cell_.ids[from]);
    }
    const MixedMesh& mesh_;
    const Cell& cell_;
    double scale_ = 0;
};

double determinant(const Vector& a, const Vector& b, const Vector& c) { return a.cross(b).dot(c); }

bool corner_positive(const Vector& a, const Vector& b, const Vector& c) {
    return determinant(a, b, c) > rounding_of(a.lpNorm<1>() * b.lpNorm<1>() * c.lpNorm<1>(), 0);
}

// x(u, v, w) trilinear: x_u is linear in v and w, and so on, their determinant of degree 2 in each.
bool hexahedron_positive(const CellEdges& edge, int depth) {
    // At (0, 0), (1, 0), (0, 1), (1, 1) of the two other variables, in their order.
    const std::array<Vector, 4> along_u{edge(1, 0), edge(2, 3), edge(5, 4), edge(6, 7)},
        along_v{edge(3, 0), edge(2, 1), edge(7, 4), edge(6, 5)},
        along_w{edge(4, 0), edge(5, 1), edge(7, 3), edge(6, 2)};
    Coefficients<3> all{};
    for (int a = 0; a < 4; ++a)
        for (int b = 0; b < 4; ++b) {
            const Vector normal = along_u[a].cross(along_v[b]);
            const int va = a % 2, wa = a / 2, ub = b % 2, wb = b / 2;
            for (int c = 0; c < 4; ++c) {
                const int uc = c % 2, vc = c / 2;
                all[(ub + uc) + 3 * (va + vc) + 9 * (wa + wb)] +=
                    share(ub, uc) * share(va, vc) * share(wa, wb) * normal.dot(along_w[c]);
            }
        }
    const double norms = largest_norm(along_u) * largest_norm(along_v) * largest_norm(along_w);
    return is_positive<3>(all, rounding_of(norms, 3 * depth), 3 * depth);
}

// A triangle times an interval: linear over the triangle, so three polynomials of degree 2 along its corners' edges
// tell.
bool wedge_positive(const CellEdges& edge, int depth) {
    const std::array<Vector, 2> first{edge(1, 0), edge(4, 3)}, second{edge(2, 0), edge(5, 3)};
    const std::array<Vector, 3> up{edge(3, 0), edge(4, 1), edge(5, 2)};
    const double rounding = rounding_of(largest_norm(first) * largest_norm(second) * largest_norm(up), depth);
    for (const Vector& along : up) {
        Coefficients<1> all{};
        for (int a = 0; a < 2; ++a)
            for (int b = 0; b < 2; ++b) all[a + b] += share(a, b) * determinant(first[a], second[b], along);
        if (!is_positive<1>(all, rounding, depth)) return false;
    }
    return true;
}

// x = (1 - w) q(u, v) + w apex: the determinant is (1 - w)^2 det(q_u, q_v, apex - q), above 0 but at the apex itself.
// For a bilinear q the terms of higher order cancel, and what is left is bilinear, so that the base's corners tell.
bool pyramid_positive(const CellEdges& edge) {
    return std::ranges::all_of(detail::pyramid_shape.corners, [&](const detail::CellCorner& at) {
        return corner_positive(edge(at[1], at[0]), edge(at[2], at[0]), edge(at[3], at[0]));
    });
}

bool cell_positive(const MixedMesh& mesh, const Cell& cell, int depth) {
    const CellEdges edge(mesh, cell);
    if (!edge.usable()) return false;
    if (&cell.shape == &detail::tet_shape) return corner_positive(edge(1, 0), edge(2, 0), edge(3, 0));
    if (&cell.shape == &detail::hexahedron_shape) return hexahedron_positive(edge, depth);
    return &cell.shape == &detail::wedge_shape ? wedge_positive(edge, depth) : pyramid_positive(edge);
}

void require_ids(const MixedMesh& mesh) {
    std::vector<Index> lost;
    detail::for_each_cell(mesh, [&](const Cell& cell) {
        for (int k = 0; k < cell.shape.vertices; ++k)
            if (cell.ids[k] < 0 || cell.ids[k] >= mesh.vertices.rows()) {
                lost.push_back(cell.number);
                return;
            }
    });
    if (!lost.empty())
        throw GeometryError("cells name vertices that do not exist (cells " + first_few(lost) +
                                "); vertex ids count from 0 to " + std::to_string(mesh.vertices.rows() - 1),
                            "index_out_of_range", lost);
}

}  // namespace

std::vector<std::uint8_t> proven_positive(const MixedMesh& mesh, int depth, int threads) {
    if (depth < 0 || depth > 20)
        throw InvalidInput("depth is " + std::to_string(depth) + "; give 0 to 20 halvings", "depth_out_of_range");
    require_ids(mesh);
    std::vector<Cell> cells;
    cells.reserve(mesh.cell_count());
    detail::for_each_cell(mesh, [&](const Cell& cell) { cells.push_back(cell); });
    std::vector<std::uint8_t> proven(cells.size());
    parallel_for(static_cast<std::int64_t>(cells.size()), threads,
                 [&](std::int64_t i) { proven[i] = cell_positive(mesh, cells[i], depth); });
    return proven;
}

}  // namespace octafield::volume
