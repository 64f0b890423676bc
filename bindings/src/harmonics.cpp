// Real spherical harmonics by degree.

#include "octafield/frames/harmonics.hpp"
#include "bind.hpp"
#include "rows.hpp"

namespace octafield::bindings {

using namespace frames;
using py::literals::operator""_a;

namespace {

// visit.template operator()<degree>() for the degrees that are there.
template <class Visitor>
py::object with_degree(int degree, Visitor&& visit) {
    switch (degree) {
        case 2:
            return visit.template operator()<2>();
        case 4:
            return visit.template operator()<4>();
        case 6:
            return visit.template operator()<6>();
        case 8:
            return visit.template operator()<8>();
        case 9:
            return visit.template operator()<9>();
    }
    throw InvalidInput("degree " + std::to_string(degree) + " is not one of: 2, 4, 6, 8, 9", "unknown_option_value");
}

}  // namespace

void bind_harmonics(py::module_& m) {
    m.def(
        "harmonics_evaluate",
        [](int degree, const ArrayLike& directions, int threads) {
            const auto input = read_directions(directions, "directions");
            return with_degree(degree, [&]<int l>() {
                return map_rows<2 * l + 1>(input, threads, [](const auto& row, auto out) {
                    out = Harmonics<l>::evaluate(row.transpose()).transpose();
                });
            });
        },
        "degree"_a, "directions"_a, py::kw_only(), "threads"_a = 0,
        "(n, 2 degree + 1) real orthonormal spherical harmonics, order m = -degree..degree, at (n, 3) directions. "
        "Degrees 2, 4, 6, 8, 9; no Condon-Shortley phase.");
    m.def(
        "harmonics_rotation",
        [](int degree, const ArrayLike& g, int threads) {
            const auto input = read_quaternions(g, "g");
            return with_degree(degree, [&]<int l>() {
                return map_rows<2 * l + 1, 2 * l + 1>(input, threads, [](const auto& row, auto out) {
                    as_matrix<double, 2 * l + 1, 2 * l + 1>(out) = Harmonics<l>::rotation(from_wxyz(row));
                });
            });
        },
        "degree"_a, "g"_a, py::kw_only(), "threads"_a = 0,
        "(n, s, s) orthogonal matrices, s = 2 degree + 1, that turn the coefficients of functions by (n, 4) rotations "
        "g: "
        "(g f)(x) = f(g^-1 x).");
    m.def(
        "harmonics_rotate",
        [](int degree, const ArrayLike& g, const ArrayLike& v, int threads) {
            return with_degree(degree, [&]<int l>() {
                const auto [a, b] =
                    broadcast(read_quaternions(g, "g"), read_rows<Rows<double, 2 * l + 1>>(v, "v"), "g", "v");
                return map_pairs<2 * l + 1>(a, b, threads, [](const auto& x, const auto& y, auto out) {
                    out = Harmonics<l>::rotate(from_wxyz(x), y.transpose()).transpose();
                });
            });
        },
        "degree"_a, "g"_a, "v"_a, py::kw_only(), "threads"_a = 0,
        "(n, 2 degree + 1) coefficients v turned by (n, 4) rotations g, without forming the matrices.");
    m.def(
        "harmonics_generators",
        [](int degree) {
            return with_degree(degree, []<int l>() -> py::object {
                Rows<double, Eigen::Dynamic> rows(3, (2 * l + 1) * (2 * l + 1));
                for (int k = 0; k < 3; ++k)
                    as_matrix<double, 2 * l + 1, 2 * l + 1>(rows.row(k)) = Harmonics<l>::generators()[k];
                return give_back(std::move(rows), {2 * l + 1, 2 * l + 1}, false);
            });
        },
        "degree"_a,
        "(3, s, s) skew-symmetric matrices, s = 2 degree + 1: derivatives of harmonics_rotation under turns about the "
        "x, y, z axes.");
    m.def(
        "harmonics_octahedral",
        [](int degree) {
            return with_degree(degree,
                               []<int l>() -> py::object { return own(Eigen::VectorXd(Harmonics<l>::octahedral())); });
        },
        "degree"_a,
        "(2 degree + 1,) the unit coefficients that the 24 rotations of the cube leave unchanged; zero for degree 2, "
        "which has none.");
}

}  // namespace octafield::bindings
