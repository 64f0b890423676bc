// Reading what others wrote, refusing what is broken, and writing what can be read back.
#include "octafield/surface/read_write.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <clocale>
#include <cstring>
#include <fstream>
#include <limits>

#include "mesh_fixtures.hpp"
#include "octafield/error.hpp"

namespace octafield::surface {
namespace {

using namespace testing;
namespace fs = std::filesystem;

class ReadWrite : public ::testing::Test {
protected:
    void SetUp() override {
        const std::string name = ::testing::UnitTest::GetInstance()->current_test_info()->name();
        folder_ = fs::path(::testing::TempDir()) / ("octafield_read_write_" + name);
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    fs::path file(const std::string& name, const std::string& bytes) const {
        std::ofstream(folder_ / name, std::ios::binary) << bytes;
        return folder_ / name;
    }
    TriangleMesh read(const std::string& name, const std::string& bytes) const {
        return read_surface(file(name, bytes));
    }

    // The message with which reading fails; must be an IoError naming the file.
    std::string refusal(const std::string& name, const std::string& bytes) const {
        try {
            read(name, bytes);
        } catch (const IoError& error) {
            EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
            return error.what();
        }
        ADD_FAILURE() << name << " was read although it is broken";
        return {};
    }

    fs::path folder_;
};

std::string raw(const auto&... values) {
    std::string bytes;
    (bytes.append(reinterpret_cast<const char*>(&values), sizeof values), ...);
    return bytes;
}

std::string binary_stl(std::uint32_t announced, int present, const std::string& comment = "made by a test") {
    std::string bytes = comment;
    bytes.resize(80, ' ');
    bytes += raw(announced);
    for (int t = 0; t < present; ++t) {
        const float values[12] = {0, 0, 1, 0, 0, static_cast<float>(t), 1, 0, 0, 0, 1, 0};
        bytes += raw(values, std::uint16_t{0});
    }
    return bytes;
}

const std::string kFacet =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";

TEST_F(ReadWrite, TextFormatsBringEveryDoubleBack) {
    TriangleMesh mesh = icosphere(2, 1e-6);
    mesh.vertices.row(0) << 1.0 / 3, -0.1, 1e300;
    for (const char* name : {"a.obj", "a.off", "a.ply", "a.obj.gz", "a.OFF.GZ", "a.ply.gz"}) {
        write_surface(mesh, folder_ / name);
        const TriangleMesh back = read_surface(folder_ / name);
        EXPECT_EQ(back.vertices, mesh.vertices) << name;
        EXPECT_EQ(back.triangles, mesh.triangles) << name;
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 6) << "temporary files were left behind";
}

TEST_F(ReadWrite, StlBringsTheSurfaceBackInSinglePrecision) {
    const TriangleMesh mesh = cube_surface(3);
    for (const char* name : {"a.stl", "a.STL.gz"}) {
        write_surface(mesh, folder_ / name);
        const TriangleMesh back = read_surface(folder_ / name);
        EXPECT_EQ(back.vertices.rows(), mesh.vertices.rows()) << name;
        EXPECT_EQ(euler_characteristic(back), 2);
        EXPECT_NEAR(signed_volume(back), 1, 1e-6);
    }
}

TEST_F(ReadWrite, WritingTheSameMeshGivesTheSameBytes) {
    const auto bytes = [&](const std::string& name) {
        write_surface(icosphere(1), folder_ / name);
        std::ifstream in(folder_ / name, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(in), {});
    };
    for (const std::string extension : {".stl", ".obj.gz", ".ply"})
        EXPECT_EQ(bytes("a" + extension), bytes("b" + extension)) << extension;
}

TEST_F(ReadWrite, StlMergesBitEqualPointsOnly) {
    const std::string other =
        "facet normal 0 0 0\nouter loop\nvertex 1 -0.0 0\nvertex -0 0 0\nvertex 0 -1 1e-30\nendloop\nendfacet\n";
    const std::string third =
        "facet normal nan nan nan\nouter loop\nvertex 1.0000001 0 0\nvertex 0 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
    const TriangleMesh mesh = read(
        "a.stl", "solid some name facet\n" + kFacet + other + "endsolid some name\nsolid b\n" + third + "endsolid\n");
    EXPECT_EQ(mesh.triangles.rows(), 3);
    EXPECT_EQ(mesh.vertices.rows(), 5);
}

TEST_F(ReadWrite, ABinaryStlMayBeginWithSolid) {
    EXPECT_EQ(read("a.stl", binary_stl(3, 3, "solid made by a program")).triangles.rows(), 3);
    EXPECT_NE(refusal("b.stl", binary_stl(3, 2, "solid made by a program") + std::string(10, '\0')).find("announces 3"),
              std::string::npos);
}

TEST_F(ReadWrite, OtherFormatsKeepPointsApart) {
    EXPECT_EQ(read("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 0\nf 1 2 3\nf 4 3 2\n").vertices.rows(), 4);
}

TEST_F(ReadWrite, ObjOfManyDialects) {
    const TriangleMesh mesh = read("a.obj",
                                   "\xEF\xBB\xBF# a comment\r\nmtllib a.mtl\r\no thing\r\nv 0 0 0 1.0\r\nv +1 0 0 0.5 "
                                   "0.5 0.5\r\nvt 0 0\r\nvn 0 0 1\r\n"
                                   "f 1//1 2//1 3/1/1 4/1\r\ng group\r\ns off\r\nusemtl x\r\nv 1 1e0 0\r\nv 0 1 .0 # "
                                   "the last\r\nl 1 2\r\nf -4 -3 \\\r\n -2\r\n");
    ASSERT_EQ(mesh.vertices.rows(), 4);
    Triangles expected(3, 3);
    expected << 0, 1, 2, 0, 2, 3, 0, 1, 2;
    EXPECT_EQ(mesh.triangles, expected);
}

TEST_F(ReadWrite, OffOfManyDialects) {
    const std::string body = "0 0 0\n1 0 0 # comment\n\n1 1 0\n0 1 0\n4 0 1 2 3 255 0 0\n";
    for (const std::string head : {"OFF\n4 1 0\n", "OFF 4 1 0\n", "# c\nOFF\n# c\n4 1\n", "4 1 0\n", "COFF\n4 1 0\n"}) {
        const TriangleMesh mesh = read("a.off", head + body);
        EXPECT_EQ(mesh.vertices.rows(), 4) << head;
        EXPECT_EQ(mesh.triangles.rows(), 2) << head;
    }
}

TEST_F(ReadWrite, PlyInAsciiWithOtherElements) {
    const TriangleMesh mesh = read(
        "a.ply",
        "ply\nformat ascii 1.0\ncomment c\nelement material 1\nproperty list uchar float values\nelement vertex 4\n"
        "property uchar red\nproperty float y\nproperty float x\nproperty double z\nelement face 2\nproperty uchar "
        "flag\n"
        "property list uchar uint vertex_index\nend_header\n2 0.5 0.5\n255 0 0 0\n255 0 1 0\n255 1 1 0\n255 1 0 "
        "0.25\n7 4 0 1 2 3\n7 3 0 1 3\n");
    ASSERT_EQ(mesh.vertices.rows(), 4);
    EXPECT_EQ(mesh.triangles.rows(), 3);
    EXPECT_EQ(mesh.vertices.row(3), Eigen::RowVector3d(0, 1, 0.25));
}

TEST_F(ReadWrite, PlyInBothByteOrders) {
    const std::string header =
        "\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar "
        "short vertex_indices\nend_header\n";
    const float xyz[9] = {0, 0, 0, 2, 0, 0, 0, 3, 0};
    const std::int16_t ids[3] = {0, 1, 2};
    std::string little, big;
    const auto add = [&](std::string bytes) {
        little += bytes;
        std::reverse(bytes.begin(), bytes.end());
        big += bytes;
    };
    for (const float value : xyz) add(raw(value));
    add(raw(std::uint8_t{3}));
    for (const std::int16_t id : ids) add(raw(id));
    const TriangleMesh a = read("a.ply", "ply\nformat binary_little_endian 1.0" + header + little);
    const TriangleMesh b = read("b.ply", "ply\nformat binary_big_endian 1.0" + header + big);
    EXPECT_EQ(a.vertices, b.vertices);
    EXPECT_EQ(a.triangles, b.triangles);
    EXPECT_EQ(triangle_areas(a)[0], 3);
    for (std::size_t cut = 1; cut < little.size(); ++cut)
        refusal("cut.ply", "ply\nformat binary_little_endian 1.0" + header + little.substr(0, little.size() - cut));
}

TEST_F(ReadWrite, RefusesWhatIsNoReadableFile) {
    EXPECT_THROW(read_surface(folder_ / "missing.stl"), IoError);
    fs::create_directory(folder_ / "folder.stl");
    EXPECT_THROW(read_surface(folder_ / "folder.stl"), IoError);
    EXPECT_THROW(read_surface(file("mesh.step", "ISO-10303")), IoError);
    EXPECT_THROW(read_surface(file("mesh", "OFF")), IoError);
    for (const char* name : {"a.stl", "a.obj", "a.off", "a.ply", "a.stl.gz"})
        EXPECT_NE(refusal(name, "").find("empty"), std::string::npos);
}

TEST_F(ReadWrite, RefusesBinaryJunkInEveryFormat) {
    std::string junk;
    for (unsigned i = 0, x = 1; i < 4096; ++i) junk += static_cast<char>((x = x * 1664525 + 1013904223) >> 24);
    for (const char* name : {"a.stl", "a.obj", "a.off", "a.ply"}) refusal(name, junk);
    refusal("b.stl", "\x1f\x8b" + junk);
}

TEST_F(ReadWrite, RefusesATruncatedGzip) {
    write_surface(icosphere(2), folder_ / "whole.obj.gz");
    std::ifstream in(folder_ / "whole.obj.gz", std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(in), {});
    refusal("half.obj.gz", bytes.substr(0, bytes.size() / 2));
    refusal("nearly.obj.gz", bytes.substr(0, bytes.size() - 3));
}

TEST_F(ReadWrite, RefusesTruncatedOrWrongStl) {
    EXPECT_NE(refusal("a.stl", binary_stl(1000, 10)).find("announces 1000 triangles, but the file has room for 10"),
              std::string::npos);
    refusal("b.stl", binary_stl(4294967295u, 10));
    refusal("c.stl", binary_stl(5, 10));
    refusal("d.stl", binary_stl(0, 0));
    refusal("e.stl", binary_stl(2, 2).substr(0, 50));
    refusal("f.stl", "solid a\n" + kFacet);
    refusal("g.stl", "solid a\n" + kFacet.substr(0, 60));
    refusal("h.stl", "solid a\nendsolid a\n");
    EXPECT_NE(refusal("i.stl", "solid a\n" + kFacet + "facet normal 0 0 1\nouter loop\nvertex 0 x 0\n").find("line 11"),
              std::string::npos);
}

TEST_F(ReadWrite, RefusesCoordinatesThatAreNotFinite) {
    std::string stl = binary_stl(1, 1);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    std::memcpy(stl.data() + 84 + 12, &nan, 4);
    EXPECT_NE(refusal("a.stl", stl).find("not finite"), std::string::npos);
    EXPECT_NE(refusal("a.obj", "v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n").find("line 2"), std::string::npos);
    EXPECT_NE(refusal("b.obj", "v 0 0 0\nv 1 1e999 0\nv 0 1 0\nf 1 2 3\n").find("not finite"), std::string::npos);
    refusal("a.off", "OFF\n3 1 0\n0 0 inf\n1 0 0\n0 1 0\n3 0 1 2\n");
    EXPECT_EQ(read("tiny.obj", "v 0 0 1e-999\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").vertices(0, 2), 0);
}

TEST_F(ReadWrite, NumbersOutOfRangeDoNotFollowTheLocale) {
    // Locales with a decimal comma, where there are any: the last one installed, else "C".
    for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "de_DE"}) std::setlocale(LC_ALL, name);
    const double value = read("tiny.obj", "v 0 0 1.5e-999\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").vertices(0, 2);
    const double least = read("least.obj", "v 0 0 5.5e-324\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").vertices(0, 2);
    const std::string huge = refusal("huge.obj", "v 0 0 1.5e999\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    std::setlocale(LC_ALL, "C");
    EXPECT_EQ(value, 0);
    EXPECT_EQ(least, std::numeric_limits<double>::denorm_min());
    EXPECT_NE(huge.find("not finite"), std::string::npos);
}

TEST_F(ReadWrite, RefusesIndicesOutOfRangeAndNamesTheLine) {
    const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    EXPECT_NE(refusal("a.obj", points + "f 1 2 3\nf 1 2 4\n").find("line 5"), std::string::npos);
    refusal("b.obj", points + "f 0 1 2\n");
    refusal("c.obj", points + "f -4 1 2\n");
    refusal("d.obj", points + "f 1 2 99999999999999999999\n");
    EXPECT_NE(refusal("least.obj", points + "f 1 2 -9223372036854775808\n").find("counts back"), std::string::npos);
    refusal("e.obj", points + "f 1 2\n");
    refusal("f.obj", points + "f a b c\n");
    refusal("g.obj", points);
    refusal("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n");
    refusal("b.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n");
    refusal("c.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4 0 1 2\n");
    refusal("d.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
}

TEST_F(ReadWrite, RefusesHugeAnnouncedCountsBeforeAllocating) {
    EXPECT_NE(refusal("a.off", "OFF\n4000000000000000000 1 0\n0 0 0\n").find("announces"), std::string::npos);
    refusal("b.off", "OFF\n-1 1 0\n0 0 0\n");
    const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
    refusal("a.ply", "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\n" + xyz + "end_header\n0000");
    refusal("b.ply", "ply\nformat ascii 1.0\nelement vertex 9000000000000000000\n" + xyz + "end_header\n0 0 0\n");
    refusal("c.ply",
            "ply\nformat ascii 1.0\nelement vertex 1\n" + xyz +
                "element face 1\nproperty list uint int vertex_indices\nend_header\n0 0 0\n4000000000 0 0 0\n");
    refusal("d.ply", "ply\nformat ascii 1.0\nelement nothing 9000000000000000000\nend_header\n0\n");
    refusal("e.ply",
            "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n-3 0 0 0\n");
    refusal("f.ply", "ply\nelement vertex 1\n" + xyz + "end_header\n0 0 0\n");
}

TEST_F(ReadWrite, RefusesEveryTruncationOfATextFile) {
    const std::string off = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
    for (std::size_t size = 1; size + 2 < off.size(); ++size) refusal("a.off", off.substr(0, size));
}

TEST_F(ReadWrite, WritingNeverLeavesHalfAFile) {
    EXPECT_THROW(write_surface(icosphere(1), folder_ / "missing" / "a.stl"), IoError);
    EXPECT_THROW(write_surface(icosphere(1), folder_ / "a.vtp"), IoError);
    fs::create_directory(folder_ / "folder.obj");
    EXPECT_THROW(write_surface(icosphere(1), folder_ / "folder.obj"), IoError);
    EXPECT_THROW(write_surface(icosphere(1, 1e39), folder_ / "large.stl"), IoError) << "does not fit single precision";
    TriangleMesh wrong = icosphere(1);
    wrong.triangles(3, 1) = 1000;
    EXPECT_THROW(write_surface(wrong, folder_ / "a.stl"), InvalidInput);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

TEST(SharedSurfaces, EveryFormatOfAFileGivesTheSameSurface) {
    const fs::path folder = fs::path(OCTAFIELD_SHARED_DATA) / "surfaces";
    if (!fs::exists(folder)) GTEST_SKIP() << "no data in " << folder;
    for (const std::string name : {"s01", "s04", "s15", "s16", "s17", "i10"}) {
        const TriangleMesh obj = read_surface(folder / (name + "_surface.obj"));
        for (const std::string extension : {"_surface.stl", "_surface_binary.stl.gz"}) {
            const TriangleMesh stl = read_surface(folder / (name + extension));
            EXPECT_EQ(stl.vertices.rows(), obj.vertices.rows()) << name << extension;
            EXPECT_EQ(stl.triangles.rows(), obj.triangles.rows()) << name << extension;
            EXPECT_NEAR(signed_volume(stl), signed_volume(obj), 1e-6 * signed_volume(obj)) << name << extension;
        }
    }
}

}  // namespace
}  // namespace octafield::surface
