#include "quartic.hpp"

#include <array>

namespace octafield::frames {
namespace {

constexpr int pair_indices[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {2, 0}, {0, 1}};

// Number of the monomial x_i x_j x_k x_l.
int monomial_of(int i, int j, int k, int l) {
    int exponents[3] = {0, 0, 0};
    for (int axis : {i, j, k, l}) ++exponents[axis];
    int row = 0;
    while (quartic_exponents[row][0] != exponents[0] || quartic_exponents[row][1] != exponents[1]) ++row;
    return row;
}

// How many index tuples (i, j, k, l) give monomial r: 4! / (e0! e1! e2!).
constexpr double multiplicity(int r) {
    constexpr double factorial[5] = {1, 1, 2, 6, 24};
    const auto& e = quartic_exponents[r];
    return 24 / (factorial[e[0]] * factorial[e[1]] * factorial[e[2]]);
}

struct PairTable {
    int monomial[6][6];
    double scale[6][6];
};

PairTable make_pair_table() {
    PairTable table{};
    for (int a = 0; a < 6; ++a)
        for (int b = 0; b < 6; ++b) {
            const auto& p = pair_indices[a];
            const auto& q = pair_indices[b];
            const int r = monomial_of(p[0], p[1], q[0], q[1]);
            table.monomial[a][b] = r;
            table.scale[a][b] = (b < 3 ? 1 : 2) / multiplicity(r);
        }
    return table;
}

}  // namespace

Vector15 quartic_monomials(const Eigen::Vector3d& x) {
    const double xx = x[0] * x[0], yy = x[1] * x[1], zz = x[2] * x[2];
    const double xy = x[0] * x[1], xz = x[0] * x[2], yz = x[1] * x[2];
    Vector15 m;
    m << xx * xx, xx * xy, xx * xz, xx * yy, xx * yz, xx * zz, xy * yy, xy * yz, xy * zz, xz * zz, yy * yy, yy * yz,
        yy * zz, yz * zz, zz * zz;
    return m;
}

Eigen::Matrix<double, 15, 3> quartic_monomial_gradients(const Eigen::Vector3d& x) {
    std::array<Eigen::Vector3d, 5> power;  // power[e][axis] = x_axis^e
    power[0].setOnes();
    for (int e = 1; e < 5; ++e) power[e] = power[e - 1].cwiseProduct(x);
    Eigen::Matrix<double, 15, 3> gradients;
    for (int r = 0; r < 15; ++r)
        for (int axis = 0; axis < 3; ++axis) {
            double value = 1;
            for (int other = 0; other < 3; ++other) {
                const int e = quartic_exponents[r][other];
                if (other != axis)
                    value *= power[e][other];
                else
                    value *= e == 0 ? 0 : e * power[e - 1][other];
            }
            gradients(r, axis) = value;
        }
    return gradients;
}

Quartic::Quartic(const Vector15& coefficients) {
    static const PairTable table = make_pair_table();
    for (int a = 0; a < 6; ++a)
        for (int b = 0; b < 6; ++b) pairs_(a, b) = coefficients[table.monomial[a][b]] * table.scale[a][b];
}

Eigen::Matrix3d Quartic::contract(const Eigen::Vector3d& x) const {
    Eigen::Matrix<double, 6, 1> squares;
    squares << x[0] * x[0], x[1] * x[1], x[2] * x[2], x[1] * x[2], x[2] * x[0], x[0] * x[1];
    const Eigen::Matrix<double, 6, 1> m = pairs_ * squares;
    Eigen::Matrix3d full;
    full << m[0], m[5], m[4], m[5], m[1], m[3], m[4], m[3], m[2];
    return full;
}

}  // namespace octafield::frames
