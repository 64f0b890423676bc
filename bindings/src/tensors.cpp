// What tensor4 and odeco offer beyond the common operations.

#include <optional>

#include "bind.hpp"
#include "octafield/frames/odeco.hpp"
#include "octafield/frames/tensor4.hpp"
#include "rows.hpp"

namespace octafield::bindings {

using namespace frames;
using py::literals::operator""_a;

namespace {

using Vectors15 = Rows<double, 15>;

// (n, 3, 3, 3, 3) or (3, 3, 3, 3) as rows of 81.
RowInput<Rows<double, 81>> read_full(const ArrayLike& a) {
    const auto array = numbers<double>(a, "a");
    const bool single = array.ndim() == 4;
    bool right = single || array.ndim() == 5;
    for (py::ssize_t k = array.ndim() - 4; right && k < array.ndim(); ++k) right = array.shape(k) == 3;
    if (!right) throw_shape("a", "(n, 3, 3, 3, 3) or (3, 3, 3, 3)", array);
    const py::ssize_t n = single ? 1 : array.shape(0);
    Rows<double, 81> rows = Eigen::Map<const Rows<double, 81>>(array.data(), n, 81);
    require_finite_rows(rows, "a");
    return {std::move(rows), single};
}

// (n, 6, 6) or (6, 6) as rows of 36.
RowInput<Rows<double, 36>> read_mandel(const ArrayLike& p) {
    const auto array = numbers<double>(p, "p");
    const bool single = array.ndim() == 2;
    if ((!single && array.ndim() != 3) || array.shape(array.ndim() - 1) != 6 || array.shape(array.ndim() - 2) != 6)
        throw_shape("p", "(n, 6, 6) or (6, 6)", array);
    Rows<double, 36> rows = Eigen::Map<const Rows<double, 36>>(array.data(), single ? 1 : array.shape(0), 36);
    require_finite_rows(rows, "p");
    return {std::move(rows), single};
}

template <class Row>
Tensor4::Full full_of(const Row& row) {
    return Eigen::Map<const Eigen::Matrix<double, 9, 9, Eigen::RowMajor>>(row.data());
}

void bind_coordinates(py::module_& m) {
    m.def(
        "tensor4_full",
        [](const ArrayLike& v, int threads) {
            return map_rows<3, 3, 3, 3>(read_rows<Vectors15>(v, "v"), threads, [](const auto& row, auto out) {
                as_matrix<double, 9, 9>(out) = Tensor4::full(row.transpose());
            });
        },
        "v"_a, py::kw_only(), "threads"_a = 0,
        "(n, 3, 3, 3, 3) fully symmetric tensors of (n, 15) tensor4 vectors; the Frobenius norm is the Euclidean one.");
    m.def(
        "tensor4_from_full",
        [](const ArrayLike& a, int threads) {
            return map_rows<15>(read_full(a), threads,
                                [](const auto& row, auto out) { out = Tensor4::from_full(full_of(row)).transpose(); });
        },
        "a"_a, py::kw_only(), "threads"_a = 0,
        "(n, 15) tensor4 vectors of the symmetric parts of (n, 3, 3, 3, 3) tensors.");
    m.def(
        "tensor4_monomials",
        [](const ArrayLike& v, int threads) {
            return map_rows<15>(read_rows<Vectors15>(v, "v"), threads, [](const auto& row, auto out) {
                out = Tensor4::monomials(row.transpose()).transpose();
            });
        },
        "v"_a, py::kw_only(), "threads"_a = 0,
        "(n, 15) coefficients of the quartics A_ijkl x_i x_j x_k x_l; monomials x4 x3y x3z x2y2 x2yz x2z2 xy3 xy2z "
        "xyz2 "
        "xz3 y4 y3z y2z2 yz3 z4.");
    m.def(
        "tensor4_from_monomials",
        [](const ArrayLike& coefficients, int threads) {
            return map_rows<15>(
                read_rows<Vectors15>(coefficients, "coefficients"), threads,
                [](const auto& row, auto out) { out = Tensor4::from_monomials(row.transpose()).transpose(); });
        },
        "coefficients"_a, py::kw_only(), "threads"_a = 0, "The inverse of tensor4_monomials.");
    m.def(
        "tensor4_mandel",
        [](const ArrayLike& v, int threads) {
            return map_rows<6, 6>(read_rows<Vectors15>(v, "v"), threads, [](const auto& row, auto out) {
                as_matrix<double, 6, 6>(out) = Tensor4::mandel(row.transpose());
            });
        },
        "v"_a, py::kw_only(), "threads"_a = 0,
        "(n, 6, 6) Mandel matrices: the tensors as maps of symmetric matrices in the orthonormal basis xx, yy, zz, "
        "sqrt2 yz, sqrt2 zx, sqrt2 xy. A frame's is a projector of rank 3.");
    m.def(
        "tensor4_from_mandel",
        [](const ArrayLike& p, int threads) {
            return map_rows<15>(read_mandel(p), threads, [](const auto& row, auto out) {
                const Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>> matrix(row.data());
                out = Tensor4::from_mandel(matrix).transpose();
            });
        },
        "p"_a, py::kw_only(), "threads"_a = 0,
        "(n, 15) tensor4 vectors of the symmetric parts of (n, 6, 6) Mandel matrices.");
    m.def(
        "tensor4_affine",
        [](const ArrayLike& v, int threads) {
            return map_rows<9>(read_rows<Vectors15>(v, "v"), threads,
                               [](const auto& row, auto out) { out = Tensor4::affine(row.transpose()).transpose(); });
        },
        "v"_a, py::kw_only(), "threads"_a = 0,
        "(n, 9) coordinates in the affine space of tensors with the partial traces of a frame, A_iikl = delta_kl "
        "(Chemin et al. 2018); of the orthogonal projections of (n, 15) vectors onto it.");
    m.def(
        "tensor4_from_affine",
        [](const ArrayLike& p, int threads) {
            return map_rows<15>(read_rows<Rows<double, 9>>(p, "p"), threads, [](const auto& row, auto out) {
                out = Tensor4::from_affine(row.transpose()).transpose();
            });
        },
        "p"_a, py::kw_only(), "threads"_a = 0, "(n, 15) tensor4 vectors with the (n, 9) affine coordinates p.");
    m.def(
        "tensor4_to_sh4",
        [](const ArrayLike& v, int threads) {
            return map_rows<9>(read_rows<Vectors15>(v, "v"), threads,
                               [](const auto& row, auto out) { out = Tensor4::to_sh4(row.transpose()).transpose(); });
        },
        "v"_a, py::kw_only(), "threads"_a = 0, "(n, 9) sh4 vectors: the degree-4 parts of (n, 15) tensors.");
    m.def(
        "tensor4_from_sh4",
        [](const ArrayLike& a, int threads) {
            return map_rows<15>(read_rows<Rows<double, 9>>(a, "a"), threads, [](const auto& row, auto out) {
                out = Tensor4::from_sh4(row.transpose()).transpose();
            });
        },
        "a"_a, py::kw_only(), "threads"_a = 0,
        "(n, 15) tensors with the partial traces of a frame and the degree-4 parts a: distances become sqrt(6/5) times "
        "as long.");
}

void bind_characterisation(py::module_& m) {
    m.def(
        "tensor4_residual",
        [](const ArrayLike& a, int threads) {
            return map_rows<3>(read_full(a), threads, [](const auto& row, auto out) {
                const Tensor4::Residual r = Tensor4::residual(full_of(row));
                out << r.symmetry, r.partial_trace, r.projector;
            });
        },
        "a"_a, py::kw_only(), "threads"_a = 0,
        "(n, 3): how far (n, 3, 3, 3, 3) tensors are from full symmetry, from the partial traces A_iikl = delta_kl and "
        "from a projector as Mandel matrix (Frobenius norms; the last two of the symmetric part). All zero exactly for "
        "frames.");
    m.def(
        "tensor4_recover",
        [](const ArrayLike& v, int threads) {
            return map_rows<4>(read_rows<Vectors15>(v, "v"), threads, [](const auto& row, auto out) {
                out = to_wxyz(Tensor4::recover(row.transpose())).transpose();
            });
        },
        "v"_a, py::kw_only(), "threads"_a = 0,
        "(n, 4) frames of (n, 15) tensors by their eigentensors, jointly diagonalised (Chemin et al. 2018): exact for "
        "frames, near the nearest frame close to them.");
}

// frame, lengths, distance
py::tuple odeco_frames(const Rows<double, 8>& rows, bool single) {
    return py::make_tuple(give_back(Quaternions(rows.leftCols<4>()), {4}, single),
                          give_back(Points(rows.middleCols<3>(4)), {3}, single),
                          give_back(Eigen::VectorXd(rows.col(7)), {}, single));
}

template <class Row>
void store(const OdecoFrame& f, Row out) {
    out << to_wxyz(f.frame).transpose(), f.lengths.transpose(), f.distance;
}

void bind_odeco(py::module_& m) {
    m.def(
        "odeco_embed",
        [](const ArrayLike& q, const ArrayLike& lengths, int threads) {
            const auto [a, b] =
                broadcast(read_quaternions(q, "q"), read_rows<Points>(lengths, "lengths"), "q", "lengths");
            return map_pairs<15>(a, b, threads, [](const auto& x, const auto& y, auto out) {
                out = Odeco::embed(from_wxyz(x), Vector3(y.transpose())).transpose();
            });
        },
        "q"_a, "lengths"_a, py::kw_only(), "threads"_a = 0, "The same, (n, 15), with (n, 3) axis lengths.");
    m.def(
        "odeco_differential",
        [](const ArrayLike& q, const ArrayLike& lengths, int threads) {
            const auto [a, b] =
                broadcast(read_quaternions(q, "q"), read_rows<Points>(lengths, "lengths"), "q", "lengths");
            return map_pairs<15, 6>(a, b, threads, [](const auto& x, const auto& y, auto out) {
                as_matrix<double, 15, 6>(out) = Odeco::differential(from_wxyz(x), Vector3(y.transpose()));
            });
        },
        "q"_a, "lengths"_a, py::kw_only(), "threads"_a = 0,
        "(n, 15, 6) with (n, 3) axis lengths: columns 0-2 under world rotations, 3-5 by the lengths.");
    m.def(
        "odeco_nearest",
        [](const ArrayLike& v, const std::optional<ArrayLike>& guess, int threads) {
            auto input = read_rows<Vectors15>(v, "v");
            const auto n = input.rows.rows();
            auto guesses = read_guesses(guess, n);
            const auto result = for_rows(
                n, threads, Rows<double, 8>(n, 8),
                [rows = std::move(input.rows), guesses = std::move(guesses)](Rows<double, 8>& out, std::int64_t i) {
                    Quaternion start = Quaternion::Identity();
                    if (guesses.rows() > 0) start = from_wxyz(guesses.row(i));
                    store(Odeco::nearest(rows.row(i).transpose(), guesses.rows() > 0 ? &start : nullptr), out.row(i));
                });
            return odeco_frames(result, input.single);
        },
        "v"_a, "guess"_a = py::none(), py::kw_only(), "threads"_a = 0,
        "The nearest odeco tensors to (n, 15) vectors, lengths free: (n, 4) frames, (n, 3) axis lengths (falling) and "
        "(n,) distances. guess: (n, 4) frames to start from as well.");
    m.def(
        "odeco_nearest_local",
        [](const ArrayLike& v, const ArrayLike& start, int threads) {
            auto [a, b] = broadcast(read_rows<Vectors15>(v, "v"), read_quaternions(start, "start"), "v", "start");
            const auto n = a.rows.rows();
            const auto result = for_rows(
                n, threads, Rows<double, 8>(n, 8), [v = a.rows, q = b.rows](Rows<double, 8>& out, std::int64_t i) {
                    store(Odeco::nearest_local(v.row(i).transpose(), from_wxyz(q.row(i))), out.row(i));
                });
            return odeco_frames(result, a.single);
        },
        "v"_a, "start"_a, py::kw_only(), "threads"_a = 0,
        "Like odeco_nearest, (n, 4) frames, (n, 3) lengths and (n,) distances, by one ascent from the (n, 4) frames "
        "`start`: the "
        "local optimum next to them.");
    m.def(
        "odeco_extract",
        [](const ArrayLike& v, int threads) {
            auto input = read_rows<Vectors15>(v, "v");
            const auto n = input.rows.rows();
            const auto result = for_rows(n, threads, Rows<double, 8>(n, 8),
                                         [rows = std::move(input.rows)](Rows<double, 8>& out, std::int64_t i) {
                                             store(Odeco::extract(rows.row(i).transpose()), out.row(i));
                                         });
            return odeco_frames(result, input.single);
        },
        "v"_a, py::kw_only(), "threads"_a = 0,
        "Axes and lengths of (n, 15) tensors that are odeco up to rounding, by joint diagonalisation: frames, lengths, "
        "distances as in odeco_nearest.");
}

}  // namespace

void bind_tensors(py::module_& m) {
    bind_coordinates(m);
    bind_characterisation(m);
    bind_odeco(m);
}

}  // namespace octafield::bindings
