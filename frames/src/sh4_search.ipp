// The search over the lanes of sh4_ascent.ipp: guesses, then starts from a cover of SO(3)/O, then from soft maxima.

struct Work {
    int n = 0;
    double unit[9][chunk], size[chunk], form[form_size][chunk];
    double q[4][chunk], value[chunk];  // the best so far
};

// Starts of ascents, then what they reached.
struct Starts {
    static constexpr int per_input = 48, most = chunk * per_input + lanes;
    int count = 0, input[most], of_input[chunk] = {};
    double q[4][most], value[most], curvature[most], hessian[6][most];

    void clear() {
        count = 0;
        for (int& n : of_input) n = 0;
    }
    void add(int i, double w, double x, double y, double z) {
        if (of_input[i] == per_input) return;
        ++of_input[i];
        input[count] = i, q[0][count] = w, q[1][count] = x, q[2][count] = y, q[3][count] = z;
        ++count;
    }
};

inline Form gather_form(const Work& work, const int* input) {
    Form t;
    V* const component = &t.xxxx;
    for (int c = 0; c < form_size; ++c) component[c] = gather(work.form[c], input);
    return t;
}

// Unit vectors and their forms. Scaled by the largest entry first, so that no square overflows or underflows.
inline void prepare(const Tables& tables, const double* v, Work& work) {
    const int groups = (work.n + lanes - 1) / lanes;
    for (int i = 0; i < groups * lanes; ++i)
        for (int c = 0; c < 9; ++c) work.unit[c][i] = i < work.n ? v[9 * i + c] : 0;
    for (int first = 0; first < work.n; first += lanes) {
        V x[9], largest = V{};
        for (int c = 0; c < 9; ++c) x[c] = load(&work.unit[c][first]), largest = greater(largest, absolute(x[c]));
        const V divisor = select(largest > 0.0, largest, all(1.0));
        V squares = V{};
        for (int c = 0; c < 9; ++c) x[c] /= divisor, squares += x[c] * x[c];
        const V norm = root(squares), inverse = 1.0 / select(largest > 0.0, norm, all(1.0));
        for (int c = 0; c < 9; ++c) x[c] *= inverse, store(&work.unit[c][first], x[c]);
        const V size = norm * largest;
        store(&work.size[first], select(size < __DBL_MAX__, size, all(__DBL_MAX__)));
        V t[form_size];
        for (int r = 0; r < 9; ++r) {
            t[r] = V{};
            for (int c = 0; c < 9; ++c) t[r] += tables.form[r][c] * x[c];
        }
        t[9] = -(t[1] + t[2]), t[10] = -(t[3] + t[4]), t[11] = -(t[0] + t[1]);
        for (int r = 0; r < form_size; ++r) store(&work.form[r][first], t[r]);
    }
}

// Runs all starts and keeps the best per input; the first of equally good ones, so that rounding does not choose.
inline void run(Starts& starts, Work& work) {
    for (int pad = 0; pad < lanes; ++pad) {
        starts.input[starts.count + pad] = starts.input[starts.count - 1];
        for (int c = 0; c < 4; ++c) starts.q[c][starts.count + pad] = starts.q[c][starts.count - 1];
    }
    for (int first = 0; first < starts.count; first += lanes) {
        const Form t = gather_form(work, starts.input + first);
        Frame q = {load(&starts.q[0][first]), load(&starts.q[1][first]), load(&starts.q[2][first]),
                   load(&starts.q[3][first])};
        Expansion e;
        ascend(t, q, e);
        store(&starts.q[0][first], q.w), store(&starts.q[1][first], q.x);
        store(&starts.q[2][first], q.y), store(&starts.q[3][first], q.z);
        store(&starts.value[first], e.value), store(&starts.curvature[first], largest_eigenvalue(e));
        const V* const h = &e.h11;
        for (int c = 0; c < 6; ++c) store(&starts.hessian[c][first], h[c]);
    }
    for (int k = 0; k < starts.count; ++k) {
        const int i = starts.input[k];
        if (!(starts.value[k] > work.value[i] + 1e-12)) continue;
        work.value[i] = starts.value[k];
        for (int c = 0; c < 4; ++c) work.q[c][i] = starts.q[c][k];
    }
}

// Unit eigenvector for the eigenvalue `value` of start k's Hessian: the longest column of the adjugate of H - value.
inline void soft_direction(const Starts& starts, int k, double value, double* direction) {
    const double a = starts.hessian[0][k] - value, b = starts.hessian[1][k] - value, c = starts.hessian[2][k] - value;
    const double f = starts.hessian[3][k], g = starts.hessian[4][k], h = starts.hessian[5][k];
    const double columns[3][3] = {{b * c - f * f, f * g - h * c, h * f - b * g},
                                  {f * g - h * c, a * c - g * g, g * h - a * f},
                                  {h * f - b * g, g * h - a * f, a * b - h * h}};
    double longest = -1;
    for (const auto& x : columns) {
        const double squares = x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
        if (squares <= longest) continue;
        longest = squares;
        const double norm = __builtin_sqrt(squares);
        for (int i = 0; i < 3; ++i) direction[i] = norm > 0 ? x[i] / norm : i == 0;
    }
}

