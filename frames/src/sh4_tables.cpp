#include <cassert>
#include <cmath>

#include "octafield/frames/octahedral_group.hpp"
#include "octafield/frames/sh4.hpp"
#include "sh4_basis.hpp"
#include "sh4_kernel.hpp"

namespace octafield::frames::sh4 {
namespace {

// With 0.34, 181 frames: none is farther from all of them than 0.232 radians.
constexpr double spacing = 0.34;  // of the cubes, radians; nearest neighbours are 0.294 apart
constexpr double covering_radius = 0.232;

// A body-centred cubic lattice of rotation vectors (the exponential map only shortens distances), as far as the frames
// nearest to the identity reach; of frames that coincide nearly across the faces of that region one is kept.
std::vector<Quaternion> cover() {
    std::vector<Quaternion> frames = {Quaternion::Identity()};
    constexpr int range = 9;
    const double largest = 1.0961 + spacing;
    for (int i = -range; i <= range; ++i)
        for (int j = -range; j <= range; ++j)
            for (int k = -range; k <= range; ++k) {
                if (((i ^ j) | (j ^ k)) & 1) continue;
                const Vector3 w = spacing / 2 * Vector3(i, j, k);
                if (w.norm() > largest) continue;
                const Quaternion q = exp(w);
                bool apart = distance(q, Quaternion::Identity()) > w.norm() - 0.5 * spacing;
                for (std::size_t f = 0; f < frames.size() && apart; ++f) apart = distance(q, frames[f]) > 0.5 * spacing;
                if (apart) frames.push_back(q);
            }
    return frames;
}

void fill_form(double (&form)[form_size][9]) {
    // Monomial (quartic.hpp) and number of index orders of each independent component.
    constexpr int monomial[form_size] = {0, 3, 10, 1, 6, 4, 11, 2, 7, 12, 8, 5};
    constexpr double orders[form_size] = {1, 6, 1, 4, 4, 12, 4, 4, 12, 6, 12, 6};
    const auto basis = axis_basis();
    for (int r = 0; r < form_size; ++r)
        for (int c = 0; c < 9; ++c) form[r][c] = basis(c, monomial[r]) / orders[r];
}

}  // namespace

const Tables& tables() {
    static const Tables ready = [] {
        Tables t;
        fill_form(t.form);
        const auto frames = cover();
        std::vector<Sh4::Vector> embedded;
        for (const Quaternion& q : frames) {
            embedded.push_back(Sh4::embed(q));
            for (const double c : {q.w(), q.x(), q.y(), q.z()}) t.frames.push_back(c);
            t.embedded.insert(t.embedded.end(), embedded.back().begin(), embedded.back().end());
        }
        for (std::size_t i = 0; i < frames.size(); ++i) {
            for (std::size_t j = 0; j < frames.size(); ++j)
                if (i != j && distance(frames[i], frames[j]) < 0.9 * spacing)
                    t.neighbours.push_back(static_cast<int>(j));
            assert(t.neighbours.size() <= (i + 1) * neighbours_each);
            t.neighbours.resize((i + 1) * neighbours_each, static_cast<int>(i));
        }
        // |F''| <= sqrt(16 20/3) (sh4_certificate.cpp) bounds what F loses from a maximum to the nearest frame.
        t.margin = 0.5 * std::sqrt(16 * 20.0 / 3) * covering_radius * covering_radius;
        return t;
    }();
    return ready;
}

double unit_form(const double* v, double (&form)[form_size]) {
    const Eigen::Map<const Sh4::Vector> input(v);
    const double largest = input.cwiseAbs().maxCoeff();
    const Sh4::Vector scaled = largest > 0 ? Sh4::Vector(input / largest) : Sh4::Vector::Zero();
    const double norm = scaled.norm();
    for (int r = 0; r < form_size; ++r) {
        form[r] = 0;
        for (int c = 0; c < 9; ++c) form[r] += tables().form[r][c] * (norm > 0 ? scaled[c] / norm : 0.0);
    }
    return norm * largest;
}

}  // namespace octafield::frames::sh4
