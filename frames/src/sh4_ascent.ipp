// F and its local ascent over OCTAFIELD_LANES quaternions at a time. Included by sh4_kernel.cpp once per instruction
// set, into a namespace of its own. Lanes never meet in arithmetic, and only +, -, *, /, sqrt and comparisons are used,
// without contraction to fused operations: a result has the same bits in any lane, batch and instruction set.

constexpr int lanes = OCTAFIELD_LANES;
typedef double V __attribute__((vector_size(8 * OCTAFIELD_LANES)));
typedef decltype(V{} < V{}) Mask;

inline V all(double x) { return x - V{}; }
inline V select(Mask m, V a, V b) { return m ? a : b; }
inline V absolute(V a) { return select(a < 0.0, -a, a); }
inline V greater(V a, V b) {
#ifdef OCTAFIELD_GREATER
    return OCTAFIELD_GREATER(a, b);
#else
    return select(a > b, a, b);
#endif
}
inline V load(const double* p) {
    V v;
    __builtin_memcpy(&v, p, sizeof v);
    return v;
}
inline V gather(const double* p, const int* index) {
    V v = {};
    for (int l = 0; l < lanes; ++l) v[l] = p[index[l]];
    return v;
}
inline void store(double* p, V v) { __builtin_memcpy(p, &v, sizeof v); }
// Bit l tells whether lane l is true.
inline unsigned bits(Mask m) {
#ifdef OCTAFIELD_BITS
    return OCTAFIELD_BITS(m);
#else
    unsigned list = 0;
    for (int l = 0; l < lanes; ++l) list |= (m[l] ? 1u : 0u) << l;
    return list;
#endif
}
inline bool any(Mask m) { return bits(m) != 0; }
inline V root(V a) {
    V r = {};
    for (int l = 0; l < lanes; ++l) r[l] = __builtin_sqrt(a[l]);
    return r;
}

struct Form {
    V xxxx, xxyy, yyyy, xxxy, xyyy, xxyz, yyyz, xxzx, yyzx, yyzz, xyzz, xxzz;
};
struct Frame {
    V w, x, y, z;
};
struct Axis {
    V x, y, z;
};
struct TraceFree {  // symmetric 3x3, zz = -xx - yy
    V xx, yy, yz, zx, xy;
};
struct Expansion {  // of u -> F(q exp(u)): body coordinates
    V value, g1, g2, g3, h11, h22, h33, h23, h31, h12;
};