// Cosine and sine of half of 0.3, -0.3, 0.6, -0.6 radians, then of 60, 90 ... 300 degrees.
constexpr int both_sides = 4, whole_circle = 13;
constexpr double half_turns[whole_circle][2] = {{0.98877107793604224, 0.14943813247359922},
                                                {0.98877107793604224, -0.14943813247359922},
                                                {0.95533648912560598, 0.29552020666133955},
                                                {0.95533648912560598, -0.29552020666133955},
                                                {0.86602540378443871, 0.49999999999999994},
                                                {0.70710678118654757, 0.70710678118654746},
                                                {0.50000000000000011, 0.8660254037844386},
                                                {0.25881904510252074, 0.96592582628906831},
                                                {6.123233995736766e-17, 1},
                                                {-0.25881904510252085, 0.96592582628906831},
                                                {-0.49999999999999978, 0.86602540378443871},
                                                {-0.70710678118654746, 0.70710678118654757},
                                                {-0.86602540378443871, 0.49999999999999994}};

// Maxima too near each other for the cover to tell apart are soft: along their join the second derivative changes sign
// within a distance in which the third is bounded. So from every soft maximum of nearly the best value, starts to both
// sides along its softest direction, and all round where maximisers nearly form a closed curve.
inline void explore(const Starts& found, const Work& work, Starts& starts) {
    constexpr int remembered = 4;            // maxima of different value explored per input
    constexpr double soft = 2, ridge = 0.3;  // least curvatures; at the frame nearest to its own vector it is 20/3
    constexpr double nearly_best = 0.05;
    double seen[chunk][remembered];
    int seen_count[chunk] = {};
    for (int k = 0; k < found.count; ++k) {
        const int i = found.input[k];
        if (work.value[i] >= sure_value || found.curvature[k] < -soft) continue;
        if (found.value[k] < work.value[i] - nearly_best) continue;
        bool again = seen_count[i] == remembered;
        for (int s = 0; s < seen_count[i]; ++s) again |= __builtin_fabs(seen[i][s] - found.value[k]) < 1e-11;
        if (again) continue;
        seen[i][seen_count[i]++] = found.value[k];
        double e[3] = {};
        soft_direction(found, k, found.curvature[k], e);
        const double w = found.q[0][k], x = found.q[1][k], y = found.q[2][k], z = found.q[3][k];
        const int turns = found.curvature[k] > -ridge ? whole_circle : both_sides;
        for (int n = 0; n < turns; ++n) {
            const double* const turn = half_turns[n];
            const double c = turn[0], u = turn[1] * e[0], v = turn[1] * e[1], t = turn[1] * e[2];
            starts.add(i, w * c - x * u - y * v - z * t, w * u + x * c + y * t - z * v, w * v - x * t + y * c + z * u,
                       w * t + x * v - y * u + z * c);
        }
    }
}

// Starts for the inputs list[0 .. lanes): the best frame of the cover if its score already decides (sure_value), else
// all frames of the cover that score higher than their neighbours and could lie next to the global maximum.
inline void scan(const Tables& tables, const int* list, int count, double* scores, const Work& work, Starts& starts) {
    const int size = tables.size();
    V x[9];
    for (int c = 0; c < 9; ++c) x[c] = gather(work.unit[c], list);
    V best = all(-2.0), where = V{};
    for (int i = 0; i < size; ++i) {
        const double* const a = &tables.embedded[9 * i];
        const V s = ((a[0] * x[0] + a[1] * x[1]) + (a[2] * x[2] + a[3] * x[3])) +
                    ((a[4] * x[4] + a[5] * x[5]) + (a[6] * x[6] + a[7] * x[7])) + a[8] * x[8];
        store(scores + lanes * i, s);
        const Mask better = s > best;
        best = select(better, s, best), where = select(better, all(i), where);
    }
    const auto add = [&](int i, int l) {
        const double* const q = &tables.frames[4 * i];
        starts.add(list[l], q[0], q[1], q[2], q[3]);
    };
    for (int l = 0; l < count; ++l)
        if (best[l] >= sure_value) add(static_cast<int>(where[l]), l);
    if (!any(best < sure_value)) return;
    const V lowest = select(best >= sure_value, all(2.0), best - tables.margin);
    for (int i = 0; i < size; ++i) {
        const V s = load(scores + lanes * i);
        const int* const neighbour = &tables.neighbours[neighbours_each * i];
        V around[2] = {lowest, lowest};
        for (int k = 0; k < neighbours_each; ++k)
            around[k % 2] = greater(around[k % 2], load(scores + lanes * neighbour[k]));
        const unsigned lanes_at_peak = bits(s >= greater(around[0], around[1]));
        for (int l = 0; l < count && lanes_at_peak >> l; ++l)
            if (lanes_at_peak >> l & 1) add(i, l);
    }
}

