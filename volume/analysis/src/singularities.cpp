#include "octafield/volume/singularities.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>

#include "octafield/frames/octahedral_lift.hpp"
#include "octafield/frames/sh4.hpp"
#include "octafield/parallel.hpp"
#include "octafield/volume/triangle_table.hpp"
#include "quarter_turns.hpp"
#include "require_frames.hpp"
#include "singular_curves.hpp"

namespace octafield::volume {
namespace {

using frames::Quaternion;
using frames::Sh4;

// The turn of a frame carried continuously round a -> b -> c -> a, in a's own axes: the frame q_a comes back as q_a h.
// With m_uv the matching (q_u m_uv near q_v), q_a goes on as q_b m_ab^-1, then q_c m_bc^-1 m_ab^-1, so h = (m_ab m_bc
// m_ca)^-1. Every edge is matched from its lower to its higher vertex: triangles that share it then agree, also in a
// tie, and the holonomies of a tet's four faces multiply to the identity, so no tet has exactly one singular face.
// Lifted: three smallest steps are less than a whole turn in all, so 0 means no turn. tie: at one of the edges.
frames::LiftedMatching holonomy(const Quaternion& a, const Quaternion& b, const Quaternion& c) {
    const auto ab = frames::lifted_matching(a, b), bc = frames::lifted_matching(b, c),
               ac = frames::lifted_matching(a, c);
    const int round_trip =
        frames::lifted_product(frames::lifted_product(ab.element, bc.element), frames::lifted_inverse(ac.element));
    return {frames::lifted_inverse(round_trip), ab.tie || bc.tie || ac.tie};
}

// Barycentric coordinates of the point where the linear interpolant of three vectors is shortest in the closed
// triangle. On a side that is its middle, as all vectors have one length.
Eigen::Vector3d shortest_interpolant(const std::array<Sh4::Vector, 3>& a) {
    const Sh4::Vector u = a[1] - a[0], v = a[2] - a[0];
    const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), determinant = uu * vv - uv * uv;
    if (determinant > 1e-14 * uu * vv) {
        const double s = (uv * a[0].dot(v) - vv * a[0].dot(u)) / determinant;
        const double t = (uv * a[0].dot(u) - uu * a[0].dot(v)) / determinant;
        if (s >= 0 && t >= 0 && s + t <= 1) return {1 - s - t, s, t};
    }
    Eigen::Vector3d best;
    double shortest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
        const int next = (k + 1) % 3;
        const double norm = (a[k] + a[next]).squaredNorm();
        if (norm < shortest) {
            shortest = norm;
            best = (Eigen::Vector3d::Unit(k) + Eigen::Vector3d::Unit(next)) / 2;
        }
    }
    return best;
}

// All but the quarter turns, which need the curve.
SingularTriangle describe(const TetMesh& mesh, const Quaternions& frames, const TriangleTable& table, Index t,
                          int lift) {
    std::array<Eigen::Vector3d, 3> p;
    std::array<Sh4::Vector, 3> a;
    for (int k = 0; k < 3; ++k) {
        p[k] = mesh.vertices.row(table.triangles(t, k)).transpose();
        a[k] = Sh4::embed(frames::from_wxyz(frames.row(table.triangles(t, k))));
    }
    SingularTriangle s;
    s.a = table.triangles(t, 0), s.b = table.triangles(t, 1), s.c = table.triangles(t, 2);
    s.holonomy = frames::holonomy_of(lift);
    s.quarter_turns = 0;
    s.boundary = table.sides(t, 1) < 0;
    const Eigen::Vector3d weights = shortest_interpolant(a);
    s.point = weights[0] * p[0] + weights[1] * p[1] + weights[2] * p[2];
    return s;
}

// Whether the tet lies on the positive side of the triangle opposite its corner k: there its own outward order is the
// reverse.
bool on_positive_side(const TetMesh& mesh, Eigen::Index tet, int k) {
    const auto id = [&](int i) { return mesh.tets(tet, tet_face[k][i]); };
    return ((id(0) > id(1)) + (id(1) > id(2)) + (id(0) > id(2))) % 2 == 1;
}

// A singular face of a tet and the point its curve goes on to inside the tet.
struct Branch {
    Index singular, point;
    bool positive;  // the tet is on the positive side
};

struct DualGraph {
    std::vector<Branch> branches;              // in the order of the tets
    std::vector<std::array<Index, 2>> joints;  // the segments: two point ids, lower first
};

