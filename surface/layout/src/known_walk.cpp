#include "known_walk.hpp"

namespace octafield::surface::detail {

KnownWalk::KnownWalk(const SeparatrixTracer& tracer, const Slot& slot) : tracer_(tracer), walk_(tracer.begin(slot)) {}

bool KnownWalk::goes_on(Index triangles) {
    if (triangles < triangle_count()) return true;
    if (!tracer_.step(walk_)) return false;
    if (found_.empty() ? !walk_.found.empty() : walk_.found != found_.back().points)
        found_.push_back({triangle_count(), walk_.found});
    return true;
}

std::vector<Passing> KnownWalk::passing(Index triangles) const {
    for (auto found = found_.rbegin(); found != found_.rend(); ++found)
        if (found->triangles <= triangles) return by_slot(found->points);
    return {};
}

}  // namespace octafield::surface::detail
