#include "octafield/surface/quad_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "octafield/error.hpp"

namespace octafield::surface {
namespace {

using Vector = Eigen::Vector3d;

// A row of vertex ids of either kind.
struct Face {
    const Index* ids;
    int corners;
};

Face face(const QuadMesh& mesh, Index f) {
    const Index triangles = static_cast<Index>(mesh.triangles.rows());
    return f < triangles ? Face{mesh.triangles.row(f).data(), 3} : Face{mesh.quads.row(f - triangles).data(), 4};
}

// The side that leaves corner k, counter-clockwise.
Vector side(const QuadMesh& mesh, const Face& face, int k) {
    return mesh.vertices.row(face.ids[(k + 1) % face.corners]) - mesh.vertices.row(face.ids[k]);
}

// Twice the area that the sides at corner k span.
Vector corner_area(const QuadMesh& mesh, const Face& face, int k) {
    return side(mesh, face, (k + face.corners - 1) % face.corners).cross(side(mesh, face, k));
}

// Of a quad half the cross product of its diagonals, which is that of the lines between the middles of its sides.
Vector area(const QuadMesh& mesh, const Face& face) {
    if (face.corners == 3) return corner_area(mesh, face, 0) / 2;
    const Vector first = mesh.vertices.row(face.ids[2]) - mesh.vertices.row(face.ids[0]);
    const Vector second = mesh.vertices.row(face.ids[3]) - mesh.vertices.row(face.ids[1]);
    return first.cross(second) / 2;
}

void throw_if_any(const std::vector<Index>& ids, const char* kind, const std::string& what, const std::string& remedy) {
    if (!ids.empty()) throw GeometryError(what + " (" + first_few(ids) + "); " + remedy, kind, ids);
}

template <class Bad>
std::vector<Index> faces_where(const QuadMesh& mesh, const Bad& bad) {
    std::vector<Index> found;
    for (Index f = 0; f < mesh.face_count(); ++f)
        if (bad(face(mesh, f))) found.push_back(f);
    return found;
}

void require_ids(const QuadMesh& mesh) {
    const auto outside = [&](const Face& at) {
        return std::any_of(at.ids, at.ids + at.corners, [&](Index v) { return v < 0 || v >= mesh.vertices.rows(); });
    };
    throw_if_any(faces_where(mesh, outside), "index_out_of_range", "faces name vertices that do not exist",
                 "vertex ids count from 0 to " + std::to_string(mesh.vertices.rows() - 1));
}

void require_faces(const QuadMesh& mesh) {
    std::vector<Index> lost;
    for (Index v = 0; v < mesh.vertices.rows(); ++v)
        if (!mesh.vertices.row(v).allFinite()) lost.push_back(v);
    throw_if_any(lost, "non_finite_vertex", "vertices have coordinates that are not finite", "correct or remove them");
    const auto repeats = [](const Face& at) {
        for (int i = 0; i < at.corners; ++i)
            if (std::find(at.ids, at.ids + i, at.ids[i]) != at.ids + i) return true;
        return false;
    };
    throw_if_any(faces_where(mesh, repeats), "repeated_vertex", "faces use a vertex twice",
                 "make a triangle of a quad with three different vertices, remove the others");
    const auto flat = [&](const Face& at) {
        const Vector normal = area(mesh, at);
        for (int k = 0; k < at.corners; ++k)
            if (!(corner_area(mesh, at, k).dot(normal) > 0)) return true;
        return false;
    };
    throw_if_any(faces_where(mesh, flat), "degenerate_face", "faces have a corner that is flat or turns the other way",
                 "split such quads into triangles, remove faces without area");
}

struct Side {
    Index low, high, face;
    bool forward;
};

void require_edges(const QuadMesh& mesh, bool closed) {
    std::vector<Side> sides;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const Face at = face(mesh, f);
        for (int k = 0; k < at.corners; ++k) {
            const Index a = at.ids[k], b = at.ids[(k + 1) % at.corners];
            sides.push_back({std::min(a, b), std::max(a, b), f, a < b});
        }
    }
    const auto key = [](const Side& s) { return std::pair(s.low, s.high); };
    std::stable_sort(sides.begin(), sides.end(), [&](const Side& a, const Side& b) { return key(a) < key(b); });
    std::vector<Index> crowded, turned, open;
    for (auto first = sides.begin(); first != sides.end();) {
        const auto last = std::find_if(first, sides.end(), [&](const Side& s) { return key(s) != key(*first); });
        const auto count = last - first;
        std::vector<Index>* bad = count > 2                                              ? &crowded
                                  : count == 2 && first->forward == (first + 1)->forward ? &turned
                                  : count == 1 && closed                                 ? &open
                                                                                         : nullptr;
        if (bad != nullptr) bad->insert(bad->end(), {first->low, first->high});
        first = last;
    }
    throw_if_any(crowded, "non_manifold_edge", "three faces or more share an edge (vertices of these edges)",
                 "take the surface apart there");
    throw_if_any(turned, "inconsistent_orientation", "two faces run an edge the same way (vertices of these edges)",
                 "turn one of them over");
    throw_if_any(open, "not_closed", "the surface ends at edges (vertices of these edges)", "close the holes");
}

}  // namespace

void require_valid(const QuadMesh& mesh, bool closed) {
    if (mesh.face_count() == 0) throw GeometryError("the surface has no faces; give one at least", "empty");
    require_ids(mesh);
    require_faces(mesh);
    require_edges(mesh, closed);
}

Eigen::VectorXd scaled_jacobians(const QuadMesh& mesh) {
    require_ids(mesh);
    Eigen::VectorXd result(mesh.face_count());
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const Face at = face(mesh, f);
        const Vector normal = area(mesh, at).stableNormalized();
        double least = 1, longest = 0;
        for (int k = 0; k < at.corners; ++k) {
            const double product = side(mesh, at, (k + at.corners - 1) % at.corners).norm() * side(mesh, at, k).norm();
            longest = std::max(longest, product);
            const double span = corner_area(mesh, at, k).dot(normal);
            least = std::min(least, product > 0 ? span / product : 0);
        }
        if (at.corners == 4)
            result[f] = least;
        else
            result[f] = longest > 0 ? 2 / std::sqrt(3.0) * 2 * area(mesh, at).norm() / longest : 0;
    }
    return result;
}

TriangleMesh split_quads(const QuadMesh& mesh) {
    require_ids(mesh);
    TriangleMesh result{mesh.vertices, Triangles(mesh.triangles.rows() + 2 * mesh.quads.rows(), 3)};
    result.triangles.topRows(mesh.triangles.rows()) = mesh.triangles;
    Eigen::Index t = mesh.triangles.rows();
    for (const auto quad : mesh.quads.rowwise()) {
        const double first = (mesh.vertices.row(quad[2]) - mesh.vertices.row(quad[0])).squaredNorm();
        const double second = (mesh.vertices.row(quad[3]) - mesh.vertices.row(quad[1])).squaredNorm();
        const int a = second < first ? 1 : 0;  // the diagonal's corner
        result.triangles.row(t++) << quad[a], quad[a + 1], quad[a + 2];
        result.triangles.row(t++) << quad[a], quad[a + 2], quad[(a + 3) % 4];
    }
    return result;
}

}  // namespace octafield::surface
