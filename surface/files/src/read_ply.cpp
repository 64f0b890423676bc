// PLY, ASCII and binary of either byte order. CGAL's reader is not used here: it allocates what a list's count
// announces, accepts faces of two integer types only, and cannot say where a file is wrong.
#include <algorithm>
#include <bit>
#include <cstring>
#include <map>

#include "mesh_builder.hpp"
#include "text_cursor.hpp"

namespace octafield::surface {
namespace {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::int64_t size_of(PlyType type) {
    constexpr std::int64_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
    return sizes[static_cast<int>(type)];
}

struct Property {
    std::string name;
    PlyType type;
    bool is_list = false;
    PlyType count_type = PlyType::uint8;
};

struct Element {
    std::string name;
    std::int64_t count;
    std::vector<Property> properties;
};

enum class Encoding { ascii, little_endian, big_endian };

class PlyParser {
public:
    PlyParser(const std::string& bytes, const std::string& file)
        : bytes_(bytes), cursor_(bytes), header_(file, "line"), file_(file) {}

    TriangleMesh parse() {
        parse_header();
        MeshBuilder builder(file_, encoding_ == Encoding::ascii ? "line" : "byte");
        builder_ = &builder;
        position_ = cursor_.offset();
        for (const Element& element : elements_) parse_element(element);
        return builder.finish();
    }

private:
    void parse_header() {
        std::vector<std::string_view> words;
        if (!cursor_.next_line(words, '\0') || words[0] != "ply") header_.fail("it does not begin with \"ply\"");
        bool has_format = false;
        while (true) {
            if (!cursor_.next_line(words, '\0')) header_.fail("the file ends within the header", cursor_.line());
            if (words[0] == "end_header") break;
            if (words[0] == "format" && words.size() >= 2) {
                parse_format(words[1]);
                has_format = true;
            } else if (words[0] == "element" && words.size() == 3) {
                const auto count = to_integer(words[2]);
                if (!count || *count < 0)
                    header_.fail("the number of elements must be a whole number" + instead_of(words[2]), cursor_.line());
                elements_.push_back({std::string(words[1]), *count, {}});
            } else if (words[0] == "property" && !elements_.empty()) {
                elements_.back().properties.push_back(parse_property(words));
            } else if (words[0] != "comment" && words[0] != "obj_info") {
                header_.fail("a line of the header expected" + instead_of(words[0]), cursor_.line());
            }
        }
        if (!has_format) header_.fail("the header names no format");
    }

    void parse_format(std::string_view name) {
        if (name == "ascii") {
            encoding_ = Encoding::ascii;
        } else if (name == "binary_little_endian") {
            encoding_ = Encoding::little_endian;
        } else if (name == "binary_big_endian") {
            encoding_ = Encoding::big_endian;
        } else {
            header_.fail("ascii, binary_little_endian or binary_big_endian expected" + instead_of(name), cursor_.line());
        }
    }

    Property parse_property(const std::vector<std::string_view>& words) const {
        if (words.size() == 3) return {std::string(words[2]), parse_type(words[1])};
        if (words.size() == 5 && words[1] == "list")
            return {std::string(words[4]), parse_type(words[3]), true, parse_type(words[2])};
        header_.fail("a property needs a type and a name", cursor_.line());
    }

