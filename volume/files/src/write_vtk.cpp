#include "octafield/volume/write_vtk.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkIntArray.h>
#include <vtkPointData.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <array>

#include "octafield/frames/sh4.hpp"
#include "octafield/volume/combing.hpp"
#include "octafield/volume/smoothed_curves.hpp"
#include "require_frames.hpp"
#include "vtk_writer.hpp"

namespace octafield::volume {
namespace {

using namespace detail;

namespace fs = std::filesystem;

template <class T>
std::array<T, 1> one(T value) {
    return {value};
}

constexpr const char* axis_names[3] = {"frame_u", "frame_v", "frame_w"};

void add_quaternions(vtkFieldData* data, const char* name, const Quaternions& rows) {
    const auto array = add_array<vtkDoubleArray>(
        data, name, 4, rows.rows(), [&](Eigen::Index i) -> frames::Vector4 { return rows.row(i).transpose(); });
    constexpr const char* wxyz[4] = {"w", "x", "y", "z"};
    for (int c = 0; c < 4; ++c) array->SetComponentName(c, wxyz[c]);
}

void add_frames(vtkFieldData* data, const Quaternions& rows) {
    using frames::Sh4;
    const auto q = [&](Eigen::Index i) -> frames::Quaternion { return frames::from_wxyz(rows.row(i)); };
    for (int k = 0; k < 3; ++k)
        add_array<vtkDoubleArray>(data, axis_names[k], 3, rows.rows(),
                                  [&](Eigen::Index i) -> Eigen::Vector3d { return q(i).toRotationMatrix().col(k); });
    add_quaternions(data, "quaternion", rows);
    const auto sh4 = add_array<vtkDoubleArray>(data, "sh4", Sh4::dimension, rows.rows(),
                                               [&](Eigen::Index i) { return Sh4::embed(q(i)); });
    for (int m = -4; m <= 4; ++m) sh4->SetComponentName(m + 4, std::to_string(m).c_str());
}

void add_stretched_frames(vtkFieldData* data, const Quaternions& rows, const Stretches& stretch) {
    const Rows<double, 9> axes = stretched_axes(rows, stretch);
    const auto axis = [&](Eigen::Index i, int k) -> Eigen::Vector3d {
        return axes.row(i).segment<3>(3 * k).transpose();
    };
    for (int k = 0; k < 3; ++k)
        add_array<vtkDoubleArray>(data, axis_names[k], 3, rows.rows(),
                                  [&](Eigen::Index i) -> Eigen::Vector3d { return axis(i, k).normalized(); });
    add_array<vtkDoubleArray>(data, "frame_lengths", 3, rows.rows(), [&](Eigen::Index i) {
        return Eigen::Vector3d(axis(i, 0).norm(), axis(i, 1).norm(), axis(i, 2).norm());
    });
    const auto array = add_array<vtkDoubleArray>(data, "stretch", 6, stretch.rows(), [&](Eigen::Index i) {
        return Eigen::Matrix<double, 6, 1>(stretch.row(i).transpose());
    });
    constexpr const char* names[6] = {"xx", "yy", "zz", "yz", "xz", "xy"};
    for (int c = 0; c < 6; ++c) array->SetComponentName(c, names[c]);
    add_quaternions(data, "rotation", rows);
}

void require_lengths(const Points& lengths, Eigen::Index count, const char* per) {
    if (lengths.rows() > 0 && lengths.rows() != count)
        throw InvalidInput("lengths has " + std::to_string(lengths.rows()) + " rows; give one per " + per + ", " +
                               std::to_string(count) + ", or none",
                           "wrong_size");
}

void add_lengths(vtkFieldData* data, const Points& lengths) {
    if (lengths.rows() == 0) return;
    add_array<vtkDoubleArray>(data, "frame_lengths", 3, lengths.rows(),
                              [&](Eigen::Index i) -> Eigen::Vector3d { return lengths.row(i).transpose(); });
}

void add_named(vtkFieldData* data, const std::map<std::string, Rows<double, Eigen::Dynamic>>& arrays,
               Eigen::Index count, const char* per) {
    for (const auto& [name, rows] : arrays) {
        if (rows.rows() != count)
            throw InvalidInput(name + " has " + std::to_string(rows.rows()) + " rows; give one per " + per + ", " +
                                   std::to_string(count),
                               "wrong_size");
        if (data->HasArray(name.c_str()))
            throw InvalidInput(name + " is an array of the field itself; choose another name", "name_taken");
        add_array<vtkDoubleArray>(data, name.c_str(), static_cast<int>(rows.cols()), count,
                                  [&](Eigen::Index i) { return rows.row(i); });
    }
}

template <class Table>
vtkNew<vtkCellArray> to_cells(const Table& table) {
    vtkNew<vtkCellArray> cells;
    cells->AllocateExact(table.rows(), table.size());
    for (Eigen::Index i = 0; i < table.rows(); ++i) {
        cells->InsertNextCell(static_cast<int>(table.cols()));
        for (Eigen::Index k = 0; k < table.cols(); ++k) cells->InsertCellPoint(table(i, k));
    }
    return cells;
}

vtkNew<vtkCellArray> vertex_cells(const std::vector<Index>& points) {
    return to_cells(Eigen::Map<const Eigen::Matrix<Index, Eigen::Dynamic, 1>>(
        points.data(), static_cast<Eigen::Index>(points.size())));
}

void require_graph(const SingularGraph& graph) {
    if (graph.curve_quarter_turns.size() != graph.curves.size())
        throw InvalidInput("curve_quarter_turns has " + std::to_string(graph.curve_quarter_turns.size()) +
                               " entries for " + std::to_string(graph.curves.size()) + " curves; give one per curve",
                           "wrong_size");
    const auto require_point = [&](Index p) {
        if (p < 0 || p >= graph.points.rows())
            throw InvalidInput(
                "the singular graph uses point " + std::to_string(p) + " of " + std::to_string(graph.points.rows()),
                "index_out_of_range", {p});
    };
    for (const auto& curve : graph.curves) std::for_each(curve.begin(), curve.end(), require_point);
    std::for_each(graph.nodes.begin(), graph.nodes.end(), require_point);
}

void add_meshability(vtkPointData* data, const Meshability& meshability, Eigen::Index point_count) {
    std::vector<int> meshable(point_count, -1), junction(point_count, -1);
    for (const SingularVertex& v : meshability.vertices) {
        if (v.point < 0 || v.point >= point_count)
            throw InvalidInput("the meshability refers to point " + std::to_string(v.point) + " of " +
                                   std::to_string(point_count) + "; give that of this graph",
                               "index_out_of_range", {v.point});
        meshable[v.point] = v.meshable;
        junction[v.point] = v.junction;
    }
    add_array<vtkIntArray>(data, "meshable", 1, point_count, [&](Eigen::Index i) { return one(meshable[i]); });
    add_array<vtkIntArray>(data, "junction", 1, point_count, [&](Eigen::Index i) { return one(junction[i]); });
}

}  // namespace

void write_field(const fs::path& path, const TetDomain& domain, const Quaternions& frames, const Metadata& metadata,
                 const FieldArrays& more) {
    const TetMesh& mesh = domain.mesh();
    const std::vector<Index>& regions = domain.regions();
    require_frames(frames, mesh.vertices.rows());
    if (more.tet_frames.rows() > 0) require_frames(more.tet_frames, mesh.tets.rows());
    require_lengths(more.lengths, mesh.vertices.rows(), "vertex");
    require_lengths(more.tet_lengths, mesh.tets.rows(), "tet");
    const bool stretched = more.stretch.rows() > 0;
    if (stretched && (more.lengths.rows() > 0 || more.tet_frames.rows() > 0))
        throw InvalidInput(
            "stretch is of frames at the vertices, whose lengths follow from it; leave out lengths and tet_frames",
            "stretched_axes");
    std::vector<std::uint8_t> on_boundary(mesh.vertices.rows(), 0);
    for (const Index v : domain.boundary().vertex_map) on_boundary[v] = 1;

    vtkNew<vtkUnstructuredGrid> grid;
    grid->SetPoints(to_points(mesh.vertices));
    grid->SetCells(VTK_TETRA, to_cells(mesh.tets));
    if (stretched)
        add_stretched_frames(grid->GetPointData(), frames, more.stretch);
    else
        add_frames(grid->GetPointData(), frames);
    add_array<vtkUnsignedCharArray>(grid->GetPointData(), "boundary", 1, mesh.vertices.rows(),
                                    [&](Eigen::Index i) { return one(on_boundary[i]); });
    add_lengths(grid->GetPointData(), more.lengths);
    add_lengths(grid->GetCellData(), more.tet_lengths);
    if (more.tet_frames.rows() > 0) add_frames(grid->GetCellData(), more.tet_frames);
    if (!regions.empty())
        add_array<vtkIntArray>(grid->GetCellData(), "region", 1, mesh.tets.rows(),
                               [&](Eigen::Index i) { return one(regions[i]); });
    const std::vector<std::uint8_t> agree = axes_agree(domain, frames);
    add_array<vtkUnsignedCharArray>(grid->GetCellData(), "axes_agree", 1, mesh.tets.rows(),
                                    [&](Eigen::Index i) { return one(agree[i]); });
    add_named(grid->GetPointData(), more.point_data, mesh.vertices.rows(), "vertex");
    add_named(grid->GetCellData(), more.cell_data, mesh.tets.rows(), "tet");
    for (Eigen::Index e = 0; e < more.features.rows(); ++e)
        if (more.features.row(e).minCoeff() < 0 || more.features.row(e).maxCoeff() >= mesh.vertices.rows())
            throw InvalidInput("feature edge " + std::to_string(e) + " names a vertex that the mesh does not have",
                               "index_out_of_range", {static_cast<Index>(e)});
    if (more.features.rows() > 0)  // not as cells: those are the tets
        add_array<vtkIntArray>(grid->GetFieldData(), "feature_edges", 2, more.features.rows(),
                               [&](Eigen::Index i) { return more.features.row(i); });
    add_metadata(grid, metadata);
    write_xml<vtkXMLUnstructuredGridWriter>(path, grid.Get());
}

void write_singular_graph(const fs::path& path, const SingularGraph& graph, const Metadata& metadata,
                          const Meshability* meshability) {
    require_graph(graph);
    vtkNew<vtkPolyData> data;
    data->SetPoints(to_points(graph.points));
    data->SetVerts(vertex_cells(graph.nodes));
    vtkNew<vtkCellArray> lines;
    for (const auto& curve : graph.curves) {
        lines->InsertNextCell(static_cast<int>(curve.size()));
        for (const Index p : curve) lines->InsertCellPoint(p);
    }
    data->SetLines(lines);

    const Eigen::Index nodes = static_cast<Eigen::Index>(graph.nodes.size());
    const Eigen::Index cells = nodes + static_cast<Eigen::Index>(graph.curves.size());
    const auto turns = [&](Eigen::Index i) { return i < nodes ? 0 : graph.curve_quarter_turns[i - nodes]; };
    add_array<vtkIntArray>(data->GetCellData(), "quarter_turns", 1, cells,
                           [&](Eigen::Index i) { return one(turns(i)); });
    add_array<vtkDoubleArray>(data->GetCellData(), "index", 1, cells,
                              [&](Eigen::Index i) { return one(turns(i) / 4.0); });
    add_array<vtkIntArray>(data->GetCellData(), "curve", 1, cells,
                           [&](Eigen::Index i) { return one(i < nodes ? -1 : i - nodes); });
    std::vector<std::uint8_t> is_node(graph.points.rows(), 0);
    for (const Index p : graph.nodes) is_node[p] = 1;
    add_array<vtkUnsignedCharArray>(data->GetPointData(), "node", 1, graph.points.rows(),
                                    [&](Eigen::Index i) { return one(is_node[i]); });
    const Points smoothed = smoothed_curves(graph).points;
    add_array<vtkDoubleArray>(data->GetPointData(), "smoothed", 3, smoothed.rows(),
                              [&](Eigen::Index i) -> Eigen::Vector3d { return smoothed.row(i).transpose(); });
    if (meshability) add_meshability(data->GetPointData(), *meshability, graph.points.rows());
    add_metadata(data, metadata);
    write_xml<vtkXMLPolyDataWriter>(path, data.Get());
}

void write_surface_field(const fs::path& path, const surface::TriangleMesh& mesh, const Points& directions,
                         const Metadata& metadata) {
    if (directions.rows() != mesh.vertices.rows())
        throw InvalidInput("directions has " + std::to_string(directions.rows()) + " rows; give one per vertex, " +
                               std::to_string(mesh.vertices.rows()),
                           "wrong_size");
    vtkNew<vtkPolyData> data;
    data->SetPoints(to_points(mesh.vertices));
    data->SetPolys(to_cells(mesh.triangles));
    add_array<vtkDoubleArray>(data->GetPointData(), "direction", 3, directions.rows(),
                              [&](Eigen::Index i) -> Eigen::Vector3d { return directions.row(i).transpose(); });
    add_metadata(data, metadata);
    write_xml<vtkXMLPolyDataWriter>(path, data.Get());
}

void write_surface_singularities(const fs::path& path, const std::vector<surface::SurfaceSingularity>& singularities,
                                 const Metadata& metadata) {
    const Eigen::Index count = static_cast<Eigen::Index>(singularities.size());
    Points points(count, 3);
    std::vector<Index> ids(count);
    for (Eigen::Index i = 0; i < count; ++i) {
        points.row(i) = singularities[i].position.transpose();
        ids[i] = static_cast<Index>(i);
    }
    vtkNew<vtkPolyData> data;
    data->SetPoints(to_points(points));
    data->SetVerts(vertex_cells(ids));
    add_array<vtkDoubleArray>(data->GetPointData(), "index", 1, count,
                              [&](Eigen::Index i) { return one(singularities[i].index); });
    add_metadata(data, metadata);
    write_xml<vtkXMLPolyDataWriter>(path, data.Get());
}

}  // namespace octafield::volume