// Joins the singular triangles of every tet, by a segment or through a node, which is appended to `points` and
// graph.nodes.
DualGraph join_in_tets(const TetMesh& mesh, const TriangleTable& table, const std::vector<Index>& singular_number,
                       SingularGraph& graph, std::vector<Eigen::Vector3d>& points) {
    DualGraph dual;
    for (Eigen::Index tet = 0; tet < table.tet_triangles.rows(); ++tet) {
        std::vector<Branch> faces;
        for (int k = 0; k < 4; ++k)
            if (const Index s = singular_number[table.tet_triangles(tet, k)]; s >= 0)
                faces.push_back({s, -1, on_positive_side(mesh, tet, k)});
        if (faces.empty()) continue;
        if (faces.size() == 2) {
            faces[0].point = faces[1].singular;
            faces[1].point = faces[0].singular;
            dual.joints.push_back(
                {std::min(faces[0].singular, faces[1].singular), std::max(faces[0].singular, faces[1].singular)});
        } else {
            const Index node = static_cast<Index>(points.size());
            Eigen::Vector3d mean = Eigen::Vector3d::Zero();
            for (Branch& face : faces) {
                face.point = node;
                mean += points[face.singular] / static_cast<double>(faces.size());
                dual.joints.push_back({face.singular, node});
            }
            graph.nodes.push_back(node);
            points.push_back(mean);
        }
        dual.branches.insert(dual.branches.end(), faces.begin(), faces.end());
    }
    return dual;
}

// lifts: holonomies of the singular triangles.
void set_quarter_turns(const TetMesh& mesh, const Quaternions& frames, const DualGraph& dual,
                       const std::vector<Eigen::Vector3d>& points, const std::vector<std::uint8_t>& lifts,
                       SingularGraph& graph) {
    // From the point before the triangle to the point after it, along its positive normal: steadier than the normal,
    // which a zigzag of triangles tosses about.
    std::vector<Eigen::Vector3d> along(graph.triangles.size(), Eigen::Vector3d::Zero());
    for (const Branch& b : dual.branches)
        along[b.singular] += (b.positive ? 1 : -1) * (points[b.point] - points[b.singular]);
    for (std::size_t i = 0; i < along.size(); ++i) {
        SingularTriangle& s = graph.triangles[i];
        if (along[i].isZero(0)) {  // the points lie on one edge: only the triangle has a direction
            const Eigen::Vector3d a = mesh.vertices.row(s.a), b = mesh.vertices.row(s.b), c = mesh.vertices.row(s.c);
            along[i] = (b - a).cross(c - a);
        }
        const Turn turn = turn_of(lifts[i], frames::from_wxyz(frames.row(s.a)));
        s.quarter_turns = quarter_turns(turn, along[i]);
        s.undecided |= across(turn, along[i]);
        graph.complex_triangles += s.quarter_turns == 0;
        graph.undecided_triangles += s.undecided;
    }
}

// A segment between triangles of different types goes to the complex one, else to the one that comes first.
std::vector<Segment> typed_segments(const DualGraph& dual, const SingularGraph& graph) {
    std::vector<Segment> segments;
    for (const auto& [first, second] : dual.joints) {
        const bool node = second >= static_cast<Index>(graph.triangles.size());
        const bool complex_second = !node && graph.triangles[second].quarter_turns == 0;
        segments.push_back({{first, second}, complex_second ? 0 : graph.triangles[first].quarter_turns});
    }
    return segments;
}

}  // namespace

SingularGraph singular_graph(const TetDomain& domain, const Quaternions& frames, int threads) {
    const TetMesh& mesh = domain.mesh();
    require_frames(frames, mesh.vertices.rows());
    const TriangleTable& table = domain.triangles();
    const Eigen::Index count = table.triangles.rows();
    std::vector<std::uint8_t> holonomies(count), ties(count), lifts;
    parallel_for(count, threads, [&](std::int64_t t) {
        const auto q = [&](int k) -> Quaternion { return frames::from_wxyz(frames.row(table.triangles(t, k))); };
        const auto [element, tie] = holonomy(q(0), q(1), q(2));
        holonomies[t] = static_cast<std::uint8_t>(element);
        ties[t] = tie;
    });

    SingularGraph graph;
    std::vector<Index> singular_number(count, -1);
    std::vector<Eigen::Vector3d> points;
    for (Eigen::Index t = 0; t < count; ++t) {
        if (holonomies[t] == 0) continue;
        singular_number[t] = static_cast<Index>(graph.triangles.size());
        lifts.push_back(holonomies[t]);
        graph.triangles.push_back(describe(mesh, frames, table, static_cast<Index>(t), holonomies[t]));
        graph.triangles.back().undecided = ties[t] != 0;
        points.push_back(graph.triangles.back().point);
    }
    const DualGraph dual = join_in_tets(mesh, table, singular_number, graph, points);
    set_quarter_turns(mesh, frames, dual, points, lifts, graph);
    const std::vector<Segment> segments = typed_segments(dual, graph);
    CurveSet set = chain_segments(segments, static_cast<Index>(points.size()));
    graph.curves = std::move(set.curves);
    graph.curve_quarter_turns = std::move(set.types);
    for (const Segment& s : segments) graph.length += (points[s.ends[1]] - points[s.ends[0]]).norm();
    graph.points.resize(points.size(), 3);
    for (std::size_t i = 0; i < points.size(); ++i) graph.points.row(i) = points[i].transpose();
    return graph;
}

}  // namespace octafield::volume
