// Charts of connected parts of a surface: cut open, relieved and split until they are as asked.
#pragma once

#include <vector>

#include "mapped_chart.hpp"
#include "octafield/progress.hpp"

namespace octafield::surface::detail {

class ChartMaker {
public:
    // barrier: by edge of the surface, whether charts end there. progress: told of `phase` before each map.
    ChartMaker(const SurfaceDomain& domain, std::vector<bool> barrier, const AtlasOptions& options,
               const Progress& progress, const char* phase);

    // Connected parts between barriers, each ascending, by their first triangles.
    std::vector<std::vector<Index>> faces() const;
    // Of the region, whose triangles ascend.
    std::vector<MappedChart> charts(const std::vector<Index>& region);
    ChartMesh uncut(const std::vector<Index>& region) const;

private:
    // 1: as asked; below 0: not one-to-one.
    double merit(const MappedChart& chart) const;
    bool as_asked(const MappedChart& chart) const;
    MappedChart best_map(const std::vector<Index>& region, const ChartMesh& whole);
    void tell() const;
    void cut(const std::vector<Index>& edges, std::vector<Index>& all);

    const SurfaceDomain& domain_;
    std::vector<bool> barrier_, slit_;
    Eigen::VectorXd costs_;
    AtlasOptions options_;
    const Progress& progress_;
    const char* phase_;
    double done_ = 0;  // triangles
};

}  // namespace octafield::surface::detail
