#include "singular_curves.hpp"

#include <numeric>

namespace octafield::volume {
namespace {

class Chainer {
public:
    Chainer(const std::vector<Segment>& segments, Index point_count, const std::vector<std::uint8_t>& ends)
        : segments_(segments),
          ends_(ends),
          begin_(point_count + 1, 0),
          incident_(2 * segments.size()),
          used_(segments.size(), 0) {
        for (const Segment& s : segments)
            for (const Index p : s.ends) ++begin_[p + 1];
        std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
        std::vector<Index> next(begin_.begin(), begin_.end() - 1);
        for (std::size_t i = 0; i < segments.size(); ++i)
            for (const Index p : segments[i].ends) incident_[next[p]++] = static_cast<Index>(i);
    }

    CurveSet run() {
        for (Index p = 0; p + 1 < static_cast<Index>(begin_.size()); ++p) {
            if (!is_end(p)) continue;
            for (Index i = begin_[p]; i < begin_[p + 1]; ++i)
                if (!used_[incident_[i]]) walk(p, incident_[i]);
        }
        for (std::size_t s = 0; s < segments_.size(); ++s)
            if (!used_[s]) walk(segments_[s].ends[0], static_cast<Index>(s));
        return std::move(set_);
    }

private:
    bool is_end(Index p) const {
        return (!ends_.empty() && ends_[p]) || begin_[p + 1] - begin_[p] != 2 ||
               segments_[incident_[begin_[p]]].type != segments_[incident_[begin_[p] + 1]].type;
    }

    void walk(const Index start, Index segment) {
        std::vector<Index> curve{start};
        Index p = start;
        for (;;) {
            used_[segment] = 1;
            p = segments_[segment].ends[segments_[segment].ends[0] == p];
            curve.push_back(p);
            if (is_end(p) || p == start) break;
            segment = incident_[begin_[p] + (incident_[begin_[p]] == segment)];
        }
        set_.curves.push_back(std::move(curve));
        set_.types.push_back(segments_[segment].type);
    }

    const std::vector<Segment>& segments_;
    const std::vector<std::uint8_t>& ends_;
    std::vector<Index> begin_, incident_;  // segments at each point
    std::vector<std::uint8_t> used_;
    CurveSet set_;
};

}  // namespace

CurveSet chain_segments(const std::vector<Segment>& segments, Index point_count,
                        const std::vector<std::uint8_t>& ends) {
    return Chainer(segments, point_count, ends).run();
}

}  // namespace octafield::volume
