#include "array_schemes.hpp"

#include <utility>

#include "arrays.hpp"
#include "bind.hpp"
#include "checks.hpp"
#include "gil.hpp"
#include "interruptible.hpp"
#include "sampling.hpp"

namespace octafield::bindings {

namespace {

using volume::ArrayScheme;
using volume::ArrayValues;
using py::literals::operator""_a;

// Kept by threads that have not the lock.
std::shared_ptr<const py::object> kept(py::object object) {
    return {new py::object(std::move(object)), [](const py::object* last) {
                const WithGil gil;
                delete last;
            }};
}

struct PythonScheme : ArrayScheme {
    std::shared_ptr<const py::object> object;
};

// Row-major numbers of an array of that shape. With the lock.
ArrayValues taken(const py::handle& answer, const std::string& what, const std::vector<py::ssize_t>& shape) {
    const auto array = numbers<double>(answer, what);
    std::string expected;
    for (const auto n : shape) expected += (expected.empty() ? "(" : ", ") + std::to_string(n);
    if (std::vector<py::ssize_t>(array.shape(), array.shape() + array.ndim()) != shape)
        throw_shape(what, expected + ")", array);
    Index columns = 1;
    for (std::size_t k = 1; k < shape.size(); ++k) columns *= static_cast<Index>(shape[k]);
    return Eigen::Map<const ArrayValues>(array.data(), shape[0], columns);
}

// call(frames ...) -> ArrayValues of callable(frames ...), as `use` makes them of the answer.
template <class Use>
auto calling(const py::handle& object, const char* attribute, Use use) {
    return [callable = kept(object.attr(attribute)), use](const auto&... frames) -> ArrayValues {
        const WithGil gil;
        const py::object answer = call_python(*callable, py::make_tuple(own(Quaternions(frames))...));
        return use(answer, (frames.rows(), ...));
    };
}

bool has_callable(const py::handle& value, const char* attribute) {
    return py::hasattr(value, attribute) && PyCallable_Check(value.attr(attribute).ptr());
}

}  // namespace

bool is_array_scheme(const py::handle& value) {
    return !py::isinstance<py::str>(value) && (has_callable(value, "embed") || has_callable(value, "residual"));
}

std::shared_ptr<const ArrayScheme> array_scheme(const py::handle& value) {
    const auto scheme = std::make_shared<PythonScheme>();
    scheme->object = kept(py::reinterpret_borrow<py::object>(value));
    scheme->name = value.attr("name").cast<std::string>();
    scheme->dimension = value.attr("dimension").cast<Index>();
    const py::ssize_t d = scheme->dimension;
    const std::string name = "scheme '" + scheme->name + "': ";
    const bool derived = has_callable(value, "differential");
    if (has_callable(value, "embed")) {
        const std::string embed = name + "embed", differential = name + "differential";
        scheme->embed = calling(value, "embed", [=](const py::object& answer, py::ssize_t n) {
            return taken(answer, embed, {n, d});
        });
        if (derived)
            scheme->differential = calling(value, "differential", [=](const py::object& answer, py::ssize_t n) {
                return taken(answer, differential, {n, d, 3});
            });
        return scheme;
    }
    const std::string residual = name + "residual", differential = name + "differential";
    scheme->residual = calling(value, "residual", [=](const py::object& answer, py::ssize_t n) {
        return taken(answer, residual, {n, d});
    });
    if (derived)
        scheme->residual_differential = calling(value, "differential", [=](const py::object& answer, py::ssize_t n) {
            const auto pair = py::isinstance<py::sequence>(answer) ? py::tuple(answer) : py::tuple();
            if (pair.size() != 2)
                throw InvalidInput(differential + ": expected two arrays, by the first and by the second frame",
                                   "wrong_type");
            ArrayValues both(n, 6 * d);
            for (int side = 0; side < 2; ++side) {
                const ArrayValues one = taken(pair[side], differential, {n, d, 3});
                for (Index c = 0; c < d; ++c) both.middleCols<3>(6 * c + 3 * side) = one.middleCols<3>(3 * c);
            }
            return both;
        });
    return scheme;
}

py::object python_scheme(const ArrayScheme& scheme) { return *static_cast<const PythonScheme&>(scheme).object; }

void bind_array_schemes(py::module_& m) {
    m.def(
        "scheme_energy",
        [](const py::object& scheme, const MeshOrSampling& mesh, const ArrayLike& frames, int threads) {
            threads_option(threads);
            return run_interruptible([given = array_scheme(scheme), mesh = mesh, threads,
                                      rows = from_python<Quaternions>(frames, "frames")](Job&) mutable {
                const std::shared_ptr<const volume::Sampling> sampling = sampling_of(mesh);
                check_unit(rows, sampling->count(), "frames");
                return array_energy(*given, *sampling, rows, threads);
            });
        },
        "scheme"_a, "domain"_a, "frames"_a, py::kw_only(), "threads"_a = 0,
        "What an EmbeddingScheme or EdgeScheme minimises, of (n, 4) frames at the vertices of a TetDomain or TetMesh, "
        "or at the "
        "sites of a Sampling. Raises InvalidInput, GeometryError, and what the scheme's functions raise.");
}

}  // namespace octafield::bindings
