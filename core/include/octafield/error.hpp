// The error family of octafield, mapped to Python exceptions of the same names.
// A message says what was wrong, where (element ids, the first few), and what to do.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace octafield {

// Base class. `kind` is a short stable word for the defect (for example "not_closed"), `elements` the 0-based ids of
// the elements concerned, of whatever sort the message names. Both may be empty.
class Error : public std::runtime_error {
public:
    explicit Error(const std::string& message, std::string kind = {}, std::vector<std::int32_t> elements = {})
        : std::runtime_error(message), kind_(std::move(kind)), elements_(std::move(elements)) {}
    const std::string& kind() const noexcept { return kind_; }
    const std::vector<std::int32_t>& elements() const noexcept { return elements_; }

private:
    std::string kind_;
    std::vector<std::int32_t> elements_;
};

// The caller's argument or option is unusable.
class InvalidInput : public Error {
    using Error::Error;
};
// The geometry handed in is unsound, or a mesher could not fill it.
class GeometryError : public Error {
    using Error::Error;
};
// A numerical method broke down.
class SolverError : public Error {
    using Error::Error;
};
// A file could not be read or written.
class IoError : public Error {
    using Error::Error;
};
// A progress callback asked to stop.
class Cancelled : public Error {
    using Error::Error;
};

// "3, 17, 20 and 41 more": the first few ids of a list, for messages.
inline std::string first_few(const std::vector<std::int32_t>& ids, std::size_t most = 5) {
    std::string text;
    for (std::size_t i = 0; i < ids.size() && i < most; ++i) text += (i ? ", " : "") + std::to_string(ids[i]);
    if (ids.size() > most) text += " and " + std::to_string(ids.size() - most) + " more";
    return text;
}

}  // namespace octafield
