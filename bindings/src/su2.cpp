// What su2 offers beyond the common operations, and the binary groups behind it. Points of C^3 are complex arrays.

#include <string>

#include "bind.hpp"
#include "octafield/frames/su2.hpp"
#include "octafield/frames/su2_metric.hpp"
#include "rows.hpp"

namespace octafield::bindings {

using namespace frames;
using py::literals::operator""_a;

namespace {

using Points3c = Rows<Complex, 3>;

RowInput<Points3c> read_points(const ArrayLike& h, const char* name) { return read_rows<Points3c>(h, name); }

void bind_points(py::module_& m) {
    m.def(
        "su2_complex",
        [](const ArrayLike& v, int threads) {
            return map_rows_to<Complex, 3>(read_rows<Rows<double, 6>>(v, "v"), threads, [](const auto& row, auto out) {
                out = Su2::complex(row.transpose()).transpose();
            });
        },
        "v"_a, py::kw_only(), "threads"_a = 0, "(n, 3) complex h0, h1, h2 of (n, 6) su2 vectors.");
    m.def(
        "su2_real",
        [](const ArrayLike& h, int threads) {
            return map_rows<6>(read_points(h, "h"), threads,
                               [](const auto& row, auto out) { out = Su2::real(row.transpose()).transpose(); });
        },
        "h"_a, py::kw_only(), "threads"_a = 0,
        "(n, 6) su2 vectors re h0, im h0, re h1, im h1, re h2, im h2 of (n, 3) complex points.");
    m.def(
        "su2_jacobian",
        [](const ArrayLike& q, int threads) {
            return map_rows_to<Complex, 3, 2>(read_quaternions(q, "q"), threads, [](const auto& row, auto out) {
                as_matrix<Complex, 3, 2>(out) = Su2::jacobian({row[0], row[1]}, {row[2], row[3]});
            });
        },
        "q"_a, py::kw_only(), "threads"_a = 0,
        "(n, 3, 2) complex derivatives of (h0, h1, h2) by u = q0 + i q1 and v = q2 + i q3; singular values in [0.3019, "
        "8].");
    m.def(
        "su2_surface_residual",
        [](const ArrayLike& h, int threads) {
            return map_rows_to<Complex>(read_points(h, "h"), threads, [](const auto& row, auto out) {
                out[0] = Su2::surface_residual(row.transpose());
            });
        },
        "h"_a, py::kw_only(), "threads"_a = 0,
        "(n,) complex h2^2 - h1 (h0^3 - 108 h1^2) of (n, 3) points: zero on the model surface.");
    m.def(
        "su2_squared_norm",
        [](const ArrayLike& h, int threads) {
            return map_rows<>(read_points(h, "h"), threads,
                              [](const auto& row, auto out) { out[0] = Su2::squared_norm(row.transpose()); });
        },
        "h"_a, py::kw_only(), "threads"_a = 0,
        "(n,) |u|^2 + |v|^2 of the quaternions with invariants h, (n, 3) complex, without computing one: 1 for "
        "frames.");
    m.def(
        "su2_inverse",
        [](const ArrayLike& h, double tolerance, int threads) {
            return map_rows<48, 4>(read_points(h, "h"), threads, [tolerance](const auto& row, auto out) {
                const auto all = Su2::inverse(row.transpose(), tolerance);
                auto matrix = as_matrix<double, 48, 4>(out);
                for (int k = 0; k < 48; ++k) matrix.row(k) = to_wxyz(all[k]).transpose();
            });
        },
        "h"_a, "tolerance"_a = 1e-6, py::kw_only(), "threads"_a = 0,
        "(n, 48, 4): all quaternions with invariants h, (n, 3) complex points of the model surface to `tolerance`; "
        "unit "
        "ones for frames.");
    m.def(
        "su2_inverse_frame",
        [](const ArrayLike& h, double tolerance, int threads) {
            return map_rows<4>(read_points(h, "h"), threads, [tolerance](const auto& row, auto out) {
                out = to_wxyz(Su2::inverse_frame(row.transpose(), tolerance)).transpose();
            });
        },
        "h"_a, "tolerance"_a = 1e-6, py::kw_only(), "threads"_a = 0,
        "(n, 4) frames with invariants h, up to the points' norm: the first of su2_inverse, normalised.");
}

void bind_axis(py::module_& m) {
    m.def(
        "su2_axis_turn",
        [](const ArrayLike& n, const ArrayLike& t, int threads) {
            const auto [a, b] = broadcast(read_directions(n, "n"), read_numbers(t, "t"), "n", "t");
            return map_pairs_to<Complex, 3>(a, b, threads, [](const auto& x, const auto& y, auto out) {
                out = Su2Axis(x.transpose()).turn(y[0]).transpose();
            });
        },
        "n"_a, "t"_a, py::kw_only(), "threads"_a = 0,
        "(n, 3) complex invariants of frames with the (n, 3) axis n, turned by t radians about it from the frame that "
        "takes "
        "x to n by the shortest arc.");
    m.def(
        "su2_axis_ellipse",
        [](const ArrayLike& n, int threads) {
            return map_rows_to<Complex, 5>(read_directions(n, "n"), threads, [](const auto& row, auto out) {
                const Su2Axis::Ellipse e = Su2Axis(row.transpose()).ellipse();
                out << e.center0, e.center1, e.plus, e.minus, e.ratio;
            });
        },
        "n"_a, py::kw_only(), "threads"_a = 0,
        "(n, 5) complex c0, c1, p, m, r: frames with axis n have h0 = c0 + p exp(4it) + m exp(-4it) and h1 = c1 + r (p "
        "exp(4it) + m exp(-4it)).");
    m.def(
        "su2_axis_linear_residual",
        [](const ArrayLike& n, const ArrayLike& h, int threads) {
            const auto [a, b] = broadcast(read_directions(n, "n"), read_points(h, "h"), "n", "h");
            return map_pairs_to<Complex>(a, b, threads, [](const auto& x, const auto& y, auto out) {
                out[0] = Su2Axis(x.transpose()).linear_residual(y.transpose());
            });
        },
        "n"_a, "h"_a, py::kw_only(), "threads"_a = 0,
        "(n,) complex a^2 h0 - h1 - 16 a^6, a = i (n_y + i n_z) / 2: zero if n or (-n_x, n_y, n_z) is an axis of the "
        "frame "
        "with invariants h.");
    m.def(
        "su2_axis_residual",
        [](const ArrayLike& n, const ArrayLike& h, int threads) {
            const auto [a, b] = broadcast(read_directions(n, "n"), read_points(h, "h"), "n", "h");
            return map_pairs_to<Complex, 2>(a, b, threads, [](const auto& x, const auto& y, auto out) {
                const auto r = Su2Axis(x.transpose()).residual(y.transpose());
                out << r[0], r[1];
            });
        },
        "n"_a, "h"_a, py::kw_only(), "threads"_a = 0,
        "(n, 2) complex: both zero exactly if n is an axis of the frame with invariants h.");
}

void bind_geometry(py::module_& m) {
    m.def(
        "su2_pulled_back",
        [](const ArrayLike& q, int threads) {
            return map_rows_to<Complex, 3, 3>(read_quaternions(q, "q"), threads, [](const auto& row, auto out) {
                as_matrix<Complex, 3, 3>(out) = su2_metric::pulled_back(from_wxyz(row));
            });
        },
        "q"_a, py::kw_only(), "threads"_a = 0,
        "(n, 3, 3) complex pulled-back metrics (J^+)^H J^+ at frames: dh^H M dh is |(du, dv)|^2 (Beaufort, thesis, "
        "4.33).");
    m.def(
        "su2_distance",
        [](const ArrayLike& h1, const ArrayLike& h2, int threads) {
            const auto [a, b] = broadcast(read_points(h1, "h1"), read_points(h2, "h2"), "h1", "h2");
            return map_pairs<>(a, b, threads, [](const auto& x, const auto& y, auto out) {
                out[0] = su2_metric::distance(x.transpose(), y.transpose());
            });
        },
        "h1"_a, "h2"_a, py::kw_only(), "threads"_a = 0,
        "(n,) geodesic distances in radians of points of the model surface, (n, 3) complex.");
    m.def(
        "su2_log",
        [](const ArrayLike& h1, const ArrayLike& h2, int threads) {
            const auto [a, b] = broadcast(read_points(h1, "h1"), read_points(h2, "h2"), "h1", "h2");
            return map_pairs_to<Complex, 3>(a, b, threads, [](const auto& x, const auto& y, auto out) {
                out = su2_metric::log(x.transpose(), y.transpose()).transpose();
            });
        },
        "h1"_a, "h2"_a, py::kw_only(), "threads"_a = 0,
        "(n, 3) complex tangent vectors at h1 whose su2_exp is h2; their su2_length is the distance.");
    m.def(
        "su2_exp",
        [](const ArrayLike& h, const ArrayLike& tangent, int threads) {
            const auto [a, b] = broadcast(read_points(h, "h"), read_points(tangent, "tangent"), "h", "tangent");
            return map_pairs_to<Complex, 3>(a, b, threads, [](const auto& x, const auto& y, auto out) {
                out = su2_metric::exp(x.transpose(), y.transpose()).transpose();
            });
        },
        "h"_a, "tangent"_a, py::kw_only(), "threads"_a = 0,
        "(n, 3) points of the model surface reached from h along tangent vectors, (n, 3) complex.");
    m.def(
        "su2_length",
        [](const ArrayLike& h, const ArrayLike& tangent, int threads) {
            const auto [a, b] = broadcast(read_points(h, "h"), read_points(tangent, "tangent"), "h", "tangent");
            return map_pairs<>(a, b, threads, [](const auto& x, const auto& y, auto out) {
                out[0] = su2_metric::length(x.transpose(), y.transpose());
            });
        },
        "h"_a, "tangent"_a, py::kw_only(), "threads"_a = 0,
        "(n,) angles in radians of the rotations that tangent vectors at h stand for.");
    m.def(
        "su2_mean",
        [](const ArrayLike& points, const std::optional<ArrayLike>& weights) {
            const auto input = read_points(points, "points");
            std::vector<Complex3> list;
            for (const auto& row : input.rows.rowwise()) list.push_back(row.transpose());
            const Eigen::VectorXd w = weights ? from_python<Eigen::VectorXd>(*weights, "weights") : Eigen::VectorXd();
            return own(Eigen::VectorXcd(su2_metric::mean(list, w)));
        },
        "points"_a, "weights"_a = py::none(),
        "The (3,) Karcher mean of (m, 3) complex points of the model surface; (m,) weights.");
}

void bind_groups(py::module_& m) {
    m.def(
        "binary_group_elements",
        [](const std::string& name) {
            const auto& list = elements(binary_group(name));
            Quaternions rows(static_cast<Eigen::Index>(list.size()), 4);
            for (std::size_t i = 0; i < list.size(); ++i) rows.row(i) = to_wxyz(list[i]).transpose();
            return own(std::move(rows));
        },
        "name"_a,
        "Unit quaternions of a binary group: \"vierer\" (8, 4), \"tetrahedral\" (24, 4), \"octahedral\" (48, 4), "
        "\"icosahedral\" "
        "(120, 4).");
    m.def(
        "binary_group_invariants",
        [](const std::string& name, const ArrayLike& q, int threads) {
            return map_rows_to<Complex, 3>(read_rows<Quaternions>(q, "q"), threads,
                                           [group = binary_group(name)](const auto& row, auto out) {
                                               out = invariants(group, from_wxyz(row)).transpose();
                                           });
        },
        "name"_a, "q"_a, py::kw_only(), "threads"_a = 0,
        "(n, 3) complex invariant forms f0, f1, f2 of a binary group at (n, 4) quaternions of any norm: the same for q "
        "and q "
        "o, o in the group.");
    m.def(
        "binary_group_relation_residual",
        [](const std::string& name, const ArrayLike& f, int threads) {
            return map_rows_to<Complex>(read_points(f, "f"), threads,
                                        [group = binary_group(name)](const auto& row, auto out) {
                                            out[0] = relation_residual(group, row.transpose());
                                        });
        },
        "name"_a, "f"_a, py::kw_only(), "threads"_a = 0,
        "(n,) complex f2^2 - P(f0, f1), the relation of a binary group's invariants; zero on their model surface.");
}

}  // namespace

void bind_su2(py::module_& m) {
    bind_points(m);
    bind_axis(m);
    bind_geometry(m);
    bind_groups(m);
}

}  // namespace octafield::bindings
