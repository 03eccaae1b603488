#include "geometry/obj.h"

#include "core/files.h"
#include "core/log.h"
#include "core/random.h"
#include "geometry/triangulate.h"
#include "tests/geometry/shapes.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"
#include "tests/support/warnings.h"

#include <gtest/gtest.h>

#include <chrono>

namespace daumier::geometry {
namespace {

using testing::ExpectError;

const std::string kFour = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(ParseObj, ReadsAllCornerFormsAndNegativeIndices) {
  for (const char* face :
       {"f 1 2 3 4", "f 1/9 2/9 3/9 4/9", "f 1//7 2//7 3//7 4//7", "f 1/9/7 2/9/7 3/9/7 4/9/7", "f -4 -3 -2 -1"}) {
    const PolygonMesh mesh = ParseObj(kFour + face + "\n", "text");
    EXPECT_EQ(mesh.corners, (std::vector<int>{0, 1, 2, 3})) << face;
    EXPECT_EQ(mesh.num_polygons(), 1) << face;
  }
}

TEST(ParseObj, ReadsUvOfCorners) {
  const PolygonMesh mesh =
      ParseObj(kFour + "vt 0 0\nvt 1 0.25 0.5\nvt 0.5\nf 1/1 2/2 3/3\nf 1/-3/ 3/2/7 4/-1/7\n", "text");
  EXPECT_EQ(mesh.uv, (TextureCoordinates(3, 2) << 0, 0, 1, 0.25, 0.5, 0).finished());
  EXPECT_EQ(mesh.uv_corners, (std::vector<int>{0, 1, 2, 0, 1, 2}));
  EXPECT_EQ(mesh.corners, (std::vector<int>{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(ParseObj(kFour + "f 1/2 2/1 3/1\nvt 0 0\nvt 1 1\n", "text").uv_corners, (std::vector<int>{1, 0, 0}))
      << "vt may come after the polygons that use it";
}

TEST(ParseObj, EmptyAndZeroIndicesAreAbsent) {
  for (const char* face : {"f 1/ 2/ 3/ 4/", "f 1// 2// 3// 4//", "f 1/0 2/0 3/0 4/0", "f 1/0/0 2/0/0 3/0/0 4/0/0",
                           "f 1/1/ 2/1/ 3/1/ 4/1/", "f 1 2/ 3//1 4/0/1"}) {
    EXPECT_EQ(ParseObj(kFour + face + "\n", "text").corners, (std::vector<int>{0, 1, 2, 3})) << face;
    EXPECT_FALSE(ParseObj(kFour + face + "\n", "text").has_uv()) << face;
  }
}

TEST(ParseObj, DropsUvThatSomeCornersLackWithAWarning) {
  testing::AllowWarnings();
  const std::string four = kFour + "vt 0 0\nvt nan 1\n";
  for (const char* faces : {"f 1/1 2 3/1\n", "f 1/1 2/1 3/1\nf 1 3 4\n", "f 1/1 2/2 3/1\n"}) {
    const int num_warnings = log::NumWarnings();
    const PolygonMesh mesh = ParseObj(four + faces, "text");
    EXPECT_EQ(log::NumWarnings(), num_warnings + 1) << faces;
    EXPECT_FALSE(mesh.has_uv()) << faces;
    EXPECT_TRUE(mesh.uv_corners.empty()) << faces;
  }
  const int num_warnings = log::NumWarnings();
  EXPECT_FALSE(ParseObj(four + "f 1 2 3\n", "text").has_uv());
  EXPECT_EQ(ParseObj(four + "f 1/1 2/1 3/1\n", "text").uv.rows(), 1) << "the row that is not finite has no use";
  EXPECT_EQ(log::NumWarnings(), num_warnings);
}

TEST(ParseObj, KeepsARepeatedVertexOnceAndSkipsWhatIsNoPolygonThen) {
  testing::AllowWarnings();
  const int num_warnings = log::NumWarnings();
  const PolygonMesh mesh = ParseObj(kFour + "vt 0 0\nvt 1 1\nf 1/1 2/1 2/2 3/1 1/2 4/2\nf 1/1 2/1 2/1\n", "text");
  EXPECT_EQ(mesh.corners, (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(mesh.uv_corners, (std::vector<int>{0, 0, 0, 1}));
  EXPECT_EQ(mesh.num_polygons(), 1);
  EXPECT_EQ(log::NumWarnings(), num_warnings + 1);
  ExpectError([] { ParseObj(kFour + "f 1 2 2\n", "a.obj"); }, "no polygon");
}

TEST(ParseObj, SkipsPolygonsOfFewerThanThreeCornersInTheMidst) {
  testing::AllowWarnings();
  const int num_warnings = log::NumWarnings();
  EXPECT_EQ(ParseObj(kFour + "f 1 2\nf 3\nf \nf 1 2 3\n", "text").offsets, (std::vector<int>{0, 3}));
  EXPECT_EQ(log::NumWarnings(), num_warnings + 1);
}

TEST(ParseObj, VerticesThatAreNotFiniteKeepTheNumbersOfTheOthers) {
  testing::AllowWarnings();
  for (const char* place : {"nan 0 0", "0 -nan(ind) 0", "0 0 -1.#IND00", "1.#QNAN 0 0", "inf 0 0", "0 1e999 0"}) {
    const int num_warnings = log::NumWarnings();
    const PolygonMesh mesh = ParseObj(
        std::string("v ") + place + "\nvt 0 1\n" + kFour + "f 2/1 3/1 4/1\nf 1/1 2/1 3/1\nf 2/1 4/1 5/1\n", "text");
    EXPECT_EQ(log::NumWarnings(), num_warnings + 1) << place;
    EXPECT_EQ(mesh.vertices.rows(), 5) << place;
    EXPECT_FALSE(mesh.vertices.row(0).allFinite()) << place;
    EXPECT_EQ(mesh.vertices.row(4), Eigen::RowVector3d(0, 1, 0)) << place;
    EXPECT_EQ(mesh.corners, (std::vector<int>{1, 2, 3, 1, 3, 4})) << place;
    EXPECT_EQ(mesh.uv_corners.size(), 6u) << place;
  }
  ExpectError([] { ParseObj("v nan 0 0\n" + kFour + "f 1 2 3\n", "a.obj"); }, "a.obj: no polygon is left");
}

TEST(ParseObj, SkipsElementsThatAreNoPolygonsWithOneWarning) {
  testing::AllowWarnings();
  const int num_warnings = log::NumWarnings();
  const PolygonMesh mesh = ParseObj(kFour +
                                        "cstype bezier\nvp 0 1\np 1\nl 1 2 3\ncurv 0 1 1 2\ncurv2 1 2\nsurf 0 1 0 1 1 "
                                        "2\nparm u 0 1\nend\nfo 1 2 3 4\n",
                                    "text");
  EXPECT_EQ(mesh.corners, (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(log::NumWarnings(), num_warnings + 1);
}

TEST(ParseObj, SkipsColoursAndWeightsOfVertices) {
  const PolygonMesh mesh =
      ParseObj("v 0 0 0 0.5\nv 1 0 0 0.1 0.2 0.3\nv 1 1 0 255 128 0 1\n#MRGB ffffffff\nf 1 2 3\n", "text");
  EXPECT_EQ(mesh.vertices, (Points(3, 3) << 0, 0, 0, 1, 0, 0, 1, 1, 0).finished());
}

TEST(ParseObj, ReadsIndentedLinesAByteOrderMarkAndALastLineWithoutEnd) {
  const PolygonMesh mesh = ParseObj("\xEF\xBB\xBFv 0 0 0\n  v 1 0 0\n\tv 1 1 0\n \tvt 0 1\n  f 1/1 2/1 3/1", "text");
  EXPECT_EQ(mesh.vertices.rows(), 3);
  EXPECT_EQ(mesh.corners, (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(mesh.uv_corners, (std::vector<int>{0, 0, 0}));
  EXPECT_EQ(ParseObjVertices("v 0 0 0\n  v 1 2 3", "text", 2)(1, 2), 3);
}

// 200,000 corners in one polygon: a comparison of all pairs would take a minute.
TEST(ParseObj, ReadsAPolygonOfManyCornersInSeconds) {
  constexpr int kCorners = 200'000;
  std::string text, polygon = "f";
  for (int k = 0; k < kCorners; ++k) {
    text += "v 0 0 0\n";
    polygon += fmt::format(" {}", k + 1);
  }
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(ParseObj(text + polygon + "\n", "text").corners.size(), size_t(kCorners));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
}

TEST(ParseObj, PassesOverWhatItDoesNotNeed) {
  const PolygonMesh mesh = ParseObj(
      "# head\r\nmtllib a.mtl\r\ng face\r\nv +1.5 -2e-1\t3 1.0\r\nvt 0 0\r\nvn 0 0 1\r\nv 1 0 0\r\nv 0 1 0\r\nusemtl "
      "skin\r\ns 1\r\nf 1 2 3 # end\r\n",
      "text");
  EXPECT_EQ(mesh.vertices.row(0), Eigen::RowVector3d(1.5, -0.2, 3));
  EXPECT_EQ(mesh.offsets, (std::vector<int>{0, 3}));
}

TEST(ParseObj, RefusesWhatIsWrongAndNamesTheLine) {
  ExpectError([] { ParseObj("v 0 0\n", "a.obj"); }, "a.obj:1: a vertex needs three coordinates");
  ExpectError([] { ParseObj("v 0 0 zero\n", "a.obj"); }, "a.obj:1: a coordinate is not a number");
  ExpectError([] { ParseObj("v 0,5 0,1 0\n", "a.obj"); }, "a.obj:1: a coordinate is not a number (found '0,5'");
  ExpectError([] { ParseObjVertices("v 0 0 nan\n", "a.obj", 1); }, "a.obj:1: a coordinate is not finite");
  ExpectError([] { ParseObj(kFour + "f 1 2", "a.obj"); }, "a.obj:5: a polygon needs three corners: the file is cut");
  ExpectError([] { ParseObj(kFour + "f 1 2 x\n", "a.obj"); }, "a.obj:5: a corner is not a vertex number");
  ExpectError([] { ParseObj(kFour + "f 0 1 2\n", "a.obj"); }, "a.obj:5: a corner is not a vertex number");
  ExpectError([] { ParseObj(kFour + "f -5 1 2\n", "a.obj"); }, "a.obj:5: a corner is not a vertex number");
  ExpectError([] { ParseObj(kFour + "f 1-2 3 4\n", "a.obj"); }, "a.obj:5: a corner is not a vertex number");
  ExpectError([] { ParseObj(kFour + "f 1/2/3/4 2 3\n", "a.obj"); }, "a.obj:5: a corner is not of the form v/vt/vn");
  ExpectError([] { ParseObj(kFour + "vt 0 0\nf 1/x 2/1 3/1\n", "a.obj"); },
              "a.obj:6: a corner is not of the form v/vt");
  ExpectError([] { ParseObj(kFour + "vt 0 0\nf 1/-2 2/1 3/1\n", "a.obj"); },
              "a.obj:6: a corner is not of the form v/vt");
  ExpectError([] { ParseObj(kFour + "vt 0 0\nf 1/1 2/2 3/1\n", "a.obj"); }, "uses texture coordinate 2 of 1");
  ExpectError([] { ParseObj(kFour + "vt\t\n", "a.obj"); }, "a.obj:5: a texture coordinate needs a number");
  ExpectError([] { ParseObj(kFour + "vt 0 b\n", "a.obj"); }, "a.obj:5: a texture coordinate is not a number");
}

TEST(ParseObj, RefusesACutText) {
  ExpectError([] { ParseObj("", "a.obj"); }, "no vertex");
  ExpectError(
      [] { ParseObj(kFour, "a.obj"); },
      "a.obj: has points, but no faces: a cloud of points (found 4 vertices and no faces, expected faces). Mesh it "
      "first");
  ExpectError(
      [] { ParseObj(kFour + "p 1 2\nl 1 2 3\ncurv 0 1 1 2\n", "a.obj"); },
      "a.obj: no mesh of polygons (found 4 vertices and 3 points, lines or free-form elements, expected faces)");
  ExpectError([] { ParseObj(kFour + "f 1 2 5\n", "a.obj"); }, "uses vertex 5 of 4");
  // A text cut inside its last polygon is a shorter text of its own; every other cut is refused.
  const std::string whole = kFour + "f 1 2 3 4\n", shortest = kFour + "f 1 2 3";
  for (size_t length = 0; length < shortest.size(); ++length) {
    EXPECT_THROW(ParseObj(std::string_view(whole).substr(0, length), "a.obj"), Error) << length;
  }
}

TEST(ParseObj, DamagedTextsAreReadOrRefused) {
  testing::AllowWarnings();
  log::SetLevel(log::Level::kOff);
  const std::string whole =
      "\xEF\xBB\xBF# a\r\n" + kFour +
      "v nan 1.#IND -2\r\nvt 0 0\rvt 1 1\nvn 0 0 1\nl 1 2\nf 1/1 2/2 \\\n 3/1 4/2\r\nf -1// -2//1 -3\nf 1 1 2\n";
  constexpr std::string_view kBytes = "0123456789-+.e/\\\r\n\t #vftnlp\xFF";
  Rng rng(3);
  int num_refused = 0;
  for (int i = 0; i < 20'000; ++i) {
    std::string damaged = whole.substr(0, whole.size() - (i % 2 == 0 ? 0 : rng.Below(whole.size())));
    for (uint64_t flip = 0; flip <= rng.Below(3) && !damaged.empty(); ++flip)
      damaged[rng.Below(damaged.size())] = kBytes[rng.Below(kBytes.size())];
    try {
      const PolygonMesh mesh = ParseObj(damaged, "a.obj");
      for (const int v : mesh.corners)
        EXPECT_TRUE(v >= 0 && v < mesh.vertices.rows() && mesh.vertices.row(v).allFinite());
    } catch (const Error&) {
      ++num_refused;
    }
  }
  EXPECT_GT(num_refused, 2000);
  EXPECT_LT(num_refused, 19'000);
  log::SetLevel(log::Level::kInfo);
}

TEST(ParseObjVertices, AgreesWithTheFullReaderAndSkipsPolygons) {
  const std::string text = kFour + "f nonsense\n";
  EXPECT_EQ(ParseObjVertices(text, "text", 4), ParseObj(kFour + "f 1 2 3 4\n", "text").vertices);
  ExpectError([&] { ParseObjVertices(text, "a.obj", 5); }, "4 vertices, expected 5");
  ExpectError([&] { ParseObjVertices(text, "a.obj", 3); }, "4 vertices, expected 3");
  ExpectError([] { ParseObjVertices("v 0 0 0\nv 1 1", "a.obj", 2); }, "a.obj:2: a vertex needs three coordinates");
}

TEST(WriteObj, ReadObjGivesTheSameBitsBack) {
  const testing::TempDir folder;
  TriangleMesh mesh = testing::Sphere(std::sqrt(3.0), 2);
  WriteObj(folder / "sphere.obj", mesh);
  const PolygonMesh read = ReadObj(folder / "sphere.obj");
  EXPECT_EQ(read.vertices, mesh.vertices);
  EXPECT_EQ(read.corners, std::vector<int>(mesh.triangles.data(), mesh.triangles.data() + mesh.triangles.size()));
}

TEST(WriteObj, ReadObjGivesUvAndPolygonsBack) {
  const testing::TempDir folder;
  PolygonMesh mesh{.vertices = Points::Random(5, 3), .offsets = {0, 4, 7}, .corners = {0, 1, 2, 3, 3, 2, 4}};
  mesh.uv = TextureCoordinates::Random(6, 2);
  mesh.uv_corners = {0, 1, 2, 3, 4, 2, 5};
  WriteObj(folder / "mesh.obj", mesh);
  const PolygonMesh read = ReadObj(folder / "mesh.obj");
  EXPECT_EQ(read.vertices, mesh.vertices);
  EXPECT_EQ(read.offsets, mesh.offsets);
  EXPECT_EQ(read.corners, mesh.corners);
  EXPECT_EQ(read.uv, mesh.uv);
  EXPECT_EQ(read.uv_corners, mesh.uv_corners);
  const TriangleMesh triangles = TriangulateMesh(mesh);
  WriteObj(folder / "triangles.obj", triangles);
  const TriangleMesh again = TriangulateMesh(ReadObj(folder / "triangles.obj"));
  EXPECT_EQ(again.uv, mesh.uv);
  EXPECT_EQ(again.uv_triangles, triangles.uv_triangles);
}

TEST(WriteObj, OfAMeshWithoutUvHasVerticesAndPolygonsAlone) {
  const testing::TempDir folder;
  WriteObj(folder / "one.obj", TriangleMesh{(Points(3, 3) << 0, 0, 0, 1.5, 0, 0, 0, -1, 0).finished(),
                                            (Triangles(1, 3) << 0, 1, 2).finished()});
  EXPECT_EQ(ReadFile(folder / "one.obj"), "v 0 0 0\nv 1.5 0 0\nv 0 -1 0\nf 1 2 3\n");
}

TEST(WriteObj, OfPartsHasGroupsAndAFileOfMaterials) {
  const testing::TempDir folder;
  TriangleMesh mesh;
  mesh.vertices = Points::Identity(3, 3);
  mesh.triangles = (Triangles(2, 3) << 0, 1, 2, 2, 1, 0).finished();
  const std::vector<ObjMaterial> materials = {{"skin", {0.5f, 0.25f, 0}, 0}, {"eye", {1, 1, 1}, 0.5f}};
  WriteObj(folder / "a head.obj", mesh, {{"face", "skin", 1}, {"eyes", "eye", 1}}, materials);
  EXPECT_EQ(
      ReadFile(folder / "a head.obj"),
      "mtllib a head.mtl\nv 1 0 0\nv 0 1 0\nv 0 0 1\ns 1\ng face\nusemtl skin\nf 1 2 3\ng eyes\nusemtl eye\nf 3 2 1\n");
  EXPECT_EQ(ReadFile(folder / "a head.mtl"),
            "newmtl skin\nKd 0.5 0.25 0\nKs 0 0 0\nNs 10\nillum 2\n\n"
            "newmtl eye\nKd 1 1 1\nKs 0.5 0.5 0.5\nNs 250\nillum 2\n\n");
  EXPECT_EQ(ReadObj(folder / "a head.obj").num_polygons(), 2);
  ExpectError([&] { WriteObj(folder / "bad.obj", mesh, {{"face", "skin", 1}}, materials); }, "1 triangles in parts");
}

TEST(WriteObj, RefusesUvThatDoesNotFit) {
  const testing::TempDir folder;
  TriangleMesh mesh = testing::EquilateralTriangle();
  mesh.uv.resize(2, 2);
  mesh.uv.setZero();
  mesh.uv_triangles = mesh.triangles;
  ExpectError([&] { WriteObj(folder / "bad.obj", mesh); }, "row 2 of UV, there are 2");
  EXPECT_FALSE(std::filesystem::exists(folder / "bad.obj"));
}

TEST(ReadObj, NamesAMissingFile) {
  ExpectError([] { ReadObj("absent/head.obj"); }, "absent/head.obj");
}

}  // namespace
}  // namespace daumier::geometry
