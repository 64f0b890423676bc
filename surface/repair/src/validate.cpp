#include "octafield/surface/validate.hpp"

#include <algorithm>
#include <numeric>

#include "half_edges.hpp"
#include "merge_points.hpp"
#include "octafield/error.hpp"
#include "shells.hpp"
#include "short_number.hpp"
#include "triangle_tests.hpp"

namespace octafield::surface {
namespace {

std::string plural(std::size_t count, const std::string& noun, const std::string& nouns) {
    return std::to_string(count) + " " + (count == 1 ? noun : nouns);
}

// Whether a repair level does it has to be tried; those who have tried say more.
constexpr const char* kRemedy =
    "; correct the surface where it was made, or see which level of repair makes it sound (octafield info)";

std::string first_few_edges(const std::vector<Index>& ends) {
    std::string text;
    const std::size_t count = ends.size() / 2, most = 5;
    for (std::size_t i = 0; i < std::min(count, most); ++i)
        text += (i ? ", " : "") + std::to_string(ends[2 * i]) + "-" + std::to_string(ends[2 * i + 1]);
    if (count > most) text += " and " + std::to_string(count - most) + " more";
    return text;
}

// What the sides of the edges tell.
struct EdgeDefects {
    std::vector<Index> non_manifold, inconsistent, boundary;  // flattened vertex ids
    bool some_edge_shared = false;
};

EdgeDefects edge_defects(const std::vector<HalfEdge>& sides) {
    EdgeDefects found;
    for_each_edge(sides, [&](auto first, auto last) {
        const auto add = [&](std::vector<Index>& list) { list.insert(list.end(), {first->low, first->high}); };
        if (last - first > 1) found.some_edge_shared = true;
        if (last - first > 2) add(found.non_manifold);
        if (last - first == 2 && first->forward == (first + 1)->forward) add(found.inconsistent);
        if (last - first == 1) add(found.boundary);
    });
    return found;
}

// Vertices where fans of triangles meet that no edge joins.
std::vector<Index> non_manifold_vertices(const TriangleMesh& mesh, const std::vector<HalfEdge>& sides) {
    std::vector<Index> parent(3 * mesh.triangles.rows());  // of corners: joined across each edge at both its ends
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](Index c) {
        while (parent[c] != c) c = parent[c] = parent[parent[c]];
        return c;
    };
    const auto corner = [](const HalfEdge& side, bool low) {
        return 3 * side.triangle + (side.forward == low ? side.corner : (side.corner + 1) % 3);
    };
    for_each_edge(sides, [&](auto first, auto last) {
        for (auto side = first + 1; side != last; ++side)
            for (const bool low : {true, false}) {
                const Index a = root(corner(*first, low)), b = root(corner(*side, low));
                parent[std::max(a, b)] = std::min(a, b);
            }
    });
    std::vector<int> fans(mesh.vertices.rows(), 0);
    for (Index c = 0; c < static_cast<Index>(parent.size()); ++c)
        if (parent[c] == c) ++fans[mesh.triangles(c / 3, c % 3)];
    std::vector<Index> found;
    for (Index v = 0; v < static_cast<Index>(fans.size()); ++v)
        if (fans[v] > 1) found.push_back(v);
    return found;
}

// Vertices in use at the place of an earlier vertex in use.
std::vector<Index> duplicate_vertices(const TriangleMesh& mesh) {
    std::vector<bool> used(mesh.vertices.rows(), false);
    for (const Index v : mesh.triangles.reshaped()) used[v] = true;
    const std::vector<Index> first = first_equal_points(mesh.vertices);
    std::vector<bool> taken(mesh.vertices.rows(), false);
    std::vector<Index> found;
    for (Index v = 0; v < mesh.vertices.rows(); ++v) {
        if (!used[v]) continue;
        if (taken[first[v]]) found.push_back(v);
        taken[first[v]] = true;
    }
    return found;
}

std::vector<Index> triangles_where(const TriangleMesh& mesh, const auto& is_wrong) {
    std::vector<Index> found;
    for (Index t = 0; t < mesh.triangles.rows(); ++t)
        if (is_wrong(t)) found.push_back(t);
    return found;
}

class Examination {
public:
    Examination(const TriangleMesh& mesh, const ValidateOptions& options) : mesh_(mesh), options_(options) {}

    std::vector<Defect> run() {
        if (mesh_.triangles.rows() == 0) {
            defects_.push_back({"empty", "triangle", {}, "the mesh has no triangles; is it the right file?"});
            return defects_;
        }
        test_numbers();
        if (defects_.empty()) test_topology();
        return defects_;
    }

private:
    void add(const char* kind, const char* element, std::vector<Index> elements, std::string message) {
        if (!elements.empty()) defects_.push_back({kind, element, std::move(elements), std::move(message)});
    }

    // Where the first of them is, for those who look at the surface.
    std::string at_vertex(const std::vector<Index>& vertices) const {
        if (vertices.empty()) return {};
        const auto point = mesh_.vertices.row(vertices.front());
        return " at (" + short_number(point[0]) + ", " + short_number(point[1]) + ", " + short_number(point[2]) + ")";
    }
    std::string at_triangle(const std::vector<Index>& triangles) const {
        return triangles.empty() ? std::string() : at_vertex({mesh_.triangles(triangles.front(), 0)});
    }

