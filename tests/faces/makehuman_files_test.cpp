#include "faces/makehuman_files.h"

#include "core/files.h"
#include "faces/makehuman.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

using testing::ExpectError;
using testing::TempDir;

/// A base mesh with MakeHuman's numbers of vertices and polygons, and no shape.
std::string BaseObj(int num_vertices = 19158, int num_polygons = 13378) {
  std::string text;
  for (int v = 0; v < num_vertices; ++v) text += fmt::format("v {} 0.5 {}\n", v, -v);
  for (int p = 0; p < num_polygons; ++p) {
    const int first = p % 13000 + 1;
    text += fmt::format("f {}/1 {}/1 {}/1 {}/1\n", first, first + 1, first + 2, first + 3);
  }
  return text;
}

class MakeHumanFilesTest : public ::testing::Test {
 protected:
  void Write(const std::string& path, const std::string& text) {
    MakeDirectory((directory_ / path).parent_path());
    WriteFileAtomically(directory_ / path, text);
  }
  void WriteCheckout() {
    Write("makehuman/data/3dobjs/base.obj", BaseObj());
    Write("makehuman/data/targets/nose/nose-hump-morehump.target", "# comment\n 2 .5 -1 0.25\r\n19000 1 1 1\n");
  }
  /// The npm package with two targets.
  void WritePackage(size_t num_bytes) {
    Json mesh = {{"vertices", Json::array()}, {"faces", Json::array()}};
    for (int i = 0; i < 3 * 19158; ++i) mesh["vertices"].push_back(i);
    for (int p = 0; p < 13378; ++p) {
      const int first = p % 13000;
      for (const int n : {11, first, first + 1, first + 2, first + 3, 0, 0, 0, 0, 0}) mesh["faces"].push_back(n);
    }
    Write("public/data/models/human_full_size.json", mesh.dump());
    Write("src/json/targets/target-list.json",
          R"({"targets": {"data/targets/a/c-d.target": [], "data/targets/a/c.target": []}})");
    Write("package.json", R"({"version": "0.0.2"})");
    std::string bytes(num_bytes, '\0');
    const size_t row = sizeof(int16_t) * 3 * 19158;
    if (bytes.size() > row)
      bytes[row + 2] = 7, bytes[4] = -1, bytes[5] = -1;  // the second row, a/c, moves y of vertex 0 by 7
    Write("public/data/targets/targets.bin", bytes);
  }

  static constexpr size_t kBytes = 2 * sizeof(int16_t) * 3 * 19158;
  TempDir directory_;
};

TEST_F(MakeHumanFilesTest, CheckoutGivesBodyAndTargets) {
  WriteCheckout();
  const MakeHumanFiles files = OpenMakeHuman(directory_.path());
  EXPECT_EQ(files.body.vertices.rows(), 13380);
  EXPECT_EQ(files.body.vertices.row(7), Eigen::RowVector3d(7, 0.5, -7));
  EXPECT_EQ(files.body.num_polygons(), 13378);
  EXPECT_EQ(files.target_names, std::vector<std::string>{"nose/nose-hump-morehump"});
  const geometry::Points target = files.target("nose/nose-hump-morehump");
  EXPECT_EQ(target.row(2), Eigen::RowVector3d(0.5, -1, 0.25));
  EXPECT_DOUBLE_EQ(target.cwiseAbs().sum(), 1.75);
}

TEST_F(MakeHumanFilesTest, PackageGivesRowsInOrderOfPath) {
  WritePackage(kBytes);
  const MakeHumanFiles files = OpenMakeHuman(directory_.path());
  EXPECT_EQ(files.body.vertices.row(1), Eigen::RowVector3d(3, 4, 5));
  EXPECT_EQ(files.target_names, (std::vector<std::string>{"a/c", "a/c-d"}));
  EXPECT_DOUBLE_EQ(files.target("a/c-d")(0, 2), -0.001);
  EXPECT_DOUBLE_EQ(files.target("a/c")(0, 1), 0.007);
  EXPECT_EQ(files.provenance.at("version"), "0.0.2");
  ExpectError([&] { files.target("z"); }, "no target 'z'");
}

TEST_F(MakeHumanFilesTest, UvOfCheckoutAndPackageIsThatOfTheBody) {
  WriteCheckout();
  EXPECT_FALSE(OpenMakeHuman(directory_.path()).body.has_uv());
  Write("makehuman/data/3dobjs/base.obj", BaseObj() + "vt 0.25 0.75\n");
  const geometry::PolygonMesh checkout = OpenMakeHuman(directory_.path()).body;
  EXPECT_EQ(checkout.uv, (geometry::TextureCoordinates(1, 2) << 0.25, 0.75).finished());
  EXPECT_EQ(checkout.uv_corners.size(), checkout.corners.size());
  WritePackage(kBytes);
  Json mesh = Json::parse(ReadFile(directory_ / "public/data/models/human_full_size.json"));
  mesh["uvs"] = {{9, 9, 0.5, 0.25, 0.125, 0}};
  for (size_t face = 0; face < mesh["faces"].size(); face += 10) {
    for (int k = 0; k < 4; ++k) mesh["faces"][face + 6 + k] = 1 + k % 2;
  }
  Write("public/data/models/human_full_size.json", mesh.dump());
  const geometry::PolygonMesh package = OpenMakeHuman(directory_.path()).body;
  EXPECT_EQ(package.uv, (geometry::TextureCoordinates(2, 2) << 0.5, 0.25, 0.125, 0).finished());
  EXPECT_EQ(package.uv_corners[4], 0);
  EXPECT_EQ(package.uv_corners[5], 1);
  mesh["faces"][8] = 3;
  Write("public/data/models/human_full_size.json", mesh.dump());
  ExpectError([&] { OpenMakeHuman(directory_.path()); }, "names UV 3, there are 3");
}

TEST_F(MakeHumanFilesTest, DamagedDataAreRefusedByName) {
  ExpectError([&] { OpenMakeHuman(directory_ / "nowhere"); }, "./dev setup");
  ExpectError([&] { OpenMakeHuman(directory_.path()); }, "holds neither");
  WriteCheckout();
  Write("makehuman/data/targets/nose/nose-hump-morehump.target", "2 0.5 x 1\n");
  ExpectError([&] { OpenMakeHuman(directory_.path()).target("nose/nose-hump-morehump"); }, "morehump.target:1");
  Write("makehuman/data/targets/nose/nose-hump-morehump.target", "99999 1 1 1\n");
  ExpectError([&] { OpenMakeHuman(directory_.path()).target("nose/nose-hump-morehump"); }, "99999");
  Write("makehuman/data/3dobjs/base.obj", BaseObj(19000));
  ExpectError([&] { OpenMakeHuman(directory_.path()); }, "19000 vertices, MakeHuman's base mesh has 19158");
  WritePackage(kBytes - 2);
  ExpectError([&] { OpenMakeHuman(directory_.path()); }, "truncated");
  Write("public/data/models/human_full_size.json", "{\"vertices\": [");
  ExpectError([&] { OpenMakeHuman(directory_.path()); }, "human_full_size.json");
}

}  // namespace
}  // namespace daumier::faces
