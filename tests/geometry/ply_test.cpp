#include "geometry/ply.h"

#include "core/files.h"
#include "core/log.h"
#include "core/random.h"
#include "geometry/triangulate.h"
#include "tests/geometry/ply_bytes.h"
#include "tests/geometry/shapes.h"
#include "tests/support/corruption.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"
#include "tests/support/warnings.h"

#include <gtest/gtest.h>

#include <future>
#include <limits>

namespace daumier::geometry {
namespace {

using testing::ExpectError;
using testing::kPlyFormats;
using testing::PlyBytes;

void ExpectSameMesh(const PolygonMesh& mesh, const PolygonMesh& expected) {
  EXPECT_EQ(mesh.vertices, expected.vertices);
  EXPECT_EQ(mesh.offsets, expected.offsets);
  EXPECT_EQ(mesh.corners, expected.corners);
  EXPECT_EQ(mesh.uv, expected.uv);
  EXPECT_EQ(mesh.uv_corners, expected.uv_corners);
}

const std::string kVertices = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kPoints = "0 0 0\n1 0 0\n1 1 0\n0 1 0.5\n";

/// An ASCII file of four vertices with these further lines of the header and of the data.
std::string Ascii(const std::string& header, const std::string& rows) {
  return "ply\nformat ascii 1.0\n" + kVertices + header + "end_header\n" + kPoints + rows;
}
const std::string kFace = "element face 1\nproperty list uchar int vertex_indices\n";

/// A mesh whose numbers are 32-bit floats: polygons of 3 to 5 corners, and a seam of UV at vertex 1.
PolygonMesh MixedPolygons() {
  PolygonMesh mesh{.vertices = (Points::Random(6, 3).array() * 1024).round() / 256,
                   .offsets = {0, 3, 7, 12},
                   .corners = {0, 1, 2, 1, 3, 4, 2, 0, 2, 4, 5, 1}};
  mesh.uv = (TextureCoordinates::Random(7, 2).array() * 1024).round() / 256;
  mesh.uv_corners = {0, 1, 2, 3, 4, 5, 2, 0, 2, 5, 6, 1};
  return mesh;
}

TEST(Ply, WriteThenReadKeepsPolygonsAndUv) {
  const testing::TempDir folder;
  PolygonMesh mesh = MixedPolygons();
  WritePly(folder / "mixed.ply", mesh);
  ExpectSameMesh(ReadPly(folder / "mixed.ply"), mesh);
  mesh.uv.resize(0, 2);
  mesh.uv_corners.clear();
  WritePly(folder / "plain.ply", mesh);
  ExpectSameMesh(ReadPly(folder / "plain.ply"), mesh);
}

TEST(Ply, WriteThenReadKeepsTheMesh) {
  const testing::TempDir folder;
  const TriangleMesh mesh = testing::Torus(2, 1, 7, 5);
  WritePly(folder / "torus.ply", mesh);
  const PolygonMesh read = ReadPly(folder / "torus.ply");
  EXPECT_LT((read.vertices - mesh.vertices).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_EQ(read.corners, std::vector<int>(mesh.triangles.data(), mesh.triangles.data() + mesh.triangles.size()));
}

TEST(Ply, WritesPolygonsOfMoreCornersThanAByteCounts) {
  const testing::TempDir folder;
  PolygonMesh mesh{.vertices = Points::Zero(300, 3), .offsets = {0, 300}};
  for (int k = 0; k < 300; ++k) mesh.corners.push_back(k);
  mesh.uv = TextureCoordinates::Zero(300, 2);
  mesh.uv_corners = mesh.corners;
  WritePly(folder / "many.ply", mesh);
  ExpectSameMesh(ReadPly(folder / "many.ply"), mesh);
}

TEST(Ply, ReadsTheBytesOfASmallFile) {
  // One triangle, with the last position and texture coordinate 1.
  const testing::TempDir folder;
  TriangleMesh mesh{Points::Zero(3, 3), (Triangles(1, 3) << 0, 1, 2).finished(), TextureCoordinates::Zero(3, 2),
                    (Triangles(1, 3) << 0, 1, 2).finished()};
  mesh.vertices(2, 2) = mesh.uv(2, 1) = 1;
  WritePly(folder / "one.ply", mesh);
  const std::string bytes = ReadFile(folder / "one.ply"), one("\0\0\x80\x3f", 4);
  const std::string data = bytes.substr(bytes.find("end_header\n") + 11);
  EXPECT_EQ(data, std::string(32, '\0') + one + std::string("\3\0\0\0\0\1\0\0\0\2\0\0\0\6", 14) +
                      std::string(20, '\0') + one);
}

/// A triangle and a quad with the types and in the order of properties that are the least like those that WritePly
/// writes, in any format: extra scalars and lists before, between and behind, an unknown element first.
template <class Scalar, class Count, class Index>
std::string Unusual(PlyFormat format, const std::string& scalar, const std::string& count, const std::string& index) {
  PlyBytes file(format,
                fmt::format("element camera 2\nproperty list {1} {0} k\nelement empty 3\nelement vertex 4\n"
                            "property uchar red\nproperty {0} z\nproperty {0} x\nproperty list uchar short rings\n"
                            "property {0} y\nelement face 2\nproperty ushort group\n"
                            "property list {1} {2} vertex_index\nproperty list int double weights\n"
                            "element edge 1\nproperty int a\n",
                            scalar, count, index));
  file.Add(Count(1)).Add(Scalar(9)).Add(Count(0));
  for (const auto& [x, y, z] : {std::array{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {9, 10, 11}}) {
    file.Add(uint8_t(200))
        .Add(Scalar(z))
        .Add(Scalar(x))
        .Add(uint8_t(2))
        .Add(int16_t(-1))
        .Add(int16_t(1))
        .Add(Scalar(y));
  }
  file.Add(uint16_t(7)).Add(Count(3)).Add(Index(0)).Add(Index(1)).Add(Index(2)).Add(int32_t(1)).Add(0.25);
  file.Add(uint16_t(8)).Add(Count(4)).Add(Index(0)).Add(Index(2)).Add(Index(3)).Add(Index(1)).Add(int32_t(0));
  file.Add(int32_t(5));
  return file.bytes();
}

TEST(Ply, ReadsEveryFormatTypeAndOrderOfProperties) {
  PolygonMesh expected{.vertices = Points(4, 3), .offsets = {0, 3, 7}, .corners = {0, 1, 2, 0, 2, 3, 1}};
  expected.vertices << 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11;
  for (const PlyFormat format : kPlyFormats) {
    ExpectSameMesh(ParsePly(Unusual<float, uint8_t, int32_t>(format, "float", "uchar", "int"), "text"), expected);
    ExpectSameMesh(ParsePly(Unusual<double, int32_t, uint32_t>(format, "float64", "int32", "uint32"), "text"),
                   expected);
    ExpectSameMesh(ParsePly(Unusual<int16_t, uint16_t, uint8_t>(format, "int16", "ushort", "uint8"), "text"), expected);
    ExpectSameMesh(ParsePly(Unusual<int8_t, int8_t, int16_t>(format, "char", "char", "short"), "text"), expected);
    ExpectSameMesh(ParsePly(Unusual<int32_t, float, double>(format, "int", "float", "double"), "text"), expected);
  }
}

TEST(Ply, KeepsDoublePositionsExactly) {
  for (const PlyFormat format : kPlyFormats) {
    PlyBytes file(format, "element vertex 3\nproperty double x\nproperty double y\nproperty double z\n" + kFace);
    for (int k = 0; k < 9; ++k) file.Add(1.0 / (k + 3));
    file.Add(uint8_t(3)).Add(0).Add(1).Add(2);
    EXPECT_EQ(ParsePly(file.bytes(), "text").vertices(2, 1), 1.0 / 10);
  }
}

TEST(Ply, ReadsUvOfVerticesUnderTheirUsualNames) {
  for (const auto& [u, v] : {std::pair("s", "t"), {"u", "v"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}}) {
    for (const PlyFormat format : kPlyFormats) {
      PlyBytes file(format, fmt::format("element vertex 3\nproperty float {}\nproperty float x\nproperty float y\n"
                                        "property float z\nproperty double {}\n{}",
                                        u, v, kFace));
      for (int k = 0; k < 3; ++k) file.Add(0.5f * k).Add(0.f).Add(0.f).Add(0.f).Add(0.25 * k);
      file.Add(uint8_t(3)).Add(2).Add(0).Add(1);
      const PolygonMesh mesh = ParsePly(file.bytes(), "text");
      EXPECT_EQ(mesh.uv, (TextureCoordinates(3, 2) << 0, 0, 0.5, 0.25, 1, 0.5).finished()) << u;
      EXPECT_EQ(mesh.uv_corners, (std::vector<int>{2, 0, 1})) << u;
    }
  }
}

TEST(Ply, ReadsUvOfCornersAndMakesEqualOnesAtAVertexOneRow) {
  const std::string header =
      "element face 2\nproperty list uchar int vertex_indices\nproperty list uchar float texcoord\n"
      "property int texnumber\n";
  const PolygonMesh mesh = ParsePly(Ascii(header, "3 0 1 2 6 0 0 1 0 1 1 5\n3 0 2 3 6 -0 0 .5 .5 0 0 5\n"), "text");
  EXPECT_EQ(mesh.uv_corners, (std::vector<int>{0, 1, 2, 0, 3, 4}))
      << "a seam at vertex 2; vertices 0 and 3 share no row";
  EXPECT_EQ(mesh.uv, (TextureCoordinates(5, 2) << 0, 0, 1, 0, 1, 1, 0.5, 0.5, 0, 0).finished());
}

TEST(Ply, DropsUvThatSomeFacesLackWithAWarning) {
  testing::AllowWarnings();
  const std::string header =
      "element face 2\nproperty list uchar float texcoord\nproperty list uchar int vertex_indices\n";
  for (const char* rows : {"6 0 0 1 0 1 1 3 0 1 2\n0 3 0 2 3\n", "6 0 0 1 0 1 1 3 0 1 2\n6 0 0 1 nan 1 1 3 0 2 3\n"}) {
    const int num_warnings = log::NumWarnings();
    const PolygonMesh mesh = ParsePly(Ascii(header, rows), "text");
    EXPECT_FALSE(mesh.has_uv());
    EXPECT_EQ(mesh.num_polygons(), 2);
    EXPECT_EQ(log::NumWarnings(), num_warnings + 1);
  }
  const int num_warnings = log::NumWarnings();
  EXPECT_FALSE(ParsePly(Ascii(header, "0 3 0 1 2\n0 3 0 2 3\n"), "text").has_uv());
  EXPECT_EQ(log::NumWarnings(), num_warnings);
}

TEST(Ply, AcceptsWhatIsNoManifold) {
  const PolygonMesh fin = ParsePly(
      Ascii("element face 4\nproperty list uchar int vertex_indices\n", "3 0 1 2\n3 0 1 3\n3 1 0 2\n3 0 1 2\n"),
      "text");
  EXPECT_EQ(fin.num_polygons(), 4);
}

TEST(Ply, KeepsARepeatedVertexOnceWithAWarning) {
  testing::AllowWarnings();
  const int num_warnings = log::NumWarnings();
  const PolygonMesh mesh = ParsePly(
      Ascii("element face 3\nproperty list uchar int vertex_indices\n", "4 0 1 1 2\n3 0 0 3\n2 0 1\n"), "text");
  EXPECT_EQ(mesh.corners, (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(log::NumWarnings(), num_warnings + 1);
}

TEST(Ply, StripsAlternateTheirWinding) {
  const PolygonMesh mesh =
      ParsePly(Ascii("element tristrips 1\nproperty list int int vertex_indices\n", "8 0 1 3 2 -1 0 1 2\n"), "text");
  EXPECT_EQ(mesh.corners, (std::vector<int>{0, 1, 3, 3, 1, 2, 0, 1, 2}));
  EXPECT_EQ(
      ParsePly(Ascii("element tristrips 1\nproperty list int int vertex_indices\n", "5 0 1 1 2 3\n"), "text").corners,
      (std::vector<int>{1, 2, 3}))
      << "a repeated vertex turns the strip";
}

TEST(Ply, RefusesWhatIsWrongAndSaysWhatItFound) {
  const auto refuses = [](const std::string& bytes, const std::string& part) {
    ExpectError([&] { ParsePly(bytes, "a.ply"); }, "a.ply: ");
    ExpectError([&] { ParsePly(bytes, "a.ply"); }, part);
  };
  refuses("hello\n", "not a PLY file");
  refuses(Ascii("", ""), "has points, but no faces: a cloud of points (found 4 vertices and no faces, expected faces)");
  refuses(Ascii("element face 0\nproperty list uchar int vertex_indices\n", ""), "a cloud of points");
  refuses(Ascii(kFace, "3 0 1 4\n"),
          "row 1 of element face: a corner is out of range (found 4, expected a whole number from 0 to 3)");
  refuses(Ascii(kFace, "3 0 1 -1\n"), "found -1");
  refuses(Ascii(kFace, "3 0 1 1.5\n"), "found 1.5");
  refuses(Ascii(kFace, "-3 0 1 2\n"), "found a list of -3 numbers");
  refuses(Ascii(kFace, "3 0 1\n"), "truncated PLY file");
  refuses(Ascii(kFace, "2 0 1\n"), "no polygon is left (found 1 with fewer than three distinct corners");
  refuses(Ascii("element face 1\nproperty int vertex_indices\n", "3\n"), "element face has no list vertex_indices");
  refuses(Ascii("element face 1\nproperty list uchar float texcoord\nproperty list uchar int vertex_index\n",
                "5 0 0 1 0 1 3 0 1 2\n"),
          "texcoord does not fit its corners (found 5 numbers, expected 6)");
  refuses("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n" + kFace +
              "end_header\n0 0\n3 0 0 0\n",
          "have no number z");
  refuses("ply\nformat ascii 1.0\n" + kFace + "end_header\n3 0 0 0\n", "found 0 vertices");
  refuses("ply\nformat ascii 1.0\nelement vertex 3000000000\nproperty float x\n" + kFace + "end_header\n",
          "found 3000000000 vertices");
  refuses(
      "ply\nformat binary_little_endian 1.0\nelement vertex 2000000000\nproperty float x\n" + kFace + "end_header\n",
      "truncated PLY file (found 0 bytes for element vertex, expected 2000000000 rows");
}

TEST(Ply, VerticesThatAreNotFiniteKeepTheNumbersOfTheOthers) {
  testing::AllowWarnings();
  for (const char* place : {"nan", "-nan", "1.#QNAN", "inf", "1e999"}) {
    const std::string header = "element face 2\nproperty list uchar int vertex_indices\n";
    std::string bytes = Ascii(header, "3 0 1 2\n3 0 2 3\n");
    bytes.replace(bytes.find("0.5"), 3, place);
    const int num_warnings = log::NumWarnings();
    const PolygonMesh mesh = ParsePly(bytes, "text");
    EXPECT_EQ(log::NumWarnings(), num_warnings + 1) << place;
    EXPECT_EQ(mesh.vertices.rows(), 4) << place;
    EXPECT_EQ(mesh.corners, (std::vector<int>{0, 1, 2})) << place;
  }
  for (const PlyFormat format : kPlyFormats) {
    PlyBytes file(format, kVertices + kFace);
    for (int k = 0; k < 11; ++k) file.Add(float(k * k));
    file.Add(std::numeric_limits<float>::quiet_NaN()).Add(uint8_t(3)).Add(2).Add(0).Add(1);
    EXPECT_EQ(ParsePly(file.bytes(), "text").corners, (std::vector<int>{2, 0, 1}));
  }
}

TEST(Ply, CommentsBlanksAndAByteOrderMarkAreSkippedAnywhere) {
  const std::string bytes = "\xEF\xBB\xBFply \ncomment before\n\n  format   ascii\t1.0  \nobj_info a b\n" + kVertices +
                            "comment an element 7\n" + kFace +
                            "comment last\n end_header \n 0 0\t0\n\ncomment 1 2 3\n1 0 0 1\r\n1 0\n"
                            "obj_info 4\n0 1 0.5\n\n3 0\n1   2";
  const PolygonMesh mesh = ParsePly(bytes, "text");
  EXPECT_EQ(mesh.vertices, (Points(4, 3) << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0.5).finished());
  EXPECT_EQ(mesh.corners, (std::vector<int>{0, 1, 2}));
}

TEST(Ply, FacesMayComeBeforeVertices) {
  const PolygonMesh mesh =
      ParsePly("ply\nformat ascii 1.0\n" + kFace + kVertices + "end_header\n3 0 2 3\n" + kPoints, "text");
  EXPECT_EQ(mesh.corners, (std::vector<int>{0, 2, 3}));
  EXPECT_EQ(mesh.vertices(3, 2), 0.5);
}

TEST(Ply, RefusesMissingAndCutFiles) {
  const testing::TempDir folder;
  ExpectError([&] { ReadPly(folder / "absent.ply"); }, "absent.ply");
  WritePly(folder / "mixed.ply", MixedPolygons());
  const std::string bytes = ReadFile(folder / "mixed.ply");
  const auto read = [&] { ReadPly(folder / "mixed.ply"); };
  EXPECT_EQ(testing::CountRefusedTruncations(folder / "mixed.ply", bytes, read), int(bytes.size()));
  EXPECT_NO_THROW(read());
}

TEST(Ply, DamagedBytesOfEveryFormatAreReadOrRefused) {
  testing::AllowWarnings();
  log::SetLevel(log::Level::kOff);
  Rng rng(11);
  int num_refused = 0;
  const auto parse = [&](std::string_view bytes) {
    try {
      ParsePly(bytes, "text");
    } catch (const Error&) {
      ++num_refused;
    }
  };
  constexpr int kFlips = 3000;
  for (const PlyFormat format : kPlyFormats) {
    const std::string bytes = Unusual<float, uint8_t, int32_t>(format, "float", "uchar", "int");
    num_refused = 0;
    for (size_t size = 0; size < bytes.size(); ++size) parse(std::string_view(bytes).substr(0, size));
    EXPECT_GT(num_refused, int(bytes.size()) - 4) << "the last number of an ASCII file may lack its blank";
    num_refused = 0;
    for (int i = 0; i < kFlips; ++i) {
      std::string damaged = bytes;
      for (uint64_t flip = 0; flip <= rng.Below(3); ++flip)
        damaged[rng.Below(damaged.size())] ^= static_cast<char>(1 + rng.Below(255));
      parse(damaged);
    }
    EXPECT_GT(num_refused, kFlips / 20);
  }
  log::SetLevel(log::Level::kInfo);
}

TEST(Ply, RefusesToWriteWhatItCouldNotRead) {
  const testing::TempDir folder;
  TriangleMesh mesh{Points::Zero(3, 3), (Triangles(1, 3) << 0, 1, 3).finished()};
  ExpectError([&] { WritePly(folder / "bad.ply", mesh); }, "bad.ply: polygon 0 has the corner 3 of 3 vertices");
  mesh.triangles(0, 2) = 2;
  mesh.vertices(0, 0) = 1e300;
  ExpectError([&] { WritePly(folder / "bad.ply", mesh); }, "not finite as a 32-bit float");
  EXPECT_FALSE(std::filesystem::exists(folder / "bad.ply"));
}

// Run under TSan with --gtest_filter=*Threads*. OpenMesh's reader crashed here.
TEST(PlyThreads, EightThreadsReadTheSameAsOne) {
  const testing::TempDir folder;
  std::vector<std::filesystem::path> files;
  std::vector<PolygonMesh> expected;
  for (int i = 0; i < 12; ++i) {
    files.push_back(folder / fmt::format("{}.ply", i));
    if (i % 4 == 3) {
      const TriangleMesh torus = testing::Torus(2, 1, 20 + i, 10);
      WritePly(files.back(), torus);
    } else {
      WriteFileAtomically(files.back(), Unusual<float, uint8_t, int32_t>(kPlyFormats[i % 4], "float", "uchar", "int"));
    }
    expected.push_back(ReadPly(files.back()));
  }
  const auto work = [&](int thread) {
    int num_equal = 0;
    for (int i = 0; i < 120; ++i) {
      const size_t file = size_t(i + thread) % files.size();
      const PolygonMesh mesh = ReadPly(files[file]);
      num_equal += mesh.vertices == expected[file].vertices && mesh.corners == expected[file].corners &&
                   mesh.offsets == expected[file].offsets;
    }
    return num_equal;
  };
  std::vector<std::future<int>> threads;
  for (int thread = 0; thread < 8; ++thread) threads.push_back(std::async(std::launch::async, work, thread));
  for (auto& thread : threads) EXPECT_EQ(thread.get(), 120);
}

}  // namespace
}  // namespace daumier::geometry
