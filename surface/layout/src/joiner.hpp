// Separatrices joined to the curves of a layout.
#pragma once

#include <set>
#include <tuple>
#include <utility>

#include "octafield/progress.hpp"
#include "separatrix_tracer.hpp"

namespace octafield::surface::detail {

// Traces separatrices and joins them, short ones first: what lies behind a point is not reached through it. So each is
// traced only as far as it has not been joined.
class Joiner {
public:
    // `of_points`: only those of the points where it is true; empty: all.
    Joiner(const SeparatrixTracer& tracer, const LayoutPoints& points, double max_length,
           const std::vector<bool>& of_points = {});

    Index count() const { return count_; }                           // of all
    Index open() const { return static_cast<Index>(open_.size()); }  // not joined
    double joined_length() const { return joined_length_; }          // of the curves that are joined

    // Those that are not joined, up to `reach`. False where all have been traced to their ends.
    bool trace(double reach, const Progress& progress = {});
    // Those that pass one another's points within `reach`.
    void join(double reach);
    // All, those that were not joined last; returns where those start that did not end.
    std::vector<Index> take_curves(std::vector<LayoutCurve>& result);

private:
    const SeparatrixTracer& tracer_;
    const LayoutPoints& points_;
    double max_length_, traced_ = 0, joined_length_ = 0;
    Index count_ = 0;
    std::vector<std::pair<Slot, Trace>> open_;
    std::set<Slot> taken_;
    std::set<std::tuple<double, Slot, Slot>> tried_;
    std::vector<LayoutCurve> joined_;
};

}  // namespace octafield::surface::detail
