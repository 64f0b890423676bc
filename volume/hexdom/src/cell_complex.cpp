#include "cell_complex.hpp"

#include <algorithm>

namespace octafield::volume::detail {

FaceCycle face_cycle(std::array<Index, 4> ids) {
    const int corners = ids[3] < 0 ? 3 : 4;
    int lowest = 0;
    for (int k = 1; k < corners; ++k)
        if (ids[k] < ids[lowest]) lowest = k;
    FaceCycle face{{-1, -1, -1, -1}};
    for (int k = 0; k < corners; ++k) face.ids[k] = ids[(lowest + k) % corners];
    return face;
}

FaceCycle opposite(const FaceCycle& face) {
    const auto& f = face.ids;
    return face.corners() == 3 ? FaceCycle{{f[0], f[2], f[1], -1}} : FaceCycle{{f[0], f[3], f[2], f[1]}};
}

CellComplex::CellComplex(const MixedMesh& mesh) : points_(mesh.vertices.rows()), cells_at_(mesh.vertices.rows()) {
    for (std::size_t v = 0; v < points_.size(); ++v) points_[v] = mesh.vertices.row(static_cast<Index>(v));
    cells_.reserve(mesh.cell_count());
    for_each_cell(mesh, [&](const Cell& cell) { add(cell.shape, {cell.ids, std::size_t(cell.shape.vertices)}); });
}

FaceCycle CellComplex::face(Index cell, const CellFace& local) const {
    std::array<Index, 4> ids{-1, -1, -1, -1};
    for (int k = 0; k < local.corners; ++k) ids[k] = cells_[cell].ids[local.local[k]];
    return face_cycle(ids);
}

Index CellComplex::cell_with(const FaceCycle& wanted) const {
    for (const Index cell : cells_at_[wanted.ids[0]]) {
        const auto& ids = cells_[cell].ids;
        const auto has = [&](Index v) { return std::find(ids.begin(), ids.end(), v) != ids.end(); };
        if (!has(wanted.ids[1]) || !has(wanted.ids[2])) continue;
        for (const CellFace& local : shape(cell).faces)
            if (local.corners == wanted.corners() && face(cell, local) == wanted) return cell;
    }
    return -1;
}

Index CellComplex::add(const CellShape& shape, std::span<const Index> ids) {
    const Index number = cell_count();
    LiveCell cell{&shape, {-1, -1, -1, -1, -1, -1, -1, -1}};
    std::copy(ids.begin(), ids.end(), cell.ids.begin());
    cells_.push_back(cell);
    for (const Index v : ids) cells_at_[v].push_back(number);
    return number;
}

Index CellComplex::add_vertex(const Eigen::Vector3d& point) {
    points_.push_back(point);
    cells_at_.emplace_back();
    return static_cast<Index>(points_.size()) - 1;
}

void CellComplex::remove(Index cell) {
    for (int k = 0; k < shape(cell).vertices; ++k) {
        std::vector<Index>& at = cells_at_[cells_[cell].ids[k]];
        at.erase(std::find(at.begin(), at.end(), cell));
    }
    cells_[cell].shape = nullptr;
}

MixedMesh CellComplex::mesh(Index first_new) const {
    MixedMesh mesh;
    std::vector<Index> number(points_.size());
    Index used = 0;
    mesh.vertices.resize(vertex_count(), 3);
    for (Index v = 0; v < vertex_count(); ++v) {
        if (v >= first_new && cells_at_[v].empty()) continue;
        mesh.vertices.row(used) = points_[v];
        number[v] = used++;
    }
    mesh.vertices.conservativeResize(used, 3);
    const auto take = [&](auto& rows, const CellShape& shape) {
        const auto kept = [&](const LiveCell& cell) { return cell.shape == &shape; };
        rows.resize(std::count_if(cells_.begin(), cells_.end(), kept), shape.vertices);
        Eigen::Index row = 0;
        for (const LiveCell& cell : cells_)
            if (kept(cell))
                std::transform(cell.ids.begin(), cell.ids.begin() + shape.vertices, rows.row(row++).data(),
                               [&](Index v) { return number[v]; });
    };
    take(mesh.tets, tet_shape);
    take(mesh.hexahedra, hexahedron_shape);
    take(mesh.wedges, wedge_shape);
    take(mesh.pyramids, pyramid_shape);
    return mesh;
}

void CellComplex::set_walls(const Triangles& walls) {
    for (const auto row : walls.rowwise()) {
        walls_.push_back({row[0], row[1], row[2]});
        std::sort(walls_.back().begin(), walls_.back().end());
    }
    std::sort(walls_.begin(), walls_.end());
}

bool CellComplex::wall(const FaceCycle& face) const {
    if (walls_.empty() || face.corners() == 4) return false;
    std::array<Index, 3> ids{face.ids[0], face.ids[1], face.ids[2]};
    std::sort(ids.begin(), ids.end());
    return std::binary_search(walls_.begin(), walls_.end(), ids);
}

}  // namespace octafield::volume::detail
