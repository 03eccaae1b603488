#include "geometry/obj.h"

#include "core/files.h"
#include "tests/geometry/shapes.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

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
  ExpectError([] { ParseObj("v 0 0 nan\n", "a.obj"); }, "a.obj:1: a coordinate is not finite");
  ExpectError([] { ParseObj("v 0 0 1e999\n", "a.obj"); }, "a.obj:1:");
  ExpectError([] { ParseObj(kFour + "f 1 2\n", "a.obj"); }, "a.obj:5: a polygon needs three corners");
  ExpectError([] { ParseObj(kFour + "f 1 2 x\n", "a.obj"); }, "a.obj:5: a corner is not a vertex number");
  ExpectError([] { ParseObj(kFour + "f 0 1 2\n", "a.obj"); }, "a.obj:5: a corner is not a vertex number");
  ExpectError([] { ParseObj(kFour + "f -5 1 2\n", "a.obj"); }, "a.obj:5: a corner is not a vertex number");
  ExpectError([] { ParseObj(kFour + "f 1/1 2/1 3\n", "a.obj"); }, "a.obj:5: corners of different forms");
  ExpectError([] { ParseObj(kFour + "f 1 2 2\n", "a.obj"); }, "a.obj:5: a vertex comes twice");
}

TEST(ParseObj, RefusesACutText) {
  ExpectError([] { ParseObj("", "a.obj"); }, "no vertex");
  ExpectError([] { ParseObj(kFour, "a.obj"); }, "no polygon");
  ExpectError([] { ParseObj(kFour + "f 1 2 5\n", "a.obj"); }, "uses vertex 5 of 4");
  const std::string whole = kFour + "f 1 2 3 4\n";
  for (size_t length = 0; length < whole.size(); ++length) {
    EXPECT_THROW(ParseObj(std::string_view(whole).substr(0, length), "a.obj"), Error) << length;
  }
}

TEST(ParseObjVertices, AgreesWithTheFullReaderAndSkipsPolygons) {
  const std::string text = kFour + "f nonsense\n";
  EXPECT_EQ(ParseObjVertices(text, "text", 4), ParseObj(kFour + "f 1 2 3 4\n", "text").vertices);
  ExpectError([&] { ParseObjVertices(text, "a.obj", 5); }, "4 vertices, expected 5");
  ExpectError([&] { ParseObjVertices(text, "a.obj", 3); }, "4 vertices, expected 3");
  ExpectError([] { ParseObjVertices("v 0 0 0\nv 1 1", "a.obj", 2); }, "a.obj:2: the last line has no line end");
}

TEST(WriteObj, ReadObjGivesTheSameBitsBack) {
  const testing::TempDir folder;
  TriangleMesh mesh = testing::Sphere(std::sqrt(3.0), 2);
  WriteObj(folder / "sphere.obj", mesh);
  const PolygonMesh read = ReadObj(folder / "sphere.obj");
  EXPECT_EQ(read.vertices, mesh.vertices);
  EXPECT_EQ(read.corners, std::vector<int>(mesh.triangles.data(), mesh.triangles.data() + mesh.triangles.size()));
}

TEST(ReadObj, NamesAMissingFile) {
  ExpectError([] { ReadObj("absent/head.obj"); }, "absent/head.obj");
}

}  // namespace
}  // namespace daumier::geometry
