// Functions of frames/ on arrays: one row per frame, rows in parallel.

#include <optional>

#include "arrays.hpp"
#include "bind.hpp"
#include "checks.hpp"
#include "interruptible.hpp"
#include "octafield/frames/geodesic.hpp"
#include "octafield/frames/octahedral_group.hpp"
#include "octafield/frames/quaternion.hpp"
#include "octafield/parallel.hpp"
#include "rows.hpp"

namespace octafield::bindings {

using namespace frames;
using py::literals::operator""_a;

namespace {

void bind_quaternions(py::module_& m) {
    m.def(
        "quaternion_exp",
        [](const ArrayLike& rotation_vectors, int threads) {
            const auto input = read_rows<Points>(rotation_vectors, "rotation_vectors");
            return map_rows<4>(input, threads,
                               [](const auto& w, auto out) { out = to_wxyz(exp(w.transpose())).transpose(); });
        },
        "rotation_vectors"_a, py::kw_only(), "threads"_a = 0,
        "(n, 4) unit quaternions w x y z of the rotations by |w| radians about w / |w|, for (n, 3) vectors w. A single "
        "(3,) vector gives (4,).");
    m.def(
        "quaternion_log",
        [](const ArrayLike& q, int threads) {
            return map_rows<3>(read_quaternions(q, "q"), threads,
                               [](const auto& row, auto out) { out = log(from_wxyz(row)).transpose(); });
        },
        "q"_a, py::kw_only(), "threads"_a = 0,
        "(n, 3) rotation vectors of (n, 4) unit quaternions, angle in [0, pi] radians: quaternion_exp gives q or -q "
        "back.");
    m.def(
        "rotation_matrices",
        [](const ArrayLike& q, int threads) {
            const auto to_matrix = [](const auto& row, auto out) {
                as_matrix<double, 3, 3>(out) = from_wxyz(row).toRotationMatrix();
            };
            return map_rows<3, 3>(read_quaternions(q, "q"), threads, to_matrix);
        },
        "q"_a, py::kw_only(), "threads"_a = 0,
        "(n, 3, 3) rotation matrices of (n, 4) unit quaternions; the columns are the frame's axes.");
    m.def(
        "random_rotations",
        [](std::int64_t n, std::uint64_t seed) {
            if (n < 0) throw InvalidInput("n: " + std::to_string(n) + " is negative", "option_out_of_range");
            return own(run_interruptible([n, seed](Job&) { return random_rotations(n, seed); }));
        },
        "n"_a, "seed"_a = 0,
        "(n, 4) unit quaternions of rotations distributed uniformly (Shoemake 1992); the same numbers on every "
        "platform for one seed.");
    m.def(
        "frame_from_axes",
        [](const ArrayLike& directions, const ArrayLike& normals, int threads) {
            auto [d, n] = broadcast(read_rows<Points>(directions, "directions"), read_directions(normals, "normals"),
                                    "directions", "normals");
            return map_pairs<4>(d, n, threads, [](const auto& direction, const auto& normal, auto out) {
                out = to_wxyz(frame_from_axes(direction.transpose(), normal.transpose())).transpose();
            });
        },
        "directions"_a, "normals"_a, py::kw_only(), "threads"_a = 0,
        "(n, 4) frames whose third axis is the (n, 3) normal and whose first axis is the part of the (n, 3) direction "
        "orthogonal to it.");
}

void bind_group(py::module_& m) {
    const auto quaternions = [](const auto& group) {
        Quaternions rows(static_cast<Eigen::Index>(group.size()), 4);
        for (Eigen::Index i = 0; i < rows.rows(); ++i) rows.row(i) = to_wxyz(group[i]).transpose();
        return own(std::move(rows));
    };
    m.def(
        "octahedral_group", [quaternions] { return quaternions(octahedral_group()); },
        "(24, 4) unit quaternions w x y z of the rotations of the cube, w >= 0. Numbers: 0 identity; 1-3 half turns "
        "about x, y, z; 4-9 "
        "quarter turns about +x, -x, +y, -y, +z, -z; 10-15 half turns about face diagonals; 16-23 third turns about "
        "space diagonals.");
    m.def(
        "binary_octahedral_group", [quaternions] { return quaternions(binary_octahedral_group()); },
        "(48, 4) unit quaternions: octahedral_group(), then their negatives.");
    m.def(
        "octahedral_product_table",
        [] {
            Rows<Index, Eigen::Dynamic> table(octahedral_order, octahedral_order);
            for (int a = 0; a < octahedral_order; ++a)
                for (int b = 0; b < octahedral_order; ++b) table(a, b) = octahedral_product(a, b);
            return own(std::move(table));
        },
        "(24, 24) int32: entry [a, b] is the number of o_a * o_b.");
    m.def(
        "octahedral_inverse_table",
        [] {
            std::vector<Index> table(octahedral_order);
            for (int a = 0; a < octahedral_order; ++a) table[a] = octahedral_inverse(a);
            return own(std::move(table));
        },
        "(24,) int32: entry [a] is the number of the inverse of o_a.");
}

void bind_frame_pairs(py::module_& m) {
    m.def(
        "distance",
        [](const ArrayLike& q1, const ArrayLike& q2, int threads) {
            const auto [a, b] = broadcast(read_quaternions(q1, "q1"), read_quaternions(q2, "q2"), "q1", "q2");
            return map_pairs<>(a, b, threads, [](const auto& x, const auto& y, auto out) {
                out[0] = distance(from_wxyz(x), from_wxyz(y));
            });
        },
        "q1"_a, "q2"_a, py::kw_only(), "threads"_a = 0,
        "(n,) geodesic distances of frames in radians, in [0, 1.0961], for (n, 4) unit quaternions; a single (4,) goes "
        "with every row of the other.");
    m.def(
        "matching",
        [](const ArrayLike& q1, const ArrayLike& q2, int threads) {
            const auto [a, b] = broadcast(read_quaternions(q1, "q1"), read_quaternions(q2, "q2"), "q1", "q2");
            return map_pairs_to<Index>(a, b, threads, [](const auto& x, const auto& y, auto out) {
                out[0] = matching(from_wxyz(x), from_wxyz(y));
            });
        },
        "q1"_a, "q2"_a, py::kw_only(), "threads"_a = 0,
        "(n,) int32 numbers of the octahedral_group() elements o that bring q1 * o closest to q2, for (n, 4) unit "
        "quaternions.");
    m.def(
        "closest_representative",
        [](const ArrayLike& q, const ArrayLike& reference, int threads) {
            const auto [a, b] =
                broadcast(read_quaternions(q, "q"), read_quaternions(reference, "reference"), "q", "reference");
            return map_pairs<4>(a, b, threads, [](const auto& x, const auto& y, auto out) {
                out = to_wxyz(closest_representative(from_wxyz(x), from_wxyz(y))).transpose();
            });
        },
        "q"_a, "reference"_a, py::kw_only(), "threads"_a = 0,
        "(n, 4): the quaternion q * o of the same frame that is closest to the reference, signed so that their dot "
        "product is positive.");
}

// (n, m, 4) or (m, 4) frames; no weights, (m,) or (n, m).
py::tuple frame_means(const ArrayLike& frames, const std::optional<ArrayLike>& weights, int threads) {
    const auto array = numbers<double>(frames, "frames");
    const bool single = array.ndim() == 2;
    if (array.ndim() < 2 || array.ndim() > 3 || array.shape(array.ndim() - 1) != 4)
        throw_shape("frames", "(m, 4) or (n, m, 4)", array);
    const py::ssize_t n = single ? 1 : array.shape(0), m = array.shape(array.ndim() - 2);
    Quaternions rows = Eigen::Map<const Quaternions>(array.data(), n * m, 4);
    check_unit(rows, -1, "frames");

    Eigen::VectorXd all_weights;
    if (weights) {
        const auto w = numbers<double>(*weights, "weights");
        const bool one_per_frame = w.ndim() == 2 && w.shape(0) == n && w.shape(1) == m;
        if (!one_per_frame && !(w.ndim() == 1 && w.size() == m)) throw_shape("weights", "(m,) or (n, m)", w);
        all_weights = Eigen::Map<const Eigen::VectorXd>(w.data(), w.size());
    }
    const auto means =
        for_rows(n, threads, Rows<double, 6>(n, 6), [rows, m, all_weights](Rows<double, 6>& out, std::int64_t i) {
            const bool own_row = all_weights.size() > m;
            const FrameMean mean =
                frame_mean(rows.middleRows(i * m, m), own_row ? all_weights.segment(i * m, m).eval() : all_weights);
            out.row(i) << to_wxyz(mean.frame).transpose(), mean.variance, mean.converged;
        });
    return py::make_tuple(give_back(Quaternions(means.leftCols<4>()), {4}, single),
                          give_back(Eigen::VectorXd(means.col(4)), {}, single),
                          give_back(Eigen::VectorXd(means.col(5)), {}, single).attr("__ne__")(0));
}

void bind_geodesics(py::module_& m) {
    m.def(
        "frame_exp",
        [](const ArrayLike& q, const ArrayLike& w, int threads) {
            const auto [a, b] = broadcast(read_quaternions(q, "q"), read_rows<Points>(w, "w"), "q", "w");
            return map_pairs<4>(a, b, threads, [](const auto& x, const auto& y, auto out) {
                out = to_wxyz(frame_exp(from_wxyz(x), y.transpose())).transpose();
            });
        },
        "q"_a, "w"_a, py::kw_only(), "threads"_a = 0,
        "(n, 4) frames exp(w) q: frame q turned by the (n, 3) rotation vector w, world axes, radians.");
    m.def(
        "frame_log",
        [](const ArrayLike& q1, const ArrayLike& q2, int threads) {
            const auto [a, b] = broadcast(read_quaternions(q1, "q1"), read_quaternions(q2, "q2"), "q1", "q2");
            return map_pairs<3>(a, b, threads, [](const auto& x, const auto& y, auto out) {
                out = frame_log(from_wxyz(x), from_wxyz(y)).transpose();
            });
        },
        "q1"_a, "q2"_a, py::kw_only(), "threads"_a = 0,
        "(n, 3) smallest rotation vectors from frames q1 to frames q2, world axes, radians: frame_exp(q1, w) is the "
        "frame q2 and |w| is distance(q1, q2).");
    m.def(
        "slerp",
        [](const ArrayLike& q1, const ArrayLike& q2, const ArrayLike& t, int threads) {
            using Ends = Rows<double, 8>;
            const auto [a, b] = broadcast(read_quaternions(q1, "q1"), read_quaternions(q2, "q2"), "q1", "q2");
            Ends ends(a.rows.rows(), 8);
            ends << a.rows, b.rows;
            const auto [pairs, fractions] =
                broadcast(RowInput<Ends>{std::move(ends), a.single}, read_numbers(t, "t"), "q1", "t");
            return map_pairs<4>(pairs, fractions, threads, [](const auto& x, const auto& y, auto out) {
                const Quaternion from(x[0], x[1], x[2], x[3]), to(x[4], x[5], x[6], x[7]);
                out = to_wxyz(slerp(from, to, y[0])).transpose();
            });
        },
        "q1"_a, "q2"_a, "t"_a, py::kw_only(), "threads"_a = 0,
        "(n, 4) frames at the fractions t, a number or (n,), of the shortest paths from the (n, 4) frames q1 (t = 0) "
        "to the "
        "frames q2 (t = 1); a single frame or number goes with every row.");
    m.def(
        "frame_mean", frame_means, "frames"_a, "weights"_a = py::none(), py::kw_only(), "threads"_a = 0,
        "Karcher means of (n, m, 4) frames, or (m, 4) for one mean: the frames of least weighted mean squared geodesic "
        "distance. weights: (m,) for all means, or (n, m); not negative, not all zero. Returns (n, 4) frames, (n,) "
        "variances "
        "(that mean, radians squared) and (n,) whether the iteration converged; for one mean a (4,) frame and two "
        "scalars. Certainly the minimum where all frames lie within about 20 degrees of one another, else the best of "
        "several descents.");
}

}  // namespace

void bind_frames(py::module_& m) {
    bind_quaternions(m);
    bind_group(m);
    bind_frame_pairs(m);
    bind_geodesics(m);
    bind_harmonics(m);
    bind_representations(m);
    bind_tensors(m);
    bind_su2(m);
    bind_metrics(m);
}

}  // namespace octafield::bindings
