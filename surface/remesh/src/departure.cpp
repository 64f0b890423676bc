#include "departure.hpp"

#include <array>

namespace octafield::surface {
namespace {

using Vector = Eigen::Vector3d;

// The triangles as they are, with their patches.
Background as_ground(const Working& work) {
    Background now;
    const SurfaceMesh& mesh = work.marked.mesh;
    now.mesh.vertices.resize(mesh.num_vertices(), 3);
    now.mesh.triangles.resize(mesh.number_of_faces(), 3);
    now.patches = work.marked.patches;
    for (const Vertex v : mesh.vertices()) now.mesh.vertices.row(static_cast<Index>(v)) = work.at(v);
    for (const Face f : mesh.faces()) {
        int k = 0;
        for (const Vertex v : CGAL::vertices_around_face(mesh.halfedge(f), mesh))
            now.mesh.triangles(static_cast<Index>(now.patch.size()), k++) = static_cast<Index>(v);
        now.patch.push_back(work.marked.patch[f]);
    }
    return now;
}

}  // namespace

Departure departure_of_mesh(const Working& work, CloseRounds& rounds, const Background& ground, double told) {
    Departure found;
    const SurfaceMesh& mesh = work.marked.mesh;
    for (const Face f : mesh.faces()) {
        std::array<Vector, 3> at;
        int k = 0;
        for (const Vertex v : CGAL::vertices_around_face(mesh.halfedge(f), mesh)) at[k++] = work.at(v);
        for (const Vector& p : {Vector((at[0] + at[1] + at[2]) / 3), Vector((at[0] + at[1]) / 2),
                                Vector((at[1] + at[2]) / 2), Vector((at[2] + at[0]) / 2)})
            if (const auto place = rounds.place_near(work, f, p))
                found.add((place->point - p).norm(), told, ground.mesh.triangles.row(place->carrier.id));
    }
    return found;
}

Departure departure_of_input(const TriangleMesh& input, const Background& ground, const Working& work, double told) {
    Departure found;
    const Background now = as_ground(work);
    const GroundTrees trees(now);
    std::vector<bool> seen(input.vertices.rows(), false);
    for (Index t = 0; t < ground.mesh.triangles.rows(); ++t)
        for (const Index v : ground.mesh.triangles.row(t)) {
            if (v >= input.vertices.rows() || seen[v]) continue;
            seen[v] = true;
            const Vector p = input.vertices.row(v);
            found.add((trees.nearest(ground.patch[t], p).point - p).norm(), told, std::array{v});
        }
    return found;
}

double off_surface(const Working& work, const Background& ground) {
    const GroundTrees input(ground);
    double most = 0;
    for (const Vertex v : work.marked.mesh.vertices()) {
        const Vector p = work.at(v);
        most = std::max(most, (input.nearest(patch_at(work.marked, v), p).point - p).norm());
    }
    return most;
}

}  // namespace octafield::surface
