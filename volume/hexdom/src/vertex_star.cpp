#include "vertex_star.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "cell_shapes.hpp"

namespace octafield::volume::detail {

// Of an ideal cell's corner, with the edges as columns of W: G = (W^T W)^-1, so that |A W^-1|^2 is the trace of A G
// A^T; and det W / 3^(3/2).
struct IdealCorner {
    explicit IdealCorner(double cosine_01, double cosine_02, double cosine_12) {
        Eigen::Matrix3d products;
        products << 1, cosine_01, cosine_02, cosine_01, 1, cosine_12, cosine_02, cosine_12, 1;
        gram = products.inverse();
        weight = std::sqrt(products.determinant() / 27);
    }
    Eigen::Matrix3d gram;
    double weight;
};

namespace {

using Vector = Eigen::Vector3d;

const IdealCorner cube(0, 0, 0), regular_tet(0.5, 0.5, 0.5), right_prism(0.5, 0, 0), equal_pyramid(0, 0.5, 0.5);

// Corners of a kind of cell, and the factors that make the quality of the ideal ones 1.
struct QualityCorner {
    CellCorner at;
    double factor;
    const IdealCorner* ideal;  // null: not of the energy
};

// The four corners of the tet a, b, c, d, positive if it is. The energy takes any one of them.
void add_tet(std::vector<QualityCorner>& corners, const CellCorner& t, double factor, const IdealCorner* ideal) {
    corners.push_back({t, factor, ideal});
    corners.push_back({{t[1], t[0], t[3], t[2]}, factor, nullptr});
    corners.push_back({{t[2], t[0], t[1], t[3]}, factor, nullptr});
    corners.push_back({{t[3], t[0], t[2], t[1]}, factor, nullptr});
}

std::vector<QualityCorner> corners_of(const CellShape& shape) {
    std::vector<QualityCorner> corners;
    if (&shape == &tet_shape) add_tet(corners, {0, 1, 2, 3}, std::sqrt(2.0), &regular_tet);
    for (const CellCorner& at : shape.corners) {
        if (&shape == &hexahedron_shape) corners.push_back({at, 1, &cube});
        if (&shape == &wedge_shape) corners.push_back({at, 2 / std::sqrt(3.0), &right_prism});
        if (&shape == &pyramid_shape) add_tet(corners, at, 2, &equal_pyramid);
    }
    return corners;
}

// Those that a vertex at a place of the cell's row changes.
using CornersAt = std::array<std::vector<QualityCorner>, 8>;

CornersAt corners_at(const CellShape& shape) {
    CornersAt found;
    for (const QualityCorner& corner : corners_of(shape))
        for (const int local : corner.at) found[local].push_back(corner);
    return found;
}

const CornersAt& corners_at(const CellShape* shape) {
    static const CornersAt tet = corners_at(tet_shape), hexahedron = corners_at(hexahedron_shape),
                           wedge = corners_at(wedge_shape), pyramid = corners_at(pyramid_shape);
    return shape == &tet_shape          ? tet
           : shape == &hexahedron_shape ? hexahedron
           : shape == &wedge_shape      ? wedge
                                        : pyramid;
}

// (|T| / sqrt(3))^6 / det(T)^2, with |T|^2 = square and the ideal's weight. Squared, so that poor corners count more.
double shape_energy(double weight, double square, double determinant) {
    const double root = weight / determinant;
    return root * root * square * square * square;
}

// The edges of the map at a hexahedron's middle run between opposite faces' vertices, summed: on which side each vertex
// is.
constexpr int middle_signs[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                    {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};

struct CellRow {
    const CellShape* shape;
    const Index* ids;
};

CellRow cell_row(const MixedMesh& mesh, Index cell) {
    if (cell < mesh.tets.rows()) return {&tet_shape, mesh.tets.row(cell).data()};
    cell -= static_cast<Index>(mesh.tets.rows());
    if (cell < mesh.hexahedra.rows()) return {&hexahedron_shape, mesh.hexahedra.row(cell).data()};
    cell -= static_cast<Index>(mesh.hexahedra.rows());
    if (cell < mesh.wedges.rows()) return {&wedge_shape, mesh.wedges.row(cell).data()};
    return {&pyramid_shape, mesh.pyramids.row(cell - static_cast<Index>(mesh.wedges.rows())).data()};
}

// What a kind of cell counts where hexahedra come first: its qualities as so much higher, its energy so much less.
struct Rank {
    double quality, energy;
};

Rank rank_of(const CellShape* shape) {
    if (shape == &hexahedron_shape) return {1, 1};
    return shape == &wedge_shape ? Rank{1.5, 0.2} : Rank{2.5, 0.01};
}

}  // namespace

std::span<const Index> cell_vertices(const MixedMesh& mesh, Index cell) {
    const CellRow row = cell_row(mesh, cell);
    return {row.ids, static_cast<std::size_t>(row.shape->vertices)};
}

VertexCells::VertexCells(const MixedMesh& mesh) : first_(mesh.vertices.rows() + 1) {
    for_each_cell(mesh, [&](const Cell& cell) {
        for (int k = 0; k < cell.shape.vertices; ++k) ++first_[cell.ids[k] + 1];
    });
    for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
    all_.resize(first_.back());
    std::vector<Index> next(first_.begin(), first_.end() - 1);
    for_each_cell(mesh, [&](const Cell& cell) {
        for (int k = 0; k < cell.shape.vertices; ++k) all_[next[cell.ids[k]]++] = {cell.number, k};
    });
}

void VertexStar::set(const MixedMesh& mesh, const VertexCells& cells, Index v, bool hexahedra_first) {
    corners_.clear();
    length_sum_ = 0;
    length_count_ = 0;
    for (const Incidence& at : cells.of(v)) add_cell(mesh, at, hexahedra_first);
    size_ = length_count_ > 0 ? length_sum_ / length_count_ : 0;
}

void VertexStar::add_cell(const MixedMesh& mesh, const Incidence& at, bool hexahedra_first) {
    const CellRow cell = cell_row(mesh, at.cell);
    const Rank rank = hexahedra_first ? rank_of(cell.shape) : Rank{1, 1};
    const auto point = [&](int local) -> Vector { return mesh.vertices.row(cell.ids[local]); };
    for (const QualityCorner& corner : corners_at(cell.shape)[at.corner]) {
        const Vector apex = point(corner.at[0]);
        const Vector edges[3] = {point(corner.at[1]) - apex, point(corner.at[2]) - apex, point(corner.at[3]) - apex};
        int signs[3];
        for (int k = 0; k < 3; ++k) signs[k] = at.corner == corner.at[0] ? -1 : at.corner == corner.at[k + 1] ? 1 : 0;
        add(edges, signs, rank.quality * corner.factor, corner.ideal, rank.energy);
        if (signs[0] + signs[1] + signs[2] != -3) continue;
        for (const Vector& edge : edges) length_sum_ += edge.norm();
        length_count_ += 3;
    }
    if (cell.shape != &hexahedron_shape) return;
    Vector edges[3] = {Vector::Zero(), Vector::Zero(), Vector::Zero()};
    for (int local = 0; local < 8; ++local)
        for (int k = 0; k < 3; ++k) edges[k] += middle_signs[local][k] * point(local);
    add(edges, middle_signs[at.corner], 1, nullptr, 0);
}

void VertexStar::add(const Vector (&edges)[3], const int (&signs)[3], double factor, const IdealCorner* ideal,
                     double importance) {
    Corner& corner = corners_.emplace_back();
    const Vector normals[3] = {edges[1].cross(edges[2]), edges[2].cross(edges[0]), edges[0].cross(edges[1])};
    corner.determinant = edges[2].dot(normals[2]);
    corner.slope = signs[0] * normals[0] + signs[1] * normals[1] + signs[2] * normals[2];
    corner.factor = corner.scale = factor;
    corner.count = 0;
    for (int k = 0; k < 3; ++k) {
        if (signs[k] != 0) {
            corner.ends[corner.count++] = -signs[k] * edges[k];
            continue;
        }
        const double length = edges[k].norm();
        corner.scale = length > 0 ? corner.scale / length : 0;
    }
    corner.weight = 0;
    if (ideal == nullptr) return;
    corner.weight = ideal->weight * std::sqrt(importance);  // it is squared
    corner.square = corner.constant = 0;
    corner.linear.setZero();
    for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k) {
            const double g = ideal->gram(j, k);
            corner.square += g * signs[j] * signs[k];
            corner.linear += g * signs[j] * edges[k];
            corner.constant += g * edges[j].dot(edges[k]);
        }
}

double VertexStar::lowest(const Vector& x, double enough) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Corner& corner : corners_) {
        double square = 1;
        for (int k = 0; k < corner.count; ++k) square *= (x - corner.ends[k]).squaredNorm();
        const double value =
            square > 0 ? corner.scale * (corner.determinant + corner.slope.dot(x)) / std::sqrt(square) : 0;
        if (!(value >= least)) least = value;
        if (!(least >= enough)) return least;
    }
    return least;
}

