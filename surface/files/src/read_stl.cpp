// STL, ASCII and binary. CGAL's reader is not used here: it takes a truncated header for an empty mesh, and keys a
// std::map by points, which coordinates that are not numbers break; and it cannot say where a file is wrong.
#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cstring>

#include "mesh_builder.hpp"
#include "text_cursor.hpp"

namespace octafield::surface {
namespace {

static_assert(std::endian::native == std::endian::little, "binary STL is little-endian");

constexpr std::size_t kHeaderBytes = 84;    // comment (80), number of triangles (4)
constexpr std::size_t kTriangleBytes = 50;  // normal and three vertices of 4-byte floats (48), attribute (2)

bool equals_ignoring_case(std::string_view word, std::string_view lower) {
    return std::ranges::equal(word, lower, [](unsigned char a, char b) { return std::tolower(a) == b; });
}

std::size_t announced_triangles(const std::string& bytes) {
    std::uint32_t count = 0;
    std::memcpy(&count, bytes.data() + 80, 4);
    return count;
}

// Many binary files begin with "solid", too, so the size decides first, and text has no zero bytes.
bool is_binary(const std::string& bytes) {
    if (bytes.size() >= kHeaderBytes && bytes.size() == kHeaderBytes + kTriangleBytes * announced_triangles(bytes))
        return true;
    return !equals_ignoring_case(TextCursor(bytes).next_word(), "solid") || bytes.find('\0') != bytes.npos;
}

TriangleMesh parse_binary(const std::string& bytes, const std::string& file) {
    MeshBuilder builder(file, "byte");
    if (bytes.size() < kHeaderBytes)
        builder.fail("it is neither text beginning with \"solid\" nor long enough for a binary STL");
    const std::size_t count = announced_triangles(bytes), present = (bytes.size() - kHeaderBytes) / kTriangleBytes;
    if (count != present)
        builder.fail("the header announces " + std::to_string(count) + " triangles, but the file has room for " +
                     std::to_string(present) + "; it is truncated, damaged, or not an STL file");
    for (std::size_t t = 0; t < count; ++t) {
        const std::size_t start = kHeaderBytes + kTriangleBytes * t;
        std::array<float, 12> values;  // normal, then the vertices
        std::memcpy(values.data(), bytes.data() + start, sizeof values);
        for (int k = 1; k <= 3; ++k)
            builder.add_vertex(values[3 * k], values[3 * k + 1], values[3 * k + 2],
                               static_cast<std::int64_t>(start) + 12 * k);
        const auto first = static_cast<std::int64_t>(3 * t);
        builder.add_polygon(std::array{first, first + 1, first + 2}, static_cast<std::int64_t>(start));
    }
    return builder.finish();
}

class AsciiStl {
public:
    AsciiStl(const std::string& bytes, const std::string& file) : cursor_(bytes), builder_(file, "line") {}

    TriangleMesh parse() {
        for (auto word = cursor_.next_word(); !word.empty(); word = cursor_.next_word()) {
            if (!equals_ignoring_case(word, "solid")) builder_.fail("solid expected" + instead_of(word), cursor_.line());
            cursor_.skip_line();  // the name, any words
            parse_solid();
        }
        return builder_.finish();
    }

private:
    void parse_solid() {
        while (true) {
            const auto word = cursor_.next_word();
            if (equals_ignoring_case(word, "endsolid")) return cursor_.skip_line();
            if (word.empty()) builder_.fail("the file ends before endsolid; it is truncated", cursor_.line());
            if (!equals_ignoring_case(word, "facet")) builder_.fail("facet or endsolid expected" + instead_of(word), cursor_.line());
            parse_facet();
        }
    }

    void parse_facet() {
        expect("normal");
        for (int k = 0; k < 3; ++k) cursor_.next_word();  // follows from the vertices; often wrong or "nan"
        expect("outer");
        expect("loop");
        for (int k = 0; k < 3; ++k) {
            expect("vertex");
            const double x = number(), y = number(), z = number();
            builder_.add_vertex(x, y, z, cursor_.line());
        }
        expect("endloop");
        expect("endfacet");
        const std::int64_t end = builder_.vertex_count();
        builder_.add_polygon(std::array{end - 3, end - 2, end - 1}, cursor_.line());
    }

    void expect(std::string_view keyword) {
        const auto word = cursor_.next_word();
        if (equals_ignoring_case(word, keyword)) return;
        std::string what(keyword);
        what += word.empty() ? " expected, but the file ends; it is truncated" : " expected" + instead_of(word);
        builder_.fail(what, cursor_.line());
    }

    double number() {
        const auto word = cursor_.next_word();
        const auto value = to_double(word);
        if (!value) builder_.fail("a vertex needs three numbers" + instead_of(word), cursor_.line());
        return *value;
    }

    TextCursor cursor_;
    MeshBuilder builder_;
};

}  // namespace

TriangleMesh parse_stl(const std::string& bytes, const std::string& file) {
    return is_binary(bytes) ? parse_binary(bytes, file) : AsciiStl(bytes, file).parse();
}

}  // namespace octafield::surface
