#include "octafield/volume/write_vtk.hpp"

#include <gtest/gtest.h>
#include <unistd.h>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <fstream>

#include "octafield/error.hpp"
#include "octafield/frames/sh4.hpp"
#include "tet_fixtures.hpp"

namespace octafield::volume {
namespace {

namespace fs = std::filesystem;
using frames::Vector3;

class WriteVtk : public ::testing::Test {
protected:
    void SetUp() override {
        folder = fs::temp_directory_path() / ("octafield-write-vtk-" + std::to_string(getpid()));
        fs::create_directories(folder);
    }
    void TearDown() override { fs::remove_all(folder); }
    int files() const {
        return static_cast<int>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
    }
    fs::path folder;
};

template <class Reader>
vtkNew<Reader> read_back(const fs::path& path) {
    vtkNew<Reader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    return reader;
}

std::string text(vtkDataObject* data, const char* name) {
    const auto array = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray(name));
    return array ? std::string(array->GetValue(0)) : "missing";
}

TEST_F(WriteVtk, FieldsComeBackWithTheSameBits) {
    const TetMesh mesh = testing::kuhn_cube(3);
    const Quaternions field = frames::random_rotations(mesh.vertices.rows(), 4);
    write_field(folder / "field.vtu", mesh, field, {{"representation", "sh4"}, {"note", "a < b & \"c\""}});
    EXPECT_EQ(files(), 1);  // no temporary file stays

    const auto reader = read_back<vtkXMLUnstructuredGridReader>(folder / "field.vtu");
    vtkUnstructuredGrid* grid = reader->GetOutput();
    ASSERT_EQ(grid->GetNumberOfPoints(), mesh.vertices.rows());
    ASSERT_EQ(grid->GetNumberOfCells(), mesh.tets.rows());
    vtkPointData* data = grid->GetPointData();
    const auto value = [&](const char* name, vtkIdType i, int c) { return data->GetArray(name)->GetComponent(i, c); };
    for (vtkIdType v = 0; v < grid->GetNumberOfPoints(); ++v) {
        EXPECT_EQ(Vector3(grid->GetPoint(v)), Vector3(mesh.vertices.row(v)));
        for (int c = 0; c < 4; ++c) EXPECT_EQ(value("quaternion", v, c), field(v, c));
        const Eigen::Matrix3d axes = frames::from_wxyz(field.row(v)).toRotationMatrix();
        for (int c = 0; c < 3; ++c) {
            EXPECT_EQ(value("frame_u", v, c), axes(c, 0));
            EXPECT_EQ(value("frame_v", v, c), axes(c, 1));
            EXPECT_EQ(value("frame_w", v, c), axes(c, 2));
        }
        const auto a = frames::Sh4::embed(frames::from_wxyz(field.row(v)));
        for (int c = 0; c < 9; ++c) EXPECT_EQ(value("sh4", v, c), a[c]);
        const bool outside = mesh.vertices.row(v).minCoeff() == 0 || mesh.vertices.row(v).maxCoeff() == 1;
        EXPECT_EQ(value("boundary", v, 0), outside);
    }
    for (vtkIdType t = 0; t < grid->GetNumberOfCells(); ++t) {
        EXPECT_EQ(grid->GetCellType(t), VTK_TETRA);
        for (int k = 0; k < 4; ++k) EXPECT_EQ(grid->GetCell(t)->GetPointId(k), mesh.tets(t, k));
    }
    EXPECT_STREQ(data->GetArray("quaternion")->GetComponentName(0), "w");
    EXPECT_STREQ(data->GetArray("sh4")->GetComponentName(0), "-4");
    EXPECT_STREQ(data->GetArray("sh4")->GetComponentName(8), "4");
    const auto bytes = [&](const char* name) {
        vtkDataArray* array = grid->GetFieldData()->GetArray(name);
        std::string text;
        for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
            text += static_cast<char>(array->GetTuple1(i));
        return text;
    };
    EXPECT_EQ(bytes("representation"), "sh4");
    EXPECT_EQ(bytes("note"), "a < b & \"c\"");
}

TEST_F(WriteVtk, FramesInTetsAndLengthsAreDataOfTheirOwn) {
    const TetMesh mesh = testing::kuhn_cube(2);
    const Quaternions field = frames::random_rotations(mesh.vertices.rows(), 4);
    const FieldArrays more{.tet_frames = frames::random_rotations(mesh.tets.rows(), 5),
                           .lengths = Points::Random(mesh.vertices.rows(), 3),
                           .tet_lengths = Points::Random(mesh.tets.rows(), 3)};
    write_field(folder / "field.vtu", mesh, field, {}, more);
    const auto reader = read_back<vtkXMLUnstructuredGridReader>(folder / "field.vtu");
    vtkCellData* cells = reader->GetOutput()->GetCellData();
    vtkDataArray* lengths = reader->GetOutput()->GetPointData()->GetArray("frame_lengths");
    for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t) {
        const Eigen::Matrix3d axes = frames::from_wxyz(more.tet_frames.row(t)).toRotationMatrix();
        for (int c = 0; c < 4; ++c) EXPECT_EQ(cells->GetArray("quaternion")->GetComponent(t, c), more.tet_frames(t, c));
        for (int c = 0; c < 3; ++c) {
            EXPECT_EQ(cells->GetArray("frame_v")->GetComponent(t, c), axes(c, 1));
            EXPECT_EQ(cells->GetArray("frame_lengths")->GetComponent(t, c), more.tet_lengths(t, c));
        }
    }
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
        for (int c = 0; c < 3; ++c) EXPECT_EQ(lengths->GetComponent(v, c), more.lengths(v, c));
    EXPECT_THROW(write_field(folder / "a.vtu", mesh, field, {}, {.tet_frames = field}), InvalidInput);
    EXPECT_THROW(write_field(folder / "a.vtu", mesh, field, {}, {.lengths = Points::Ones(2, 3)}), InvalidInput);
}

