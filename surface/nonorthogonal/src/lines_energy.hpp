// E_s as a function of the angles of the lines: two unknowns per vertex, one where the first line is given and the
// second one free but for a bound, none where both are given.
#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <vector>

#include "boundary_lines.hpp"
#include "linked_vertices.hpp"

namespace octafield::surface::detail {

class LinesEnergy {
public:
    using State = Eigen::VectorXd;  // (n) unknowns
    using Matrix = Eigen::SparseMatrix<double>;
    enum class Curvature {
        exact,
        convex,  // the squares alone, without weights that are negative
    };
    struct Slope {
        double energy;
        Eigen::VectorXd gradient;  // (n)
    };

    // Keeps the references. Second lines on the boundary that the corner does not give are unknown; the angle between
    // the lines stays between low and high,
    //     (low + high) / 2 + (high - low) / pi atan(x):
    // least_angle and pi - least_angle where freedom is 1, both the angle that `boundary` has where it is 0, in between
    // linear. Freedom 0: no such unknowns.
    LinesEnergy(const std::vector<VertexLink>& links, const BoundaryLines& boundary, const VertexCharts& charts,
                double lambda, double least_angle, double freedom);

    Index size() const { return size_; }
    State state_of(const std::vector<TwoLines>& lines) const;
    std::vector<TwoLines> lines_of_state(const State& state) const;

    Slope slope(const State& state) const;
    // Lower triangle, with next to nothing added that keeps it definite where turning all lines changes nothing. The
    // pattern is the same on every call.
    const Matrix& hessian(const State& state, Curvature curvature);
    State turned(const State& state, const Eigen::VectorXd& direction, double length) const {
        return state + length * direction;
    }
    double rounding() const { return rounding_; }

private:
    // c2 sqrt(lambda) and c4 of one line of a vertex, and how they change with its unknown.
    struct Line {
        Index unknown = -1;
        std::array<Complex, 2> value, change, second_change;
    };
    struct Range {
        double middle = 0, half = 0;
    };
    using VertexLines = std::array<Line, 2>;
    std::vector<VertexLines> vertex_lines(const State& state) const;
    std::vector<std::array<Complex, 2>> forces(const std::vector<VertexLines>& vertices, double& energy) const;

    const std::vector<VertexLink>& links_;
    const BoundaryLines& boundary_;
    double root_lambda_, rounding_ = 0, shift_ = 0;
    Index size_ = 0;
    std::vector<std::array<Index, 2>> unknown_;  // (V), of the two lines, -1: given
    std::vector<Range> between_;                 // (V), of the angle between the lines where only one is unknown
    std::vector<double> positive_weights_;       // of the links
    Matrix matrix_;
};

}  // namespace octafield::surface::detail
