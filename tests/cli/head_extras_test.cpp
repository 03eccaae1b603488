// --triangles and --print of `daumier rig`, as its users run it.
#include "core/files.h"
#include "core/json.h"
#include "faces/face_model_file.h"
#include "geometry/closed_surface.h"
#include "geometry/obj.h"
#include "geometry/stl.h"
#include "tests/cli/pipeline.h"
#include "tests/support/glb_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace daumier::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class HeadExtrasCommand : public ::testing::Test {
 protected:
  HeadExtrasCommand() {
    const faces::FaceModel model = faces::ReadFaceModelWeights(SourceRoot() / "weights/face-ict");
    geometry::WriteObj(folder_ / "face.obj", faces::SurfaceMesh(model.face_template, model.face_template.neutral));
  }
  std::string In(const std::string& name) const { return (folder_ / name).string(); }
  ProcessResult Rig(const std::string& out, std::vector<std::string> options) const {
    options.insert(options.begin(), {"rig", In("face.obj"), "--out", In(out)});
    return Daumier(options);
  }

  const TempDir folder_;
};

TEST_F(HeadExtrasCommand, WritesAHeadOfFewerTrianglesAndAPrint) {
  const ProcessResult result = Rig("head.glb", {"--triangles", "4000", "--print", "--vrm", "--compress", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json summary = Json::parse(result.out);
  EXPECT_GT(summary["decimated"]["before"], 20000);
  EXPECT_LE(summary["decimated"]["after"], 4000);
  EXPECT_GE(summary["decimated"]["after"], 3999);
  EXPECT_EQ(summary["decimated"]["greatest_peak_loss_percent"], 0);
  const GlbReader head(ReadFile(folder_ / "head.glb"));
  int64_t num_indices = 0;
  for (const Json& mesh : head.json()["meshes"])
    for (const Json& primitive : mesh["primitives"])
      num_indices += head.accessor(primitive["indices"].get<int>())["count"].get<int64_t>();
  EXPECT_EQ(num_indices, 3 * summary["decimated"]["after"].get<int64_t>());
  EXPECT_EQ(summary["triangles"], summary["decimated"]["after"]) << "eyes among them";
  EXPECT_EQ(head.json()["meshes"][0]["extras"]["targetNames"].size(), 52u);

  const std::string stl = ReadFile(folder_ / "head.stl");
  EXPECT_TRUE(stl.starts_with("Daumier head, millimetres"));
  const geometry::TriangleMesh print = geometry::DecodeStl(stl);
  EXPECT_TRUE(geometry::IsClosed(print.triangles));
  EXPECT_GT(print.triangles.rows(), 20000) << "of the full head";
  EXPECT_EQ(print.vertices.col(2).minCoeff(), 0);
  EXPECT_NEAR(print.vertices.col(2).maxCoeff(), summary["print"]["size_mm"][2].get<double>(), 0.06);
  EXPECT_GT(print.vertices.col(2).maxCoeff(), 180);
  EXPECT_LT(print.vertices.col(2).maxCoeff(), 320);
  EXPECT_EQ(summary["print"]["closed_surfaces"], 6);
  EXPECT_EQ(summary["bytes"][In("head.stl")], 84 + 50 * print.triangles.rows());

  const fs::path script = SourceRoot() / "tools/npm/validate_gltf.mjs";
  if (!fs::exists(script.parent_path() / "node_modules/gltf-validator") ||
      RunProcess({"/bin/sh", "-c", "command -v node"}).exit_code != 0)
    return;
  const auto validated = RunProcess({"/usr/bin/env", "node", script.string(), In("head.glb"), In("head.vrm")});
  EXPECT_EQ(validated.exit_code, 0) << validated.out << validated.err;
}

TEST_F(HeadExtrasCommand, PrintsAPoseAndReplacesItsOwnFilesAlone) {
  ASSERT_EQ(Rig("head.glb", {"--print"}).exit_code, 0);
  const std::string rest = ReadFile(folder_ / "head.stl");
  const ProcessResult posed = Rig("head.glb", {"--print-pose", "JawOpen=0.5", "--print-pose", "mouthSmile_L=1"});
  ASSERT_EQ(posed.exit_code, 0) << posed.err;
  EXPECT_NE(ReadFile(folder_ / "head.stl"), rest);
  WriteFileAtomically(folder_ / "head.stl", "solid part of mine");
  const ProcessResult refused = Rig("head.glb", {"--print"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("head.stl"));
  EXPECT_EQ(ReadFile(folder_ / "head.stl"), "solid part of mine");
  EXPECT_EQ(Rig("head.glb", {"--print", "--force"}).exit_code, 0);
}

TEST_F(HeadExtrasCommand, KeepsAHeadThatHasFewTrianglesAndRefusesMisuse) {
  const ProcessResult many = Rig("head.glb", {"--triangles", "900000", "--json"});
  ASSERT_EQ(many.exit_code, 0) << many.err;
  const Json decimated = Json::parse(many.out)["decimated"];
  EXPECT_EQ(decimated["before"], decimated["after"]);
  EXPECT_EQ(decimated["remark"], "the head has no more triangles than --triangles 900000 and is kept as it is");
  const std::vector<std::pair<std::vector<std::string>, std::string>> misuses = {
      {{"--triangles", "499"}, "--triangles"},
      {{"--triangles", "few"}, "--triangles"},
      {{"--print-pose", "jawOpen"}, "expected TARGET=WEIGHT"},
      {{"--print-pose", "jawOpen=2"}, "from 0 to 1"},
      {{"--print-pose", "jawOpen=x"}, "from 0 to 1"},
      {{"--print-pose", "grin=1"}, "--print-pose grin=1"}};
  for (const auto& [options, part] : misuses) {
    const ProcessResult result = Rig("other.glb", options);
    EXPECT_EQ(result.exit_code, 2) << part;
    EXPECT_THAT(result.err, HasSubstr(part));
  }
  EXPECT_FALSE(fs::exists(folder_ / "other.glb"));
}

}  // namespace
}  // namespace daumier::testing
