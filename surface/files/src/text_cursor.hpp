// Words and lines of a text file held in memory, with line numbers. Independent of the locale.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace octafield::surface {

class TextCursor {
public:
    explicit TextCursor(std::string_view text);

    // The words of the next line that has any; false at the end of the file. The rest of a line from `comment` on is
    // left out.
    bool next_line(std::vector<std::string_view>& words, char comment = '#');
    // The next word, on whatever line; empty at the end of the file.
    std::string_view next_word();
    void skip_line();

    std::int64_t line() const { return line_; }  // of what was returned last, 1-based
    std::size_t offset() const { return position_; }
    std::int64_t bytes_left() const { return static_cast<std::int64_t>(text_.size() - position_); }

private:
    std::string_view take_line();

    std::string_view text_;
    std::size_t position_ = 0;
    std::int64_t line_ = 1;
    std::int64_t following_line_ = 1;
};

// The whole word as a number; none if it is anything else. "nan" and "inf" are numbers here.
std::optional<double> to_double(std::string_view word);
std::optional<std::int64_t> to_integer(std::string_view word);

// ", not \"-1,5\" (a decimal comma; points are needed)": the word that was found instead, for messages. Long words are
// cut, bytes that are no printable ASCII shown as '?'; empty: ", but the line or file ends".
std::string instead_of(std::string_view word);

}  // namespace octafield::surface
