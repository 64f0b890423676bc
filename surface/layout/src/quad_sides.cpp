#include "quad_sides.hpp"

#include <algorithm>
#include <string>
#include <tuple>

#include "octafield/error.hpp"

namespace octafield::surface::detail {

QuadSides::QuadSides(const Quads& given) : quads(given) {
    std::vector<std::tuple<Index, Index, Index>> sides;
    for (Index s = 0; s < 4 * quads.rows(); ++s) {
        const Index a = from(s), b = from(turned(s, 1));
        sides.emplace_back(std::min(a, b), std::max(a, b), s);
    }
    std::sort(sides.begin(), sides.end());
    mates.assign(sides.size(), -1);
    for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
        const auto& [a, b, s] = sides[i];
        const auto& [c, d, t] = sides[i + 1];
        if (a != c || b != d) continue;
        if (mates[s] >= 0 || from(s) == from(t))
            throw GeometryError("the edge of vertices " + std::to_string(a) + " and " + std::to_string(b) +
                                    " has more than two quads, or two that run along it in the same way",
                                "non_manifold_edge", {a, b});
        mates[s] = t;
        mates[t] = s;
    }
    const Index count = quads.size() > 0 ? quads.maxCoeff() + 1 : 0;
    out.resize(count);
    boundary.assign(count, false);
    for (Index s = 0; s < static_cast<Index>(mates.size()); ++s) {
        out[from(s)].push_back(s);
        if (mates[s] < 0) boundary[from(s)] = boundary[from(turned(s, 1))] = true;
    }
    for (Index v = 0; v < count; ++v)
        if (is_irregular(v)) irregular.push_back(v);
}

void require_only_quads(const QuadMesh& mesh) {
    if (mesh.triangles.rows() > 0)
        throw InvalidInput("the base complex is that of quads; the mesh has triangles", "not_quads");
    if (mesh.quads.size() > 0 && (mesh.quads.minCoeff() < 0 || mesh.quads.maxCoeff() >= mesh.vertices.rows()))
        throw GeometryError("quads name vertices that there are not", "index_out_of_range");
}

}  // namespace octafield::surface::detail
