// How long edges shall be: the same everywhere, or by the vertices of a domain.
#pragma once

#include <Eigen/Core>
#include <utility>

#include "octafield/arrays.hpp"

namespace octafield::volume {

class EdgeLengths {
public:
    EdgeLengths(double everywhere) : longest_(everywhere), shortest_(everywhere) {}  // not explicit: a length is one
    explicit EdgeLengths(const Eigen::VectorXd& at_vertices)                         // (n), above 0, n > 0
        : longest_(at_vertices.maxCoeff()), shortest_(at_vertices.minCoeff()) {
        if (shortest_ < longest_) at_vertices_ = at_vertices;
    }

    double longest() const { return longest_; }
    double shortest() const { return shortest_; }
    bool vary() const { return at_vertices_.size() > 0; }
    double at(Index vertex) const { return vary() ? at_vertices_[vertex] : longest_; }
    // Between corners of a tet or triangle. weights: barycentric.
    template <class Corners, class Weights>
    double between(const Corners& corners, const Weights& weights) const {
        if (!vary()) return longest_;
        double sum = 0;
        for (Eigen::Index k = 0; k < corners.size(); ++k) sum += weights[k] * at_vertices_[corners[k]];
        return sum;
    }
    // At some vertices; empty where the lengths are the same everywhere.
    template <class Vertices>
    Eigen::VectorXd of(const Vertices& vertices) const {
        Eigen::VectorXd result(vary() ? static_cast<Eigen::Index>(vertices.size()) : 0);
        for (Eigen::Index i = 0; i < result.size(); ++i) result[i] = at_vertices_[vertices[i]];
        return result;
    }

private:
    double longest_, shortest_;
    Eigen::VectorXd at_vertices_;
};

}  // namespace octafield::volume
