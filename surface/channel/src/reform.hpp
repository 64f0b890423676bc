// Groups of quads exchanged for better templates.
#pragma once

#include <functional>

#include "patch_filler.hpp"
#include "plane_quads.hpp"

namespace octafield::surface::detail {

class Reformer {
public:
    Reformer(PlaneQuads& quads, const PatchFiller& filler) : quads_(quads), filler_(filler) {}

    // Each quad in turn, the dearest first: of all groups with it that have a simple outline of a few sides the one
    // whose best template saves most is exchanged. Quads round which nothing was changed since they were tried are left
    // out. `ask` is called often and may throw. Returns how many groups were exchanged.
    Index round(const std::function<void()>& ask);
    // Vertices were moved: these quads are tried again.
    void touch(Index q);

private:
    struct Group {
        std::vector<Index> quads;
        std::vector<Index> outline;
        std::vector<Index> inner;  // vertices, all of them free
    };
    PlaneQuads& quads_;
    const PatchFiller& filler_;
    std::vector<char> tried_;

    std::vector<Group> groups(Index q) const;
    bool outlined(Group& group) const;
    Patch patch_of(const Group& group) const;
    double cost_of(const Group& group) const;
    bool exchange(Index q);
    void put(const Group& group, const Filling& filling);
};

}  // namespace octafield::surface::detail
