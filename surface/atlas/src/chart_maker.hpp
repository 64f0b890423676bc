// Charts of connected parts of a surface: cut open, relieved and split until they are as asked.
#pragma once

#include <vector>

#include "mapped_chart.hpp"
#include "octafield/progress.hpp"

namespace octafield::surface::detail {

class ChartMaker {
public:
    // barrier: by edge of the surface, whether charts end there.
    ChartMaker(const SurfaceDomain& domain, std::vector<bool> barrier, const AtlasOptions& options);

    // Connected parts between barriers, each ascending, by their first triangles.
    std::vector<std::vector<Index>> faces() const;
    // The face's charts.
    std::vector<MappedChart> charts(std::vector<Index> face);
    ChartMesh uncut(const std::vector<Index>& region) const;

private:
    bool as_asked(const MappedChart& chart) const;
    bool can_stay(const MappedChart& chart) const;
    MappedChart best_map(const std::vector<Index>& region, const ChartMesh& whole);
    void cut(const std::vector<Index>& edges, std::vector<Index>& all);

    const SurfaceDomain& domain_;
    std::vector<bool> barrier_, slit_;
    Eigen::VectorXd costs_;
    AtlasOptions options_;
};

}  // namespace octafield::surface::detail