void VertexStar::qualities(const Vector& x, std::vector<double>& values, std::vector<Vector>& gradients) const {
    values.clear();
    gradients.clear();
    for (const Corner& corner : corners_) {
        double square = 1;
        for (int k = 0; k < corner.count; ++k) square *= (x - corner.ends[k]).squaredNorm();
        const double scale = square > 0 ? corner.scale / std::sqrt(square) : 0;
        const double value = scale * (corner.determinant + corner.slope.dot(x));
        Vector gradient = scale * corner.slope;
        if (square > 0)
            for (int k = 0; k < corner.count; ++k) {
                const Vector from = x - corner.ends[k];
                gradient -= value / from.squaredNorm() * from;
            }
        values.push_back(value);
        gradients.push_back(gradient);
    }
}

double VertexStar::lowest_determinant(const Vector& x) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Corner& corner : corners_)
        least = std::min(least, corner.factor * (corner.determinant + corner.slope.dot(x)));
    return least / (size_ * size_ * size_);
}

void VertexStar::determinants(const Vector& x, std::vector<double>& values, std::vector<Vector>& gradients) const {
    values.clear();
    gradients.clear();
    for (const Corner& corner : corners_) {
        const double scale = corner.factor / (size_ * size_ * size_);
        values.push_back(scale * (corner.determinant + corner.slope.dot(x)));
        gradients.push_back(scale * corner.slope);
    }
}