TEST_F(WriteVtk, OtherArraysComeBackAndFitTheMesh) {
    const TetMesh mesh = testing::kuhn_cube(2);
    const Quaternions field = frames::random_rotations(mesh.vertices.rows(), 4);
    FieldArrays more;
    more.point_data["one"] = Rows<double, Eigen::Dynamic>::Random(mesh.vertices.rows(), 1);
    more.cell_data["nine"] = Rows<double, Eigen::Dynamic>::Random(mesh.tets.rows(), 9);
    write_field(folder / "field.vtu", mesh, field, {}, more);
    const auto reader = read_back<vtkXMLUnstructuredGridReader>(folder / "field.vtu");
    vtkDataArray* one = reader->GetOutput()->GetPointData()->GetArray("one");
    vtkDataArray* nine = reader->GetOutput()->GetCellData()->GetArray("nine");
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) EXPECT_EQ(one->GetTuple1(v), more.point_data["one"](v, 0));
    for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t)
        for (int c = 0; c < 9; ++c) EXPECT_EQ(nine->GetComponent(t, c), more.cell_data["nine"](t, c));
    FieldArrays few, taken;
    few.point_data["one"] = more.cell_data["nine"];
    taken.point_data["boundary"] = more.point_data["one"];
    EXPECT_THROW(write_field(folder / "a.vtu", mesh, field, {}, few), InvalidInput);
    EXPECT_THROW(write_field(folder / "a.vtu", mesh, field, {}, taken), InvalidInput);
}

TEST_F(WriteVtk, SingularGraphsComeBack) {
    const TetMesh mesh = testing::kuhn_cube(3);
    const SingularGraph graph = singular_graph(mesh, frames::random_rotations(mesh.vertices.rows(), 4));
    ASSERT_FALSE(graph.nodes.empty());
    write_singular_graph(folder / "singular.vtp", graph, {{"version", "1"}});
    const auto reader = read_back<vtkXMLPolyDataReader>(folder / "singular.vtp");
    vtkPolyData* data = reader->GetOutput();
    const vtkIdType nodes = static_cast<vtkIdType>(graph.nodes.size());
    ASSERT_EQ(data->GetNumberOfVerts(), nodes);
    ASSERT_EQ(data->GetNumberOfLines(), static_cast<vtkIdType>(graph.curves.size()));
    vtkCellData* cells = data->GetCellData();
    for (std::size_t i = 0; i < graph.curves.size(); ++i) {
        vtkCell* cell = data->GetCell(nodes + static_cast<vtkIdType>(i));
        ASSERT_EQ(cell->GetNumberOfPoints(), static_cast<vtkIdType>(graph.curves[i].size()));
        for (std::size_t k = 0; k < graph.curves[i].size(); ++k)
            EXPECT_EQ(cell->GetPointId(static_cast<int>(k)), graph.curves[i][k]);
        EXPECT_EQ(cells->GetArray("quarter_turns")->GetTuple1(nodes + i), graph.curve_quarter_turns[i]);
        EXPECT_EQ(cells->GetArray("index")->GetTuple1(nodes + i), graph.curve_quarter_turns[i] / 4.0);
        EXPECT_EQ(cells->GetArray("curve")->GetTuple1(nodes + i), static_cast<double>(i));
    }
    for (vtkIdType i = 0; i < nodes; ++i) {
        EXPECT_EQ(data->GetCell(i)->GetPointId(0), graph.nodes[i]);
        EXPECT_EQ(data->GetPointData()->GetArray("node")->GetTuple1(graph.nodes[i]), 1);
        EXPECT_EQ(cells->GetArray("curve")->GetTuple1(i), -1);
    }
    EXPECT_EQ(text(data, "version"), "1");
}

TEST_F(WriteVtk, AnEmptyGraphIsAFileWithoutCells) {
    write_singular_graph(folder / "empty.vtp", {});
    const auto reader = read_back<vtkXMLPolyDataReader>(folder / "empty.vtp");
    EXPECT_EQ(reader->GetOutput()->GetNumberOfCells(), 0);
}

