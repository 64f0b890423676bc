#include "octafield/volume/diffuse.hpp"

#include <Eigen/IterativeLinearSolvers>
#include <cmath>
#include <numbers>
#include <vector>

#include "constraints.hpp"
#include "octafield/frames/sh4.hpp"
#include "octafield/parallel.hpp"
#include "octafield/volume/operators.hpp"

namespace octafield::volume {
namespace {

using frames::Quaternion;
using frames::Sh4;
using frames::Vector3;
using frames::Vector4;

constexpr int components = Sh4::dimension;

// sh4 vectors of all frames with one axis fixed: centre + cos(4t) u + sin(4t) v, t the twist from `reference`
// (Ray, Sokolov, Levy 2016, section 3).
struct TwistCircle {
    Quaternion reference;
    Vector3 axis;
    Sh4::Vector centre;
    Eigen::Matrix<double, components, 2> plane;  // columns u, v: orthogonal, squared norm 5/12

    TwistCircle(const Quaternion& frame, const Vector3& about) : reference(frame), axis(about) {
        const auto turned = [&](double angle) { return Sh4::embed(frames::exp(angle * axis) * reference); };
        const Sh4::Vector start = turned(0), opposite = turned(std::numbers::pi / 4);
        centre = (start + opposite) / 2;
        plane.col(0) = (start - opposite) / 2;
        plane.col(1) = turned(std::numbers::pi / 8) - centre;
    }
    Quaternion frame_at(const Eigen::Vector2d& coordinates) const {
        return frames::exp(std::atan2(coordinates[1], coordinates[0]) / 4 * axis) * reference;
    }
};

// The heat equation in the space the constraints leave: nine unknowns at a free vertex, two at one with a fixed axis.
class ConstrainedHeat {
public:
    ConstrainedHeat(const TetMesh& mesh, const BoundaryConstraints& constraints, const Quaternions& frames);

    // One implicit step of the given time (input length squared) from `frames`, projected back onto frames.
    Quaternions step(const Quaternions& frames, double time, int threads);

private:
    struct Vertex {
        VertexConstraint kind;
        Index first;   // of its unknowns
        Index circle;  // in circles_, where kind is axis
    };
    using Basis = Eigen::Matrix<double, components, Eigen::Dynamic, 0, components, components>;

    Basis basis(Index vertex) const;
    Eigen::VectorXd unknowns_of(const Quaternions& frames) const;
    void assemble(const SparseMatrix& stiffness);

