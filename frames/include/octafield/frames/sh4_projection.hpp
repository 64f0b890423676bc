// Nearest frames of sh4 vectors in batches, and with a proof that no frame is nearer.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "octafield/frames/sh4.hpp"

namespace octafield::frames {

// Sh4::project on n rows. v: (n, 9) row-major, any scale; guess: (n, 4) quaternions wxyz of any length but zero, or
// null; frames (n, 4): unit quaternions wxyz; distances (n). A row's result does not depend on the other rows, and has
// the same bits as Sh4::project, in any order, split into any blocks, by any of sh4_instruction_sets(). One thread.
//
// The frame is a local maximum of F(q) = v . embed(q), to rounding. Where F(q) >= sqrt(7/12) |v| it is the global
// one (Federer's reach, frames/src/sh4_kernel.hpp): then one ascent from the guess, or from the best of a cover
// of SO(3)/O, is all the work. Other inputs take ascents from every local maximum on the cover, then to both sides of
// every soft maximum reached; that this finds the global maximum is measured, not proven (sh4_project_certified proves
// it input by input). Of equally near frames, the guess's or else the first found in the cover's fixed order is kept.
// Throws InvalidInput, with row numbers, if a row of v or a guess has a NaN or an infinity, or a guess is zero.
void sh4_project(const double* v, const double* guess, std::int64_t n, double* frames, double* distances);

// The same by the code for one instruction set of sh4_instruction_sets(): the bits are the same, the speed is not.
void sh4_project(const double* v, const double* guess, std::int64_t n, double* frames, double* distances,
                 std::string_view instruction_set);
// Of those compiled in, what this processor runs, the widest first: "avx512", "avx2", "base". The first is the default.
std::vector<std::string_view> sh4_instruction_sets();

struct CertifiedProjection {
    Projection projection;
    double gap = 0;          // no frame has v . embed(frame) above that of `projection` by more than gap |v|
    bool certified = false;  // gap <= gap_tolerance; false only if the boxes allowed did not suffice
    bool improved = false;   // the search found a frame better than sh4_project's by more than the tolerance
    std::int64_t boxes = 0;  // boxes of SO(3)/O bounded
};

// Branch and bound over SO(3)/O from the frame of sh4_project (frames/src/sh4_certificate.cpp states the bounds and
// their proof). gap_tolerance: relative to |v|, in (0, 1); below 1e-12 it acts as 1e-12, the reach of rounding. Throws
// InvalidInput if v is not finite or the tolerance out of range.
CertifiedProjection sh4_project_certified(const Sh4::Vector& v, double gap_tolerance = 1e-9,
                                          std::int64_t most_boxes = 2000000);

}  // namespace octafield::frames
