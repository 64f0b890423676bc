#include "even_sides.hpp"

#include <algorithm>

#include "charts.hpp"
#include "layout_pieces.hpp"

namespace octafield::surface::detail {

QuadLayout with_lengths_for_parameters(const QuadLayout& layout) {
    QuadLayout result = layout;
    const LayoutPieces& pieces = *layout.pieces;
    const CutSurface& cut = pieces.cut;
    std::vector<Eigen::VectorXd> steps;  // of each side, between its points
    for (const LayoutSide& side : layout.sides)
        steps.emplace_back(Eigen::VectorXd::Zero(std::max<Eigen::Index>(side.points.rows() - 1, 0)));
    for (Index p = 0; p < cut.polygon_count(); ++p)
        for (Index c = cut.first[p]; c < cut.first[p + 1]; ++c) {
            if (pieces.chain_of_side[c] < 0) continue;
            const Eigen::Vector3d way = cut.positions.row(cut.nodes[cut.next(p, c)]) - cut.positions.row(cut.nodes[c]);
            const bool own = layout.domain.has_own_lengths();
            steps[pieces.chain_of_side[c]][pieces.part_of_side[c]] =
                own ? std::abs(vector_by_own_lengths(layout.domain, cut.triangles[p], way)) : way.norm();
        }
    for (std::size_t s = 0; s < steps.size(); ++s)
        for (Eigen::Index i = 0; i < steps[s].size(); ++i)
            result.sides[s].parameters[i + 1] = result.sides[s].parameters[i] + steps[s][i];
    result.curves.parameter_area = layout.domain.areas().sum();
    return result;
}

}  // namespace octafield::surface::detail