    void test_numbers() {
        auto out = triangles_where(mesh_, [&](Index t) {
            return mesh_.triangles.row(t).minCoeff() < 0 || mesh_.triangles.row(t).maxCoeff() >= mesh_.vertices.rows();
        });
        const auto vertex_range = "0 to " + std::to_string(mesh_.vertices.rows() - 1);
        add("index_out_of_range", "triangle", out,
            plural(out.size(), "triangle uses", "triangles use") + " a vertex outside " + vertex_range + ": triangle " +
                first_few(out) + "; correct the vertex numbers (they are 0-based)");
        std::vector<Index> not_finite;
        for (Index v = 0; v < mesh_.vertices.rows(); ++v)
            if (!mesh_.vertices.row(v).allFinite()) not_finite.push_back(v);
        add("non_finite_vertex", "vertex", not_finite,
            plural(not_finite.size(), "vertex has", "vertices have") + " a coordinate that is not finite: vertex " +
                first_few(not_finite) + "; correct the coordinates");
    }

    void test_topology() {
        auto flat = triangles_where(mesh_, [&](Index t) { return is_degenerate(mesh_, t); });
        const bool has_flat = !flat.empty();
        add("degenerate_triangle", "triangle", flat,
            plural(flat.size(), "triangle has", "triangles have") + " no area: triangle " + first_few(flat) +
                ", the first" + at_triangle(flat) + kRemedy);
        const std::vector<HalfEdge> sides = sorted_half_edges(mesh_.triangles);
        const EdgeDefects edges = edge_defects(sides);
        auto duplicates = duplicate_vertices(mesh_);
        const bool has_duplicates = !duplicates.empty();
        if (has_duplicates && !edges.some_edge_shared) {
            auto all = triangles_where(mesh_, [](Index) { return true; });
            add("soup", "triangle", all,
                "no two of the " + std::to_string(all.size()) +
                    " triangles share an edge, although points coincide (a triangle soup)" + kRemedy);
            return;
        }
        add("duplicate_vertex", "vertex", duplicates,
            plural(duplicates.size(), "vertex coincides", "vertices coincide") + " with an earlier one: vertex " +
                first_few(duplicates) + ", the first" + at_vertex(duplicates) + kRemedy);
        test_edges(sides, edges);
        if (options_.self_intersection && !has_flat && !has_duplicates) test_self_intersection();
    }

    void test_edges(const std::vector<HalfEdge>& sides, const EdgeDefects& edges) {
        const bool sound_before = defects_.empty();
        add("non_manifold_edge", "edge", edges.non_manifold,
            "more than 2 triangles share " + plural(edges.non_manifold.size() / 2, "edge", "edges") + " (vertices " +
                first_few_edges(edges.non_manifold) +
                ", the first" + at_vertex(edges.non_manifold) + ")" + kRemedy);
        add("inconsistent_orientation", "edge", edges.inconsistent,
            plural(edges.inconsistent.size() / 2, "edge has", "edges have") +
                " triangles of opposite orientation (vertices " + first_few_edges(edges.inconsistent) +
                ", the first" + at_vertex(edges.inconsistent) + ")" + kRemedy);
        if (options_.closed)
            add("not_closed", "edge", edges.boundary,
                "the surface is not closed: " + plural(edges.boundary.size() / 2, "edge has", "edges have") +
                    " one triangle only (vertices " + first_few_edges(edges.boundary) +
                    ", the first" + at_vertex(edges.boundary) + ")" + kRemedy);
        if (!sound_before || !edges.non_manifold.empty()) return;
        auto vertices = non_manifold_vertices(mesh_, sides);
        add("non_manifold_vertex", "vertex", vertices,
            "separate parts of the surface touch at " + plural(vertices.size(), "vertex", "vertices") + ": vertex " +
                first_few(vertices) + ", the first" + at_vertex(vertices) + kRemedy);
        if (!defects_.empty()) return;
        auto wrong = wrong_way_triangles(mesh_, sides);
        add("inside_out", "triangle", wrong,
            std::to_string(wrong.size()) +
                " triangles belong to shells that face the wrong way (outer shells must face outward, the shells of "
                "cavities into the cavity): triangle " +
                first_few(wrong) + ", the first" + at_triangle(wrong) + kRemedy);
    }

    void test_self_intersection() {
        auto found = intersecting_triangles(mesh_);
        add("self_intersection", "triangle", found,
            std::to_string(found.size()) + " triangles cross or touch others: triangle " + first_few(found) +
                ", the first" + at_triangle(found) + kRemedy);
    }

    const TriangleMesh& mesh_;
    const ValidateOptions& options_;
    std::vector<Defect> defects_;
};

}  // namespace

std::vector<Defect> find_defects(const TriangleMesh& mesh, const ValidateOptions& options) {
    return Examination(mesh, options).run();
}

void require_valid(const TriangleMesh& mesh, const ValidateOptions& options) {
    const std::vector<Defect> defects = find_defects(mesh, options);
    if (defects.empty()) return;
    std::string message = defects.front().message;
    if (defects.size() > 1)
        message += " (" + plural(defects.size() - 1, "further kind", "further kinds") + " of defects found)";
    throw GeometryError(message, defects.front().kind, defects.front().elements);
}

}  // namespace octafield::surface
