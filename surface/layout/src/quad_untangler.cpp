#include "quad_untangler.hpp"

#include <ceres/gradient_problem.h>
#include <ceres/gradient_problem_solver.h>
#include <glog/logging.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace octafield::surface::detail {
namespace {

using Vector = Eigen::Vector3d;
constexpr int most_rounds = 25, most_iterations = 15, most_followed = 50;
constexpr double of_field = 40;          // beside shapes
constexpr double least_length = 1e-12;   // square, of the mean square of edges
constexpr double least_progress = 1e-3;  // of the sum, in a round without inverted corners

// The quads that count, with vertices of their own numbers: a few of a large mesh cost as much as few.
struct Counted {
    Counted(const QuadMesh& mesh, const Movable& movable) : quads(mesh.quads(movable.quads, Eigen::all)) {
        vertices.assign(quads.data(), quads.data() + quads.size());
        std::sort(vertices.begin(), vertices.end());
        vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
        part.resize(vertices.size());
        for (Index q = 0; q < quads.rows(); ++q)
            for (int k = 0; k < 4; ++k) {
                const auto found = std::lower_bound(vertices.begin(), vertices.end(), quads(q, k));
                quads(q, k) = static_cast<Index>(found - vertices.begin());
                part[quads(q, k)] = movable.part[movable.quads[q]];
            }
        positions = mesh.vertices(vertices, Eigen::all);
        near.assign(vertices.size(), -1);
    }
    auto nearest(const SurfaceParts& parts, Index v, const Vector& p) const {
        return parts.nearest(part[v], p, near[v]);
    }
    Quads quads;
    std::vector<Index> vertices;  // of the mesh, ascending: those on seams are the first
    std::vector<Index> part;      // of the surface
    std::vector<Index> near;      // a triangle not far from each
    Points positions;
};

// Of the vertices that can move: the values are lengths along seams, or pairs in tangent planes.
class Energy : public ceres::FirstOrderFunction {
public:
    Energy(const SmootherInput& input, Movable& movable, const QuadMesh& mesh, double of_sizes)
        : input_(input),
          places_(movable.places),
          counted_(mesh, movable),
          quads_(counted_.quads),
          first_(counted_.vertices.size(), -1),
          bases_(counted_.vertices.size()),
          of_sizes_(of_sizes) {
        for (Index q = 0; q < quads_.rows(); ++q) {
            Vector middle = Vector::Zero();
            for (int k = 0; k < 4; ++k) middle += Vector(counted_.positions.row(quads_(q, k))) / 4;
            Index& triangle = movable.triangles[movable.quads[q]];
            triangle = input.parts.nearest(movable.part[movable.quads[q]], middle, triangle).second;
            for (int k = 0; k < 4; ++k) counted_.near[quads_(q, k)] = triangle;
            normals_.push_back(input.parts.normal(triangle));
            wanted_.push_back(input.parts.unit_area(triangle));
            if (input.follow) set_lines(q, input.follow.direction(triangle, middle));
            for (int k = 0; k < 4; ++k) area_ += edge(q, k).squaredNorm();
        }
        for (Index v = 0; v < static_cast<Index>(first_.size()); ++v) {
            if (movable.fixed[counted_.vertices[v]]) continue;
            first_[v] = count_;
            count_ += is_on_seam(v) ? 1 : 2;
            if (is_on_seam(v)) continue;
            const Vector at = counted_.positions.row(v);
            const Vector n = input.parts.normal(counted_.nearest(input.parts, v, at).second);
            bases_[v].col(0) = n.unitOrthogonal();
            bases_[v].col(1) = n.cross(bases_[v].col(0));
        }
        area_ /= 4 * std::max<double>(1, static_cast<double>(quads_.rows()));
        double sum = 0, wanted = 0;
        for (Index q = 0; q < quads_.rows(); ++q) {
            const auto p = [&](int k) -> Vector { return counted_.positions.row(quads_(q, k)); };
            sum += (p(2) - p(0)).cross(p(3) - p(1)).norm() / 2;
            wanted += wanted_[q];
        }
        for (double& area : wanted_) area *= sum / wanted;
        const double worst = std::min(0.0, least(counted_.positions) / area_);
        softness_ = area_ * std::sqrt(1e-8 + 0.04 * worst * worst);
    }

    int NumParameters() const override { return count_; }

