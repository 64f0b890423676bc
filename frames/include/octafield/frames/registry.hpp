// Run-time names of representations and metrics. A new one is added here and nowhere else.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "octafield/error.hpp"
#include "octafield/frames/odeco.hpp"
#include "octafield/frames/sh4.hpp"
#include "octafield/frames/sh469.hpp"
#include "octafield/frames/su2.hpp"
#include "octafield/frames/tensor4.hpp"

namespace octafield::frames {

template <Representation... R>
struct RepresentationList {
    // visit.template operator()<R>() for each.
    template <class Visitor>
    static void for_each(Visitor&& visit) {
        (visit.template operator()<R>(), ...);
    }
    static std::vector<std::string> names() { return {std::string(R::name)...}; }
    template <template <class...> class List>
    using In = List<R...>;
};

using Representations = RepresentationList<Sh4, Tensor4, Su2, Odeco, Sh469>;

// InvalidInput that names what is unknown and lists what is known.
[[noreturn]] void throw_unknown_name(std::string_view what, std::string_view name,
                                     const std::vector<std::string>& known);

// visit.template operator()<R>() for the representation of that name. Throws InvalidInput that lists the names.
template <class Visitor>
void with_representation(std::string_view name, Visitor&& visit) {
    bool found = false;
    Representations::for_each([&]<Representation R>() {
        if (R::name != name) return;
        found = true;
        visit.template operator()<R>();
    });
    if (!found) throw_unknown_name("representation", name, Representations::names());
}

// A distance of frames. Chordal ones are Euclidean distances of embeddings; `speed` is their ratio to the angle at
// small angles, or 0 where it depends on frame and direction.
struct Metric {
    std::string_view name;
    std::string_view description;
    double (*distance)(const Quaternion& p, const Quaternion& q);
    double speed;
};

// geodesic, then one per representation under its name (chordal), then su2_end, su2_symmetric, su2_midpoint,
// su2_geodesic.
const std::vector<Metric>& metrics();
const Metric& metric(std::string_view name);  // throws InvalidInput that lists the names

}  // namespace octafield::frames
