#include "octafield/surface/principal_directions.hpp"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <cmath>

namespace octafield::surface {
namespace {

using Vector = Eigen::Vector3d;
using Tensor = Eigen::Matrix3d;  // symmetric, zero on its plane's normal

// Against that of triangles all round whose normals are known from both sides.
constexpr double one_sided_weight = 1e-3;

// The triangles round a vertex between two features, or all of them.
struct Sectors {
    std::vector<Index> of_corner;  // (3F)
    std::vector<bool> one_sided;   // per sector: ends at boundary or features
    Index count() const { return static_cast<Index>(one_sided.size()); }
};

Sectors smooth_sectors(const SurfaceDomain& domain) {
    const EdgeTopology& topology = domain.topology();
    const std::vector<bool>& is_feature = domain.is_feature();
    const VertexFans& fans = domain.fans();
    Sectors sectors;
    sectors.of_corner.resize(3 * static_cast<std::size_t>(domain.triangle_count()));
    for (const auto& fan : fans.fans) {
        const Index size = fan.last - fan.first;
        const auto starts_at_feature = [&](Index i) {
            const Index corner = fans.corners[fan.first + i % size];
            return is_feature[topology.triangle_edges(corner / 3, corner % 3)];
        };
        Index features = 0, start = 0;
        for (Index i = 0; i < size; ++i)
            if (starts_at_feature(i) && features++ == 0) start = i;
        // One feature edge alone ends at this vertex: the surface is smooth round it.
        const bool split = !fan.closed || features > 1;
        for (Index i = start; i < start + size; ++i) {
            if (i == start || (split && starts_at_feature(i))) sectors.one_sided.push_back(split);
            sectors.of_corner[fans.corners[fan.first + i % size]] = sectors.count() - 1;
        }
    }
    return sectors;
}

std::array<Vector, 3> corners(const TriangleMesh& mesh, Index t) {
    return {mesh.vertices.row(mesh.triangles(t, 0)), mesh.vertices.row(mesh.triangles(t, 1)),
            mesh.vertices.row(mesh.triangles(t, 2))};
}

// Max 1999: normals of adjacent triangles over the squared lengths of the two edges at the vertex.
std::vector<Vector> sector_normals(const SurfaceDomain& domain, const Sectors& sectors) {
    const TriangleMesh& mesh = domain.mesh();
    std::vector<Vector> normals(sectors.count(), Vector::Zero());
    const double scale = 1 / domain.mean_edge_length();  // keeps sums in range in any unit
    for (Index t = 0; t < mesh.triangles.rows(); ++t) {
        const auto p = corners(mesh, t);
        for (int k = 0; k < 3; ++k) {
            const Vector a = scale * (p[(k + 1) % 3] - p[k]), b = scale * (p[(k + 2) % 3] - p[k]);
            normals[sectors.of_corner[3 * t + k]] += a.cross(b) / (a.squaredNorm() * b.squaredNorm());
        }
    }
    for (Vector& normal : normals) normal.stableNormalize();
    return normals;
}

// Rusinkiewicz 2004, section 3: the shape operator that fits the normals' changes along the three edges best.
Tensor shape_operator(const std::array<Vector, 3>& p, const std::array<Vector, 3>& normals, const Vector& u,
                      const Vector& v, double length) {
    Eigen::Matrix<double, 6, 3> matrix;
    Eigen::Matrix<double, 6, 1> change;
    for (int k = 0; k < 3; ++k) {
        const Vector edge = (p[(k + 1) % 3] - p[k]) / length, turn = normals[(k + 1) % 3] - normals[k];
        matrix.row(2 * k) << edge.dot(u), edge.dot(v), 0;
        matrix.row(2 * k + 1) << 0, edge.dot(u), edge.dot(v);
        change.segment<2>(2 * k) << turn.dot(u), turn.dot(v);
    }
    const Vector s = matrix.colPivHouseholderQr().solve(change) / length;
    return s[0] * u * u.transpose() + s[1] * (u * v.transpose() + v * u.transpose()) + s[2] * v * v.transpose();
}

// The tensor carried from one tangent plane to another, by the smallest rotation that takes normal to normal.
Tensor carried(const Tensor& tensor, const Vector& from, const Vector& to) {
    if (from.isZero(0) || to.isZero(0)) return tensor;
    const Tensor rotation = Eigen::Quaterniond::FromTwoVectors(from, to).toRotationMatrix();
    return rotation * tensor * rotation.transpose();
}

struct Average {
    Tensor sum = Tensor::Zero();
    double weight = 0;
    void add(const Tensor& tensor, double by) {
        sum += by * tensor;
        weight += by;
    }
    Tensor mean() const { return sum / weight; }
};

struct TriangleFrame {
    Vector u, v, normal;
};

TriangleFrame frame_of(const TriangleMesh& mesh, Index t) {
    const auto p = corners(mesh, t);
    const Vector u = (p[1] - p[0]).stableNormalized();
    const Vector normal = u.cross((p[2] - p[0]).stableNormalized()).stableNormalized();
    return {u, normal.cross(u), normal};
}

// Shape operators averaged over the triangles round each sector's vertex, with their total weight.
std::vector<Average> sector_tensors(const TriangleMesh& mesh, const Sectors& sectors,
                                    const std::vector<Vector>& normals) {
    std::vector<Average> averages(sectors.count());
    const double total = triangle_areas(mesh).sum();
    for (Index t = 0; t < mesh.triangles.rows(); ++t) {
        const auto p = corners(mesh, t);
        const TriangleFrame frame = frame_of(mesh, t);
        std::array<Vector, 3> corner_normals;
        double weight = (p[1] - p[0]).cross(p[2] - p[0]).norm() / total;
        bool one_sided = false;
        for (int k = 0; k < 3; ++k) {
            const Index sector = sectors.of_corner[3 * t + k];
            corner_normals[k] = normals[sector];
            one_sided = one_sided || sectors.one_sided[sector];
        }
        if (one_sided) weight *= one_sided_weight;
        const double length = std::max({(p[1] - p[0]).norm(), (p[2] - p[1]).norm(), (p[0] - p[2]).norm()});
        const Tensor tensor = shape_operator(p, corner_normals, frame.u, frame.v, length);
        for (int k = 0; k < 3; ++k) {
            const Index sector = sectors.of_corner[3 * t + k];
            averages[sector].add(carried(tensor, frame.normal, normals[sector]), weight);
        }
    }
    return averages;
}

}  // namespace

PrincipalDirections principal_directions(const SurfaceDomain& domain) {
    const TriangleMesh& mesh = domain.mesh();
    const Sectors sectors = smooth_sectors(domain);
    const std::vector<Vector> normals = sector_normals(domain, sectors);
    const std::vector<Average> averages = sector_tensors(mesh, sectors, normals);
    const double flat = 1 / domain.size();

    const Index count = static_cast<Index>(mesh.triangles.rows());
    PrincipalDirections result;
    result.directions.resize(count, 3);
    result.curvatures.resize(count, 2);
    result.anisotropy.resize(count);
    for (Index t = 0; t < count; ++t) {
        const TriangleFrame frame = frame_of(mesh, t);
        Average average;
        for (int k = 0; k < 3; ++k) {
            const Index sector = sectors.of_corner[3 * t + k];
            average.add(carried(averages[sector].mean(), normals[sector], frame.normal), averages[sector].weight);
        }
        const Tensor tensor = average.mean();
        const double a = frame.u.dot(tensor * frame.u), b = frame.u.dot(tensor * frame.v),
                     c = frame.v.dot(tensor * frame.v);
        const double mean = (a + c) / 2, half = std::hypot((a - c) / 2, b);
        // The eigenvalue mean + half belongs to this angle; the other one may be larger in size.
        const double angle = std::atan2(2 * b, a - c) / 2 + (mean < 0 ? std::acos(0.0) : 0);
        const double first = mean < 0 ? mean - half : mean + half, second = mean < 0 ? mean + half : mean - half;
        result.directions.row(t) = std::cos(angle) * frame.u + std::sin(angle) * frame.v;
        result.curvatures.row(t) << first, second;
        result.anisotropy[t] = std::abs(first - second) / (std::abs(first) + std::abs(second) + flat);
    }
    return result;
}

}  // namespace octafield::surface