inline V dot(const Axis& a, const Axis& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

inline Axis times(const TraceFree& m, const Axis& r) {
    return {m.xx * r.x + m.xy * r.y + m.zx * r.z, m.xy * r.x + m.yy * r.y + m.yz * r.z,
            m.zx * r.x + m.yz * r.y - (m.xx + m.yy) * r.z};
}

// T(r, r, ., .)
inline TraceFree contract(const Form& t, const Axis& r) {
    const V zz = r.z * r.z;
    const V a = r.x * r.x - zz, b = r.y * r.y - zz;
    const V x2 = r.x + r.x, c = (r.y + r.y) * r.z, d = x2 * r.z, e = x2 * r.y;
    return {t.xxxx * a + t.xxyy * b + t.xxyz * c + t.xxzx * d + t.xxxy * e,
            t.xxyy * a + t.yyyy * b + t.yyyz * c + t.yyzx * d + t.xyyy * e,
            t.xxyz * a + t.yyyz * b + t.yyzz * c + t.xyzz * d + t.yyzx * e,
            t.xxzx * a + t.yyzx * b + t.xyzz * c + t.xxzz * d + t.xxyz * e,
            t.xxxy * a + t.xyyy * b + t.yyzx * c + t.xxyz * d + t.xxyy * e};
}

// The third axis enters through the trace alone: T(r_1,r_1,.,.) + T(r_2,r_2,.,.) + T(r_3,r_3,.,.) = 0. Below, tabcd is
// T(r_a,r_b,r_c,r_d); gradient and Hessian follow from r_a -> r_a + u x r_a + 1/2 u x (u x r_a).
inline Expansion expand(const Form& t, const Frame& q) {
    const V s = 2.0 / (q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    const V sx = s * q.x, sy = s * q.y, sz = s * q.z;
    const V wx = q.w * sx, wy = q.w * sy, wz = q.w * sz;
    const V xx = q.x * sx, xy = q.x * sy, xz = q.x * sz, yy = q.y * sy, yz = q.y * sz, zz = q.z * sz;
    const Axis r1 = {1.0 - (yy + zz), xy + wz, xz - wy};
    const Axis r2 = {xy - wz, 1.0 - (xx + zz), yz + wx};
    const Axis r3 = {xz + wy, yz - wx, 1.0 - (xx + yy)};
    const TraceFree m1 = contract(t, r1), m2 = contract(t, r2);
    const Axis m11 = times(m1, r1), m12 = times(m1, r2), m21 = times(m2, r1), m22 = times(m2, r2);
    const V t1111 = dot(m11, r1), t1112 = dot(m11, r2), t1113 = dot(m11, r3), t1122 = dot(m12, r2);
    const V t1123 = dot(m12, r3), t1222 = dot(m22, r1), t1223 = dot(m21, r3), t2222 = dot(m22, r2);
    const V t2223 = dot(m22, r3);
    Expansion e;
    e.value = 2.0 * (t1111 + t1122 + t2222);
    e.g1 = 4.0 * (2.0 * t2223 + t1123);
    e.g2 = -4.0 * (2.0 * t1113 + t1223);
    e.g3 = 4.0 * (t1112 - t1222);
    e.h11 = -4.0 * t1111 - 32.0 * (t1122 + t2222);
    e.h22 = -4.0 * t2222 - 32.0 * (t1122 + t1111);
    e.h33 = 24.0 * t1122 - 4.0 * (t1111 + t2222);
    e.h23 = -14.0 * t1123;
    e.h31 = -14.0 * t1223;
    e.h12 = 14.0 * (t1112 + t1222);
    return e;
}

// q exp(u) to second order in u; the norm of q may grow.
inline Frame turned(const Frame& q, const Axis& u) {
    const V x = 0.5 * u.x, y = 0.5 * u.y, z = 0.5 * u.z;
    return {q.w - q.x * x - q.y * y - q.z * z, q.x + q.w * x + q.y * z - q.z * y, q.y + q.w * y + q.z * x - q.x * z,
            q.z + q.w * z + q.x * y - q.y * x};
}

// Largest eigenvalue of the Hessian, from above: Newton on the characteristic polynomial from an upper bound of its
// roots.
inline V largest_eigenvalue(const Expansion& e) {
    const V mean = (e.h11 + e.h22 + e.h33) * (1.0 / 3);
    const V d1 = e.h11 - mean, d2 = e.h22 - mean, d3 = e.h33 - mean;
    const V p3 = 0.5 * (d1 * d1 + d2 * d2 + d3 * d3) + (e.h23 * e.h23 + e.h31 * e.h31 + e.h12 * e.h12);
    const V determinant =
        d1 * (d2 * d3 - e.h23 * e.h23) - e.h12 * (e.h12 * d3 - e.h23 * e.h31) + e.h31 * (e.h12 * e.h23 - d2 * e.h31);
    V x = 2.0 * root(p3 * (1.0 / 3));
    for (int i = 0; i < 6; ++i) {
        const V slope = 3.0 * x * x - p3;
        x -= ((x * x - p3) * x - determinant) / select(slope > 1e-300, slope, all(1.0));
    }
    return mean + x;
}

// Newton's step where the Hessian is negative definite; else the Hessian is shifted by twice its largest eigenvalue:
// that leaves the absolute value along this eigenvector.
inline Axis ascent_step(const Expansion& e) {
    constexpr double longest = 0.4;  // radians; a basin is about one radian wide
    const V slope = greater(greater(absolute(e.g1), absolute(e.g2)), absolute(e.g3));
    const V floor = 0.5 * slope + 1e-11;  // tames the step along flat directions, vanishes at the maximum
    V b11 = floor - e.h11, b22 = floor - e.h22, b33 = floor - e.h33;
    const V b23 = -e.h23, b31 = -e.h31, b12 = -e.h12;
    V c11 = b22 * b33 - b23 * b23, c12 = b23 * b31 - b12 * b33, c31 = b12 * b23 - b31 * b22;
    V det = b11 * c11 + b12 * c12 + b31 * c31;
    const Mask concave = (b33 > 0.0) & (c11 > 0.0) & (det > 0.0);
    if (any(~concave)) {
        const V shift = select(concave, V{}, 2.0 * greater(largest_eigenvalue(e), V{}) + floor);
        b11 += shift, b22 += shift, b33 += shift;
        c11 = b22 * b33 - b23 * b23, c12 = b23 * b31 - b12 * b33, c31 = b12 * b23 - b31 * b22;
        det = b11 * c11 + b12 * c12 + b31 * c31;
    }
    const V c22 = b11 * b33 - b31 * b31, c23 = b31 * b12 - b11 * b23, c33 = b11 * b22 - b12 * b12;
    Axis u = {c11 * e.g1 + c12 * e.g2 + c31 * e.g3, c12 * e.g1 + c22 * e.g2 + c23 * e.g3,
              c31 * e.g1 + c23 * e.g2 + c33 * e.g3};
    const V longest_component = greater(greater(absolute(u.x), absolute(u.y)), absolute(u.z));
    const V scale = 1.0 / greater(det, longest_component * (1.0 / longest) + 1e-300);
    // At a saddle or minimum the gradient says nothing: leave it by a fixed turn.
    const Mask stuck = ~concave & (slope < 1e-9);
    return {select(stuck, all(0.030), scale * u.x), select(stuck, all(0.017), scale * u.y),
            select(stuck, all(0.011), scale * u.z)};
}

// Ascends F from q until the gradient is at rounding level. Lanes stop one by one; a stopped lane keeps its bits.
inline void ascend(const Form& t, Frame& q, Expansion& e) {
    constexpr int max_steps = 80;
    constexpr double flat = 4e-15, slack = 4e-15, last_step = 3e-8;
    e = expand(t, q);
    V shrink = all(1.0);
    Mask active = shrink > 0.0;
    for (int step = 0; step < max_steps && any(active); ++step) {
        Axis u = ascent_step(e);
        u.x *= shrink, u.y *= shrink, u.z *= shrink;
        const Frame next = turned(q, u);
        const Expansion at = expand(t, next);
        const Mask gained = at.value >= e.value - slack, moved = active & gained;
        q.w = select(moved, next.w, q.w), q.x = select(moved, next.x, q.x);
        q.y = select(moved, next.y, q.y), q.z = select(moved, next.z, q.z);
        V* const now = &e.value;
        const V* const then = &at.value;
        for (int i = 0; i < 10; ++i) now[i] = select(moved, then[i], now[i]);
        shrink = select(gained, all(1.0), 0.25 * shrink);
        const V slope = greater(greater(absolute(e.g1), absolute(e.g2)), absolute(e.g3));
        const V length = greater(greater(absolute(u.x), absolute(u.y)), absolute(u.z));
        active &= (length > last_step) & ((slope > flat) | ~moved) & (shrink > 1e-3);
    }
}
