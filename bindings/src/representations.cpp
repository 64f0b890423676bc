#include "representations.hpp"

#include <pybind11/stl.h>

#include <optional>
#include <string>

#include "octafield/frames/representation.hpp"
#include "octafield/frames/sh4.hpp"
#include "rows.hpp"

namespace octafield::bindings {

using namespace frames;
using py::literals::operator""_a;

namespace {

// One entry of the registry.
struct RepresentationEntry {
    std::string name;
    int dimension;
    py::object embed, differential, project;
};

template <Representation R>
py::object embed(const ArrayLike& q, int threads) {
    return map_rows<R::dimension>(read_quaternions(q, "q"), threads,
                                  [](const auto& row, auto out) { out = R::embed(from_wxyz(row)).transpose(); });
}

template <Representation R>
py::object differential(const ArrayLike& q, int threads) {
    return map_rows<R::dimension, 3>(read_quaternions(q, "q"), threads, [](const auto& row, auto out) {
        Eigen::Map<Eigen::Matrix<double, R::dimension, 3, Eigen::RowMajor>>(out.data()) =
            R::differential(from_wxyz(row));
    });
}

template <Representation R>
py::tuple project(const ArrayLike& a, const std::optional<ArrayLike>& guess, int threads) {
    auto input = read_rows<Rows<double, R::dimension>>(a, "a");
    const auto n = input.rows.rows();
    auto guesses = guess ? read_quaternions(*guess, "guess") : RowInput<Quaternions>{Quaternions(0, 4), true};
    if (guesses.rows.rows() == 1 && n != 1) guesses.rows = Quaternions(guesses.rows.replicate(n, 1));
    if (guess && guesses.rows.rows() != n)
        throw InvalidInput("guess has " + std::to_string(guesses.rows.rows()) + " rows, a " + std::to_string(n),
                           "wrong_shape");

    using Output = Rows<double, 5>;  // frame, distance
    const Output result = for_rows(
        n, threads, Output(n, 5),
        [rows = std::move(input.rows), guesses = std::move(guesses.rows)](Output& out, std::int64_t i) {
            const Quaternion start = guesses.rows() > 0 ? from_wxyz(guesses.row(i)) : Quaternion::Identity();
            const Projection nearest = R::project(rows.row(i).transpose(), guesses.rows() > 0 ? &start : nullptr);
            out.row(i) << to_wxyz(nearest.frame).transpose(), nearest.distance;
        });
    return py::make_tuple(give_back(Quaternions(result.leftCols<4>()), {4}, input.single),
                          give_back(Eigen::VectorXd(result.col(4)), {}, input.single));
}

template <Representation R>
void bind_representation(py::module_& m, const py::dict& registry) {
    const std::string name(R::name);
    const std::string d = std::to_string(R::dimension);
    m.def((name + "_embed").c_str(), embed<R>, "q"_a, py::kw_only(), "threads"_a = 0,
          ("(n, " + d + ") " + name + " vectors of (n, 4) unit quaternions w x y z. A single (4,) quaternion gives (" +
           d + ",).")
              .c_str());
    m.def((name + "_differential").c_str(), differential<R>, "q"_a, py::kw_only(), "threads"_a = 0,
          ("(n, " + d + ", 3): column k is the derivative of " + name +
           "_embed(exp(t e_k) q) by t at 0, e_k the k-th world axis.")
              .c_str());
    m.def((name + "_project").c_str(), project<R>, "a"_a, "guess"_a = py::none(), py::kw_only(), "threads"_a = 0,
          ("The frames nearest to (n, " + d +
           ") vectors: (n, 4) unit quaternions w x y z and (n,) Euclidean distances from the vectors to "
           "their embeddings. guess: (n, 4) frames to start from as well. A zero vector gives the identity.")
              .c_str());
    registry[py::str(name)] =
        RepresentationEntry{name, R::dimension, m.attr((name + "_embed").c_str()),
                            m.attr((name + "_differential").c_str()), m.attr((name + "_project").c_str())};
}

template <Representation... R>
void bind_all(py::module_& m, const py::dict& registry) {
    (bind_representation<R>(m, registry), ...);
}

}  // namespace

void bind_representations(py::module_& m) {
    py::class_<RepresentationEntry>(
        m, "Representation",
        "An embedding of frames into R^dimension that is the same for all 48 quaternions of a frame.")
        .def_readonly("name", &RepresentationEntry::name, "Its word, for example \"sh4\".")
        .def_readonly("dimension", &RepresentationEntry::dimension, "Numbers per frame.")
        .def_readonly("embed", &RepresentationEntry::embed,
                      "embed(q, *, threads=0): (n, dimension) vectors of (n, 4) quaternions.")
        .def_readonly("differential", &RepresentationEntry::differential,
                      "differential(q, *, threads=0): (n, dimension, 3) derivatives under world rotations.")
        .def_readonly("project", &RepresentationEntry::project,
                      "project(a, guess=None, *, threads=0): the nearest frames, (n, 4), and the distances, (n,).")
        .def("__repr__", [](const RepresentationEntry& entry) {
            return "Representation(" + entry.name + ", dimension " + std::to_string(entry.dimension) + ")";
        });
    const py::dict registry;
    bind_all<Sh4>(m, registry);
    m.attr("representations") = registry;
}

}  // namespace octafield::bindings
