#include "harmonic_lines.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "definiteness.hpp"
#include "sparse_cholesky.hpp"

namespace octafield::surface::detail {
namespace {

// Of the mean weight, what weights are raised to.
constexpr double least_of_mean = 1e-3;

std::vector<Index> numbers(const std::vector<bool>& given) {
    std::vector<Index> number(given.size(), -1);
    Index count = 0;
    for (std::size_t v = 0; v < given.size(); ++v)
        if (!given[v]) number[v] = count++;
    return number;
}

// Extends values that a transport turns by link.turn^power.
void extend(const std::vector<VertexLink>& links, const std::vector<Index>& number, int power,
            Eigen::VectorXcd& values) {
    const Index size = 1 + *std::max_element(number.begin(), number.end());
    std::vector<Eigen::Triplet<Complex>> entries;
    Eigen::VectorXcd right = Eigen::VectorXcd::Zero(size);
    for (const VertexLink& link : links) {
        const Complex across = link.weight * (power == 1 ? link.turn : link.turn * link.turn);
        const Index i = number[link.i], j = number[link.j];
        if (i >= 0) entries.emplace_back(i, i, link.weight);
        if (j >= 0) entries.emplace_back(j, j, link.weight);
        if (i >= 0 && j >= 0) {
            entries.emplace_back(std::max(i, j), std::min(i, j), j > i ? -across : -std::conj(across));
        } else if (i >= 0) {
            right[i] += std::conj(across) * values[link.j];
        } else if (j >= 0) {
            right[j] += across * values[link.i];
        }
    }
    Eigen::SparseMatrix<Complex> matrix(size, size);
    matrix.setFromTriplets(entries.begin(), entries.end());
    SparseCholesky<Complex> cholesky(matrix, SparseCholesky<Complex>::amd_order(matrix));
    if (!cholesky.factorize(matrix))
        throw SolverError("the matrix of the harmonic extension is not positive definite to rounding", not_definite);
    const Eigen::VectorXcd solution = cholesky.solve(right);
    for (std::size_t v = 0; v < number.size(); ++v)
        if (number[v] >= 0) values[static_cast<Eigen::Index>(v)] = solution[number[v]];
}

}  // namespace

std::vector<TwoLines> harmonic_lines(const std::vector<VertexLink>& links, const std::vector<bool>& given,
                                     std::vector<TwoLines> lines, Extended extended) {
    if (std::all_of(given.begin(), given.end(), [](bool g) { return g; })) return lines;
    const auto count = static_cast<Eigen::Index>(lines.size());
    Eigen::VectorXcd p1(count), other(count);
    for (Eigen::Index v = 0; v < count; ++v) {
        const PowerSums sums = power_sums(lines[v]);
        p1[v] = sums.p1;
        other[v] = extended == Extended::power_sums ? sums.p2 : (sums.p1 * sums.p1 - sums.p2) / 2.0;
    }
    const std::vector<Index> number = numbers(given);
    extend(links, number, 1, p1);
    extend(links, number, 2, other);
    for (Eigen::Index v = 0; v < count; ++v) {
        if (given[v]) continue;
        const Complex p2 = extended == Extended::power_sums ? other[v] : p1[v] * p1[v] - 2.0 * other[v];
        lines[v] = lines_of({p1[v], p2}).value_or(TwoLines{0, std::numbers::pi / 2});
    }
    return lines;
}

std::vector<VertexLink> with_positive_weights(std::vector<VertexLink> links) {
    double sum = 0;
    for (const VertexLink& link : links) sum += std::abs(link.weight);
    const double least = links.empty() ? 0 : least_of_mean * sum / static_cast<double>(links.size());
    for (VertexLink& link : links) link.weight = std::max(link.weight, least);
    return links;
}

}  // namespace octafield::surface::detail