    PlyType parse_type(std::string_view name) const {
        static const std::map<std::string_view, PlyType> types = {
            {"char", PlyType::int8},      {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
            {"uint8", PlyType::uint8},    {"short", PlyType::int16},     {"int16", PlyType::int16},
            {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},   {"int", PlyType::int32},
            {"int32", PlyType::int32},    {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
            {"float", PlyType::float32},  {"float32", PlyType::float32}, {"double", PlyType::float64},
            {"float64", PlyType::float64}};
        const auto found = types.find(name);
        if (found == types.end()) header_.fail("unknown type of a property", cursor_.line());
        return found->second;
    }

    void parse_element(const Element& element) {
        if (element.properties.empty()) return;
        std::int64_t least_bytes = 0;
        for (const Property& property : element.properties)
            least_bytes +=
                encoding_ == Encoding::ascii ? 2 : size_of(property.is_list ? property.count_type : property.type);
        builder_->check_announced(element.count, "elements \"" + element.name + "\"", least_bytes, bytes_left() + 1, 0);

        const auto column = [&](std::string_view name) {
            return std::ranges::find(element.properties, name, &Property::name) - element.properties.begin();
        };
        const auto missing = static_cast<std::ptrdiff_t>(element.properties.size());
        const bool is_vertex = element.name == "vertex", is_face = element.name == "face";
        const std::ptrdiff_t xyz[3] = {column("x"), column("y"), column("z")};
        if (is_vertex && *std::ranges::max_element(xyz) == missing)
            builder_->fail("the vertices have no properties x, y, z");
        const std::ptrdiff_t corners = std::min(column("vertex_indices"), column("vertex_index"));
        if (is_face && (corners == missing || !element.properties[corners].is_list))
            builder_->fail("the faces have no list vertex_indices");

        std::vector<double> scalars(element.properties.size());
        std::vector<std::int64_t> list, ids;
        for (std::int64_t i = 0; i < element.count; ++i) {
            const std::int64_t first_byte = place();
            for (std::ptrdiff_t k = 0; k < missing; ++k) {
                const Property& property = element.properties[k];
                if (property.is_list) {
                    read_list(property, list);
                    if (k == corners) ids.swap(list);
                } else {
                    scalars[k] = read(property.type);
                }
            }
            const std::int64_t where = encoding_ == Encoding::ascii ? place() : first_byte;
            if (is_vertex) builder_->add_vertex(scalars[xyz[0]], scalars[xyz[1]], scalars[xyz[2]], where);
            if (is_face) builder_->add_polygon(ids, where);
        }
    }

    void read_list(const Property& property, std::vector<std::int64_t>& list) {
        const auto count = static_cast<std::int64_t>(read_integer(property.count_type));
        builder_->check_announced(count, "entries of a list", encoding_ == Encoding::ascii ? 2 : size_of(property.type),
                                  bytes_left() + 1, place());
        list.resize(count);
        const bool integers = property.type != PlyType::float32 && property.type != PlyType::float64;
        for (auto& entry : list) {
            if (integers) {
                entry = read_integer(property.type);
            } else {
                read(property.type);  // texture coordinates and the like; never vertex ids
                entry = -1;
            }
        }
    }

    std::int64_t read_integer(PlyType type) {
        const double value = read(type);
        // Checked before the conversion: text may hold anything.
        if (!(value >= -4294967296.0 && value <= 4294967296.0) ||
            value != static_cast<double>(static_cast<std::int64_t>(value)))
            builder_->fail("an integer expected", place());
        return static_cast<std::int64_t>(value);
    }

    double read(PlyType type) {
        if (encoding_ == Encoding::ascii) {
            const auto word = cursor_.next_word();
            if (word.empty()) builder_->fail("the file ends within its data; it is truncated", place());
            const auto value = to_double(word);
            if (!value) builder_->fail("a number expected" + instead_of(word), place());
            return *value;
        }
        switch (type) {
            case PlyType::int8:
                return read_binary<std::int8_t>();
            case PlyType::uint8:
                return read_binary<std::uint8_t>();
            case PlyType::int16:
                return read_binary<std::int16_t>();
            case PlyType::uint16:
                return read_binary<std::uint16_t>();
            case PlyType::int32:
                return read_binary<std::int32_t>();
            case PlyType::uint32:
                return read_binary<std::uint32_t>();
            case PlyType::float32:
                return read_binary<float>();
            case PlyType::float64:
                return read_binary<double>();
        }
        return 0;
    }

    template <class T>
    double read_binary() {
        static_assert(std::endian::native == std::endian::little);
        if (bytes_left() < static_cast<std::int64_t>(sizeof(T)))
            builder_->fail("the file ends within its data; it is truncated", place());
        char raw[sizeof(T)];
        std::memcpy(raw, bytes_.data() + position_, sizeof(T));
        if (encoding_ == Encoding::big_endian) std::reverse(raw, raw + sizeof(T));
        position_ += sizeof(T);
        return static_cast<double>(std::bit_cast<T>(raw));
    }

    std::int64_t bytes_left() const {
        return encoding_ == Encoding::ascii ? cursor_.bytes_left()
                                            : static_cast<std::int64_t>(bytes_.size() - position_);
    }
    std::int64_t place() const {
        return encoding_ == Encoding::ascii ? cursor_.line() : static_cast<std::int64_t>(position_);
    }

    const std::string& bytes_;
    TextCursor cursor_;
    MeshBuilder header_;  // for messages about the header, which is text in every encoding
    std::string file_;
    MeshBuilder* builder_ = nullptr;
    Encoding encoding_ = Encoding::ascii;
    std::vector<Element> elements_;
    std::size_t position_ = 0;  // in binary data
};

}  // namespace

TriangleMesh parse_ply(const std::string& bytes, const std::string& file) { return PlyParser(bytes, file).parse(); }

}  // namespace octafield::surface
