// The representations known to Python: the dictionary `representations` of every entry of the C++ registry, and module
// functions <name>_embed and so on of those that have had them.

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>

#include "bind.hpp"
#include "octafield/frames/registry.hpp"
#include "octafield/frames/sh4_projection.hpp"
#include "rows.hpp"

namespace octafield::bindings {

using namespace frames;
using py::literals::operator""_a;

namespace {

// One entry of the registry.
struct RepresentationEntry {
    std::string name;
    int dimension;
    py::object speed;  // float, or None where the differential is not isotropic
    py::object embed, differential, hessian, project, rotate;
};

using FramesAndDistances = Rows<double, 5>;

py::tuple frames_and_distances(const FramesAndDistances& rows, bool single) {
    return py::make_tuple(give_back(Quaternions(rows.leftCols<4>()), {4}, single),
                          give_back(Eigen::VectorXd(rows.col(4)), {}, single));
}

template <Representation R>
py::object embed(const ArrayLike& q, int threads) {
    return map_rows<R::dimension>(read_quaternions(q, "q"), threads,
                                  [](const auto& row, auto out) { out = R::embed(from_wxyz(row)).transpose(); });
}

template <Representation R>
py::object differential(const ArrayLike& q, int threads) {
    return map_rows<R::dimension, 3>(read_quaternions(q, "q"), threads, [](const auto& row, auto out) {
        as_matrix<double, R::dimension, 3>(out) = R::differential(from_wxyz(row));
    });
}

template <Representation R>
py::object hessian(const ArrayLike& q, const ArrayLike& v, int threads) {
    const auto [a, b] = broadcast(read_quaternions(q, "q"), read_rows<Rows<double, R::dimension>>(v, "v"), "q", "v");
    return map_pairs<3, 3>(a, b, threads, [](const auto& x, const auto& y, auto out) {
        as_matrix<double, 3, 3>(out) = R::hessian(from_wxyz(x), y.transpose());
    });
}

template <Representation R>
py::object rotate(const ArrayLike& g, const ArrayLike& v, int threads) {
    const auto [a, b] = broadcast(read_quaternions(g, "g"), read_rows<Rows<double, R::dimension>>(v, "v"), "g", "v");
    return map_pairs<R::dimension>(a, b, threads, [](const auto& x, const auto& y, auto out) {
        out = R::rotate(from_wxyz(x), y.transpose()).transpose();
    });
}

// project(row, guess or nullptr) for every row.
template <int Dimension, class Project>
py::tuple project_rows(const ArrayLike& v, const std::optional<ArrayLike>& guess, int threads, Project project) {
    auto input = read_rows<Rows<double, Dimension>>(v, "v");
    const auto n = input.rows.rows();
    const auto result =
        for_rows(n, threads, FramesAndDistances(n, 5),
                 [rows = std::move(input.rows), guesses = read_guesses(guess, n), project](FramesAndDistances& out,
                                                                                           std::int64_t i) {
                     const Quaternion start = guesses.rows() > 0 ? from_wxyz(guesses.row(i)) : Quaternion::Identity();
                     const Projection nearest = project(rows.row(i).transpose(), guesses.rows() > 0 ? &start : nullptr);
                     out.row(i) << to_wxyz(nearest.frame).transpose(), nearest.distance;
                 });
    return frames_and_distances(result, input.single);
}

// sh4 has a kernel for many rows at once.
constexpr std::int64_t block = 256;
py::tuple project_sh4_rows(const ArrayLike& v, const std::optional<ArrayLike>& guess, int threads) {
    auto input = read_rows<Rows<double, 9>>(v, "v");
    const std::int64_t n = input.rows.rows();
    struct Output {
        Quaternions frames;
        Eigen::VectorXd distances;
    };
    auto result =
        for_rows((n + block - 1) / block, threads, Output{Quaternions(n, 4), Eigen::VectorXd(n)},
                 [rows = std::move(input.rows), guesses = read_guesses(guess, n), n](Output& out, std::int64_t b) {
                     const std::int64_t first = b * block, count = std::min(block, n - first);
                     sh4_project(rows.data() + 9 * first, guesses.rows() ? guesses.data() + 4 * first : nullptr, count,
                                 out.frames.data() + 4 * first, out.distances.data() + first);
                 },
                 1);
    return py::make_tuple(give_back(std::move(result.frames), {4}, input.single),
                          give_back(std::move(result.distances), {}, input.single));
}

template <Representation R>
py::tuple project(const ArrayLike& v, const std::optional<ArrayLike>& guess, int threads) {
    if constexpr (std::same_as<R, Sh4>) return project_sh4_rows(v, guess, threads);
    return project_rows<R::dimension>(v, guess, threads, [](const typename R::Vector& row, const Quaternion* start) {
        return R::project(row, start);
    });
}

// Whose functions are names of the module, too.
constexpr std::string_view with_named_functions[] = {"sh4", "tensor4", "su2", "odeco", "sh469"};

template <Representation R>
void bind_representation(py::module_& module, const py::dict& registry) {
    const std::string name(R::name), d = std::to_string(R::dimension);
    const bool named = std::ranges::find(with_named_functions, R::name) != std::end(with_named_functions);
    py::module_ m = named ? module : module.def_submodule("_registered", "Functions of `representations`.");
    const auto attribute = [&](const char* suffix) { return py::object(m.attr((name + suffix).c_str())); };
    m.def((name + "_embed").c_str(), embed<R>, "q"_a, py::kw_only(), "threads"_a = 0,
          ("(n, " + d + ") " + name + " vectors of (n, 4) unit quaternions w x y z. A single (4,) quaternion gives (" +
           d + ",).")
              .c_str());
    m.def((name + "_differential").c_str(), differential<R>, "q"_a, py::kw_only(), "threads"_a = 0,
          ("(n, " + d + ", 3): column k is the derivative of " + name +
           "_embed(exp(t e_k) q) by t at 0, e_k the k-th world axis.")
              .c_str());
    m.def((name + "_hessian").c_str(), hessian<R>, "q"_a, "v"_a, py::kw_only(), "threads"_a = 0,
          ("(n, 3, 3): Hessians of v . " + name +
           "_embed(exp(w) q) by the rotation vector w at 0, for (n, 4) quaternions q and (n, " + d + ") vectors v.")
              .c_str());
    m.def((name + "_project").c_str(), project<R>, "v"_a, "guess"_a = py::none(), py::kw_only(), "threads"_a = 0,
          ("The frames nearest to (n, " + d +
           ") vectors: (n, 4) unit quaternions w x y z and (n,) Euclidean distances from the vectors to "
           "their embeddings. guess: (n, 4) frames to start from as well.")
              .c_str());
    py::object speed = py::none(), rotation = py::none();
    if constexpr (Equivariant<R>) {
        m.def((name + "_rotate").c_str(), rotate<R>, "g"_a, "v"_a, py::kw_only(), "threads"_a = 0,
              ("(n, " + d + ") vectors turned by (n, 4) rotations g: " + name + "_rotate(g, " + name +
               "_embed(q)) is the embedding of g q.")
                  .c_str());
        speed = py::float_(R::speed);
        rotation = attribute("_rotate");
    }
    registry[py::str(name)] = RepresentationEntry{name,
                                                  R::dimension,
                                                  speed,
                                                  attribute("_embed"),
                                                  attribute("_differential"),
                                                  attribute("_hessian"),
                                                  attribute("_project"),
                                                  rotation};
}

BandWeights band_weights(const ArrayLike& weights) {
    const auto array = numbers<double>(weights, "weights");
    if (array.size() != 3) throw_shape("weights", "(3,)", array);
    return {array.data()[0], array.data()[1], array.data()[2]};
}

// Overloads of the sh469 functions with weights of one's own.
void bind_weighted_sh469(py::module_& m) {
    m.def(
        "sh469_embed",
        [](const ArrayLike& q, const ArrayLike& weights, int threads) {
            return map_rows<41>(read_quaternions(q, "q"), threads,
                                [w = band_weights(weights)](const auto& row, auto out) {
                                    out = Sh469::embed(from_wxyz(row), w).transpose();
                                });
        },
        "q"_a, "weights"_a, py::kw_only(), "threads"_a = 0,
        "The same, (n, 41), with (3,) weights of degrees 4, 6 and 9, not negative; the default makes squared distances "
        "the left "
        "average of those of su2.");
    m.def(
        "sh469_differential",
        [](const ArrayLike& q, const ArrayLike& weights, int threads) {
            return map_rows<41, 3>(read_quaternions(q, "q"), threads,
                                   [w = band_weights(weights)](const auto& row, auto out) {
                                       as_matrix<double, 41, 3>(out) = Sh469::differential(from_wxyz(row), w);
                                   });
        },
        "q"_a, "weights"_a, py::kw_only(), "threads"_a = 0,
        "The same, (n, 41, 3), with (3,) weights of degrees 4, 6 and 9.");
    m.def(
        "sh469_project",
        [](const ArrayLike& v, const std::optional<ArrayLike>& guess, const ArrayLike& weights, int threads) {
            return project_rows<41>(v, guess, threads,
                                    [w = band_weights(weights)](const Sh469::Vector& row, const Quaternion* start) {
                                        return Sh469::project(row, start, w);
                                    });
        },
        "v"_a, "guess"_a = py::none(), py::kw_only(), "weights"_a, "threads"_a = 0,
        "The same, (n, 4) frames and (n,) distances, with (3,) weights of degrees 4, 6 and 9.");
    m.def(
        "sh469_hessian",
        [](const ArrayLike& q, const ArrayLike& v, const ArrayLike& weights, int threads) {
            const auto [a, b] = broadcast(read_quaternions(q, "q"), read_rows<Rows<double, 41>>(v, "v"), "q", "v");
            return map_pairs<3, 3>(a, b, threads, [w = band_weights(weights)](const auto& x, const auto& y, auto out) {
                as_matrix<double, 3, 3>(out) = Sh469::hessian(from_wxyz(x), y.transpose(), w);
            });
        },
        "q"_a, "v"_a, "weights"_a, py::kw_only(), "threads"_a = 0,
        "The same, (n, 3, 3), with (3,) weights of degrees 4, 6 and 9.");
}

py::object convert(const ArrayLike& v, const std::string& from, const std::string& to, int threads) {
    py::object result;
    with_representation(from, [&]<Representation From>() {
        with_representation(to, [&]<Representation To>() {
            result = map_rows<To::dimension>(
                read_rows<Rows<double, From::dimension>>(v, "v"), threads,
                [](const auto& row, auto out) { out = To::embed(From::project(row.transpose()).frame).transpose(); });
        });
    });
    return result;
}

}  // namespace

void bind_representations(py::module_& m) {
    py::class_<RepresentationEntry>(
        m, "Representation",
        "An embedding of frames into R^dimension that is the same for all 48 quaternions of a frame.")
        .def_readonly("name", &RepresentationEntry::name, "Its word, for example \"sh4\".")
        .def_readonly("dimension", &RepresentationEntry::dimension, "Numbers per frame.")
        .def_readonly("speed", &RepresentationEntry::speed,
                      "|d embed| per radian, the same at every frame in every direction; None where it varies (su2).")
        .def_readonly("embed", &RepresentationEntry::embed,
                      "embed(q, *, threads=0): (n, dimension) vectors of (n, 4) quaternions.")
        .def_readonly("differential", &RepresentationEntry::differential,
                      "differential(q, *, threads=0): (n, dimension, 3) derivatives under world rotations.")
        .def_readonly("hessian", &RepresentationEntry::hessian,
                      "hessian(q, v, *, threads=0): (n, 3, 3) second derivatives of v . embed under world rotations.")
        .def_readonly("project", &RepresentationEntry::project,
                      "project(v, guess=None, *, threads=0): the nearest frames, (n, 4), and the distances, (n,).")
        .def_readonly("rotate", &RepresentationEntry::rotate,
                      "rotate(g, v, *, threads=0): vectors turned by rotations; None where no linear map does (su2).")
        .def("__repr__", [](const RepresentationEntry& entry) {
            return "Representation(" + entry.name + ", dimension " + std::to_string(entry.dimension) + ")";
        });
    const py::dict registry;
    Representations::for_each([&]<Representation R>() { bind_representation<R>(m, registry); });
    m.attr("representations") = registry;
    bind_weighted_sh469(m);
    m.def("convert", convert, "v"_a, "from_representation"_a, "to_representation"_a, py::kw_only(), "threads"_a = 0,
          "Vectors of one representation as vectors of another, by name: the embeddings of the nearest frames.");
    m.def(
        "sh4_project_certified",
        [](const ArrayLike& v, double gap_tolerance, int threads) {
            auto input = read_rows<Rows<double, 9>>(v, "v");
            const auto n = input.rows.rows();
            const auto result = for_rows(
                n, threads, Rows<double, 6>(n, 6),
                [rows = std::move(input.rows), gap_tolerance](Rows<double, 6>& out, std::int64_t i) {
                    const CertifiedProjection c = sh4_project_certified(rows.row(i).transpose(), gap_tolerance);
                    out.row(i) << to_wxyz(c.projection.frame).transpose(), c.projection.distance, c.gap;
                },
                1);
            return py::make_tuple(give_back(Quaternions(result.leftCols<4>()), {4}, input.single),
                                  give_back(Eigen::VectorXd(result.col(4)), {}, input.single),
                                  give_back(Eigen::VectorXd(result.col(5)), {}, input.single));
        },
        "v"_a, "gap_tolerance"_a = 1e-9, py::kw_only(), "threads"_a = 0,
        "sh4_project with a proof, by branch and bound: (n, 4) frames, (n,) distances and (n,) proven bounds on how "
        "much "
        "any other frame could raise v . sh4_embed(q), relative to |v|. gap_tolerance: at least 1e-13; a gap above it "
        "means "
        "that the search gave up after 2,000,000 boxes.");
}

}  // namespace octafield::bindings