    bool Evaluate(const double* values, double* cost, double* gradient) const override {
        const Points at = positions(values);
        Points slope = Points::Zero(gradient ? at.rows() : 0, 3);
        *cost = 0;
        for (Index q = 0; q < quads_.rows(); ++q)
            for (int k = 0; k < 4; ++k) {
                const Index a = quads_(q, k), b = quads_(q, (k + 1) % 4), c = quads_(q, (k + 3) % 4);
                const Vector u = at.row(b) - at.row(a), v = at.row(c) - at.row(a), &n = normals_[q];
                const double d = u.cross(v).dot(n), root = std::sqrt(d * d + softness_ * softness_);
                const double below = d + root, above = u.squaredNorm() + v.squaredNorm();
                const double size = below / (2 * wanted_[q]);
                *cost += above / below + of_sizes_ * (size + 1 / size) / 2;
                if (input_.follow) *cost += of_field * (off_line(q, k, u) + off_line(q, k + 1, v));
                if (!gradient) continue;
                // below grows by below / root with d.
                const double by_d = -above / (below * root) + of_sizes_ * (size - 1 / size) / (2 * root);
                Vector gu = 2 * u / below + by_d * v.cross(n), gv = 2 * v / below + by_d * n.cross(u);
                if (input_.follow) {
                    gu += of_field * off_line_slope(q, k, u);
                    gv += of_field * off_line_slope(q, k + 1, v);
                }
                slope.row(b) += gu.transpose();
                slope.row(c) += gv.transpose();
                slope.row(a) -= (gu + gv).transpose();
            }
        if (gradient)
            for (Index v = 0; v < at.rows(); ++v) {
                if (first_[v] < 0) continue;
                const Vector g = slope.row(v);
                if (is_on_seam(v)) {
                    gradient[first_[v]] = g.dot(way_along(v, values[first_[v]]));
                } else {
                    Eigen::Map<Eigen::Vector2d>(gradient + first_[v]) = bases_[v].transpose() * g;
                }
            }
        return std::isfinite(*cost);
    }

    Points positions(const double* values) const {
        Points result = counted_.positions;
        for (Index v = 0; v < result.rows(); ++v) {
            if (first_[v] < 0) continue;
            if (is_on_seam(v)) {
                result.row(v) = position_on(seam_of(v), place(v, values[first_[v]]));
            } else {
                result.row(v) += (bases_[v] * Eigen::Map<const Eigen::Vector2d>(values + first_[v])).transpose();
            }
        }
        return result;
    }
    double along_seam(Index v, const double* values) const { return place(v, values[first_[v]]); }

    bool moves(Index v) const { return first_[v] >= 0; }
    const Counted& counted() const { return counted_; }

    // Parallelogram of a corner.
    double least(const Points& at) const {
        double result = std::numeric_limits<double>::infinity();
        for (Index q = 0; q < quads_.rows(); ++q)
            for (int k = 0; k < 4; ++k) {
                const Vector p = at.row(quads_(q, k)), u = at.row(quads_(q, (k + 1) % 4)),
                             v = at.row(quads_(q, (k + 3) % 4));
                result = std::min(result, (u - p).cross(v - p).dot(normals_[q]));
            }
        return result;
    }

private:
    // The two pairs of sides go by the two lines of the cross that they are nearer to.
    void set_lines(Index q, const Vector& line) {
        const Vector other = normals_[q].cross(line);
        double nearer = 0;
        for (int k = 0; k < 4; ++k) {
            const Vector side = edge(q, k);
            const double more = std::pow(side.dot(line), 2) - std::pow(side.dot(other), 2);
            nearer += k % 2 == 0 ? more : -more;
        }
        across_.push_back(nearer < 0 ? std::array{line, other} : std::array{other, line});
    }
    // sin^2 of the angle of side k from its line.
    double off_line(Index q, int k, const Vector& w) const {
        const double off = w.dot(across_[q][k % 2]);
        return off * off / (w.squaredNorm() + least_length * area_);
    }
    Vector off_line_slope(Index q, int k, const Vector& w) const {
        const double off = w.dot(across_[q][k % 2]), length = w.squaredNorm() + least_length * area_;
        return 2 * off / length * (across_[q][k % 2] - off / length * w);
    }

