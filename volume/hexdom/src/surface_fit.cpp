#include "surface_fit.hpp"

#include <Eigen/Geometry>
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>

#include "octafield/parallel.hpp"

namespace octafield::volume::detail {
namespace {

using Vector = Eigen::Vector3d;
using Kind = VertexSupport::Kind;

constexpr double farthest = 0.5;  // of a face's size: samples farther from the surface are not of the patch
constexpr double nothing = 1e-7;  // of it: distances that are rounding

struct Node {
    double u, v, weight;
};

// Gauss-Legendre, 3 points each way, on the unit square.
std::vector<Node> square_nodes() {
    const std::array<double, 3> at{0.5 - std::sqrt(0.15), 0.5, 0.5 + std::sqrt(0.15)},
        weight{5 / 18., 8 / 18., 5 / 18.};
    std::vector<Node> nodes;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) nodes.push_back({at[i], at[j], weight[i] * weight[j]});
    return nodes;
}

// Of degree 4, 6 points (Strang, Fix 1973), on the triangle u, v >= 0, u + v <= 1; weights sum to 1/2.
std::vector<Node> triangle_nodes() {
    std::vector<Node> nodes;
    for (const auto& [a, weight] :
         {std::pair(0.44594849091596489, 0.22338158967801147), std::pair(0.091576213509770743, 0.10995174365532187)})
        for (const auto& [u, v] : {std::pair(a, a), std::pair(a, 1 - 2 * a), std::pair(1 - 2 * a, a)})
            nodes.push_back({u, v, weight / 2});
    return nodes;
}

const std::vector<Node>& nodes_of(bool triangle) {
    static const std::vector<Node> square = square_nodes(), triangles = triangle_nodes();
    return triangle ? triangles : square;
}

}  // namespace

SurfaceFit::SurfaceFit(const MixedMesh& mesh, const VertexSupport& support, const SurfaceGuide& guide,
                       const Places& places, int threads)
    : support_(support), guide_(guide), places_(places), threads_(threads) {
    const CellBoundary boundary = cell_boundary(mesh);
    const auto add = [&](const auto& row) {
        Face face{{-1, -1, -1, -1}, -1};
        for (int k = 0; k < row.size(); ++k) {
            const Index v = face.ids[k] = boundary.vertex_map[row[k]];
            if (support.kind[v] == Kind::inside) return;
            if (support.kind[v] != Kind::surface) continue;
            if (face.guide_vertex >= 0 && places[face.guide_vertex].piece != places[v].piece) return;
            face.guide_vertex = v;
        }
        if (face.guide_vertex >= 0) faces_.push_back(face);
    };
    for (const auto row : boundary.mesh.triangles.rowwise()) add(row);
    for (const auto row : boundary.mesh.quads.rowwise()) add(row);
}

std::vector<SurfaceFit::Sample> SurfaceFit::samples(const Points& vertices, const Face& face) const {
    const bool triangle = face.ids[3] < 0;
    std::array<Vector, 4> p;
    for (int k = 0; k < 4; ++k) p[k] = vertices.row(face.ids[k < 3 || !triangle ? k : 0]);
    const double size = std::max((p[2] - p[0]).norm(), (p[3] - p[1]).norm());
    std::vector<Sample> found;
    for (const Node& node : nodes_of(triangle)) {
        const double u = node.u, v = node.v;
        Sample sample{{1 - u - v, u, v, 0}, Vector::Zero(), 0};
        Vector along_u = p[1] - p[0], along_v = p[2] - p[0];
        if (!triangle) {
            sample.weights = {(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v};
            along_u = (1 - v) * along_u + v * (p[2] - p[3]);
            along_v = (1 - u) * (p[3] - p[0]) + u * (p[2] - p[1]);
        }
        sample.area = node.weight * along_u.cross(along_v);
        Vector at = Vector::Zero();
        for (int k = 0; k < 4; ++k) at += sample.weights[k] * p[k];
        const Vector to = guide_.nearest_in_patch(at, places_[face.guide_vertex]).point - at;
        if (!(sample.area.norm() > 0) || to.norm() > farthest * size) continue;
        sample.distance = to.dot(sample.area.normalized());
        if (std::abs(sample.distance) < nothing * size) sample.distance = 0;
        found.push_back(sample);
    }
    return found;
}

std::vector<std::vector<SurfaceFit::Sample>> SurfaceFit::all_samples(const Points& vertices) const {
    std::vector<std::vector<Sample>> found(faces_.size());
    parallel_for(
        static_cast<std::int64_t>(faces_.size()), threads_,
        [&](std::int64_t f) { found[f] = samples(vertices, faces_[f]); }, 32);
    return found;
}

double SurfaceFit::misfit(const Points& vertices) const {
    double sum = 0;
    for (const std::vector<Sample>& of_face : all_samples(vertices))
        for (const Sample& sample : of_face) sum += sample.area.norm() * sample.distance * sample.distance;
    return sum;
}

Points SurfaceFit::steps(const Points& vertices) const {
    const std::vector<std::vector<Sample>> found = all_samples(vertices);
    Points normals = Points::Zero(vertices.rows(), 3);
    std::vector<Index> unknown(vertices.rows(), -1);
    const auto each = [&](const auto& visit) {  // visit(sample, corner of the face, vertex), of kind surface
        for (std::size_t f = 0; f < found.size(); ++f)
            for (const Sample& sample : found[f])
                for (int k = 0; k < 4; ++k)
                    if (faces_[f].ids[k] >= 0 && support_.kind[faces_[f].ids[k]] == Kind::surface)
                        visit(f, sample, k, faces_[f].ids[k]);
    };
    each([&](std::size_t, const Sample& sample, int, Index v) { normals.row(v) += sample.area; });
    Index count = 0;
    for (Index v = 0; v < vertices.rows(); ++v) {
        if (normals.row(v).norm() > 0) unknown[v] = count++;
        normals.row(v).normalize();
    }
    if (count == 0) return Points::Zero(vertices.rows(), 3);
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
    each([&](std::size_t f, const Sample& sample, int k, Index v) {
        const double area = sample.area.norm();
        const double here = sample.weights[k] * normals.row(v).dot(sample.area) / area;
        right[unknown[v]] += area * here * sample.distance;
        for (int j = 0; j < 4; ++j) {
            const Index other = faces_[f].ids[j];
            if (other < 0 || support_.kind[other] != Kind::surface) continue;
            const double there = sample.weights[j] * normals.row(other).dot(sample.area) / area;
            entries.emplace_back(unknown[v], unknown[other], area * here * there);
        }
    });
    Eigen::SparseMatrix<double> products(count, count);
    products.setFromTriplets(entries.begin(), entries.end());
    Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver(products);
    solver.setTolerance(1e-6);
    solver.setMaxIterations(200);
    const Eigen::VectorXd offsets = solver.solve(right);
    Points result = Points::Zero(vertices.rows(), 3);
    for (Index v = 0; v < vertices.rows(); ++v)
        if (unknown[v] >= 0 && std::isfinite(offsets[unknown[v]])) result.row(v) = offsets[unknown[v]] * normals.row(v);
    return result;
}

}  // namespace octafield::volume::detail
