// Rotation of harmonics in steps, so that several degrees can share the angles of one rotation.
#pragma once

#include <array>

#include "octafield/frames/harmonics.hpp"

namespace octafield::frames {

// g = (turn by alpha about z) (by beta about y) (by gamma about z), by its cosines and sines of multiples.
struct EulerTurns {
    static constexpr int most = 9;
    struct Multiples {
        std::array<double, most + 1> cosine, sine;  // of m times the angle
    };
    Multiples alpha, beta, gamma;

    // Of g / |g|. Any split of the turn between alpha and gamma serves where beta is 0 or pi.
    explicit EulerTurns(const Quaternion& g);
};

// Harmonics<degree>::rotate without the checks of its input.
template <int degree>
typename Harmonics<degree>::Vector rotate_harmonics(const EulerTurns& turns,
                                                    const typename Harmonics<degree>::Vector& c);

}  // namespace octafield::frames