    Vector edge(Index q, int k) const {
        return counted_.positions.row(quads_(q, (k + 1) % 4)) - counted_.positions.row(quads_(q, k));
    }
    bool is_on_seam(Index v) const { return counted_.vertices[v] < static_cast<Index>(places_.size()); }
    const SideGrids::OnSeam& on_seam(Index v) const { return places_[counted_.vertices[v]]; }
    const Seam& seam_of(Index v) const { return input_.seams.seams[on_seam(v).seam]; }
    Vector way_along(Index v, double value) const {
        const Seam& seam = seam_of(v);
        const double step = 1e-6 * seam.length, at = place(v, value);
        const Vector way = (position_on(seam, at + step) - position_on(seam, at - step)) / (2 * step);
        if (seam.closed) return way;
        const double share = at / seam.length, start = start_of(v);
        return way * share * (1 - share) / (start * (1 - start));
    }
    double start_of(Index v) const {
        const Seam& seam = seam_of(v);
        return std::clamp(on_seam(v).at / seam.length, 1e-3, 1 - 1e-3);
    }
    // Near 0 a value is a length along the seam; those of open seams saturate at the ends, so that none is passed.
    double place(Index v, double value) const {
        const Seam& seam = seam_of(v);
        if (seam.closed) return on_seam(v).at + value;
        const double start = start_of(v);
        const double t = std::log(start / (1 - start)) + value / (seam.length * start * (1 - start));
        return seam.length / (1 + std::exp(-t));
    }

    const SmootherInput& input_;
    const std::vector<SideGrids::OnSeam>& places_;
    Counted counted_;
    const Quads& quads_;
    std::vector<int> first_;  // value of each vertex; -1: it stays
    std::vector<Eigen::Matrix<double, 3, 2>> bases_;
    std::vector<Vector> normals_;
    std::vector<double> wanted_;                 // area of each quad, in all that of the quads
    std::vector<std::array<Vector, 2>> across_;  // the lines of the field that is followed, at each quad
    double of_sizes_;
    int count_ = 0;
    double area_ = 0, softness_ = 0;
};

}  // namespace

Movable::Movable(const SmootherInput& input, const QuadMesh& mesh)
    : places(input.on_seams), fixed(mesh.vertices.rows(), false) {
    for (std::size_t v = 0; v < places.size(); ++v) fixed[v] = places[v].seam < 0 || places[v].held;
    for (const Index v : input.fixed)
        if (!input.follow && v >= static_cast<Index>(places.size())) {
            fixed[v] = true;
            held.push_back(v);
        }
    std::vector<Index> part_of_patch;
    for (const LayoutPatch& patch : input.layout.patches) part_of_patch.push_back(input.parts.part_of(patch));
    for (const Index patch : input.patches) part.push_back(part_of_patch[patch]);
    triangles.assign(mesh.quads.rows(), -1);
    quads.resize(mesh.quads.rows());
    std::iota(quads.begin(), quads.end(), 0);
}

void untangle(const SmootherInput& input, Movable& movable, double of_sizes, QuadMesh& mesh) {
    std::vector<SideGrids::OnSeam>& places = movable.places;
    FLAGS_minloglevel = google::GLOG_FATAL;  // a line search that fails ends a round, no more
    ceres::GradientProblemSolver::Options options;
    options.max_num_iterations = input.follow ? most_followed : most_iterations;
    options.logging_type = ceres::SILENT;
    for (int round = 0; round < most_rounds; ++round) {
        auto* energy = new Energy(input, movable, mesh, of_sizes);
        const ceres::GradientProblem problem(energy);  // owns it
        if (energy->NumParameters() == 0) return;
        std::vector<double> values(energy->NumParameters(), 0);
        ceres::GradientProblemSolver::Summary summary;
        ceres::Solve(options, problem, values.data(), &summary);
        const Points found = energy->positions(values.data());
        const bool sound = energy->least(found) > 0;
        const Counted& counted = energy->counted();
        for (Index i = 0; i < found.rows(); ++i) {
            if (!energy->moves(i)) continue;
            const Index v = counted.vertices[i];
            if (v < static_cast<Index>(places.size())) {
                places[v].at = energy->along_seam(i, values.data());
                mesh.vertices.row(v) = position_on(input.seams.seams[places[v].seam], places[v].at);
            } else {
                mesh.vertices.row(v) = counted.nearest(input.parts, i, found.row(i).transpose()).first;
            }
        }
        if (sound && summary.initial_cost - summary.final_cost < least_progress * summary.initial_cost) return;
    }
}

}  // namespace octafield::surface::detail
