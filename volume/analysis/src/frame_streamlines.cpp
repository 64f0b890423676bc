#include <cmath>
#include <string>

#include "frame_tracer.hpp"
#include "octafield/error.hpp"
#include "octafield/parallel.hpp"
#include "octafield/volume/locate_points.hpp"
#include "octafield/volume/streamlines.hpp"
#include "require_frames.hpp"

namespace octafield::volume {
namespace {

void require_seeds(const TetMesh& mesh, const std::vector<FrameStreamlineSeed>& seeds) {
    std::vector<Index> outside, without;
    for (std::size_t i = 0; i < seeds.size(); ++i) {
        const FrameStreamlineSeed& s = seeds[i];
        const bool weights = s.weights.allFinite() && s.weights.minCoeff() >= 0 && std::abs(s.weights.sum() - 1) < 1e-6;
        if (s.tet < 0 || s.tet >= mesh.tets.rows() || !weights) outside.push_back(static_cast<Index>(i));
        if (!s.direction.allFinite() || s.direction.isZero(0)) without.push_back(static_cast<Index>(i));
    }
    if (!outside.empty())
        throw InvalidInput("seeds " + first_few(outside) +
                               " are not in the mesh; give tet ids and barycentric weights of sum 1, none below 0",
                           "outside", outside);
    if (!without.empty())
        throw InvalidInput("seeds " + first_few(without) + " have no direction; give a finite vector that is not 0",
                           "no_direction", without);
}

void require_length(double value, const char* name) {
    if (!(std::isfinite(value) && value >= 0))
        throw InvalidInput(std::string(name) + " must be a length, or 0 for its default", "option_out_of_range");
}

}  // namespace

std::vector<FrameStreamline> frame_streamlines(const TetDomain& domain, const Quaternions& frames,
                                               const std::vector<FrameStreamlineSeed>& seeds,
                                               const FrameStreamlineOptions& options, int threads,
                                               const Stretches& stretch) {
    const TetMesh& mesh = domain.mesh();
    require_frames(frames, mesh.vertices.rows());
    const Stretches* stretched = stretch_or_none(stretch, domain.vertex_count());
    require_seeds(mesh, seeds);
    require_length(options.max_length, "max_length");
    require_length(options.closing_distance, "closing_distance");
    std::vector<FrameStreamline> lines(seeds.size());
    if (seeds.empty()) return lines;
    FrameStreamlineOptions used = options;
    if (used.max_length == 0) used.max_length = 4 * surface::shape_size(domain.boundary().mesh);
    const FrameTracer tracer(mesh, VertexAxes(frames, stretched), domain.triangles(), used);
    parallel_for(
        static_cast<std::int64_t>(seeds.size()), threads, [&](std::int64_t i) { lines[i] = tracer.trace(seeds[i]); },
        1);
    return lines;
}

std::vector<FrameStreamlineSeed> seeds_at(const TetDomain& domain, const Points& points, const Points& directions) {
    if (points.rows() != directions.rows())
        throw InvalidInput("there are " + std::to_string(points.rows()) + " points and " +
                               std::to_string(directions.rows()) + " directions; give one per point",
                           "wrong_size");
    const LocatedPoints located = locate_points(domain, points);
    std::vector<Index> outside;
    std::vector<FrameStreamlineSeed> seeds;
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
        if (located.tet[i] < 0) outside.push_back(static_cast<Index>(i));
        seeds.push_back({located.tet[i], directions.row(i).transpose(), located.weights.row(i).transpose()});
    }
    if (!outside.empty())
        throw InvalidInput("points " + first_few(outside) + " are outside the mesh; give points in its tets", "outside",
                           outside);
    return seeds;
}

std::vector<FrameStreamlineSeed> axis_seeds_at(const TetDomain& domain, const Quaternions& frames, const Points& points,
                                               const Stretches& stretch) {
    const TetMesh& mesh = domain.mesh();
    require_frames(frames, mesh.vertices.rows());
    const VertexAxes axes(frames, stretch_or_none(stretch, domain.vertex_count()));
    std::vector<FrameStreamlineSeed> result;
    for (const FrameStreamlineSeed& seed : seeds_at(domain, points, Points::Zero(points.rows(), 3))) {
        Eigen::Index nearest;
        seed.weights.maxCoeff(&nearest);
        for (int axis = 0; axis < 3; ++axis) {
            result.push_back(seed);
            result.back().direction = axes.direction(mesh.tets(seed.tet, nearest), axis);
        }
    }
    return result;
}

}  // namespace octafield::volume
