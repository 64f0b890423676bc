// Whole numbers for quads of a size, or for a number of quads.
#pragma once

#include <optional>

#include "octafield/surface/quantized_quads.hpp"
#include "tile_arcs.hpp"

namespace octafield::surface::detail {

// Whole numbers on arcs and parts of seams.
struct SizedCounts {
    ArcCounts arcs;                // of the layout's sides
    std::vector<int> part_counts;  // of seams
    double size = 0, quads = 0;
};

class CountChooser {
public:
    CountChooser(const QuadLayout& layout, const Seams& seams, const QuantizedQuadsOptions& options)
        : layout_(layout), seams_(seams), options_(options) {}

    SizedCounts at_size(const ArcProblem& problem, double size) const;
    // As the options want it; a number of quads by sizes from a first one on, by the square root of what is missing,
    // between those with too many and too few. Throws InvalidInput (kind "bad_option").
    SizedCounts wanted(const ArcProblem& problem, double first) const;
    // Sides that are as long as one another go to another whole number at the same size, so that there may be none with
    // the number of quads wanted. Where `found` is off by more than 2 % and there are few arcs, numbers are sought that
    // have as many, counted linear in what they differ by from the nearest ones. Those that are nearer, and not much
    // more uneven, are taken. No more tracks become one than in `found`.
    SizedCounts nearer(ArcProblem problem, SizedCounts found) const;
    double first_size() const;
    double next_size(const SizedCounts& found) const;  // the same where the number of quads is near enough

private:
    SizedCounts with_quads(const ArcProblem& problem, double wanted, double size) const;
    // Whose quads, linear near those counts, are off by so many at most; none where there are none, or none are found.
    std::optional<SizedCounts> within(ArcProblem problem, const std::vector<int>& at, double most) const;
    bool is_better(const SizedCounts& found, const SizedCounts& than, double wanted) const;

    const QuadLayout& layout_;
    const Seams& seams_;
    const QuantizedQuadsOptions& options_;
};

// Both from a problem's solution, which has parts of seams and more behind the arcs.
SizedCounts counts_of(const QuadLayout& layout, const Seams& seams, ArcCounts arcs, double size);

}  // namespace octafield::surface::detail
