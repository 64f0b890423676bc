#include "octafield/volume/sample_frames.hpp"

#include <vtkCellArray.h>
#include <vtkGenericCell.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStaticCellLocator.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "octafield/error.hpp"
#include "octafield/frames/octahedral_group.hpp"
#include "octafield/frames/sh4_projection.hpp"
#include "octafield/parallel.hpp"
#include "octafield/volume/locate_points.hpp"
#include "octafield/volume/triangle_table.hpp"
#include "require_frames.hpp"

namespace octafield::volume {
namespace {

using Eigen::Vector3d;
using frames::Sh4;

constexpr double default_tolerance = 1e-6;  // of the bounding-box diagonal
constexpr std::int64_t together = 256;      // points projected in one batch
constexpr double infinity = std::numeric_limits<double>::infinity();

// The triangles with a tet on one side only.
class Boundary {
public:
    explicit Boundary(const TetDomain& domain) : mesh_(domain.mesh()) {
        const TetMesh& mesh = domain.mesh();
        const TriangleTable& table = domain.triangles();
        vtkNew<vtkPoints> points;
        points->SetDataTypeToDouble();
        points->SetNumberOfPoints(mesh.vertices.rows());
        for (Eigen::Index i = 0; i < mesh.vertices.rows(); ++i)
            points->SetPoint(i, mesh.vertices(i, 0), mesh.vertices(i, 1), mesh.vertices(i, 2));
        vtkNew<vtkCellArray> cells;
        for (Eigen::Index t = 0; t < table.triangles.rows(); ++t) {
            if (table.sides(t, 1) >= 0) continue;
            const vtkIdType ids[3] = {table.triangles(t, 0), table.triangles(t, 1), table.triangles(t, 2)};
            cells->InsertNextCell(3, ids);
            tets_.push_back(table.sides(t, 0) / 4);
        }
        data_->SetPoints(points);
        data_->SetPolys(cells);
        locator_->SetDataSet(data_);
        locator_->BuildLocator();
    }

