#include "octafield/surface/read_write.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <memory>

#include "merge_points.hpp"
#include "mesh_builder.hpp"
#include "octafield/error.hpp"
#include "octafield/temporary_file.hpp"

namespace octafield::surface {
namespace {

namespace fs = std::filesystem;

struct Format {
    const char* extension;
    TriangleMesh (*parse)(const std::string& bytes, const std::string& file);
    std::string (*format)(const TriangleMesh& mesh);
};

constexpr Format kFormats[] = {{".stl", parse_stl, format_stl},
                               {".obj", parse_obj, format_obj},
                               {".off", parse_off, format_off},
                               {".ply", parse_ply, format_ply}};

std::string lower_extension(const fs::path& path) {
    std::string extension = path.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

bool is_gzip_name(const fs::path& path) { return lower_extension(path) == ".gz"; }

const Format& format_of(const fs::path& path) {
    const std::string extension = lower_extension(is_gzip_name(path) ? path.stem() : path);
    for (const Format& format : kFormats)
        if (extension == format.extension) return format;
    throw IoError("the format of " + path.string() +
                      " is unknown: surface files end in .stl, .obj, .off or .ply, each also with .gz",
                  "unknown_format");
}

// Inflates what is gzipped, whatever its name; leaves the rest as it is.
std::string load(const fs::path& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (status.type() == fs::file_type::not_found) throw IoError("there is no file " + path.string(), "missing");
    if (error || !fs::is_regular_file(status)) throw IoError(path.string() + " is not a file", "unreadable");
    const std::unique_ptr<gzFile_s, decltype(&gzclose_r)> file(gzopen(path.c_str(), "rb"), &gzclose_r);
    if (!file) throw IoError("cannot open " + path.string() + "; is it readable for you?", "unreadable");
    std::string bytes;
    std::array<char, 1 << 18> block;
    int count = 0;
    while ((count = gzread(file.get(), block.data(), block.size())) > 0) bytes.append(block.data(), count);
    int code = Z_OK;
    const std::string why = gzerror(file.get(), &code);
    if (count < 0 || (code != Z_OK && code != Z_STREAM_END))
        throw IoError("cannot read " + path.string() + ": " + why + "; it is truncated or damaged", "unreadable");
    if (bytes.empty()) throw IoError("cannot read " + path.string() + ": it is empty", "unreadable");
    return bytes;
}

bool store_plain(const std::string& bytes, const fs::path& path) {
    std::ofstream out(path, std::ios::binary);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.close();
    return out.good();
}

bool store_gzip(const std::string& bytes, const fs::path& path) {
    const gzFile file = gzopen(path.c_str(), "wb");
    if (!file) return false;
    bool good = true;
    for (std::size_t begin = 0; good && begin < bytes.size(); begin += 1 << 24) {
        const auto size = static_cast<unsigned>(std::min<std::size_t>(1 << 24, bytes.size() - begin));
        good = gzwrite(file, bytes.data() + begin, size) == static_cast<int>(size);
    }
    return (gzclose(file) == Z_OK) && good;
}

void store(const std::string& bytes, const fs::path& path) {
    TemporaryFile file(path);
    if (!(is_gzip_name(path) ? store_gzip(bytes, file.path()) : store_plain(bytes, file.path())))
        file.fail("writing stopped");
    file.move_to_target();
}

void require_single_precision(const TriangleMesh& mesh, const fs::path& path) {
    std::vector<Index> flat;
    for (Index t = 0; t < mesh.triangles.rows(); ++t) {
        Eigen::Matrix<double, 2, 3> exact, rounded;  // two edges
        for (int k = 0; k < 2; ++k) {
            const auto a = mesh.vertices.row(mesh.triangles(t, 0)), b = mesh.vertices.row(mesh.triangles(t, k + 1));
            exact.row(k) = b - a;
            rounded.row(k) = b.cast<float>().cast<double>() - a.cast<float>().cast<double>();
        }
        const auto is_flat = [](const auto& edges) { return edges.row(0).cross(edges.row(1)).isZero(0); };
        if (!is_flat(exact) && is_flat(rounded)) flat.push_back(t);
    }
    if (!flat.empty())
        throw IoError("cannot write " + path.string() + ": STL files hold single precision, in which triangles " +
                          first_few(flat) + " have no area; write .ply or .obj, or move the part to the origin",
                      "single_precision");
}

}  // namespace

TriangleMesh read_surface(const fs::path& path) {
    const Format& format = format_of(path);
    try {
        TriangleMesh mesh = format.parse(load(path), path.string());
        return format.parse == parse_stl ? merge_equal_points(mesh) : mesh;
    } catch (const std::bad_alloc&) {
        throw IoError("cannot read " + path.string() + ": it does not fit into memory", "unreadable");
    }
}

void write_surface(const TriangleMesh& mesh, const fs::path& path) {
    const Format& format = format_of(path);
    if (mesh.triangles.size() && (mesh.triangles.minCoeff() < 0 || mesh.triangles.maxCoeff() >= mesh.vertices.rows()))
        throw InvalidInput("cannot write " + path.string() + ": a triangle uses a vertex that does not exist",
                           "index_out_of_range");
    if (format.format == format_stl) require_single_precision(mesh, path);
    store(format.format(mesh), path);
}

}  // namespace octafield::surface
