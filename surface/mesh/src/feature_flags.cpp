#include "feature_flags.hpp"

#include <algorithm>

namespace octafield::surface::detail {

std::vector<bool> feature_flags(const FeatureGraph& features, const EdgeTopology& topology) {
    std::vector<std::pair<Index, Index>> listed(features.edges.rows());
    for (std::size_t i = 0; i < listed.size(); ++i)
        listed[i] = std::minmax({features.edges(i, 0), features.edges(i, 1)});
    std::sort(listed.begin(), listed.end());
    std::vector<bool> is_feature(topology.edges.rows());
    for (Index e = 0; e < topology.edges.rows(); ++e)
        is_feature[e] =
            topology.edge_triangles.row(e).minCoeff() < 0 ||
            std::binary_search(listed.begin(), listed.end(), std::pair(topology.edges(e, 0), topology.edges(e, 1)));
    return is_feature;
}

}  // namespace octafield::surface::detail