// Unit quaternions, and the distance |v - embed(q)| from the parts of v in the tangent and normal space: no digits
// cancel when v lies on the variety. The parts are those of value, gradient and Hessian: with s = |v|,
// |v - a|^2 = (s F - 1)^2 + s^2 (3/20 |g|^2 + 3/280 sum_i d_i^2 + 3/35 sum_i<j h_ij^2), d the trace-free diagonal.
inline void finish(Work& work, double* frames, double* distances) {
    for (int first = 0; first < work.n; first += lanes) {
        int input[lanes];
        for (int l = 0; l < lanes; ++l) input[l] = first + l < work.n ? first + l : work.n - 1;
        const Form t = gather_form(work, input);
        V c[4];
        for (int k = 0; k < 4; ++k) c[k] = gather(work.q[k], input);
        const V inverse = 1.0 / root(c[0] * c[0] + c[1] * c[1] + c[2] * c[2] + c[3] * c[3]);
        for (int k = 0; k < 4; ++k) c[k] *= inverse;
        const Expansion e = expand(t, {c[0], c[1], c[2], c[3]});
        const V third = e.value * (20.0 / 3);
        const V d1 = e.h11 + third, d2 = e.h22 + third, d3 = e.h33 + third;
        const V rest = 0.15 * (e.g1 * e.g1 + e.g2 * e.g2 + e.g3 * e.g3) + (3.0 / 280) * (d1 * d1 + d2 * d2 + d3 * d3) +
                       (3.0 / 35) * (e.h23 * e.h23 + e.h31 * e.h31 + e.h12 * e.h12);
        const V s = gather(work.size, input);
        const V large = greater(s, all(1.0)), ratio = s / large;
        const V along = ratio * e.value - 1.0 / large;
        const V distance = large * root(along * along + ratio * ratio * rest);
        for (int l = 0; l < lanes && first + l < work.n; ++l) {
            for (int k = 0; k < 4; ++k) frames[4 * (first + l) + k] = c[k][l];
            distances[first + l] = distance[l];
        }
    }
}

// Of any length: brought to where squares neither overflow nor underflow.
inline void add_guess(Starts& starts, int i, const double* q) {
    double largest = 0;
    for (int c = 0; c < 4; ++c) largest = __builtin_fabs(q[c]) > largest ? __builtin_fabs(q[c]) : largest;
    const double divisor = largest > 1e-10 && largest < 1e10 ? 1 : largest;
    starts.add(i, q[0] / divisor, q[1] / divisor, q[2] / divisor, q[3] / divisor);
}

void project(const Tables& tables, const double* v, const double* guess, int n, double* frames, double* distances) {
    Work work;
    work.n = n;
    prepare(tables, v, work);
    Starts starts, more;
    for (int i = 0; i < n; ++i) {
        work.value[i] = work.size[i] > 0 ? -2 : 1;
        for (int c = 0; c < 4; ++c) work.q[c][i] = c == 0;
        const double* const q = guess ? guess + 4 * i : nullptr;
        if (q && work.size[i] > 0) add_guess(more, i, q);
    }
    if (more.count > 0) run(more, work);
    int open[chunk + lanes], count = 0;
    for (int i = 0; i < n; ++i)
        if (work.value[i] < sure_value) open[count++] = i;
    if (count > 0) {
        more.clear();
        double* const scores = new double[lanes * tables.embedded.size() / 9];
        for (int pad = 0; pad < lanes; ++pad) open[count + pad] = open[count - 1];
        for (int k = 0; k < count; k += lanes)
            scan(tables, open + k, count - k < lanes ? count - k : lanes, scores, work, starts);
        delete[] scores;
        run(starts, work);
        explore(starts, work, more);
        if (more.count > 0) run(more, work);
    }
    finish(work, frames, distances);
}

void expand_all(const double* form, const double* q, std::int64_t n, std::int64_t stride, double* expansion) {
    Form t;
    V* const component = &t.xxxx;
    for (int c = 0; c < form_size; ++c) component[c] = all(form[c]);
    for (std::int64_t first = 0; first < n; first += lanes) {
        const Frame f = {load(q + first), load(q + stride + first), load(q + 2 * stride + first),
                         load(q + 3 * stride + first)};
        const Expansion e = expand(t, f);
        const V* const part = &e.value;
        for (int i = 0; i < 10; ++i) store(expansion + i * stride + first, part[i]);
    }
}

void climb_one(const double* form, double* q) {
    Form t;
    V* const component = &t.xxxx;
    for (int c = 0; c < form_size; ++c) component[c] = all(form[c]);
    Frame f = {all(q[0]), all(q[1]), all(q[2]), all(q[3])};
    Expansion e;
    ascend(t, f, e);
    const V inverse = 1.0 / root(f.w * f.w + f.x * f.x + f.y * f.y + f.z * f.z);
    q[0] = (f.w * inverse)[0], q[1] = (f.x * inverse)[0], q[2] = (f.y * inverse)[0], q[3] = (f.z * inverse)[0];
}
