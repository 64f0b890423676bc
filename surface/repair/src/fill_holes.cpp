#include "fill_holes.hpp"

#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <set>

#include "half_edges.hpp"
#include "rims.hpp"
#include "surface_mesh.hpp"
#include "triangle_tests.hpp"

namespace octafield::surface {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Vertex = SurfaceMesh::Vertex_index;
using Face = SurfaceMesh::Face_index;
using Corners = std::array<Index, 3>;

// Triangles for one rim. Vertices from the mesh's number on are new, in the order of `points`.
struct Patch {
    std::vector<Eigen::RowVector3d> points;
    std::vector<Corners> triangles;
};

// The border halfedge of a rim, if CGAL sees the same loop.
SurfaceMesh::Halfedge_index border_of(const SurfaceMesh& surface, const Rim& rim) {
    const auto start = surface.halfedge(Vertex(rim.vertices[0]), Vertex(rim.vertices[1]));
    if (start == SurfaceMesh::null_halfedge() || !surface.is_border(start)) return SurfaceMesh::null_halfedge();
    std::size_t length = 0;
    auto side = start;
    do {
        side = surface.next(side);
    } while (++length <= rim.vertices.size() && side != start);
    return length == rim.vertices.size() ? start : SurfaceMesh::null_halfedge();
}

Patch patch_of(const SurfaceMesh& surface, const std::vector<Face>& faces, Index first_new) {
    Patch patch;
    std::map<Index, Index> new_id;
    for (const Face face : faces) {
        Corners corners{};
        int k = 0;
        for (const Vertex v : CGAL::vertices_around_face(surface.halfedge(face), surface)) {
            Index id = static_cast<Index>(v);
            if (id >= first_new) {
                const auto [place, fresh] = new_id.try_emplace(id, first_new + static_cast<Index>(patch.points.size()));
                const auto& point = surface.point(v);
                if (fresh) patch.points.emplace_back(point.x(), point.y(), point.z());
                id = place->second;
            }
            corners[k++] = id;
        }
        patch.triangles.push_back(corners);
    }
    return patch;
}

Patch smooth_patch(SurfaceMesh& surface, const Rim& rim, Index first_new) {
    const auto border = border_of(surface, rim);
    if (border == SurfaceMesh::null_halfedge()) return {};
    std::vector<Face> faces;
    std::vector<Vertex> vertices;
    const bool fair = std::get<0>(pmp::triangulate_refine_and_fair_hole(surface, border, std::back_inserter(faces),
                                                                        std::back_inserter(vertices)));
    return fair ? patch_of(surface, faces, first_new) : Patch{};
}

struct RimTriangle {
    RimTriangle(int a, int b, int c) : corners{a, b, c} {}
    std::array<int, 3> corners;
};

Patch plain_patch(const TriangleMesh& mesh, const Rim& rim) {
    const auto point = [&](Index v) {
        return Kernel::Point_3(mesh.vertices(v, 0), mesh.vertices(v, 1), mesh.vertices(v, 2));
    };
    std::vector<Kernel::Point_3> points, beyond;
    for (const Index v : rim.vertices) points.push_back(point(v));
    for (const Index v : rim.beyond) beyond.push_back(point(v));
    std::vector<RimTriangle> found;
    pmp::triangulate_hole_polyline(points, beyond, std::back_inserter(found));
    Patch patch;
    for (const auto& [c] : found)
        patch.triangles.push_back({rim.vertices[c[0]], rim.vertices[c[1]], rim.vertices[c[2]]});
    return patch;
}

bool has_equal_points(const TriangleMesh& mesh, const Rim& rim) {
    std::set<std::array<double, 3>> seen;
    return std::ranges::any_of(rim.vertices, [&](Index v) {
        return !seen.insert({mesh.vertices(v, 0), mesh.vertices(v, 1), mesh.vertices(v, 2)}).second;
    });
}

class Filling {
public:
    explicit Filling(TriangleMesh& mesh) : mesh_(mesh) {}

