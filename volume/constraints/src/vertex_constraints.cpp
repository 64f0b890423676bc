#include "octafield/volume/vertex_constraints.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "constraints.hpp"
#include "octafield/error.hpp"

namespace octafield::volume {
namespace {

void require_sizes(const BoundaryConstraints& base, const VertexConstraints& given) {
    const std::size_t n = base.kind.size(), k = given.vertices.size();
    const auto rows = [](const auto& array) { return static_cast<std::size_t>(array.rows()); };
    if (base.on_boundary.size() != n || rows(base.axis) != n || rows(base.frames) != n)
        throw InvalidInput(
            "the constraints' arrays have different numbers of rows; build them with "
            "boundary_constraints",
            "wrong_size");
    if (given.kinds.size() != k || (rows(given.axes) != k && rows(given.axes) != 0) ||
        (rows(given.frames) != k && rows(given.frames) != 0))
        throw InvalidInput("kinds, axes and frames must have one row per given vertex, " + std::to_string(k) +
                               "; axes and frames may have none",
                           "wrong_size");
}

// Throws naming the vertices for whose place i bad(i) holds.
template <class Bad>
void require_none(const VertexConstraints& given, const Bad& bad, const std::string& what, const char* kind) {
    std::vector<Index> ids;
    for (std::size_t i = 0; i < given.vertices.size(); ++i)
        if (bad(i)) ids.push_back(given.vertices[i]);
    if (!ids.empty()) throw InvalidInput(what + " at vertex " + first_few(ids), kind, ids);
}

void require_sound(const BoundaryConstraints& base, const VertexConstraints& given) {
    require_sizes(base, given);
    const Index n = static_cast<Index>(base.kind.size());
    require_none(
        given, [&](std::size_t i) { return given.vertices[i] < 0 || given.vertices[i] >= n; },
        "constraints are given that a mesh of " + std::to_string(n) + " vertices cannot have", "index_out_of_range");
    std::vector<std::uint8_t> seen(n, 0);
    require_none(
        given, [&](std::size_t i) { return seen[given.vertices[i]]++ > 0; }, "more than one constraint is given",
        "repeated_value");
    require_none(
        given, [&](std::size_t i) { return !is_known(given.kinds[i]); },
        "unknown kinds of constraints (there are " + listed_kinds() + ")", "unknown_word");
    require_none(
        given,
        [&](std::size_t i) {
            if (!info(given.kinds[i]).takes_axis) return false;
            if (given.axes.rows() == 0) return true;
            const double length = given.axes.row(i).stableNorm();
            return !(length > 0 && std::isfinite(length));
        },
        "an axis of finite length above 0 is needed", "zero_axis");
    require_none(
        given,
        [&](std::size_t i) {
            if (!info(given.kinds[i]).takes_frame) return false;
            return given.frames.rows() == 0 || !(std::abs(given.frames.row(i).squaredNorm() - 1) < 1e-6);
        },
        "a unit quaternion (w, x, y, z) is needed", "not_unit");
}

}  // namespace

BoundaryConstraints with_constraints(const BoundaryConstraints& base, const VertexConstraints& given) {
    require_sound(base, given);
    BoundaryConstraints result = base;
    for (std::size_t i = 0; i < given.vertices.size(); ++i) {
        const Index v = given.vertices[i];
        result.kind[v] = given.kinds[i];
        result.axis.row(v).setZero();
        if (result.lengths.rows() > 0) result.lengths.row(v).setOnes();
        if (info(given.kinds[i]).takes_axis) result.axis.row(v) = given.axes.row(i).stableNormalized();
        if (info(given.kinds[i]).takes_frame) result.frames.row(v) = given.frames.row(i).normalized();
    }
    const Quaternions moved = constrained_start(result, result.frames);
    for (const Index v : given.vertices) result.frames.row(v) = moved.row(v);
    std::erase_if(result.released_corners, [&](Index v) { return result.kind[v] != VertexConstraint::free; });
    return result;
}

}  // namespace octafield::volume
