#include "constraint_kinds.hpp"

namespace octafield::bindings {

using volume::ConstraintKinds;
using volume::VertexConstraint;

template <>
std::vector<VertexConstraint> from_python(const py::handle& value, std::string_view name) {
    const py::array given = as_array(value, name);
    std::vector<VertexConstraint> kinds;
    if (given.size() == 0 || given.dtype().kind() != 'U') {
        const auto numbers_given = numbers<std::uint8_t>(given, name);
        if (numbers_given.ndim() != 1) throw_shape(name, "(n,)", numbers_given);
        for (py::ssize_t i = 0; i < numbers_given.size(); ++i)
            kinds.push_back(static_cast<VertexConstraint>(numbers_given.data()[i]));
        return kinds;
    }
    if (given.ndim() != 1) throw_shape(name, "(n,)", given);
    for (const py::handle& item : given) {
        const auto word = py::str(item).cast<std::string>();
        std::size_t place = 0;
        while (place < ConstraintKinds::info.size() && ConstraintKinds::info[place].name != word) ++place;
        if (place == ConstraintKinds::info.size())
            throw InvalidInput(std::string(name) + ": unknown kind '" + word + "' in row " +
                                   std::to_string(kinds.size()) + "; there are " + volume::listed_kinds(),
                               "unknown_word", {static_cast<Index>(kinds.size())});
        kinds.push_back(static_cast<VertexConstraint>(place));
    }
    return kinds;
}

std::string count_kinds(const std::vector<VertexConstraint>& kinds) {
    std::array<std::ptrdiff_t, ConstraintKinds::info.size()> counts = {};
    for (const VertexConstraint kind : kinds)
        if (volume::is_known(kind)) ++counts[static_cast<std::size_t>(kind)];
    std::string text;
    for (std::size_t k = 0; k < counts.size(); ++k)
        text += (k ? ", " : "") + std::to_string(counts[k]) + " " + std::string(ConstraintKinds::info[k].name);
    return text;
}

std::string described_kinds() {
    std::string text;
    for (std::size_t k = 0; k < ConstraintKinds::info.size(); ++k) {
        const volume::ConstraintKindInfo& kind = ConstraintKinds::info[k];
        text += (k ? ", " : "") + std::to_string(k) + " " + std::string(kind.name) + " (" + std::string(kind.meaning) + ")";
    }
    return text;
}

}  // namespace octafield::bindings
