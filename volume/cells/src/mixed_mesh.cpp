#include "octafield/volume/mixed_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "cell_shapes.hpp"
#include "octafield/error.hpp"

namespace octafield::volume {
namespace {

using detail::Cell;
using detail::CellCorner;
using detail::CellFace;
using Vector = Eigen::Vector3d;

// Determinants below this part of the product of their edges are rounding.
constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();

struct CornerJacobian {
    double determinant, lengths;  // lengths: the product of the three edges'
    double scaled() const { return lengths > 0 ? determinant / lengths : 0; }
};

CornerJacobian jacobian(const Vector& a, const Vector& b, const Vector& c) {
    return {a.cross(b).dot(c), a.norm() * b.norm() * c.norm()};
}

CornerJacobian jacobian(const MixedMesh& mesh, const Cell& cell, const CellCorner& corner) {
    const auto edge = [&](int k) -> Vector {
        return mesh.vertices.row(cell.ids[corner[k]]) - mesh.vertices.row(cell.ids[corner[0]]);
    };
    return jacobian(edge(1), edge(2), edge(3));
}

// A face of a cell by its vertices: `cycle` outward, the lowest first, the last of a triangle's -1.
struct Face {
    std::array<Index, 4> sorted, cycle;
    Index cell;
    int corners;
};

Face face_of(const Cell& cell, const CellFace& local) {
    Face face{{-1, -1, -1, -1}, {-1, -1, -1, -1}, cell.number, local.corners};
    int lowest = 0;
    for (int k = 1; k < local.corners; ++k)
        if (cell.ids[local.local[k]] < cell.ids[local.local[lowest]]) lowest = k;
    for (int k = 0; k < local.corners; ++k) face.cycle[k] = cell.ids[local.local[(lowest + k) % local.corners]];
    face.sorted = face.cycle;
    for (int k = 1; k < local.corners; ++k)  // few enough; std::sort makes GCC 12 see bounds that are not there
        for (int j = k; j > 0 && face.sorted[j] < face.sorted[j - 1]; --j)
            std::swap(face.sorted[j], face.sorted[j - 1]);
    return face;
}

std::array<Index, 4> reversed(const Face& face) {
    std::array<Index, 4> result = face.cycle;
    std::reverse(result.begin() + 1, result.begin() + face.corners);
    return result;
}

// By vertices, faces of the same ones by cell.
std::vector<Face> sorted_faces(const MixedMesh& mesh) {
    std::vector<Face> faces;
    faces.reserve(4 * mesh.tets.rows() + 6 * mesh.hexahedra.rows() + 5 * (mesh.wedges.rows() + mesh.pyramids.rows()));
    detail::for_each_cell(mesh, [&](const Cell& cell) {
        for (const CellFace& local : cell.shape.faces) faces.push_back(face_of(cell, local));
    });
    std::stable_sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) { return a.sorted < b.sorted; });
    return faces;
}

// visit(first, last) for the faces of the same vertices.
template <class Visit>
void for_each_face(const std::vector<Face>& faces, const Visit& visit) {
    for (auto first = faces.begin(); first != faces.end();) {
        const auto last = std::find_if(first, faces.end(), [&](const Face& f) { return f.sorted != first->sorted; });
        visit(first, last);
        first = last;
    }
}

class Defects {
public:
    void add(const char* kind, std::vector<Index> cells, const std::string& what, const std::string& remedy) {
        if (cells.empty()) return;
        std::sort(cells.begin(), cells.end());
        cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
        found_.push_back({kind, cells, what + " (cells " + first_few(cells) + "); " + remedy});
    }
    template <class Bad>
    void add_where(const MixedMesh& mesh, const Bad& bad, const char* kind, const std::string& what,
                   const std::string& remedy) {
        std::vector<Index> cells;
        detail::for_each_cell(mesh, [&](const Cell& cell) {
            if (bad(cell)) cells.push_back(cell.number);
        });
        add(kind, std::move(cells), what, remedy);
    }
    bool empty() const { return found_.empty(); }
    std::vector<CellDefect> take() { return std::move(found_); }

private:
    std::vector<CellDefect> found_;
};

bool any_vertex(const Cell& cell, const std::function<bool(Index)>& bad) {
    return std::any_of(cell.ids, cell.ids + cell.shape.vertices, bad);
}

void find_lost_ids(const MixedMesh& mesh, Defects& defects) {
    defects.add_where(
        mesh,
        [&](const Cell& cell) { return any_vertex(cell, [&](Index v) { return v < 0 || v >= mesh.vertices.rows(); }); },
        "index_out_of_range", "cells name vertices that do not exist",
        "vertex ids count from 0 to " + std::to_string(mesh.vertices.rows() - 1));
}

