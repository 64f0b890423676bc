#include "tetgen_run.hpp"

#define TETLIBRARY
#include <tetgen.h>

#include <algorithm>
#include <cctype>
#include <cstring>

#include "isolated_process.hpp"

namespace octafield::volume {
namespace {

// Filled with arrays from new[]: tetgenio's destructor deletes them.
void fill_input(tetgenio& in, const surface::TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& holes) {
    in.firstnumber = 0;
    in.numberofpoints = static_cast<int>(mesh.vertices.rows());
    in.pointlist = new double[mesh.vertices.size()];
    std::copy_n(mesh.vertices.data(), mesh.vertices.size(), in.pointlist);
    in.numberoffacets = static_cast<int>(mesh.triangles.rows());
    in.facetlist = new tetgenio::facet[in.numberoffacets];
    for (int f = 0; f < in.numberoffacets; ++f) {
        tetgenio::facet& facet = in.facetlist[f];
        tetgenio::init(&facet);
        facet.numberofpolygons = 1;
        facet.polygonlist = new tetgenio::polygon[1];
        facet.polygonlist[0].numberofvertices = 3;
        facet.polygonlist[0].vertexlist = new int[3];
        for (int k = 0; k < 3; ++k) facet.polygonlist[0].vertexlist[k] = mesh.triangles(f, k);
    }
    if (holes.empty()) return;
    in.numberofholes = static_cast<int>(holes.size());
    in.holelist = new double[3 * holes.size()];
    for (std::size_t h = 0; h < holes.size(); ++h) std::copy_n(holes[h].data(), 3, in.holelist + 3 * h);
}

tetgenbehavior switches(const TetgenParameters& parameters, bool second = false) {
    tetgenbehavior b;
    char first_text[] = "pYMBFzQ", second_text[] = "rYBFzQ";
    b.parse_commandline(second ? second_text : first_text);
    if (parameters.tolerance > 0) b.epsilon = parameters.tolerance;
    b.insertaddpoints = parameters.inside.rows() > 0;
    if (parameters.most_added > 0) b.steinerleft = parameters.most_added;
    if (!parameters.refine) return b;
    b.quality = 1;
    b.minratio = parameters.radius_edge_ratio;
    if (parameters.min_dihedral > 0) b.mindihedral = parameters.min_dihedral;
    b.fixedvolume = 1;
    b.maxvolume = parameters.max_volume;
    return b;
}

struct Header {
    std::int64_t points, tets;
};

void emit_mesh(const tetgenio& out, const Emit& emit) {
    const Header header{out.numberofpoints, out.numberoftetrahedra};
    emit(&header, sizeof header);
    emit(out.pointlist, sizeof(double) * 3 * header.points);
    emit(out.tetrahedronlist, sizeof(int) * 4 * header.tets);
}

TetMesh read_mesh(const std::vector<std::byte>& bytes) {
    Header header{0, 0};
    std::memcpy(&header, bytes.data(), sizeof header);
    TetMesh mesh{Points(header.points, 3), Tets(header.tets, 4)};
    const std::byte* next = bytes.data() + sizeof header;
    std::copy_n(next, sizeof(double) * mesh.vertices.size(), reinterpret_cast<std::byte*>(mesh.vertices.data()));
    next += sizeof(double) * mesh.vertices.size();
    std::copy_n(next, sizeof(Index) * mesh.tets.size(), reinterpret_cast<std::byte*>(mesh.tets.data()));
    return mesh;
}

}  // namespace

std::string tetgen_reason(const std::string& printed) {
    std::string lower = printed;
    std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const auto says = [&](const char* words) { return lower.find(words) != std::string::npos; };
    if (says("out of memory") || says("bad_alloc")) return "memory ran out";
    if (says("intersect")) return "it found parts of the surface that cross";
    if (says("too small") || says("small feature") || says("very close") || says("degenerate"))
        return "it found parts of the surface too close to each other for its arithmetic";
    if (says("assert") || says("bug")) return "it stopped at a check of its own";
    return "it stopped without a reason";
}

TetgenOutcome run_tetgen(const surface::TriangleMesh& mesh, const TetgenParameters& parameters,
                         const Progress& progress) {
    IsolatedOutcome run = run_isolated(
        [&](const Emit& emit) {
            if (parameters.most_seconds > 0) end_after(parameters.most_seconds);
            tetgenio in, out, inside;
            fill_input(in, mesh, parameters.holes);
            inside.firstnumber = 0;
            inside.numberofpoints = static_cast<int>(parameters.inside.rows());
            if (inside.numberofpoints > 0) {
                inside.pointlist = new double[parameters.inside.size()];
                std::copy_n(parameters.inside.data(), parameters.inside.size(), inside.pointlist);
            }
            tetgenbehavior b = switches(parameters);
            if (parameters.inside_later) {
                tetgenio between;
                tetgenbehavior surface_only;
                char text[] = "pYMzQ";  // with the faces on the surface, which the second run keeps
                surface_only.parse_commandline(text);
                surface_only.epsilon = b.epsilon;
                ::tetrahedralize(&surface_only, &in, &between);
                b = switches(parameters, true);
                ::tetrahedralize(&b, &between, &out, inside.numberofpoints > 0 ? &inside : nullptr);
                emit_mesh(out, emit);
                return;
            }
            ::tetrahedralize(&b, &in, &out, inside.numberofpoints > 0 ? &inside : nullptr);
            emit_mesh(out, emit);
        },
        "tetrahedralize", progress);
    TetgenOutcome outcome;
    outcome.finished = run.finished;
    outcome.out_of_time = run.out_of_time;
    if (run.finished)
        outcome.mesh = read_mesh(run.result);
    else
        outcome.reason = tetgen_reason(run.printed);
    return outcome;
}

}  // namespace octafield::volume
