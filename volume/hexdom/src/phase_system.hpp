// The quadratic form of the phases and its minimisation.
#pragma once

#include <complex>
#include <cstdint>
#include <vector>

#include "octafield/arrays.hpp"

namespace octafield::volume {

using Phases = std::vector<std::complex<double>>;

// sum over couplings of weight |z_b - turn z_a|^2, or |z_b - turn conj(z_a)|^2. Held unknowns are 1.
class PhaseSystem {
public:
    struct Coupling {
        Index a, b;
        bool conjugate;
        double weight;
        std::complex<double> turn;  // of modulus 1 or below: the mean over the tets at an edge
    };
    PhaseSystem(Index count, const std::vector<std::uint8_t>& held, const std::vector<Coupling>& couplings);

    // Solves (shift D + L) z = shift D start by conjugate gradients, D the diagonal of L; from `start`.
    void diffuse(double shift, double tolerance, Phases& z, int threads) const;
    // z / |z|; 1 where nothing is coupled.
    void normalize(Phases& z) const;
    Index free_count() const { return static_cast<Index>(free_.size()); }
    Phases start() const;  // 1 at held unknowns, 0 elsewhere
    // One free unknown per part that nothing held is coupled with, the lowest: its phase is arbitrary.
    const std::vector<Index>& arbitrary() const { return arbitrary_; }

private:
    // Products wait for the memory, and phases are wanted to 1e-3: 12 bytes.
    struct Entry {
        std::uint32_t code;  // twice the free unknown, and 1 where it is conjugated
        std::complex<float> value;
    };
    void times(double shift, const Phases& z, Phases& result, int threads) const;

    std::vector<Index> free_;  // unknown of each row
    std::vector<std::int64_t> begin_;
    std::vector<Entry> entries_;
    std::vector<double> diagonal_;
    Phases right_;  // of held neighbours
    std::vector<Index> arbitrary_;
    Index count_;
};

}  // namespace octafield::volume
