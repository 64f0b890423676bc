#include "mesh_builder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "octafield/error.hpp"

namespace octafield::surface {

void MeshBuilder::fail(const std::string& what, std::int64_t place) const {
    throw IoError("cannot read " + file_ + ": " + (place > 0 ? unit_ + " " + std::to_string(place) + ": " : "") + what,
                  "unreadable");
}

void MeshBuilder::check_announced(std::int64_t count, const std::string& what, std::int64_t least_bytes_each,
                                  std::int64_t bytes_left, std::int64_t place) const {
    if (count < 0 || count > bytes_left / std::max<std::int64_t>(least_bytes_each, 1))
        fail("the header announces " + std::to_string(count) + " " + what + ", but only " + std::to_string(bytes_left) +
                 " bytes follow; the file is truncated or the header is wrong",
             place);
}

void MeshBuilder::add_vertex(double x, double y, double z, std::int64_t place) {
    if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z))
        fail("a coordinate of vertex " + std::to_string(vertex_count()) + " (0-based) is not finite", place);
    coordinates_.insert(coordinates_.end(), {x, y, z});
}

void MeshBuilder::add_polygon(std::span<const std::int64_t> ids, std::int64_t place) {
    if (ids.size() < 3) fail("a face has " + std::to_string(ids.size()) + " vertices; it needs at least 3", place);
    for (std::size_t k = 2; k < ids.size(); ++k) {
        corners_.insert(corners_.end(), {ids[0], ids[k - 1], ids[k]});
        triangle_places_.push_back(place);
    }
}

TriangleMesh MeshBuilder::finish(std::int64_t first_id) const {
    const std::int64_t vertices = vertex_count(), triangles = static_cast<std::int64_t>(triangle_places_.size());
    if (triangles == 0) fail("it has no triangles");
    const std::int64_t most = std::numeric_limits<Index>::max() / 3;  // edges and corners must fit an Index, too
    if (vertices > most || triangles > most)
        fail("it has more than " + std::to_string(most) + " vertices or triangles");
    TriangleMesh mesh;
    mesh.vertices = Eigen::Map<const Points>(coordinates_.data(), vertices, 3);
    mesh.triangles.resize(triangles, 3);
    for (std::int64_t i = 0; i < 3 * triangles; ++i) {
        const std::int64_t id = corners_[i];
        if (id < 0 || id >= vertices)
            fail("a face uses vertex " + std::to_string(id + first_id) + ", but the vertices are " +
                     std::to_string(first_id) + " to " + std::to_string(vertices - 1 + first_id),
                 triangle_places_[i / 3]);
        mesh.triangles(i / 3, i % 3) = static_cast<Index>(id);
    }
    return mesh;
}

}  // namespace octafield::surface