TEST_F(WriteVtk, SurfaceFieldsAndTheirSingularitiesComeBack) {
    const BoundarySurface boundary = boundary_surface(testing::kuhn_cube(2));
    const Points directions = Points::Random(boundary.mesh.vertices.rows(), 3);
    write_surface_field(folder / "surface.vtp", boundary.mesh, directions);
    const auto reader = read_back<vtkXMLPolyDataReader>(folder / "surface.vtp");
    ASSERT_EQ(reader->GetOutput()->GetNumberOfPolys(), boundary.mesh.triangles.rows());
    for (Eigen::Index v = 0; v < directions.rows(); ++v)
        for (int c = 0; c < 3; ++c)
            EXPECT_EQ(reader->GetOutput()->GetPointData()->GetArray("direction")->GetComponent(v, c), directions(v, c));

    surface::SurfaceSingularity s{};
    s.position = {1, 2, 3};
    s.index = -0.25;
    write_surface_singularities(folder / "points.vtp", {s});
    const auto points = read_back<vtkXMLPolyDataReader>(folder / "points.vtp");
    ASSERT_EQ(points->GetOutput()->GetNumberOfVerts(), 1);
    EXPECT_EQ(Vector3(points->GetOutput()->GetPoint(0)), s.position);
    EXPECT_EQ(points->GetOutput()->GetPointData()->GetArray("index")->GetTuple1(0), -0.25);
    EXPECT_THROW(write_surface_field(folder / "bad.vtp", boundary.mesh, directions.topRows(2)), InvalidInput);
}

TEST_F(WriteVtk, ReplacesAnExistingFile) {
    const fs::path path = folder / "singular.vtp";
    std::ofstream(path) << "something else";
    write_singular_graph(path, {});
    EXPECT_EQ(read_back<vtkXMLPolyDataReader>(path)->GetErrorCode(), 0u);
    EXPECT_EQ(files(), 1);
}

TEST_F(WriteVtk, UnwritableTargetsAreIoErrorsThatNameTheFileAndPrintNothing) {
    ::testing::internal::CaptureStderr();
    const fs::path missing = folder / "no" / "such" / "singular.vtp";
    try {
        write_singular_graph(missing, {});
        ADD_FAILURE() << "no error";
    } catch (const IoError& error) {
        EXPECT_NE(std::string(error.what()).find(missing.string()), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("No such file"), std::string::npos);
    }
    fs::create_directories(folder / "directory.vtp" / "inside");
    EXPECT_THROW(write_singular_graph(folder / "directory.vtp", {}), IoError);  // cannot rename onto a directory
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(files(), 1);
}

TEST_F(WriteVtk, AFullDiskIsAnIoError) {
    if (!fs::exists("/dev/full")) GTEST_SKIP() << "/dev/full is absent";
    // The temporary file is made beside the target; a link of its name is the one way to fill it without a disk. Names
    // hold the process id and a counter, so a range of them is linked.
    for (int i = 0; i < 64; ++i)
        fs::create_symlink("/dev/full",
                           folder / ("full.vtp.part" + std::to_string(getpid()) + "-" + std::to_string(i)));
    ::testing::internal::CaptureStderr();
    EXPECT_THROW(write_singular_graph(folder / "full.vtp", {}), IoError);
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
    EXPECT_FALSE(fs::exists(folder / "full.vtp"));
}

TEST(WriteSingularGraph, FollowsSymbolicLinksAndRefusesWhatIsNoFile) {
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("octafield_links" + std::to_string(getpid()));
    std::filesystem::create_directories(folder / "taken.vtp");
    std::filesystem::create_symlink(folder / "target.vtp", folder / "link.vtp");
    SingularGraph graph;
    graph.points = Points::Zero(0, 3);
    EXPECT_THROW(write_singular_graph(folder / "taken.vtp", graph), IoError);
    write_singular_graph(folder / "link.vtp", graph);
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.vtp"));
    EXPECT_TRUE(std::filesystem::is_regular_file(folder / "target.vtp"));
    std::filesystem::remove_all(folder);
}

TEST(WriteSingularGraph, RefusesAGraphThatDoesNotHangTogether) {
    const std::filesystem::path path = std::filesystem::temp_directory_path() / "octafield_bad_graph.vtp";
    SingularGraph graph;
    graph.points = Points::Zero(2, 3);
    graph.curves = {{0, 1}};
    EXPECT_THROW(write_singular_graph(path, graph), InvalidInput);  // no type for the curve
    graph.curve_quarter_turns = {1};
    graph.nodes = {2};
    EXPECT_THROW(write_singular_graph(path, graph), InvalidInput);  // no such point
    EXPECT_FALSE(std::filesystem::exists(path));
}

}  // namespace
}  // namespace octafield::volume
