#include "eval/predicted_meshes.h"

#include "core/files.h"
#include "core/json.h"
#include "faces/finished_head.h"
#include "geometry/obj.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_face.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::eval {
namespace {

using testing::ExpectError;
namespace fs = std::filesystem;

class DrawnPredictionsTest : public ::testing::Test {
 protected:
  DrawnPredictionsTest() {
    drawings_[0].name = "a";
    drawings_[1].name = "b";
  }
  void WriteMesh(const std::string& name) const {
    geometry::WriteObj(folder_ / (name + ".obj"), faces::SurfaceMesh(face_, face_.neutral));
  }
  void WriteFrames(const Json& drawings) const {
    WriteFileAtomically(folder_ / "manifest.json", Json{{"details", {{"drawings", drawings}}}}.dump());
  }
  DrawnPredictions Read() const { return ReadDrawnPredictions(folder_.path(), drawings_, face_); }

  const Json frame_ = {{"frame", {{"scale", 2}, {"shift", {3, 4}}}}};
  const faces::FaceTemplate face_ = testing::SyntheticFace();
  const testing::TempDir folder_;
  std::vector<LabelledDrawing> drawings_{2};
};

TEST_F(DrawnPredictionsTest, AreMeshesWithTheirFrames) {
  WriteMesh("a");
  WriteMesh("other");
  WriteFrames({{"a", frame_}});
  const DrawnPredictions predictions = Read();
  ASSERT_EQ(predictions.of_labelled.size(), 1U);
  EXPECT_LT((predictions.of_labelled.at("a").vertices - face_.neutral).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_EQ(predictions.of_labelled.at("a").frame.scale, 2);
  EXPECT_EQ(predictions.unlabelled, std::vector<std::string>{"other"});
}

TEST_F(DrawnPredictionsTest, ARectifiedSheetHasItsHomography) {
  WriteMesh("a");
  WriteMesh("b");
  Json record = frame_;
  record["picture_from_sheet"] = {{2, 0, 30}, {0, 2, 0}, {0, 0.001, 1}};
  WriteFrames({{"a", record}, {"b", frame_}});
  const DrawnPredictions predictions = Read();
  ASSERT_TRUE(predictions.of_labelled.at("a").picture_from_sheet.has_value());
  EXPECT_EQ((*predictions.of_labelled.at("a").picture_from_sheet)(0, 2), 30);
  EXPECT_FALSE(predictions.of_labelled.at("b").picture_from_sheet.has_value());
  record["picture_from_sheet"] = {1, 2};
  WriteFrames({{"a", record}, {"b", frame_}});
  ExpectError([&] { Read(); }, "manifest.json: 'a': the homography is malformed");
}

TEST_F(DrawnPredictionsTest, WhatIsMissingIsNamed) {
  ExpectError([&] { Read(); }, "holds no mesh");
  WriteMesh("a");
  ExpectError([&] { Read(); }, "manifest.json is missing");
  WriteFileAtomically(folder_ / "manifest.json", "{}");
  ExpectError([&] { Read(); }, "manifest.json has no details.drawings");
  WriteFrames({{"other", frame_}});
  ExpectError([&] { Read(); }, "manifest.json has no frame of 'a'");
  WriteFrames({{"a", {{"frame", {{"scale", 2}}}}}});
  ExpectError([&] { Read(); }, "manifest.json: 'a': the frame is malformed");
  WriteFrames({{"a", frame_}, {"b", frame_}});
  ExpectError([&] { Read(); }, "b.obj is missing");
  fs::rename(folder_ / "a.obj", folder_ / "c.obj");
  WriteFrames(Json::object());
  ExpectError([&] { Read(); }, "none of the meshes (c, ...) has the name of a labelled drawing (a, ...)");
}

TEST_F(DrawnPredictionsTest, OtherNumbersOfVerticesAreRefused) {
  WriteFrames({{"a", frame_}});
  WriteFileAtomically(folder_ / "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  ExpectError([&] { Read(); }, "a.obj has 3 vertices (expected " + std::to_string(face_.num_vertices()));
}

TEST(TemplateMeshReader, ReadsTheFaceOfAFinishedHead) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  const faces::FinishedHead head(face);
  ASSERT_GT(head.num_vertices(), face.num_vertices());
  const testing::TempDir folder;
  geometry::WriteObj(folder / "head.obj", head.Mesh(face.neutral));
  const geometry::Points read = TemplateMeshReader(face).Read(folder / "head.obj");
  ASSERT_EQ(read.rows(), face.neutral.rows());
  EXPECT_LT((read - face.neutral).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(MeshesIn, NamesMeshesWithoutTheirExtension) {
  const testing::TempDir folder;
  for (const char* name : {"a.obj", "b.PLY", "a.mtl", "._c.obj", "manifest.json"})
    WriteFileAtomically(folder / name, "text");
  const auto meshes = MeshesIn(folder.path());
  ASSERT_EQ(meshes.size(), 2U);
  EXPECT_EQ(meshes.at("b"), folder / "b.PLY");
  WriteFileAtomically(folder / "a.ply", "text");
  ExpectError([&] { MeshesIn(folder.path()); }, "meshes of the same name");
  ExpectError([&] { MeshesIn(folder / "none"); }, "no such folder");
}

}  // namespace
}  // namespace daumier::eval
