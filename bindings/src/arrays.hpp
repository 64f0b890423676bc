// numpy arrays in and out: array-likes become Eigen matrices, Eigen matrices become numpy arrays that own them.
#pragma once

#include <pybind11/complex.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>  // in every source alike, or signatures differ

#include <Eigen/Core>
#include <complex>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "octafield/arrays.hpp"
#include "octafield/error.hpp"

namespace octafield::bindings {

namespace py = pybind11;

inline bool any_object(PyObject*) { return true; }
inline bool callable_object(PyObject* object) { return PyCallable_Check(object) == 1; }

// Python objects with a telling name in signatures.
class ArrayLike : public py::object {
    PYBIND11_OBJECT_DEFAULT(ArrayLike, py::object, any_object)
};
class ProgressCallable : public py::object {
    PYBIND11_OBJECT_DEFAULT(ProgressCallable, py::object, callable_object)
};

template <class Row>
concept DenseMatrix = std::is_base_of_v<Eigen::DenseBase<Row>, Row>;

template <class>
struct IsNumberVector : std::false_type {};
template <class Scalar>
struct IsNumberVector<std::vector<Scalar>>
    : std::bool_constant<std::is_arithmetic_v<Scalar> || std::is_enum_v<Scalar>> {};

// Types that become numpy arrays: Eigen matrices and vectors, and std::vector of numbers (or of byte-sized enums).
template <class T>
concept ArrayType = DenseMatrix<T> || IsNumberVector<T>::value;

template <class T>
struct ScalarOf {
    using type = typename T::value_type;
};
template <class T>
requires std::is_enum_v<typename T::value_type>
struct ScalarOf<T> {
    using type = std::underlying_type_t<typename T::value_type>;
};
template <class T>
using scalar_of = typename ScalarOf<T>::type;

[[noreturn]] inline void throw_shape(std::string_view name, const std::string& expected, const py::array& got) {
    std::string shape;
    for (py::ssize_t k = 0; k < got.ndim(); ++k) shape += (k ? ", " : "") + std::to_string(got.shape(k));
    if (got.ndim() == 1) shape += ",";
    throw InvalidInput(std::string(name) + ": expected an array of shape " + expected + ", got (" + shape + ")",
                       "wrong_shape");
}

// numpy.asarray, with numpy's complaint as InvalidInput.
inline py::array as_array(const py::handle& value, std::string_view name) {
    try {
        return py::module_::import("numpy").attr("asarray")(value);
    } catch (py::error_already_set& error) {
        if (!error.matches(PyExc_ValueError) && !error.matches(PyExc_TypeError)) throw;
        throw InvalidInput(std::string(name) + ": not an array of numbers (" + error.what() + ")", "wrong_type");
    }
}

inline void require_kind(const py::array& array, const char* kinds, const char* what, std::string_view name) {
    if (array.size() > 0 && std::string_view(kinds).find(array.dtype().kind()) == std::string_view::npos)
        throw InvalidInput(
            std::string(name) + ": expected " + what + ", got dtype " + py::str(array.dtype()).cast<std::string>(),
            "wrong_type");
}

template <class Target>
py::array_t<Target, py::array::c_style | py::array::forcecast> converted(const py::array& array) {
    return py::array_t<Target, py::array::c_style | py::array::forcecast>(array);
}

// Elements of an array-like in row-major order, with its shape. Integers are range-checked, never wrapped.
template <class Scalar>
py::array_t<Scalar, py::array::c_style | py::array::forcecast> numbers(const py::handle& value, std::string_view name) {
    const py::array array = as_array(value, name);
    if constexpr (std::is_integral_v<Scalar>) {
        require_kind(array, "iub", "integers", name);
        if (array.dtype().kind() == 'u' && array.itemsize() == 8) {  // beyond the range of the comparison below
            const auto natural = converted<std::uint64_t>(array);
            for (py::ssize_t i = 0; i < natural.size(); ++i)
                if (natural.data()[i] > static_cast<std::uint64_t>(std::numeric_limits<Scalar>::max()))
                    throw InvalidInput(std::string(name) + ": entry " + std::to_string(i) + " is " +
                                           std::to_string(natural.data()[i]) + ", which is too large",
                                       "index_out_of_range", {static_cast<Index>(i)});
        }
        const auto wide = converted<std::int64_t>(array);
        for (py::ssize_t i = 0; i < wide.size(); ++i)
            if (wide.data()[i] < std::numeric_limits<Scalar>::min() ||
                wide.data()[i] > std::numeric_limits<Scalar>::max())
                throw InvalidInput(std::string(name) + ": entry " + std::to_string(i) + " is " +
                                       std::to_string(wide.data()[i]) + ", which does not fit " +
                                       std::to_string(8 * sizeof(Scalar)) + " bits",
                                   "index_out_of_range", {static_cast<Index>(i)});
        return converted<Scalar>(wide);
    } else if constexpr (std::is_floating_point_v<Scalar>) {
        require_kind(array, "fiu", "real numbers", name);
        return converted<Scalar>(array);
    } else {
        require_kind(array, "cfiu", "complex numbers", name);
        return converted<Scalar>(array);
    }
}

// An array-like as a C++ array: (n, columns) matrices, (n,) vectors, fixed-size vectors. An empty list has no rows.
template <ArrayType T>
T from_python(const py::handle& value, std::string_view name) {
    const auto array = numbers<scalar_of<T>>(value, name);
    if constexpr (!DenseMatrix<T>) {
        if (array.ndim() != 1) throw_shape(name, "(n,)", array);
        const auto* data = reinterpret_cast<const typename T::value_type*>(array.data());
        return T(data, data + array.size());
    } else if constexpr (T::IsVectorAtCompileTime) {
        const bool fixed = T::SizeAtCompileTime != Eigen::Dynamic;
        if (array.ndim() != 1 || (fixed && array.size() != T::SizeAtCompileTime))
            throw_shape(name, fixed ? "(" + std::to_string(T::SizeAtCompileTime) + ",)" : "(n,)", array);
        return Eigen::Map<const T>(array.data(), array.size());
    } else {
        constexpr int columns = T::ColsAtCompileTime;
        if (array.ndim() == 1 && array.size() == 0) return T(0, columns);
        if (array.ndim() != 2 || array.shape(1) != columns)
            throw_shape(name, "(n, " + std::to_string(columns) + ")", array);
        return Eigen::Map<const T>(array.data(), array.shape(0), columns);
    }
}

// Shape of a C++ array in numpy.
template <ArrayType T>
std::vector<py::ssize_t> shape_of(const T& array) {
    if constexpr (!DenseMatrix<T>)
        return {static_cast<py::ssize_t>(array.size())};
    else if constexpr (T::IsVectorAtCompileTime)
        return {array.size()};
    else
        return {array.rows(), array.cols()};
}

// A numpy array that owns the moved-in C++ array; no element is copied.
template <ArrayType T>
py::array_t<scalar_of<T>> own(T&& array, std::vector<py::ssize_t> shape = {}) {
    static_assert(!std::is_lvalue_reference_v<T>);
    if (shape.empty()) shape = shape_of(array);
    auto kept = std::make_unique<T>(std::move(array));
    const auto* data = reinterpret_cast<const scalar_of<T>*>(kept->data());
    const py::capsule owner(kept.get(), [](void* pointer) { delete static_cast<T*>(pointer); });
    kept.release();
    return py::array_t<scalar_of<T>>(std::move(shape), data, owner);
}

}  // namespace octafield::bindings

namespace pybind11::detail {

template <>
struct handle_type_name<octafield::bindings::ArrayLike> {
    static constexpr auto name = const_name("numpy.typing.ArrayLike");
};
template <>
struct handle_type_name<octafield::bindings::ProgressCallable> {
    static constexpr auto name = const_name("collections.abc.Callable[[str, float, float], bool | None]");
};

}  // namespace pybind11::detail