    // Where the mesh is nearest to a point outside, if no farther than `most`: its tet, weights there and the distance.
    bool nearest(const Vector3d& point, double most, Index& tet, Eigen::Vector4d& weights, double& distance) const {
        vtkNew<vtkGenericCell> cell;
        vtkIdType found = -1;
        int part = 0, inside = 0;
        double squared = 0;
        Vector3d at;
        if (std::isfinite(most)) {
            // A radius of 0 finds nothing, nor does one that rounding makes too small.
            const double radius = most * (1 + 1e-12) + std::numeric_limits<double>::min();
            if (!locator_->FindClosestPointWithinRadius(const_cast<double*>(point.data()), radius, at.data(), cell,
                                                        found, part, squared, inside))
                return false;
        } else {
            locator_->FindClosestPoint(point.data(), at.data(), cell, found, part, squared);
        }
        distance = (at - point).norm();
        if (found < 0 || distance > most) return false;
        tet = tets_[found];
        const auto corner = [&](int k) -> Vector3d { return mesh_.vertices.row(mesh_.tets(tet, k)).transpose(); };
        Eigen::Matrix3d edges;
        for (int k = 0; k < 3; ++k) edges.col(k) = corner(k + 1) - corner(0);
        const Vector3d rest = edges.inverse() * (at - corner(0));
        weights = Eigen::Vector4d(1 - rest.sum(), rest[0], rest[1], rest[2]).cwiseMax(0);
        weights /= weights.sum();
        return true;
    }

private:
    const TetMesh& mesh_;
    std::vector<Index> tets_;
    vtkNew<vtkPolyData> data_;
    vtkNew<vtkStaticCellLocator> locator_;
};

// Moves points outside to the mesh where the tolerance lets them.
void bring_to_mesh(const TetDomain& domain, const Points& points, double tolerance, int threads, LocatedPoints& located,
                   std::vector<double>& distance) {
    std::vector<Index> outside;
    for (std::size_t i = 0; i < located.tet.size(); ++i)
        if (located.tet[i] < 0) outside.push_back(static_cast<Index>(i));
    if (outside.empty() || domain.tet_count() == 0) return;
    const Boundary boundary(domain);
    parallel_for(static_cast<std::int64_t>(outside.size()), threads, [&](std::int64_t k) {
        const Index i = outside[k];
        Eigen::Vector4d weights;
        if (boundary.nearest(points.row(i).transpose(), tolerance, located.tet[i], weights, distance[i]))
            located.weights.row(i) = weights.transpose();
        else
            located.tet[i] = -1, distance[i] = infinity;
    });
}

}  // namespace

InterpolatedFrames interpolate_frames(const TetDomain& domain, const Quaternions& frames, const LocatedPoints& at,
                                      int threads) {
    const TetMesh& mesh = domain.mesh();
    const auto count = static_cast<std::int64_t>(at.tet.size());
    InterpolatedFrames result{Quaternions::Constant(count, 4, std::numeric_limits<double>::quiet_NaN()),
                              std::vector<double>(count, 0)};
    parallel_for((count + together - 1) / together, threads,
                 [&](std::int64_t block) {
                     std::vector<std::int64_t> inside;
                     for (std::int64_t i = block * together; i < std::min((block + 1) * together, count); ++i)
                         if (at.tet[i] >= 0) inside.push_back(i);
                     const auto rows = static_cast<Eigen::Index>(inside.size());
                     Rows<double, Sh4::dimension> wanted = Rows<double, Sh4::dimension>::Zero(rows, Sh4::dimension);
                     Quaternions guess(rows, 4), nearest(rows, 4);
                     Eigen::VectorXd distances(rows);
                     for (Eigen::Index k = 0; k < rows; ++k) {
                         const auto weights = at.weights.row(inside[k]);
                         const auto corners = mesh.tets.row(at.tet[inside[k]]);
                         Eigen::Index largest;
                         weights.maxCoeff(&largest);
                         guess.row(k) = frames.row(corners[largest]);
                         for (int c = 0; c < 4; ++c)
                             if (weights[c] > 0)
                                 wanted.row(k) +=
                                     weights[c] * Sh4::embed(frames::from_wxyz(frames.row(corners[c]))).transpose();
                         result.confidence[inside[k]] = wanted.row(k).norm();
                     }
                     frames::sh4_project(wanted.data(), guess.data(), rows, nearest.data(), distances.data());
                     for (Eigen::Index k = 0; k < rows; ++k)
                         result.frames.row(inside[k]) =
                             frames::to_wxyz(frames::closest_representative(frames::from_wxyz(nearest.row(k)),
                                                                            frames::from_wxyz(guess.row(k))))
                                 .transpose();
                 },
                 1);
    return result;
}

SampledFrames sample_frames(const TetDomain& domain, const Quaternions& frames, const Points& points,
                            const SampleOptions& options) {
    require_frames(frames, domain.vertex_count());
    if (std::isnan(options.tolerance)) throw InvalidInput("tolerance is not a number", "option_out_of_range");
    const double tolerance = options.tolerance >= 0
                                 ? options.tolerance
                                 : default_tolerance * surface::bounding_box_diagonal(domain.mesh().vertices);
    LocatedPoints located = locate_points(domain, points, options.threads);
    std::vector<double> distance(points.rows(), 0);
    bring_to_mesh(domain, points, tolerance, options.threads, located, distance);
    for (std::size_t i = 0; i < distance.size(); ++i)
        if (located.tet[i] < 0) distance[i] = infinity;
    InterpolatedFrames found = interpolate_frames(domain, frames, located, options.threads);
    return {std::move(found.frames), std::move(found.confidence), std::move(located.tet), std::move(distance)};
}

}  // namespace octafield::volume