double VertexStar::energy(const Vector& x) const {
    double sum = 0;
    for (const Corner& corner : corners_) {
        if (corner.weight == 0) continue;
        const double determinant = corner.determinant + corner.slope.dot(x);
        if (!(determinant > 0)) return std::numeric_limits<double>::infinity();
        const double square = corner.square * x.squaredNorm() + 2 * corner.linear.dot(x) + corner.constant;
        sum += shape_energy(corner.weight, square, determinant);
    }
    return sum;
}

double VertexStar::energy(const Vector& x, Vector& gradient, Eigen::Matrix3d& hessian) const {
    double sum = 0;
    gradient.setZero();
    hessian.setZero();
    for (const Corner& corner : corners_) {
        if (corner.weight == 0) continue;
        const double determinant = corner.determinant + corner.slope.dot(x);
        if (!(determinant > 0)) return std::numeric_limits<double>::infinity();
        const double square = corner.square * x.squaredNorm() + 2 * corner.linear.dot(x) + corner.constant;
        const double value = shape_energy(corner.weight, square, determinant);
        const Vector of_square = 2 * (corner.square * x + corner.linear) / square,
                     of_slope = corner.slope / determinant;
        const Vector both = 3 * of_square - 2 * of_slope;  // of the logarithm
        sum += value;
        gradient += value * both;
        hessian += value * (both * both.transpose() - 3 * of_square * of_square.transpose() +
                            2 * of_slope * of_slope.transpose());
        hessian.diagonal().array() += value * 6 * corner.square / square;
    }
    return sum;
}

}  // namespace octafield::volume::detail
