// What the readers of all formats share: collecting a mesh while knowing where in the file one is.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::surface {

// Places in the file are lines of text formats (1-based) and bytes of binary ones (0-based); 0 or less: unknown.
class MeshBuilder {
public:
    // `file` names the file in messages, `unit` is "line" or "byte".
    MeshBuilder(std::string file, std::string unit) : file_(std::move(file)), unit_(std::move(unit)) {}

    void add_vertex(double x, double y, double z, std::int64_t place);
    // A polygon of 0-based ids, cut into a fan of triangles. Ids may name vertices that come later.
    void add_polygon(std::span<const std::int64_t> ids, std::int64_t place);
    std::int64_t vertex_count() const { return static_cast<std::int64_t>(coordinates_.size() / 3); }

    // Checks the ids. `first_id` is the format's number of the first vertex, for messages.
    TriangleMesh finish(std::int64_t first_id = 0) const;

    [[noreturn]] void fail(const std::string& what, std::int64_t place = 0) const;
    // Fails when a header announces more than the rest of the file can hold; nothing is allocated from such counts
    // before.
    void check_announced(std::int64_t count, const std::string& what, std::int64_t least_bytes_each,
                         std::int64_t bytes_left, std::int64_t place) const;

private:
    std::string file_;
    std::string unit_;
    std::vector<double> coordinates_;
    std::vector<std::int64_t> corners_;          // three per triangle
    std::vector<std::int64_t> triangle_places_;  // one per triangle
};

// The readers: the whole file's bytes in, a mesh out; they throw IoError. STL comes with three vertices of its own per
// triangle.
TriangleMesh parse_stl(const std::string& bytes, const std::string& file);
TriangleMesh parse_obj(const std::string& bytes, const std::string& file);
TriangleMesh parse_off(const std::string& bytes, const std::string& file);
TriangleMesh parse_ply(const std::string& bytes, const std::string& file);

// The writers: the whole file's bytes.
std::string format_stl(const TriangleMesh& mesh);
std::string format_obj(const TriangleMesh& mesh);
std::string format_off(const TriangleMesh& mesh);
std::string format_ply(const TriangleMesh& mesh);

}  // namespace octafield::surface