    // The rims whose patches cross nothing are filled; the others are returned.
    std::vector<Rim> fill(const std::vector<Rim>& rims, bool smooth, HoleFilling& done) {
        std::vector<Patch> patches = make(rims, smooth);
        std::vector<bool> good(rims.size());
        for (std::size_t i = 0; i < rims.size(); ++i) good[i] = !patches[i].triangles.empty();
        for (bool all_good = false; !all_good;) {
            const TriangleMesh filled = with(patches, good);
            all_good = reject_bad(filled, patches, good);
            if (all_good) accept(filled, patches, good, smooth, done);
        }
        std::vector<Rim> left;
        for (std::size_t i = 0; i < rims.size(); ++i)
            if (!good[i]) left.push_back(rims[i]);
        return left;
    }

private:
    std::vector<Patch> make(const std::vector<Rim>& rims, bool smooth) const {
        std::vector<Patch> patches(rims.size());
        SurfaceMesh surface;
        if (smooth && !to_surface_mesh(mesh_, surface)) return patches;
        for (std::size_t i = 0; i < rims.size(); ++i) {
            if (has_equal_points(mesh_, rims[i])) continue;
            if (smooth && (rims[i].pinched || wants_lid(mesh_, rims[i]))) continue;
            try {
                patches[i] = smooth ? smooth_patch(surface, rims[i], static_cast<Index>(mesh_.vertices.rows()))
                                    : plain_patch(mesh_, rims[i]);
            } catch (const CGAL::Failure_exception&) {
                patches[i] = {};
            }
        }
        return patches;
    }

    TriangleMesh with(const std::vector<Patch>& patches, const std::vector<bool>& good) const {
        const Index old_count = static_cast<Index>(mesh_.vertices.rows());
        std::vector<Eigen::RowVector3d> points;
        std::vector<Corners> triangles;
        for (std::size_t i = 0; i < patches.size(); ++i) {
            if (!good[i]) continue;
            const Index shift = static_cast<Index>(points.size());
            points.insert(points.end(), patches[i].points.begin(), patches[i].points.end());
            for (Corners corners : patches[i].triangles) {
                for (Index& v : corners) v += v >= old_count ? shift : 0;
                triangles.push_back(corners);
            }
        }
        TriangleMesh filled = mesh_;
        filled.vertices.conservativeResize(old_count + static_cast<Index>(points.size()), 3);
        for (std::size_t i = 0; i < points.size(); ++i)
            filled.vertices.row(old_count + static_cast<Index>(i)) = points[i];
        Index next = static_cast<Index>(mesh_.triangles.rows());
        filled.triangles.conservativeResize(next + static_cast<Index>(triangles.size()), 3);
        for (const auto& [a, b, c] : triangles) filled.triangles.row(next++) << a, b, c;
        return filled;
    }

    // Marks patches with triangles that cross others, have no area or share an edge with two others. True if none.
    bool reject_bad(const TriangleMesh& filled, const std::vector<Patch>& patches, std::vector<bool>& good) const {
        const Index first = static_cast<Index>(mesh_.triangles.rows());
        std::vector<Index> bad = intersecting_triangles(filled, first);
        for (Index t = first; t < filled.triangles.rows(); ++t)
            if (is_degenerate(filled, t)) bad.push_back(t);
        for_each_edge(sorted_half_edges(filled.triangles), [&](auto begin, auto end) {
            if (end - begin > 2)
                for (auto side = begin; side != end; ++side) bad.push_back(side->triangle);
        });
        std::vector<std::size_t> owner;
        for (std::size_t i = 0; i < patches.size(); ++i)
            if (good[i]) owner.insert(owner.end(), patches[i].triangles.size(), i);
        bool none = true;
        for (const Index t : bad) {
            if (t < first) continue;
            good[owner[t - first]] = false;
            none = false;
        }
        return none;
    }

    void accept(const TriangleMesh& filled, const std::vector<Patch>& patches, const std::vector<bool>& good,
                bool smooth, HoleFilling& done) {
        for (std::size_t i = 0; i < patches.size(); ++i)
            if (good[i]) ++(smooth && !patches[i].points.empty() ? done.smooth : done.plain);
        done.triangles += filled.triangles.rows() - mesh_.triangles.rows();
        done.vertices += filled.vertices.rows() - mesh_.vertices.rows();
        mesh_ = filled;
    }

    TriangleMesh& mesh_;
};

}  // namespace

HoleFilling fill_holes(TriangleMesh& mesh, int max_edges, bool smooth) {
    HoleFilling done;
    std::vector<Rim> rims = hole_rims(mesh);
    for (const Rim& rim : rims) done.largest = std::max(done.largest, rim.vertices.size());
    if (max_edges > 0)
        done.too_large = std::erase_if(
            rims, [&](const Rim& rim) { return rim.vertices.size() > static_cast<std::size_t>(max_edges); });
    Filling filling(mesh);
    if (smooth) rims = filling.fill(rims, true, done);
    done.unfillable = filling.fill(rims, false, done).size();
    return done;
}

}  // namespace octafield::surface
