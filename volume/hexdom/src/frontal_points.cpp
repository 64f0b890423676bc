#include "frontal_points.hpp"

#include <numeric>

#include "curve_points.hpp"
#include "octafield/surface/triangle_mesh.hpp"
#include "point_front.hpp"

namespace octafield::volume {
namespace {

std::vector<Index> numbers_from(Index first, Index last) {
    std::vector<Index> result(last - first);
    std::iota(result.begin(), result.end(), first);
    return result;
}

// Of each part of the surface without a point, the middle of the triangle where the frames agree best.
std::vector<FrontPlace> first_points(const SurfaceWalker& walker, const FrontField& field, const PointFront& front,
                                     Index triangles) {
    const std::vector<Index> part = walker.parts();
    std::vector<std::uint8_t> has_point(triangles, 0);  // by part
    for (const FrontPlace& place : front.places())
        for (const Index t : walker.round(place)) has_point[part[t]] = 1;
    std::vector<FrontPlace> middles;
    std::vector<Index> of_part;
    for (Index t = 0; t < triangles; ++t)
        if (!has_point[part[t]]) {
            middles.push_back(walker.place(t, frames::Vector3::Constant(1.0 / 3)));
            of_part.push_back(part[t]);
        }
    const std::vector<LocalAxes> axes = field.at(middles);
    std::vector<Index> best(triangles, -1);
    for (Index i = 0; i < static_cast<Index>(middles.size()); ++i)
        if (Index& most = best[of_part[i]]; most < 0 || axes[i].confidence > axes[most].confidence) most = i;
    std::vector<FrontPlace> result;
    for (const Index i : best)
        if (i >= 0) result.push_back(middles[i]);
    return result;
}

LatticeCells without_cells(const std::vector<FrontPlace>& places, const FrontField& field) {
    LatticeCells result;
    const auto count = static_cast<Eigen::Index>(places.size());
    result.points.resize(count, 3);
    result.weights.resize(count, 4);
    result.hexahedra.resize(0, 8);
    result.apart = true;
    for (Eigen::Index p = 0; p < count; ++p) {
        result.points.row(p) = field.position(places[p]).transpose();
        result.weights.row(p) = places[p].weights.transpose();
        result.tet.push_back(places[p].tet);
    }
    return result;
}

}  // namespace

LatticeCells frontal_points(const TetDomain& domain, const Quaternions& frames, const TetAxes& of_tets, int threads,
                            const Progress& progress) {
    const FrontField field(domain, frames, of_tets, threads);
    const Edges curves = surface_curves(domain);
    const SurfaceWalker over_surface(domain, curves);
    PointFront front(field, threads, [&] { report_or_throw(progress, "front", 0, 0); });
    front.add(curve_points(domain, curves, over_surface, field));
    front.add(first_points(over_surface, field, front, static_cast<Index>(domain.surface().mesh.triangles.rows())));
    const Index of_curves = front.count();
    front.advance(over_surface, numbers_from(0, of_curves));
    front.relax(over_surface, of_curves);
    const Index on_surface = front.count();
    const TetWalker inside(domain);
    front.advance(inside, numbers_from(0, on_surface));
    front.relax(inside, on_surface);
    return without_cells(front.places(), field);
}

}  // namespace octafield::volume
