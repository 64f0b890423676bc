// Which of many triangles in the plane, or tets in space, that fill a box holds a point.
#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "octafield/arrays.hpp"

namespace octafield::volume::detail {

template <int D>
class SimplexSearch {
public:
    using Point = Eigen::Matrix<double, D, 1>;
    using Weights = Eigen::Matrix<double, D + 1, 1>;
    using Simplex = std::array<Point, D + 1>;
    struct Place {
        Index simplex;
        Weights weights;  // barycentric, those of points a rounding outside are made 0
    };

    explicit SimplexSearch(std::vector<Simplex> simplices) : simplices_(std::move(simplices)) {
        low_.setConstant(std::numeric_limits<double>::infinity());
        Point high = -low_;
        for (const Simplex& simplex : simplices_)
            for (const Point& p : simplex) {
                low_ = low_.cwiseMin(p);
                high = high.cwiseMax(p);
            }
        const auto count = static_cast<double>(simplices_.size());
        cells_ = std::max(1, static_cast<int>(std::pow(count, 1. / D)));
        for (int i = 0; i < D; ++i) cell_[i] = std::max((high[i] - low_[i]) / cells_, 1e-300);
        bins_.resize(static_cast<std::size_t>(std::pow(cells_, D) + 0.5));
        for (std::size_t s = 0; s < simplices_.size(); ++s) enter(static_cast<Index>(s));
    }

    // The one that the point lies deepest in, or, of a point outside all, is least outside of.
    Place find(const Point& point) const {
        Place best{-1, Weights::Zero()};
        double depth = -std::numeric_limits<double>::infinity();
        const auto look = [&](Index s) {
            const Weights weights = weights_of(simplices_[s], point);
            if (!(weights.minCoeff() > depth)) return;
            depth = weights.minCoeff();
            best = {s, weights};
        };
        for (const Index s : bins_[bin(cell_of(point))]) look(s);
        if (!(depth > -1e-9))
            for (std::size_t s = 0; s < simplices_.size(); ++s) look(static_cast<Index>(s));
        if (best.simplex < 0) return {0, Weights::Constant(1. / (D + 1))};
        best.weights = best.weights.cwiseMax(0);
        best.weights /= best.weights.sum();
        return best;
    }

private:
    using Cell = std::array<int, D>;

    Cell cell_of(const Point& point) const {
        Cell cell;
        for (int i = 0; i < D; ++i)
            cell[i] = std::clamp(static_cast<int>((point[i] - low_[i]) / cell_[i]), 0, cells_ - 1);
        return cell;
    }
    std::size_t bin(const Cell& cell) const {
        std::size_t number = 0;
        for (int i = 0; i < D; ++i) number = number * cells_ + cell[i];
        return number;
    }
    void enter(Index s) {
        Point low = simplices_[s][0], high = low;
        for (const Point& p : simplices_[s]) {
            low = low.cwiseMin(p);
            high = high.cwiseMax(p);
        }
        const Cell first = cell_of(low), last = cell_of(high);
        Cell cell = first;
        while (true) {
            bins_[bin(cell)].push_back(s);
            int i = 0;
            while (i < D && cell[i] == last[i]) cell[i] = first[i], ++i;
            if (i == D) return;
            ++cell[i];
        }
    }
    static Weights weights_of(const Simplex& simplex, const Point& point) {
        Eigen::Matrix<double, D, D> edges;
        for (int i = 0; i < D; ++i) edges.col(i) = simplex[i + 1] - simplex[0];
        Weights weights;
        weights.template tail<D>() = edges.inverse() * (point - simplex[0]);
        weights[0] = 1 - weights.template tail<D>().sum();
        return weights;
    }

    std::vector<Simplex> simplices_;
    Point low_, cell_;
    int cells_ = 1;
    std::vector<std::vector<Index>> bins_;
};

}  // namespace octafield::volume::detail
