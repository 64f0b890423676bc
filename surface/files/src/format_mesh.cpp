// The bytes of surface files.
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>

#include "mesh_builder.hpp"
#include "octafield/error.hpp"

namespace octafield::surface {
namespace {

static_assert(std::endian::native == std::endian::little, "the binary formats written here are little-endian");

template <class T>
void append(std::string& bytes, T value) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    bytes.append(raw, sizeof(T));
}

void append_row(std::string& text, const Points& points, Index v) {
    char number[32];
    for (int k = 0; k < 3; ++k) {
        // 17 significant digits bring every double back, whatever the locale.
        const auto end =
            std::to_chars(number, number + sizeof number, points(v, k), std::chars_format::general, 17).ptr;
        text.append(number, end);
        text += k < 2 ? ' ' : '\n';
    }
}

void append_triangle(std::string& text, const Triangles& triangles, Index t, Index first_id) {
    for (int k = 0; k < 3; ++k) text += std::to_string(triangles(t, k) + first_id) + (k < 2 ? ' ' : '\n');
}

void append_float(std::string& bytes, double value) {
    const auto rounded = static_cast<float>(value);
    if (!std::isfinite(rounded))
        throw IoError("STL holds single precision only, and a coordinate is too large for it; write OBJ, OFF or PLY",
                      "unwritable");
    append(bytes, rounded);
}

}  // namespace

std::string format_stl(const TriangleMesh& mesh) {
    std::string bytes = "binary STL by octafield";
    bytes.resize(80, ' ');
    append(bytes, static_cast<std::uint32_t>(mesh.triangles.rows()));
    const Points normals = triangle_normals(mesh);
    for (Index t = 0; t < mesh.triangles.rows(); ++t) {
        for (int k = 0; k < 3; ++k) append_float(bytes, normals(t, k));
        for (const Index v : mesh.triangles.row(t))
            for (int k = 0; k < 3; ++k) append_float(bytes, mesh.vertices(v, k));
        append(bytes, std::uint16_t{0});
    }
    return bytes;
}

std::string format_obj(const TriangleMesh& mesh) {
    std::string text;
    for (Index v = 0; v < mesh.vertices.rows(); ++v) {
        text += "v ";
        append_row(text, mesh.vertices, v);
    }
    for (Index t = 0; t < mesh.triangles.rows(); ++t) {
        text += "f ";
        append_triangle(text, mesh.triangles, t, 1);
    }
    return text;
}

std::string format_off(const TriangleMesh& mesh) {
    std::string text =
        "OFF\n" + std::to_string(mesh.vertices.rows()) + " " + std::to_string(mesh.triangles.rows()) + " 0\n";
    for (Index v = 0; v < mesh.vertices.rows(); ++v) append_row(text, mesh.vertices, v);
    for (Index t = 0; t < mesh.triangles.rows(); ++t) {
        text += "3 ";
        append_triangle(text, mesh.triangles, t, 0);
    }
    return text;
}

std::string format_ply(const TriangleMesh& mesh) {
    std::string bytes = "ply\nformat binary_little_endian 1.0\ncomment by octafield\nelement vertex " +
                        std::to_string(mesh.vertices.rows()) +
                        "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                        std::to_string(mesh.triangles.rows()) +
                        "\nproperty list uchar int vertex_indices\nend_header\n";
    for (const double value : mesh.vertices.reshaped<Eigen::RowMajor>()) append(bytes, value);
    for (const auto triangle : mesh.triangles.rowwise()) {
        append(bytes, std::uint8_t{3});
        for (const Index v : triangle) append(bytes, v);
    }
    return bytes;
}

}  // namespace octafield::surface
