// Binding of plain structs: constructor from fields by position or name, properties, repr, pickling.
#pragma once

#include <pybind11/stl.h>

#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "views.hpp"
#include "words.hpp"

namespace octafield::bindings {

// Array fields are numpy views and can be set. Numbers, strings and enumerations (as words) can be set. Nested structs
// and lists of things are given to the constructor and read afterwards.
template <class T>
class Record {
public:
    struct Field {
        std::string name;
        std::function<void(T&, const py::handle&)> set;
        bool nested, array;  // another record: no option of a function (options.hpp); an array, which may be absent
    };

    Record(py::module_& module, const char* name, const char* doc) : name_(name), class_(module, name, doc) {}

    // Those of the class, once it is bound.
    static const std::vector<Field>& fields() { return *all_fields(); }

    template <class Member>
    Record& field(const char* name, Member T::*member, const char* doc) {
        py::cpp_function get = getter(member);
        if constexpr (ArrayType<Member> || std::is_arithmetic_v<Member> || std::is_enum_v<Member> ||
                      std::is_same_v<Member, std::string>) {
            const auto set = [name, member](T& self, const py::object& value) { assign(self, name, member, value); };
            class_.def_property(name, get, py::cpp_function(set, py::is_method(class_)), doc);
        } else {
            class_.def_property_readonly(name, get, doc);
        }
        constexpr bool nested = std::is_class_v<Member> && !ArrayType<Member> && !std::is_same_v<Member, std::string>;
        fields_->push_back({name,
                            [name, member](T& self, const py::handle& value) { assign(self, name, member, value); },
                            nested, ArrayType<Member>});
        if constexpr (std::is_enum_v<Member>) words_[name] = py::cast(words_of<Member>());
        return *this;
    }

    // A field that is no member as Python has it: get(const T&), set(T&, value).
    template <class Get, class Set>
    Record& field(const char* name, Get get, Set set, const char* doc) {
        class_.def_property(
            name, get, [set](T& self, const py::object& value) { set(self, value); }, doc);
        fields_->push_back({name, set, false, false});
        return *this;
    }

    // `repr` gives what stands between the parentheses.
    void finish(std::function<std::string(const T&)> repr) {
        const auto fields = fields_;
        const auto name = name_;
        std::string doc = name + "(";
        for (const Field& field : *fields) doc += (&field == fields->data() ? "" : ", ") + field.name + "=...";
        doc += "): fields by position or by name; those left out keep their defaults.";
        {
            py::options options;
            options.disable_function_signatures();
            class_.def(py::init([fields, name](const py::args& args, const py::kwargs& kwargs) {
                           auto self = std::make_unique<T>();
                           construct(*self, *fields, name, args, kwargs);
                           return self;
                       }),
                       doc.c_str());
        }
        if (!words_.empty()) class_.attr("words") = words_;  // by field: what an enumeration may be
        class_.def("__repr__", [repr, name](const T& self) { return name + "(" + repr(self) + ")"; });
        class_.def("__reduce__", [fields](const py::object& self) {
            py::tuple values(fields->size());
            for (std::size_t k = 0; k < fields->size(); ++k) values[k] = self.attr((*fields)[k].name.c_str());
            return py::make_tuple(py::type::of(self), values);
        });
    }

private:
    static std::shared_ptr<std::vector<Field>>& all_fields() {
        static auto all = std::make_shared<std::vector<Field>>();
        return all;
    }

    template <class Member>
    py::cpp_function getter(Member T::*member) {
        const py::is_method method(class_);
        if constexpr (ArrayType<Member>)
            return {[member](const py::object& self) { return view(self.template cast<T&>().*member, self); }, method};
        else if constexpr (std::is_same_v<Member, std::vector<std::vector<Index>>>)
            return {[member](const T& self) {
                        std::vector<py::array_t<Index>> arrays;
                        for (const auto& ids : self.*member) arrays.push_back(own(std::vector<Index>(ids)));
                        return arrays;
                    },
                    method};
        else if constexpr (std::is_enum_v<Member>)
            return {[member](const T& self) { return to_word(self.*member); }, method};
        else if constexpr (std::is_class_v<Member> && !std::is_same_v<Member, std::string>)
            return {[member](T& self) -> Member& { return self.*member; }, method,
                    py::return_value_policy::reference_internal};
        else
            return {[member](const T& self) { return self.*member; }, method};
    }

    template <class Member>
    static void assign(T& self, const char* name, Member T::*member, const py::handle& value) {
        if constexpr (ArrayType<Member>) {
            replace(self.*member, from_python<Member>(value, name));
        } else if constexpr (std::is_same_v<Member, std::vector<std::vector<Index>>>) {
            for (const auto& ids : py::reinterpret_borrow<py::iterable>(value))
                (self.*member).push_back(from_python<std::vector<Index>>(ids, name));
        } else {
            try {
                if constexpr (std::is_enum_v<Member>)
                    self.*member = from_word<Member>(value.template cast<std::string>(), name);
                else
                    self.*member = value.template cast<Member>();
            } catch (const py::cast_error&) {
                throw py::type_error(std::string(name) + ": a value of type " + Py_TYPE(value.ptr())->tp_name +
                                     " does not fit");
            }
        }
    }

    static void construct(T& self, const std::vector<Field>& fields, const std::string& name, const py::args& args,
                          const py::kwargs& kwargs) {
        if (args.size() > fields.size())
            throw py::type_error(name + ": takes at most " + std::to_string(fields.size()) + " arguments");
        for (std::size_t k = 0; k < args.size(); ++k) fields[k].set(self, args[k]);
        for (const auto& [key, value] : kwargs) {
            const auto word = key.template cast<std::string>();
            std::size_t k = 0;
            while (k < fields.size() && fields[k].name != word) ++k;
            if (k == fields.size()) throw py::type_error(name + ": has no field '" + word + "'");
            if (k < args.size()) throw py::type_error(name + ": got two values for '" + word + "'");
            fields[k].set(self, value);
        }
    }

    std::string name_;
    py::class_<T> class_;
    std::shared_ptr<std::vector<Field>> fields_ = all_fields();
    py::dict words_;
};

inline std::string count(std::ptrdiff_t n, const std::string& one, const std::string& many) {
    return std::to_string(n) + " " + (n == 1 ? one : many);
}
inline std::string count(std::ptrdiff_t n, const std::string& one) { return count(n, one, one + "s"); }

// Six digits, as in tables; the field itself has all of them.
inline std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

// ", box [0, 1] x [0, 2] x [0, 1]", nothing for no points.
template <class Rows>
std::string box(const Rows& points) {
    if (points.rows() == 0) return {};
    std::string text = ", box ";
    for (Eigen::Index k = 0; k < points.cols(); ++k)
        text += (k ? " x [" : "[") + number(points.col(k).minCoeff()) + ", " + number(points.col(k).maxCoeff()) + "]";
    return text;
}

}  // namespace octafield::bindings
