#include "octafield/frames/su2_surface.hpp"

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <numbers>

namespace octafield::frames::su2_surface {
namespace {

// coefficient A^a B^b E^e C^c of 2^20 P.
struct Term {
    int a, b, e, c;
    double coefficient;
};
constexpr Term norm_relation[] = {
    {0, 0, 0, 0, -65536},   {1, 0, 0, 0, 81920},     {2, 0, 0, 0, -17920},    {3, 0, 0, 0, 1600},   {4, 0, 0, 0, -65},
    {5, 0, 0, 0, 1},        {0, 1, 0, 0, 7569408},   {1, 1, 0, 0, -2185216},  {2, 1, 0, 0, 525440}, {3, 1, 0, 0, 4248},
    {4, 1, 0, 0, 20},       {0, 2, 0, 0, 119648256}, {1, 2, 0, 0, -10849792}, {2, 2, 0, 0, -82256}, {3, 2, 0, 0, 4},
    {0, 3, 0, 0, 47251456}, {1, 3, 0, 0, 221184},    {0, 0, 1, 0, 458752},    {1, 0, 1, 0, -55296}, {2, 0, 1, 0, 1536},
    {3, 0, 1, 0, 8},        {0, 1, 1, 0, 1060864},   {1, 1, 1, 0, -34816},    {2, 1, 1, 0, 16},     {0, 2, 1, 0, 65536},
    {0, 0, 0, 1, -1383424}, {1, 0, 0, 1, -33920},    {2, 0, 0, 1, -156},      {0, 1, 0, 1, 801024}, {1, 1, 0, 1, -2480},
    {0, 0, 1, 1, -256},     {0, 0, 0, 2, -4},
};
constexpr double scale = 1 << 20;

struct Equations {
    Complex f;
    double p;
    Complex3 df, dp;  // complex derivatives: a step d changes f by df . d, p by 2 re(dp . d)
};

Equations equations(const Su2::Vector& vector) {
    const Complex3 h = Su2::complex(vector);
    const Complex &x = h[0], &y = h[1], &z = h[2];
    const Complex x2 = x * x, x3 = x2 * x, y2 = y * y;
    Equations result;
    result.f = z * z - y * (x3 - 108.0 * y2);
    result.df << -3.0 * y * x2, 324.0 * y2 - x3, 2.0 * z;

    constexpr int powers = 6;
    const double values[4] = {std::norm(x), std::norm(y), std::norm(z), (x3 * std::conj(y2)).real()};
    double power[4][powers + 1];  // power[i][k + 1] = values[i]^k; power[i][0] is multiplied by 0
    for (int i = 0; i < 4; ++i) {
        power[i][0] = 0;
        power[i][1] = 1;
        for (int k = 2; k <= powers; ++k) power[i][k] = power[i][k - 1] * values[i];
    }
    double sum = 0, by[4] = {0, 0, 0, 0};
    for (const Term& t : norm_relation) {
        const double a = power[0][t.a + 1], b = power[1][t.b + 1], e = power[2][t.e + 1], c = power[3][t.c + 1];
        const double ab = t.coefficient * a * b, ec = t.coefficient * e * c;
        sum += ab * e * c;
        by[0] += t.a * power[0][t.a] * b * ec;
        by[1] += t.b * power[1][t.b] * a * ec;
        by[2] += t.e * power[2][t.e] * ab * c;
        by[3] += t.c * power[3][t.c] * ab * e;
    }
    result.p = sum / scale;
    result.dp << by[0] * std::conj(x) + by[3] * 1.5 * x2 * std::conj(y2),
        by[1] * std::conj(y) + by[3] * std::conj(x3) * y, by[2] * std::conj(z);
    result.dp /= scale;
    return result;
}

Vector3 values(const Equations& at) { return {at.f.real(), at.f.imag(), at.p}; }

// Columns: gradients of re F, im F, P in R^6, a basis of the normals of M.
Su2::Differential normals(const Equations& at) {
    const Complex3 across = at.df.conjugate();
    Su2::Differential columns;
    columns.col(0) = Su2::real(across);
    columns.col(1) = Su2::real(Complex(0, 1) * across);
    columns.col(2) = Su2::real(2 * at.dp.conjugate());
    return columns;
}

// Without conjugates, which Eigen's has.
Complex3 cross(const Complex3& a, const Complex3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Complex dot(const Complex3& a, const Complex3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// Newton's steps are quadratic: after one as short as this the next would be below rounding.
constexpr double last_step = 1e-9;
constexpr int max_steps = 12;

struct Piece {
    Vector3 turn;
    Point middle;
};

std::optional<Piece> piece(const Point& p, const Point& q) {
    constexpr int max_bends = 3;
    constexpr double bent = 0.02;  // radians
    const Su2::Vector step = q.h - p.h, half_way = (p.h + q.h) / 2;
    std::optional<Su2::Vector> middle = restored(half_way);
    if (!middle) return {};
    Point m = point(*middle);
    Vector3 turn = turn_of(m.turns, step);
    for (int bend = 0; bend < max_bends; ++bend) {
        // The middle of the cubic with these ends and end velocities.
        middle = restored(half_way + (p.turns - q.turns) * turn / 8);
        if (!middle) return {};
        m = point(*middle);
        const Vector3 last = turn;
        turn = turn_of((p.turns + 4 * m.turns + q.turns) / 6, step);
        if ((turn - last).norm() < bent) break;
    }
    return Piece{turn, m};
}

// Along a path of points of M, in one piece, two and four, extrapolated (Romberg; errors of orders 4, 6, 8). Where that
// does not settle, each half by itself.
std::optional<Vector3> turn_along_path(const Point& p, const Point& q, int depth) {
    constexpr double agreement = 1e-7, farthest = 1;  // radians
    constexpr std::size_t points = 9;
    std::array<Point, points> path;
    path.front() = p;
    path.back() = q;
    const auto in_pieces = [&](std::size_t stride) -> std::optional<Vector3> {
        Quaternion whole = Quaternion::Identity();
        for (std::size_t k = 0; k + 1 < points; k += stride) {
            const auto part = piece(path[k], path[k + stride]);
            if (!part) return {};
            path[k + stride / 2] = part->middle;
            whole = exp(part->turn) * whole;
        }
        return frames::log(whole);
    };
    const auto one = in_pieces(8), two = one ? in_pieces(4) : one;
    if (!two || two->norm() > farthest) return {};
    const Vector3 sixth = *two + (*two - *one) / 15;
    if ((sixth - *two).norm() < agreement / 100) return sixth;
    if (const auto four = in_pieces(2)) {
        const Vector3 finer = *four + (*four - *two) / 15, eighth = finer + (finer - sixth) / 63;
        if ((eighth - sixth).norm() < agreement) return eighth;
    }
    if (depth == 0) return {};
    const auto first = turn_along_path(p, path[4], depth - 1);
    if (!first) return {};
    const auto second = turn_along_path(path[4], q, depth - 1);
    if (!second) return {};
    return frames::log(exp(*second) * exp(*first));
}

}  // namespace

Vector3 residual(const Su2::Vector& h) { return values(equations(h)); }

Point point(const Su2::Vector& h) {
    const Equations at = equations(h);
    const Complex3 e = Complex3(8.0, 12.0, 18.0).cwiseProduct(Su2::complex(h));
    const Complex3 s = 8 / e.squaredNorm() * cross(at.df, e.conjugate());
    const Complex3 t = s - dot(at.dp, s) / dot(at.dp, e) * e;
    const Complex i(0, 1);
    Point result;
    result.h = h;
    result.turns.col(0) = Su2::real(i * e / 2.0);
    result.turns.col(1) = Su2::real(t / 2.0);
    result.turns.col(2) = Su2::real(i * t / 2.0);
    return result;
}

Eigen::Matrix<double, 3, 6> inverse_turns(const Su2::Differential& turns) {
    const Matrix3 normal = turns.transpose() * turns;
    return normal.inverse() * turns.transpose();
}

Vector3 turn_of(const Su2::Differential& turns, const Su2::Vector& step) { return inverse_turns(turns) * step; }

std::optional<Su2::Vector> restored(const Su2::Vector& point) {
    // Quadratic: after a step as short as this the next would be below rounding.
    constexpr double last_step = 1e-9, longest_step = 1;
    constexpr int max_steps = 12;
    Su2::Vector h = point;
    for (int step = 0; step < max_steps; ++step) {
        const Equations at = equations(h);
        const Su2::Differential normal = normals(at);
        const Matrix3 gram = normal.transpose() * normal;
        const Su2::Vector move = normal * (gram.inverse() * values(at));
        if (!(move.norm() < longest_step)) return {};
        h -= move;
        if (move.norm() < last_step) return h;
    }
    return {};
}

std::optional<Su2::Vector> retracted(const Su2::Vector& h, const Vector3& w) {
    constexpr double longest = 0.05, limit = 20;  // radians
    if (!(w.norm() <= limit)) return {};
    if (w.norm() <= longest)
        if (const auto half_way = restored(h + point(h).turns * w / 2))
            if (const auto end = restored(h + point(*half_way).turns * w)) return end;
    const auto middle = retracted(h, w / 2);
    return middle ? retracted(*middle, w / 2) : middle;
}

std::optional<Vector3> turn_between(const Su2::Vector& h, const Su2::Vector& k) {
    constexpr int max_steps = 200;
    constexpr double farthest = 1;  // radians
    const Eigen::Matrix<double, 3, 6> inverse = inverse_turns(point(k).turns);
    Vector3 w = turn_of(point(h).turns, k - h);
    for (int step = 0; step < max_steps; ++step) {
        const auto reached = retracted(h, w);
        if (!reached) return {};
        const Vector3 rest = inverse * (k - *reached);
        w += rest;
        if (rest.norm() < 1e-14) return w;
        if (!(w.norm() < farthest)) return {};
    }
    return {};
}

std::optional<Vector3> log(const Point& p, const Point& q) {
    constexpr int depth = 3;
    constexpr double longest = 40 * std::numbers::pi / 180;
    const auto turn = turn_along_path(p, q, depth);
    return turn && turn->norm() < longest ? turn : std::nullopt;
}

}  // namespace octafield::frames::su2_surface
