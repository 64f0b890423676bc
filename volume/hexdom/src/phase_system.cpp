#include "phase_system.hpp"

#include <algorithm>
#include <cmath>

#include "octafield/disjoint_sets.hpp"
#include "octafield/parallel.hpp"

namespace octafield::volume {
namespace {

using Complex = std::complex<double>;

// Real inner product of vectors of complex numbers: what is minimised is real. Serial, for the same bits at any number
// of threads.
double dot(const Phases& x, const Phases& y) {
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i) sum += x[i].real() * y[i].real() + x[i].imag() * y[i].imag();
    return sum;
}

constexpr int most_steps = 400;

// Free unknowns, breadth first from the lowest of each part, so that those that are coupled lie close in memory.
std::vector<Index> near_order(Index count, const std::vector<std::uint8_t>& held,
                              const std::vector<PhaseSystem::Coupling>& couplings) {
    std::vector<std::int64_t> begin(count + 1, 0);
    for (const PhaseSystem::Coupling& c : couplings)
        if (!held[c.a] && !held[c.b]) ++begin[c.a + 1], ++begin[c.b + 1];
    for (Index k = 0; k < count; ++k) begin[k + 1] += begin[k];
    std::vector<Index> others(begin.back());
    std::vector<std::int64_t> next(begin.begin(), begin.end() - 1);
    for (const PhaseSystem::Coupling& c : couplings)
        if (!held[c.a] && !held[c.b]) others[next[c.a]++] = c.b, others[next[c.b]++] = c.a;
    std::vector<Index> order;
    std::vector<std::uint8_t> reached = held;
    const auto reach = [&](Index k) {
        if (!reached[k]) order.push_back(k);
        reached[k] = 1;
    };
    std::size_t at = 0;
    for (Index first = 0; first < count; ++first)
        for (reach(first); at < order.size(); ++at)
            for (std::int64_t e = begin[order[at]]; e < begin[order[at] + 1]; ++e) reach(others[e]);
    return order;
}

}  // namespace

PhaseSystem::PhaseSystem(Index count, const std::vector<std::uint8_t>& held, const std::vector<Coupling>& couplings)
    : free_(near_order(count, held, couplings)), count_(count) {
    const std::size_t rows = free_.size();
    std::vector<Index> row(count, -1);
    for (std::size_t r = 0; r < rows; ++r) row[free_[r]] = static_cast<Index>(r);
    begin_.assign(rows + 1, 0);
    diagonal_.assign(rows, 0);
    right_.assign(rows, 0);
    for (const Coupling& c : couplings)
        if (row[c.a] >= 0 && row[c.b] >= 0) ++begin_[row[c.a] + 1], ++begin_[row[c.b] + 1];
    for (std::size_t r = 0; r < rows; ++r) begin_[r + 1] += begin_[r];
    entries_.resize(begin_.back());
    std::vector<std::int64_t> next(begin_.begin(), begin_.end() - 1);
    DisjointSets parts(rows + 1);  // the last: held
    for (const Coupling& c : couplings) {
        // z_b = turn z_a, z_a = conj(turn) z_b; z_b = turn conj(z_a), z_a = turn conj(z_b).
        const auto entry = [](Index column, bool conjugate, const Complex& value) {
            return Entry{2 * static_cast<std::uint32_t>(column) + conjugate, std::complex<float>(value)};
        };
        const Complex forth = c.weight * c.turn, back = c.weight * (c.conjugate ? c.turn : std::conj(c.turn));
        const Index a = row[c.a], b = row[c.b];
        if (a >= 0) diagonal_[a] += c.weight;
        if (b >= 0) diagonal_[b] += c.weight;
        if (a >= 0 && b >= 0) {
            entries_[next[b]++] = entry(a, c.conjugate, forth);
            entries_[next[a]++] = entry(b, c.conjugate, back);
            parts.join(a, b);
        } else if (a >= 0) {
            right_[a] += back;
            parts.join(a, static_cast<Index>(rows));
        } else if (b >= 0) {
            right_[b] += forth;
            parts.join(b, static_cast<Index>(rows));
        }
    }
    const Index held_part = parts.lowest(static_cast<Index>(rows));
    for (Index r = 0; r < static_cast<Index>(rows); ++r)
        if (parts.lowest(r) == r && r != held_part) arbitrary_.push_back(free_[r]);
}

Phases PhaseSystem::start() const {
    Phases z(count_, 1.0);
    for (const Index k : free_) z[k] = 0;
    return z;
}

void PhaseSystem::times(double shift, const Phases& z, Phases& result, int threads) const {
    parallel_for(static_cast<std::int64_t>(z.size()), threads, [&](std::int64_t r) {
        const double own = (1 + shift) * diagonal_[r];
        double real = own * z[r].real(), imag = own * z[r].imag();
        for (std::int64_t e = begin_[r]; e < begin_[r + 1]; ++e) {  // Complex's own product looks for infinities
            const Complex& other = z[entries_[e].code / 2];
            const double a = entries_[e].value.real(), b = entries_[e].value.imag(), c = other.real(),
                         d = entries_[e].code % 2 ? -other.imag() : other.imag();
            real -= a * c - b * d;
            imag -= a * d + b * c;
        }
        result[r] = {real, imag};
    });
}

void PhaseSystem::diffuse(double shift, double tolerance, Phases& all, int threads) const {
    const std::size_t rows = free_.size();
    Phases x(rows), r(rows), p(rows), q(rows), s(rows);
    for (std::size_t i = 0; i < rows; ++i) x[i] = all[free_[i]];
    times(shift, x, q, threads);
    for (std::size_t i = 0; i < rows; ++i) r[i] = right_[i] + shift * diagonal_[i] * x[i] - q[i];
    const auto precondition = [&] {
        for (std::size_t i = 0; i < rows; ++i) s[i] = diagonal_[i] > 0 ? r[i] / diagonal_[i] : 0;
    };
    precondition();
    p = s;
    double rho = dot(r, s);
    const double enough = tolerance * tolerance * rho;
    for (int step = 0; step < most_steps && rho > enough && rho > 0; ++step) {
        times(shift, p, q, threads);
        const double alpha = rho / dot(p, q);
        if (!std::isfinite(alpha)) break;
        for (std::size_t i = 0; i < rows; ++i) x[i] += alpha * p[i], r[i] -= alpha * q[i];
        precondition();
        const double next = dot(r, s);
        for (std::size_t i = 0; i < rows; ++i) p[i] = s[i] + next / rho * p[i];
        rho = next;
    }
    for (std::size_t i = 0; i < rows; ++i) all[free_[i]] = x[i];
}

void PhaseSystem::normalize(Phases& z) const {
    for (Complex& value : z) {
        const double size = std::abs(value);
        value = size > 1e-200 ? value / size : Complex(1);
    }
}

}  // namespace octafield::volume
