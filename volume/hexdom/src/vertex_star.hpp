// The Jacobians of the cells round one vertex, as functions of its displacement.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "octafield/volume/mixed_mesh.hpp"

namespace octafield::volume::detail {

// Cells round each vertex, ascending; `corner` is the place of the vertex in the cell's row.
struct Incidence {
    Index cell;
    int corner;
};
class VertexCells {
public:
    explicit VertexCells(const MixedMesh& mesh);
    std::span<const Incidence> of(Index v) const {
        return {all_.data() + first_[v], static_cast<std::size_t>(first_[v + 1] - first_[v])};
    }

private:
    std::vector<Index> first_;
    std::vector<Incidence> all_;
};

// (4, 5, 6 or 8) ids.
std::span<const Index> cell_vertices(const MixedMesh& mesh, Index cell);

class VertexStar {
public:
    using Vector = Eigen::Vector3d;

    // Refers to the mesh until the next call; displacements count from where v is then.
    // hexahedra_first: see ImproveOptions.
    void set(const MixedMesh& mesh, const VertexCells& cells, Index v, bool hexahedra_first = false);

    bool empty() const { return corners_.empty(); }
    double size() const {
        return size_;
    }  // mean length of the edges (of pyramids, diagonals of the base, too) at the vertex

    // Least scaled Jacobian, as scaled_jacobians takes it, over the corners that the vertex changes: of flat and
    // inverted corners, the edges' triple product over the product of their lengths, <= 0. Stops early below `enough`.
    double lowest(const Vector& x, double enough = -2) const;
    // All of them, with their gradients.
    void qualities(const Vector& x, std::vector<double>& values, std::vector<Vector>& gradients) const;

    // The same of determinants over size()^3: linear, so that inverted corners know their way out (Freitag, Plassmann
    // 2000).
    double lowest_determinant(const Vector& x) const;
    void determinants(const Vector& x, std::vector<double>& values, std::vector<Vector>& gradients) const;

    // Sum over the corners of (|T| / sqrt(3))^6 / det(T)^2, T from the corner of the ideal cell: convex where all are
    // positive, infinite elsewhere (inverse mean ratio; Knupp 2001).
    double energy(const Vector& x) const;
    double energy(const Vector& x, Vector& gradient, Eigen::Matrix3d& hessian) const;

private:
    // A matrix whose columns are edges, some of which end at the vertex. With x its displacement:
    struct Corner {
        double determinant;  // at x = 0
        Vector slope;        // of the determinant
        double scale;        // quality = scale determinant / product of |x - ends[k]|
        double factor;       // scale of the quality without lengths
        int count;           // of ends: 1 or 3
        Vector ends[3];
        double weight;            // of the energy, 0: none
        double square, constant;  // |T|^2 = square |x|^2 + 2 linear.x + constant
        Vector linear;
    };
    void add(const Vector (&edges)[3], const int (&signs)[3], double factor, const struct IdealCorner* ideal,
             double importance);
    void add_cell(const MixedMesh& mesh, const Incidence& at, bool hexahedra_first);

    std::vector<Corner> corners_;
    double size_ = 0, length_sum_ = 0;
    int length_count_ = 0;
};

}  // namespace octafield::volume::detail
