// numpy views of arrays inside C++ objects, safe when the array is replaced.
//
// A view keeps a Keeper alive, which keeps the Python object that holds the array. When a property is set, the old
// array moves to the Keeper of its live views, if any: they go on showing the old values, and no view ever points to
// freed memory.
#pragma once

#include <memory>

#include "arrays.hpp"

namespace octafield::bindings {

// The Keeper, as a capsule, of the array at `address` inside `owner`; the same one as long as a view lives.
py::capsule keeper_of(const void* address, py::handle owner);

// Hands `retired` to the Keeper of the array at `address` and forgets the address; nothing when no view lives.
void retire(const void* address, std::shared_ptr<void> retired);
bool has_views(const void* address);

template <ArrayType T>
py::array_t<scalar_of<T>> view(T& array, py::handle owner) {
    if (array.size() == 0) return py::array_t<scalar_of<T>>(shape_of(array));
    const auto* data = reinterpret_cast<const scalar_of<T>*>(array.data());
    return py::array_t<scalar_of<T>>(shape_of(array), data, keeper_of(&array, owner));
}

template <ArrayType T>
void replace(T& array, T&& value) {
    if constexpr (requires { requires T::SizeAtCompileTime != Eigen::Dynamic; }) {
        array = value;  // stored in place: views show the new value
    } else {
        if (has_views(&array)) retire(&array, std::make_shared<T>(std::move(array)));
        array = std::move(value);
    }
}

// Of an array inside an object that shares what it holds and never changes: cannot be written to, keeps a copy of the
// object alive.
template <class Shared, ArrayType T>
py::array frozen_view(const Shared& object, const T& array) {
    auto kept = std::make_unique<Shared>(object);
    const py::capsule owner(kept.get(), [](void* pointer) { delete static_cast<Shared*>(pointer); });
    kept.release();
    const auto* data = reinterpret_cast<const scalar_of<T>*>(array.data());
    py::array_t<scalar_of<T>> result(shape_of(array), data, owner);
    result.attr("flags").attr("writeable") = false;
    return result;
}

// get(object) -> an array inside it.
template <class Shared, class Get>
void view_property(py::class_<Shared>& type, const char* name, Get get, const char* doc) {
    type.def_property_readonly(
        name, [get](const Shared& object) { return frozen_view(object, get(object)); }, doc);
}

}  // namespace octafield::bindings