void find_degenerate(const MixedMesh& mesh, Defects& defects) {
    defects.add_where(
        mesh,
        [&](const Cell& cell) { return any_vertex(cell, [&](Index v) { return !mesh.vertices.row(v).allFinite(); }); },
        "non_finite_vertex", "cells have vertices whose coordinates are not finite", "correct or remove them");
    defects.add_where(
        mesh,
        [](const Cell& cell) {
            for (int i = 0; i < cell.shape.vertices; ++i)
                if (std::find(cell.ids, cell.ids + i, cell.ids[i]) != cell.ids + i) return true;
            return false;
        },
        "repeated_vertex", "cells use a vertex twice",
        "make cells of fewer corners of them: a hexahedron with an edge of no length is no hexahedron");
}

void find_inverted(const MixedMesh& mesh, Defects& defects) {
    defects.add_where(
        mesh,
        [&](const Cell& cell) {
            return std::any_of(cell.shape.corners.begin(), cell.shape.corners.end(), [&](const CellCorner& corner) {
                const CornerJacobian at = jacobian(mesh, cell, corner);
                return !(at.determinant > rounding * at.lengths);
            });
        },
        "inverted_cell", "cells have a corner that is flat or inverted (Jacobian not above 0)",
        "number their vertices as VTK does, or move these vertices");
}

// (sorted triangle, cell) of all faces of one cell with three vertices.
using LooseTriangle = std::pair<std::array<Index, 4>, Index>;

std::vector<Index> mismatched(const std::vector<Face>& loose) {
    std::vector<LooseTriangle> triangles;
    for (const Face& face : loose)
        if (face.corners == 3) triangles.emplace_back(face.sorted, face.cell);
    std::sort(triangles.begin(), triangles.end());
    std::vector<Index> cells;
    for (const Face& face : loose) {
        if (face.corners != 4) continue;
        for (int without = 0; without < 4; ++without) {
            std::array<Index, 4> triple{-1, -1, -1, -1};
            for (int k = 0, at = 0; k < 4; ++k)
                if (k != without) triple[at++] = face.sorted[k];
            const auto found = std::lower_bound(triangles.begin(), triangles.end(), LooseTriangle(triple, -1));
            for (auto other = found; other != triangles.end() && other->first == triple; ++other)
                if (other->second != face.cell) cells.insert(cells.end(), {face.cell, other->second});
        }
    }
    return cells;
}

void find_bad_faces(const MixedMesh& mesh, Defects& defects) {
    std::vector<Index> crowded, twisted, folded;
    std::vector<Face> loose;
    const std::vector<Face> faces = sorted_faces(mesh);
    for_each_face(faces, [&](auto first, auto last) {
        const auto both = [&](std::vector<Index>& cells) {
            for (auto face = first; face != last; ++face) cells.push_back(face->cell);
        };
        if (last - first == 1)
            loose.push_back(*first);
        else if (last - first > 2)
            both(crowded);
        else if (first->cycle == (first + 1)->cycle)
            both(folded);
        else if (reversed(*first) != (first + 1)->cycle)
            both(twisted);
    });
    defects.add("crowded_face", std::move(crowded), "three cells or more share a face",
                "remove cells that are there twice");
    defects.add("twisted_face", std::move(twisted), "cells have quads of the same vertices in another order",
                "number the vertices of both in the same order round the quad");
    defects.add("folded_cell", std::move(folded), "cells lie on the same side of a face they share",
                "remove cells that overlap");
    defects.add("mismatched_face", mismatched(loose), "quads of one cell meet triangles of another",
                "put a pyramid on the quad, or split cells so that faces match");
}

double pyramid_jacobian(const MixedMesh& mesh, const Cell& cell) {
    double least = std::numeric_limits<double>::infinity();
    for (const CellCorner& corner : cell.shape.corners) {
        std::array<Vector, 4> p;
        for (int k = 0; k < 4; ++k) p[k] = mesh.vertices.row(cell.ids[corner[k]]);
        double longest = 0;  // product of the edges at a corner of the tet
        for (int k = 0; k < 4; ++k)
            longest = std::max(longest, (p[(k + 1) % 4] - p[k]).norm() * (p[(k + 2) % 4] - p[k]).norm() *
                                            (p[(k + 3) % 4] - p[k]).norm());
        const double determinant = jacobian(p[1] - p[0], p[2] - p[0], p[3] - p[0]).determinant;
        least = std::min(least, longest > 0 ? std::sqrt(2.0) * determinant / longest : 0);
    }
    const double scaled = std::max(0.0, std::sqrt(2.0) * least);
    return scaled < 1 ? scaled : 2 - scaled;
}

