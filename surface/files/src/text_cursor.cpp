#include "text_cursor.hpp"

#include <locale.h>
#include <stdlib.h>

#include <algorithm>
#include <charconv>
#include <new>
#include <string>

namespace octafield::surface {
namespace {

constexpr std::string_view kBlanks = " \t\r\v\f";
constexpr std::string_view kBlanksAndNewline = " \t\r\v\f\n";

std::string_view without_plus(std::string_view word) {
    return word.size() > 1 && word[0] == '+' && word[1] != '-' ? word.substr(1) : word;
}

// from_chars leaves the value alone when it is too small or too large; strtod rounds to 0 or infinity. In the user's
// locale it might stop at the decimal point.
double rounded_to_range(std::string_view word) {
    static const locale_t plain = newlocale(LC_ALL_MASK, "C", locale_t{});
    if (plain == locale_t{}) throw std::bad_alloc();
    return strtod_l(std::string(word).c_str(), nullptr, plain);
}

}  // namespace

TextCursor::TextCursor(std::string_view text) : text_(text) {
    if (text_.starts_with("\xEF\xBB\xBF")) position_ = 3;  // byte order mark
}

std::string_view TextCursor::take_line() {
    line_ = following_line_++;
    const std::size_t end = std::min(text_.find('\n', position_), text_.size());
    const std::string_view line = text_.substr(position_, end - position_);
    position_ = std::min(end + 1, text_.size());
    return line;
}

void TextCursor::skip_line() { take_line(); }

bool TextCursor::next_line(std::vector<std::string_view>& words, char comment) {
    words.clear();
    while (words.empty() && position_ < text_.size()) {
        std::string_view line = take_line();
        line = line.substr(0, line.find(comment));
        for (std::size_t begin = line.find_first_not_of(kBlanks); begin != line.npos;) {
            const std::size_t end = std::min(line.find_first_of(kBlanks, begin), line.size());
            words.push_back(line.substr(begin, end - begin));
            begin = line.find_first_not_of(kBlanks, end);
        }
    }
    return !words.empty();
}

std::string_view TextCursor::next_word() {
    while (position_ < text_.size() && kBlanksAndNewline.find(text_[position_]) != kBlanksAndNewline.npos)
        if (text_[position_++] == '\n') ++following_line_;
    line_ = following_line_;
    const std::size_t end = std::min(text_.find_first_of(kBlanksAndNewline, position_), text_.size());
    const std::string_view word = text_.substr(position_, end - position_);
    position_ = end;
    return word;
}

std::optional<double> to_double(std::string_view word) {
    word = without_plus(word);
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (end != word.data() + word.size() || word.empty()) return std::nullopt;
    if (error == std::errc::result_out_of_range) return rounded_to_range(word);
    return error == std::errc() ? std::optional(value) : std::nullopt;
}

std::optional<std::int64_t> to_integer(std::string_view word) {
    word = without_plus(word);
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return error == std::errc() && end == word.data() + word.size() ? std::optional(value) : std::nullopt;
}

std::string instead_of(std::string_view word) {
    if (word.empty()) return ", but the line or file ends";
    constexpr std::size_t most = 40;
    std::string shown(word.substr(0, most));
    for (char& c : shown)
        if (c < ' ' || c > '~') c = '?';
    std::string text = ", not \"" + shown + (word.size() > most ? "..." : "") + "\"";
    std::string with_points(word);
    std::ranges::replace(with_points, ',', '.');
    if (with_points != word && to_double(with_points)) text += " (a decimal comma; points are needed)";
    return text;
}

}  // namespace octafield::surface
