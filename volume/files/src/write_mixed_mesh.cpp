#include "octafield/volume/write_mixed_mesh.hpp"

#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <array>

#include "vtk_writer.hpp"

namespace octafield::volume {
namespace {

using namespace detail;

// The arrays one after the other, each told to visit(rows, VTK's type).
template <class Visit>
void for_each_array(const MixedMesh& mesh, const Visit& visit) {
    visit(mesh.tets, VTK_TETRA);
    visit(mesh.hexahedra, VTK_HEXAHEDRON);
    visit(mesh.wedges, VTK_WEDGE);
    visit(mesh.pyramids, VTK_PYRAMID);
}

template <class Visit>
void for_each_array(const surface::QuadMesh& mesh, const Visit& visit) {
    visit(mesh.triangles, VTK_TRIANGLE);
    visit(mesh.quads, VTK_QUAD);
}

// visit(VTK's type, number of ids, ids) for each cell.
template <class Mesh, class Visit>
void for_each_cell(const Mesh& mesh, const Visit& visit) {
    for_each_array(mesh, [&](const auto& rows, int type) {
        for (Eigen::Index i = 0; i < rows.rows(); ++i) {
            std::array<vtkIdType, 8> ids{};
            for (Eigen::Index k = 0; k < rows.cols(); ++k) ids[k] = rows(i, k);
            visit(type, static_cast<vtkIdType>(rows.cols()), ids.data());
        }
    });
}

template <class Mesh>
void write_grid(const std::filesystem::path& path, const Mesh& mesh, const Metadata& metadata) {
    const Eigen::VectorXd quality = scaled_jacobians(mesh);  // refuses ids out of range
    vtkNew<vtkUnstructuredGrid> grid;
    grid->SetPoints(to_points(mesh.vertices));
    grid->Allocate(quality.size());
    for_each_cell(mesh,
                  [&](int type, vtkIdType count, const vtkIdType* ids) { grid->InsertNextCell(type, count, ids); });
    add_array<vtkDoubleArray>(grid->GetCellData(), "scaled_jacobian", 1, quality.size(),
                              [&](Eigen::Index i) { return std::array<double, 1>{quality[i]}; });
    add_metadata(grid, metadata);
    write_xml<vtkXMLUnstructuredGridWriter>(path, grid.Get());
}

}  // namespace

void write_mixed_mesh(const std::filesystem::path& path, const MixedMesh& mesh, const Metadata& metadata) {
    write_grid(path, mesh, metadata);
}

void write_quad_mesh(const std::filesystem::path& path, const surface::QuadMesh& mesh, const Metadata& metadata) {
    write_grid(path, mesh, metadata);
}

}  // namespace octafield::volume