double scaled_jacobian(const MixedMesh& mesh, const Cell& cell) {
    if (&cell.shape == &detail::pyramid_shape) return pyramid_jacobian(mesh, cell);
    double least = std::numeric_limits<double>::infinity(), longest = 0, determinant = 0;
    for (const CellCorner& corner : cell.shape.corners) {
        const CornerJacobian at = jacobian(mesh, cell, corner);
        least = std::min(least, at.scaled());
        longest = std::max(longest, at.lengths);
        determinant = at.determinant;
    }
    if (&cell.shape == &detail::tet_shape) return longest > 0 ? std::sqrt(2.0) * determinant / longest : 0;
    if (&cell.shape == &detail::wedge_shape) return 2 / std::sqrt(3.0) * least;
    // The edges of the map at its middle: from each quad's centroid to that across, four times.
    const auto sum = [&](std::array<int, 4> corners) -> Vector {
        Vector total = Vector::Zero();
        for (const int k : corners) total += mesh.vertices.row(cell.ids[k]);
        return total;
    };
    const Vector x = sum({1, 2, 5, 6}) - sum({0, 3, 4, 7}), y = sum({2, 3, 6, 7}) - sum({0, 1, 4, 5}),
                 z = sum({4, 5, 6, 7}) - sum({0, 1, 2, 3});
    return std::min(least, jacobian(x, y, z).scaled());
}

void require_ids(const MixedMesh& mesh) {
    Defects defects;
    find_lost_ids(mesh, defects);
    for (const CellDefect& defect : defects.take()) throw GeometryError(defect.message, defect.kind, defect.cells);
}

}  // namespace

std::vector<CellDefect> find_cell_defects(const MixedMesh& mesh) {
    if (mesh.cell_count() == 0) return {{"empty", {}, "the mesh has no cells; give one at least"}};
    Defects defects;
    find_lost_ids(mesh, defects);
    if (defects.empty()) find_degenerate(mesh, defects);
    if (defects.empty()) {
        find_inverted(mesh, defects);
        find_bad_faces(mesh, defects);
    }
    return defects.take();
}

void require_valid(const MixedMesh& mesh) {
    const std::vector<CellDefect> found = find_cell_defects(mesh);
    if (!found.empty()) throw GeometryError(found[0].message, found[0].kind, found[0].cells);
}

CellBoundary cell_boundary(const MixedMesh& mesh) {
    require_ids(mesh);
    // In the order of the cells, triangles before quads.
    std::vector<Face> loose;
    const std::vector<Face> faces = sorted_faces(mesh);
    for_each_face(faces, [&](auto first, auto last) {
        if (last - first == 1) loose.push_back(*first);
    });
    std::stable_sort(loose.begin(), loose.end(), [](const Face& a, const Face& b) {
        return std::pair(a.corners, a.cell) < std::pair(b.corners, b.cell);
    });
    CellBoundary result;
    for (const Face& face : loose) {
        result.cells.push_back(face.cell);
        result.vertex_map.insert(result.vertex_map.end(), face.cycle.begin(), face.cycle.begin() + face.corners);
    }
    std::sort(result.vertex_map.begin(), result.vertex_map.end());
    result.vertex_map.erase(std::unique(result.vertex_map.begin(), result.vertex_map.end()), result.vertex_map.end());
    result.mesh.vertices = mesh.vertices(result.vertex_map, Eigen::all);
    const auto triangles = std::count_if(loose.begin(), loose.end(), [](const Face& f) { return f.corners == 3; });
    result.mesh.triangles.resize(triangles, 3);
    result.mesh.quads.resize(static_cast<Eigen::Index>(loose.size()) - triangles, 4);
    const auto compact = [&](Index v) {
        return static_cast<Index>(std::lower_bound(result.vertex_map.begin(), result.vertex_map.end(), v) -
                                  result.vertex_map.begin());
    };
    for (std::size_t f = 0; f < loose.size(); ++f)
        for (int k = 0; k < loose[f].corners; ++k) {
            const Index v = compact(loose[f].cycle[k]), row = static_cast<Index>(f);
            if (loose[f].corners == 3)
                result.mesh.triangles(row, k) = v;
            else
                result.mesh.quads(row - triangles, k) = v;
        }
    return result;
}

Eigen::VectorXd scaled_jacobians(const MixedMesh& mesh) {
    require_ids(mesh);
    Eigen::VectorXd result(mesh.cell_count());
    detail::for_each_cell(mesh, [&](const Cell& cell) { result[cell.number] = scaled_jacobian(mesh, cell); });
    return result;
}

// A bilinear quad halves the space between the two pairs of triangles that its diagonals make.
Eigen::VectorXd cell_volumes(const MixedMesh& mesh) {
    require_ids(mesh);
    Eigen::VectorXd result(mesh.cell_count());
    detail::for_each_cell(mesh, [&](const Cell& cell) {
        const Vector origin = mesh.vertices.row(cell.ids[0]);
        double volume = 0;
        for (const CellFace& face : cell.shape.faces) {
            const auto under = [&](int i, int j, int k) {
                const auto p = [&](int corner) -> Vector {
                    return mesh.vertices.row(cell.ids[face.local[corner]]).transpose() - origin;
                };
                return p(i).dot(p(j).cross(p(k))) / 6;
            };
            volume += face.corners == 3 ? under(0, 1, 2)
                                        : (under(0, 1, 2) + under(0, 2, 3) + under(0, 1, 3) + under(1, 2, 3)) / 2;
        }
        result[cell.number] = volume;
    });
    return result;
}

}  // namespace octafield::volume
