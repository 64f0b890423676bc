// Row-wise functions over arrays of frames or vectors: read, broadcast, map in parallel, give back in the input's
// shape.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "checks.hpp"
#include "gil.hpp"
#include "interruptible.hpp"
#include "octafield/parallel.hpp"

namespace octafield::bindings {

// Rows of an argument; `single` when it came without the leading dimension.
template <class Matrix>
struct RowInput {
    Matrix rows;
    bool single;
};

// Row-major; a single column, which Eigen forbids to be so, is a vector.
template <class Scalar, int Columns>
using RowsOf = Eigen::Matrix<Scalar, Eigen::Dynamic, Columns, Columns == 1 ? Eigen::ColMajor : Eigen::RowMajor>;

// The row-major matrix of a fixed size that an output row holds.
template <class Scalar, int R, int C, class Row>
auto as_matrix(Row&& row) {
    return Eigen::Map<Eigen::Matrix<Scalar, R, C, Eigen::RowMajor>>(row.data());
}

template <class Matrix>
void require_finite_rows(const Matrix& rows, std::string_view name) {
    for (Eigen::Index i = 0; i < rows.rows(); ++i)
        if (!rows.row(i).allFinite())
            throw InvalidInput(std::string(name) + ": row " + std::to_string(i) + " is not finite", "non_finite",
                               {static_cast<Index>(i)});
}

// (n, columns) or (columns,), finite.
template <class Matrix>
RowInput<Matrix> read_rows(const ArrayLike& value, std::string_view name) {
    constexpr int columns = Matrix::ColsAtCompileTime;
    const auto array = numbers<typename Matrix::Scalar>(value, name);
    const bool single = array.ndim() == 1 && array.size() == columns;
    if (!single && array.ndim() != 2 && array.size() > 0)
        throw_shape(name, "(n, " + std::to_string(columns) + ") or (" + std::to_string(columns) + ",)", array);
    RowInput<Matrix> input{
        single ? Matrix(Eigen::Map<const Matrix>(array.data(), 1, columns)) : from_python<Matrix>(array, name), single};
    require_finite_rows(input.rows, name);
    return input;
}

// Unit quaternions w x y z, normalised.
inline RowInput<Quaternions> read_quaternions(const ArrayLike& value, std::string_view name) {
    auto input = read_rows<Quaternions>(value, name);
    check_unit(input.rows, -1, name);
    return input;
}

// One frame for each of n rows, or none. A single one goes with every row.
inline Quaternions read_guesses(const std::optional<ArrayLike>& guess, std::int64_t n) {
    if (!guess) return Quaternions(0, 4);
    auto guesses = read_quaternions(*guess, "guess");
    if (guesses.rows.rows() == 1 && n != 1) return guesses.rows.replicate(n, 1);
    if (guesses.rows.rows() != n)
        throw InvalidInput("guess has " + std::to_string(guesses.rows.rows()) + " rows, v " + std::to_string(n) +
                               "; give one frame per row, or one for all",
                           "wrong_shape");
    return std::move(guesses.rows);
}

// (n, 3) or (3,) vectors of any length but zero, made unit.
inline RowInput<Points> read_directions(const ArrayLike& value, std::string_view name) {
    auto input = read_rows<Points>(value, name);
    for (Eigen::Index i = 0; i < input.rows.rows(); ++i) {
        const double largest = input.rows.row(i).cwiseAbs().maxCoeff();
        if (!(largest > 0))
            throw InvalidInput(std::string(name) + ": row " + std::to_string(i) + " is zero", "zero_vector",
                               {static_cast<Index>(i)});
        input.rows.row(i) /= largest;  // its square neither overflows nor vanishes
        input.rows.row(i).normalize();
    }
    return input;
}

// (n,) numbers, (n, 1) too, or a single one.
inline RowInput<Eigen::VectorXd> read_numbers(const ArrayLike& value, const char* name) {
    const auto array = numbers<double>(value, name);
    if (array.ndim() > 1 && array.size() != array.shape(0)) throw_shape(name, "(n,) or a number", array);
    RowInput<Eigen::VectorXd> input{Eigen::Map<const Eigen::VectorXd>(array.data(), array.size()), array.ndim() == 0};
    require_finite_rows(input.rows, name);
    return input;
}

// Two arguments row by row; one row goes with every row of the other.
template <class A, class B>
std::pair<RowInput<A>, RowInput<B>> broadcast(RowInput<A> a, RowInput<B> b, const std::string& name_a,
                                              const std::string& name_b) {
    const auto n = a.rows.rows(), m = b.rows.rows();
    if (n != m && n != 1 && m != 1)
        throw InvalidInput(name_a + " has " + std::to_string(n) + " rows, " + name_b + " " + std::to_string(m) +
                               "; give as many of both, or one of either",
                           "wrong_shape");
    const bool single = a.single && b.single;
    if (n == 1 && m != 1) a.rows = A(a.rows.replicate(m, 1));
    if (m == 1 && n != 1) b.rows = B(b.rows.replicate(n, 1));
    return {{std::move(a.rows), single}, {std::move(b.rows), single}};
}

// body(output, i) for every row i, without the GIL and, where it may take long, interruptible. A thread gets at least
// rows_per_thread rows.
template <class Output, class Body>
Output for_rows(std::int64_t n, int threads, Output output, Body body, std::int64_t rows_per_thread = 256) {
    threads_option(threads);
    auto work = [n, threads, rows_per_thread, output = std::move(output), body = std::move(body)](Job& job) mutable {
        const auto row = [&](std::int64_t i) {
            if (job.cancelled()) return;
            try {
                body(output, i);
            } catch (const InvalidInput& error) {
                if (n == 1) throw;
                throw InvalidInput("row " + std::to_string(i) + ": " + error.what(), error.kind(),
                                   {static_cast<Index>(i)});
            }
        };
        parallel_for(n, threads, row, rows_per_thread);
        return std::move(output);
    };
    if (n > 4 * rows_per_thread) return run_interruptible(std::move(work));
    const WithoutGil free;
    Job job;
    return work(job);
}

// numpy array of shape (n, shape...), or (shape...) for a single input; a number where nothing of the shape is left.
template <class Matrix>
py::object give_back(Matrix&& rows, std::vector<py::ssize_t> shape, bool single) {
    if (!single) shape.insert(shape.begin(), rows.rows());
    const bool number = shape.empty();
    const py::object array = own(std::move(rows), number ? std::vector<py::ssize_t>{1} : std::move(shape));
    return number ? array.attr("item")() : array;
}

// f(row, output row) for every row; output rows have the shape Shape.
template <class Scalar, int... Shape, class Matrix, class Function>
py::object map_rows_to(RowInput<Matrix> input, int threads, Function function) {
    using Output = RowsOf<Scalar, (1 * ... * Shape)>;
    const auto n = input.rows.rows();
    auto output = for_rows(
        n, threads, Output(n, Output::ColsAtCompileTime),
        [rows = std::move(input.rows), function](Output& out, std::int64_t i) { function(rows.row(i), out.row(i)); });
    return give_back(std::move(output), {Shape...}, input.single);
}

template <int... Shape, class Matrix, class Function>
py::object map_rows(RowInput<Matrix> input, int threads, Function function) {
    return map_rows_to<double, Shape...>(std::move(input), threads, std::move(function));
}

// f(row of a, row of b, output row) for every row; output rows have the shape Shape.
template <class Scalar, int... Shape, class A, class B, class Function>
py::object map_pairs_to(RowInput<A> a, RowInput<B> b, int threads, Function function) {
    using Output = RowsOf<Scalar, (1 * ... * Shape)>;
    const auto n = a.rows.rows();
    auto output = for_rows(n, threads, Output(n, Output::ColsAtCompileTime),
                           [a = std::move(a.rows), b = std::move(b.rows), function](Output& out, std::int64_t i) {
                               function(a.row(i), b.row(i), out.row(i));
                           });
    return give_back(std::move(output), {Shape...}, a.single);
}

template <int... Shape, class A, class B, class Function>
py::object map_pairs(RowInput<A> a, RowInput<B> b, int threads, Function function) {
    return map_pairs_to<double, Shape...>(std::move(a), std::move(b), threads, std::move(function));
}

}  // namespace octafield::bindings