    std::vector<Vertex> vertices_;
    std::vector<TwistCircle> circles_;
    Rows<double, components> constant_;  // (n, 9): the part the unknowns do not reach
    SparseMatrix system_;                // basis^T L basis
    Eigen::VectorXd mass_;               // basis^T M basis, diagonal
    Eigen::VectorXd load_;               // -basis^T L constant
    Eigen::VectorXd solution_;           // of the last step: start of the next solve
};

ConstrainedHeat::ConstrainedHeat(const TetMesh& mesh, const BoundaryConstraints& constraints,
                                 const Quaternions& frames) {
    const Index n = static_cast<Index>(mesh.vertices.rows());
    constant_ = Rows<double, components>::Zero(n, components);
    Index unknowns = 0;
    for (Index v = 0; v < n; ++v) {
        const Quaternion q = frames::from_wxyz(Vector4(frames.row(v).transpose()));
        const VertexConstraint kind = constraints.kind[v];
        vertices_.push_back({kind, unknowns, static_cast<Index>(circles_.size())});
        if (kind == VertexConstraint::fixed) constant_.row(v) = Sh4::embed(q).transpose();
        if (kind == VertexConstraint::free) unknowns += components;
        if (kind == VertexConstraint::axis) {
            circles_.emplace_back(q, Vector3(constraints.axis.row(v).transpose()));
            constant_.row(v) = circles_.back().centre.transpose();
            unknowns += 2;
        }
    }
    const Eigen::VectorXd lumped = lumped_mass(mesh);
    mass_.resize(unknowns);
    for (Index v = 0; v < n; ++v)
        for (Index k = 0; k < basis(v).cols(); ++k)
            mass_[vertices_[v].first + k] = lumped[v] * basis(v).col(k).squaredNorm();
    assemble(stiffness(mesh));
}

ConstrainedHeat::Basis ConstrainedHeat::basis(Index vertex) const {
    switch (vertices_[vertex].kind) {
        case VertexConstraint::free:
            return Basis::Identity(components, components);
        case VertexConstraint::axis:
            return circles_[vertices_[vertex].circle].plane;
        default:
            return Basis(components, 0);
    }
}

void ConstrainedHeat::assemble(const SparseMatrix& stiffness) {
    std::vector<Eigen::Triplet<double>> entries;
    for (Index k = 0; k < mass_.size(); ++k) entries.emplace_back(k, k, 0.0);  // vertices of no tet have no entry else
    load_ = Eigen::VectorXd::Zero(mass_.size());
    for (Index j = 0; j < stiffness.cols(); ++j) {
        const Basis right = basis(j);
        for (SparseMatrix::InnerIterator it(stiffness, j); it; ++it) {
            const Index i = static_cast<Index>(it.row());
            const Basis left = basis(i);
            if (left.cols() == 0) continue;
            load_.segment(vertices_[i].first, left.cols()) -=
                it.value() * left.transpose() * constant_.row(j).transpose();
            const Eigen::MatrixXd block = it.value() * left.transpose() * right;
            for (Index r = 0; r < block.rows(); ++r)
                for (Index c = 0; c < block.cols(); ++c)
                    if (block(r, c) != 0)
                        entries.emplace_back(vertices_[i].first + r, vertices_[j].first + c, block(r, c));
        }
    }
    system_.resize(mass_.size(), mass_.size());
    system_.setFromTriplets(entries.begin(), entries.end());
}

Eigen::VectorXd ConstrainedHeat::unknowns_of(const Quaternions& frames) const {
    Eigen::VectorXd x(mass_.size());
    for (std::size_t v = 0; v < vertices_.size(); ++v) {
        const Basis b = basis(static_cast<Index>(v));
        if (b.cols() == 0) continue;
        const Sh4::Vector a = Sh4::embed(frames::from_wxyz(Vector4(frames.row(v).transpose())));
        x.segment(vertices_[v].first, b.cols()) =
            (b.transpose() * (a - constant_.row(v).transpose())).cwiseQuotient(b.colwise().squaredNorm().transpose());
    }
    return x;
}

Quaternions ConstrainedHeat::step(const Quaternions& frames, double time, int threads) {
    if (mass_.size() == 0) return frames;
    const Eigen::VectorXd before = unknowns_of(frames);
    SparseMatrix matrix = system_;
    matrix.diagonal() += mass_ / time;
    Eigen::ConjugateGradient<SparseMatrix, Eigen::Lower | Eigen::Upper> solver(matrix);  // Jacobi preconditioner
    solver.setTolerance(1e-4);  // of a step that is projected anyway
    solution_ = solver.solveWithGuess(load_ + mass_.cwiseProduct(before) / time, solution_.size() ? solution_ : before);
    if (!solution_.allFinite())
        throw SolverError("a diffusion step failed; look for degenerate tets (octafield info)", "diffusion");

    Quaternions result = frames;
    parallel_for(static_cast<std::int64_t>(vertices_.size()), threads, [&](std::int64_t v) {
        const Vertex& vertex = vertices_[v];
        if (vertex.kind == VertexConstraint::fixed) return;
        const Quaternion guess = frames::from_wxyz(Vector4(frames.row(v).transpose()));
        const Quaternion q = vertex.kind == VertexConstraint::axis
                                 ? circles_[vertex.circle].frame_at(solution_.segment<2>(vertex.first))
                                 : Sh4::project(solution_.segment<components>(vertex.first), &guess).frame;
        result.row(v) = frames::to_wxyz(q.normalized()).transpose();
    });
    return result;
}

}  // namespace

SmoothResult diffuse(const TetMesh& mesh, const BoundaryConstraints& constraints, const Quaternions& start,
                     const DiffuseOptions& options, const Progress& progress) {
    require_fitting(mesh, constraints, start);
    if (!(options.first_time > 0)) throw InvalidInput("first_time must be positive", "bad_option");
    if (!(options.time_exponent > 0)) throw InvalidInput("time_exponent must be positive", "bad_option");
    if (options.max_steps < 0) throw InvalidInput("max_steps is negative; give 0 or more", "bad_option");

    const surface::TriangleMesh boundary = boundary_surface(mesh).mesh;
    const double size = 3 * tet_volumes(mesh).sum() / surface::triangle_areas(boundary).sum();
    const double last_time = std::pow(surface::mean_edge_length(boundary) / 4, 2);

    SmoothResult result;
    Quaternions current = constrained_start(constraints, start);
    result.frames = current;
    result.energy = dirichlet_energy(mesh, current, options.threads);
    result.energy_history.push_back(result.energy);
    result.message = "the step's time reached the mesh size";
    result.converged = true;
    ConstrainedHeat heat(mesh, constraints, current);
    for (int k = 1;; ++k) {
        const double time = options.first_time * size * size / std::pow(k, options.time_exponent);
        if (k > 1 && time < last_time) break;
        if (k > options.max_steps ||
            !report(progress, "diffuse", std::min(1.0, std::pow(last_time / time, 1 / options.time_exponent)),
                    result.energy)) {
            result.converged = false;
            result.message = k > options.max_steps ? "max_steps reached" : "cancelled";
            break;
        }
        current = heat.step(current, time, options.threads);
        const double energy = dirichlet_energy(mesh, current, options.threads);
        result.energy_history.push_back(energy);
        result.iterations = k;
        if (energy < result.energy) {
            result.energy = energy;
            result.frames = current;
        }
    }
    return result;
}

}  // namespace octafield::volume
