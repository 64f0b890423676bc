#include "octafield/surface/feature_needles.hpp"

#include <algorithm>
#include <optional>

namespace octafield::surface {
namespace {

// Corners at a vertex between two feature edges, counter-clockwise.
struct Sector {
    Index tip;
    double angle = 0;
    std::vector<Index> corners;
};

class Blunter {
public:
    Blunter(const SurfaceDomain& domain, double least_angle)
        : domain_(domain),
          least_angle_(least_angle),
          is_feature_(domain.is_feature()),
          taken_(domain.vertex_count(), false) {}

    BluntedFeatures result() && {
        std::vector<Index> tips;
        for (const auto& fan : domain_.fans().fans) {
            const std::vector<Sector> sectors = sectors_of(fan);
            const std::size_t features = sectors.size() + (fan.closed ? 0 : 1);
            if (features < (fan.closed ? 2 : 3)) continue;
            const auto sharpest = std::min_element(sectors.begin(), sectors.end(),
                                                   [](const Sector& a, const Sector& b) { return a.angle < b.angle; });
            if (sharpest->angle < least_angle_ && blunt(*sharpest, features == 2)) tips.push_back(fan.vertex);
        }
        if (tips.empty()) return {domain_, {}};
        Edges edges(std::count(is_feature_.begin(), is_feature_.end(), true), 2);
        Index row = 0;
        for (Index e = 0; e < domain_.edge_count(); ++e)
            if (is_feature_[e]) edges.row(row++) = domain_.topology().edges.row(e);
        return {domain_.with_features(feature_graph(domain_.mesh(), edges)), std::move(tips)};
    }

private:
    Index before(Index corner) const { return domain_.topology().triangle_edges(corner / 3, corner % 3); }
    Index after(Index corner) const { return domain_.topology().triangle_edges(corner / 3, (corner % 3 + 2) % 3); }
    Index opposite(Index corner) const { return domain_.topology().triangle_edges(corner / 3, (corner % 3 + 1) % 3); }

    std::vector<Sector> sectors_of(const VertexFans::Fan& fan) const {
        std::vector<Index> corners(domain_.fans().corners.begin() + fan.first,
                                   domain_.fans().corners.begin() + fan.last);
        const auto first = std::find_if(corners.begin(), corners.end(),
                                        [&](Index corner) { return domain_.is_feature()[before(corner)]; });
        if (first == corners.end()) return {};
        std::rotate(corners.begin(), first, corners.end());
        std::vector<Sector> sectors;
        for (const Index corner : corners) {
            if (domain_.is_feature()[before(corner)]) sectors.push_back({fan.vertex, 0, {}});
            sectors.back().angle += domain_.corner_angles()(corner / 3, corner % 3);
            sectors.back().corners.push_back(corner);
        }
        return sectors;
    }

    // At a hairpin, where one feature turns back, both edges go: either by itself would end at the tip.
    bool blunt(const Sector& sector, bool hairpin) {
        std::vector<Index> vertices = {sector.tip};
        for (const Index corner : sector.corners) {
            if (domain_.is_feature()[opposite(corner)]) return false;
            for (int k = 1; k < 3; ++k) vertices.push_back(domain_.mesh().triangles(corner / 3, (corner % 3 + k) % 3));
        }
        if (std::any_of(vertices.begin(), vertices.end(), [&](Index v) { return taken_[v]; })) return false;
        const Index first = before(sector.corners.front()), last = after(sector.corners.back());
        std::optional<Index> gone;
        for (const Index e : {first, last}) {
            if (domain_.topology().edge_triangles.row(e).minCoeff() < 0) continue;  // the boundary stays
            if (!gone || domain_.edge_lengths()[e] < domain_.edge_lengths()[*gone]) gone = e;
        }
        if (!gone) return false;
        for (const Index v : vertices) taken_[v] = true;
        is_feature_[*gone] = false;
        if (hairpin) is_feature_[first] = is_feature_[last] = false;
        for (const Index corner : sector.corners) is_feature_[opposite(corner)] = true;
        return true;
    }

    const SurfaceDomain& domain_;
    double least_angle_;
    std::vector<bool> is_feature_, taken_;
};

}  // namespace

BluntedFeatures blunted_features(const SurfaceDomain& domain, double least_angle) {
    return Blunter(domain, least_angle).result();
}

}  // namespace octafield::surface
