// OBJ and OFF: one element per line. CGAL's readers are not used here: the one for OFF allocates what the header
// announces and prints to stderr, the one for OBJ refuses common statements, and neither can say which line is wrong.
#include "mesh_builder.hpp"
#include "text_cursor.hpp"

namespace octafield::surface {
namespace {

using Words = std::vector<std::string_view>;

void add_vertex_words(MeshBuilder& builder, const Words& words, std::size_t first, std::int64_t line) {
    double values[3] = {};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::string_view word = first + k < words.size() ? words[first + k] : std::string_view();
        const auto value = to_double(word);
        if (!value) builder.fail("a vertex needs three numbers" + instead_of(word), line);
        values[k] = *value;
    }
    builder.add_vertex(values[0], values[1], values[2], line);
}

// "7", "7/1", "7/1/3", "7//3", or "-1" for the vertex read last.
std::int64_t obj_vertex_id(const MeshBuilder& builder, std::string_view word, std::int64_t line) {
    const auto id = to_integer(word.substr(0, word.find('/')));
    if (!id || *id == 0)
        builder.fail("a face needs vertex numbers that begin at 1 (or, counted back from the last, at -1)" + instead_of(word),
                     line);
    if (*id > 0) return *id - 1;
    if (*id < -builder.vertex_count()) builder.fail("a face counts back to before the first vertex", line);
    return builder.vertex_count() + *id;
}

// A backslash at the end of a line continues it on the next one.
bool next_obj_line(TextCursor& cursor, Words& words) {
    if (!cursor.next_line(words)) return false;
    Words more;
    while (!words.empty() && words.back() == "\\") {
        words.pop_back();
        if (cursor.next_line(more)) words.insert(words.end(), more.begin(), more.end());
    }
    return true;
}

struct OffCounts {
    std::int64_t vertices, faces;
};

// "OFF" with or without the counts on the same line; the prefixes C, N, ST only add words behind the positions.
OffCounts parse_off_header(TextCursor& cursor, const MeshBuilder& builder) {
    Words words;
    if (!cursor.next_line(words)) builder.fail("it is empty");
    if (words[0].ends_with("OFF")) {
        const std::string_view prefix = words[0].substr(0, words[0].size() - 3);
        if (prefix.find_first_not_of("CNST") != prefix.npos)
            builder.fail("only three-dimensional OFF is supported", cursor.line());
        words.erase(words.begin());
        if (!words.empty() && words[0] == "BINARY") builder.fail("binary OFF is not supported", cursor.line());
        if (words.empty() && !cursor.next_line(words))
            builder.fail("the numbers of vertices and faces are missing", cursor.line());
    }
    const auto vertices = to_integer(words[0]), faces = words.size() > 1 ? to_integer(words[1]) : std::nullopt;
    if (!vertices || !faces)
        builder.fail("the numbers of vertices and faces expected" +
                         instead_of(!vertices ? words[0] : words.size() > 1 ? words[1] : std::string_view()),
                     cursor.line());
    builder.check_announced(*vertices, "vertices", 6, cursor.bytes_left() + 1, cursor.line());
    builder.check_announced(*faces, "faces", 8, cursor.bytes_left() + 1, cursor.line());
    return {*vertices, *faces};
}

}  // namespace

TriangleMesh parse_obj(const std::string& bytes, const std::string& file) {
    TextCursor cursor(bytes);
    MeshBuilder builder(file, "line");
    Words words;
    std::vector<std::int64_t> ids;
    while (next_obj_line(cursor, words)) {
        if (words.empty()) continue;
        if (words[0] == "v") {
            add_vertex_words(builder, words, 1, cursor.line());
        } else if (words[0] == "f") {
            ids.clear();
            for (std::size_t k = 1; k < words.size(); ++k)
                ids.push_back(obj_vertex_id(builder, words[k], cursor.line()));
            builder.add_polygon(ids, cursor.line());
        }  // all else (normals, textures, groups, materials, lines) says nothing about the surface's shape
    }
    return builder.finish(1);
}

TriangleMesh parse_off(const std::string& bytes, const std::string& file) {
    TextCursor cursor(bytes);
    MeshBuilder builder(file, "line");
    const OffCounts counts = parse_off_header(cursor, builder);
    Words words;
    for (std::int64_t i = 0; i < counts.vertices; ++i) {
        if (!cursor.next_line(words)) builder.fail("the file ends within the vertices; it is truncated", cursor.line());
        add_vertex_words(builder, words, 0, cursor.line());
    }
    std::vector<std::int64_t> ids;
    for (std::int64_t i = 0; i < counts.faces; ++i) {
        if (!cursor.next_line(words)) builder.fail("the file ends within the faces; it is truncated", cursor.line());
        const auto size = to_integer(words[0]);
        if (!size || *size < 0 || *size >= static_cast<std::int64_t>(words.size()))
            builder.fail("a face needs its number of vertices and as many vertex numbers", cursor.line());
        ids.clear();
        for (std::int64_t k = 1; k <= *size; ++k) {
            const auto id = to_integer(words[k]);
            if (!id) builder.fail("a face needs vertex numbers" + instead_of(words[k]), cursor.line());
            ids.push_back(*id);
        }
        builder.add_polygon(ids, cursor.line());
    }
    return builder.finish();
}

}  // namespace octafield::surface
