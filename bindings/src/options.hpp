// Option structs as keyword arguments of functions: names, defaults and words are those of their classes
// (option_types.cpp), so that each stands once, in the C++ struct.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "checks.hpp"
#include "record.hpp"

namespace octafield::bindings {

template <class Options>
bool take_option(Options& options, const std::string& name, const py::handle& value) {
    for (const auto& field : Record<Options>::fields())
        if (field.name == name && !field.nested) {
            if (!field.array || !value.is_none()) field.set(options, value);
            return true;
        }
    return false;
}

// The keyword arguments of a function as option structs, checked; a name that several have is the first one's.
template <class... Options>
std::tuple<Options...> options_of(const char* function, const py::kwargs& given) {
    std::tuple<Options...> all;
    for (const auto& [key, value] : given) {
        const auto name = key.template cast<std::string>();
        if (!(take_option(std::get<Options>(all), name, value) || ...))
            throw py::type_error(std::string(function) + "() got an unexpected keyword argument '" + name + "'");
    }
    (check(std::get<Options>(all)), ...);
    return all;
}

// Changes the text of a function's docstring.
void set_docstring(py::handle function, const std::string& text);

// In the signature of a function's docstring the options with their defaults, in place of **options.
template <class... Options>
void list_options(py::module_& module, const char* function) {
    std::vector<std::string> names;
    std::string listed;
    const auto add = [&]<class T>(const T&) {
        const py::object defaults = py::cast(T());
        for (const auto& field : Record<T>::fields()) {
            if (field.nested || std::find(names.begin(), names.end(), field.name) != names.end()) continue;
            names.push_back(field.name);
            const py::object value = defaults.attr(field.name.c_str());
            const bool plain = py::isinstance<py::str>(value) || py::isinstance<py::float_>(value) ||
                               py::isinstance<py::int_>(value);  // bool, too
            listed += (listed.empty() ? "" : ", ") + field.name + ": " +
                      (plain ? std::string(Py_TYPE(value.ptr())->tp_name) + " = " + py::repr(value).cast<std::string>()
                             : "numpy.typing.ArrayLike | None = None");
        }
    };
    (add(Options()), ...);
    const py::object bound = module.attr(function);
    std::string text = bound.attr("__doc__").cast<std::string>();
    const std::string rest = "**kwargs";
    const std::size_t at = text.find(rest);
    if (at == std::string::npos) throw std::logic_error(std::string(function) + " takes no options");
    const std::size_t keyword_only = text.rfind("*, ", at);
    if (keyword_only == std::string::npos) {
        text.replace(at, rest.size(), "*, " + listed);
    } else {  // "*, progress: ... = None, **kwargs" becomes "*, options, progress: ... = None"
        text.erase(at - 2, 2 + rest.size());
        text.insert(keyword_only + 3, listed + ", ");
    }
    set_docstring(bound, text);
}

}  // namespace octafield::bindings
