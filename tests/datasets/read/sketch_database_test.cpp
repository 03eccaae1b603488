#include "datasets/read/sketch_database.h"

#include "core/files.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::datasets {
namespace {

using testing::ExpectError;
using testing::TempDir;

/// One person, two faces, of which a curve is drawn, a dot or a triangle, and a wrinkle, a line or a dot.
class SketchDatabaseTest : public ::testing::Test {
 protected:
  void SetUp() override {
    MakeDirectory(directory_ / "shards");
    manifest_.kind = "sketches";
    manifest_.verb = "dataset sketches";
    manifest_.counts = {{"persons", 1}, {"faces", 2}, {"faces_per_shard", 2}, {"views_per_face", 1}};
    manifest_.details = {{"kinds", {"silhouette", "brow", "lips", "wrinkle"}},
                         {"camera",
                          {{"camera_from_world", {1, 0, 0, 0, -1, 0, 0, 0, -1}},
                           {"translation", {1, 2, 3}},
                           {"scale", 4.5},
                           {"principal_point", {128, 127}},
                           {"width", 256},
                           {"height", 256}}},
                         {"curves", {{{"name", "jaw"}, {"kind", "silhouette"}, {"closed", false}}}}};
    Write({0, 1, 3, 6, 7});
  }

  void Write(const std::vector<int64_t>& stroke_offsets) {
    SafetensorsWriter writer;
    writer.Add<float>("points", {7, 2}, std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14});
    writer.Add<int64_t>("stroke_offsets", {int64_t(stroke_offsets.size())}, stroke_offsets);
    writer.Add<int32_t>("stroke_kinds", {4}, std::vector<int32_t>{0, 3, 2, 1});
    writer.Add<int64_t>("sketch_offsets", {3}, std::vector<int64_t>{0, 2, 4});
    manifest_.checksums[shard_] = writer.Write(directory_ / shard_);
    WriteManifest(directory_.path(), manifest_);
  }

  TempDir directory_;
  Manifest manifest_;
  const std::string shard_ = "shards/person-00000.safetensors";
};

TEST_F(SketchDatabaseTest, StrokesAreReadFaceByFace) {
  const SketchDatabase sketches(directory_.path());
  ASSERT_EQ(sketches.num_faces(), 2);
  const auto first = sketches.strokes(0), second = sketches.strokes(1);
  ASSERT_EQ(first.size(), 2u);
  EXPECT_EQ(first[0].kind, 0);
  ASSERT_EQ(first[1].points.size(), 2u);
  EXPECT_EQ(first[1].points[1], (std::array<float, 2>{5, 6}));
  ASSERT_EQ(second.size(), 2u);
  EXPECT_EQ(second[0].kind, 2);
  EXPECT_EQ(second[0].points.size(), 3u);
  EXPECT_EQ(second[1].points[0], (std::array<float, 2>{13, 14}));
}

TEST_F(SketchDatabaseTest, CurvePointsLeaveWrinklesOut) {
  const SketchDatabase sketches(directory_.path());
  EXPECT_EQ(sketches.num_curves(), 1);
  EXPECT_EQ(sketches.curve_points(0), (std::vector<float>{1, 2}));
  EXPECT_EQ(sketches.curve_points(1), (std::vector<float>{7, 8, 9, 10, 11, 12}));
}

TEST_F(SketchDatabaseTest, TheCameraIsReadBack) {
  const render::Camera camera = SketchDatabase(directory_.path()).camera();
  EXPECT_EQ(camera.camera_from_world(1, 1), -1);
  EXPECT_EQ(camera.translation, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(camera.scale, 4.5);
  EXPECT_EQ(camera.principal_point, Eigen::Vector2d(128, 127));
  EXPECT_EQ(camera.width, 256);
  manifest_.details["camera"]["translation"] = {1, 2};
  WriteManifest(directory_.path(), manifest_);
  ExpectError([&] { SketchDatabase(directory_.path()); }, "translation has 2 numbers");
}

TEST_F(SketchDatabaseTest, LipsAreACurveAndNoFeature) {
  manifest_.details["curves"].push_back({{"name", "lips"}, {"kind", "lips"}, {"closed", true}});
  WriteManifest(directory_.path(), manifest_);
  const SketchDatabase sketches(directory_.path());
  EXPECT_EQ(sketches.num_curves(), 2);
  EXPECT_EQ(sketches.feature_curves(), (std::vector<int>{0}));
  EXPECT_EQ(PointsOf(sketches.strokes(0), sketches.feature_curves()), (std::vector<float>{1, 2}));
  ExpectError([&] { PointsOf(sketches.strokes(0), std::vector<int>{2}); }, "stroke 2 of a sketch of 2");
}

TEST_F(SketchDatabaseTest, ViewsOfAFaceFollowEachOther) {
  manifest_.counts = {{"persons", 1}, {"faces", 1}, {"faces_per_shard", 1}, {"views_per_face", 2}};
  WriteManifest(directory_.path(), manifest_);
  const SketchDatabase sketches(directory_.path());
  EXPECT_EQ(sketches.num_views(), 2);
  EXPECT_EQ(sketches.strokes(0, 1)[0].points.size(), 3u);
  ExpectError([&] { sketches.strokes(0, 2); }, "view 2, of a database of 1 faces in 2 views");
}

TEST_F(SketchDatabaseTest, VersionOneHasNoFactsAndSaysSo) {
  const SketchDatabase sketches(directory_.path());
  EXPECT_FALSE(sketches.has_facts());
  EXPECT_EQ(sketches.num_turned_views(), 0);
  ExpectError([&] { sketches.facts(0); }, "sketches of version 1, which lack landmarks");
}

TEST_F(SketchDatabaseTest, NewerVersionsAreRefused) {
  manifest_.details["version"] = SketchDatabase::kDrawnVersion + 1;
  WriteManifest(directory_.path(), manifest_);
  ExpectError([&] { SketchDatabase(directory_.path()); }, "sketches of version 4, expected 1 to 3");
}

TEST_F(SketchDatabaseTest, VersionTwoWithoutItsArraysIsRefused) {
  manifest_.details["version"] = 2;
  WriteManifest(directory_.path(), manifest_);
  ExpectError([&] { SketchDatabase(directory_.path()); }, "landmarks");
}

TEST_F(SketchDatabaseTest, TurnedViewsFollowTheOthers) {
  manifest_.counts = {{"persons", 1}, {"faces", 1}, {"faces_per_shard", 1}, {"views_per_face", 2}};
  manifest_.details["turned_views"] = 1;
  WriteManifest(directory_.path(), manifest_);
  const SketchDatabase sketches(directory_.path());
  EXPECT_EQ(sketches.num_views(), 1);
  EXPECT_EQ(sketches.num_turned_views(), 1);
  EXPECT_EQ(sketches.strokes(0, 1)[0].points.size(), 3u);
}

TEST_F(SketchDatabaseTest, DrawnViewsHaveTheCurvesOfTheExactOne) {
  manifest_.counts = {{"persons", 1}, {"faces", 1}, {"faces_per_shard", 1}, {"views_per_face", 2}};
  manifest_.details["version"] = SketchDatabase::kDrawnVersion;
  ExpectError([&] { WriteManifest(directory_.path(), manifest_), SketchDatabase(directory_.path()); }, "drawn_views");
  manifest_.details["drawn_views"] = 1;
  WriteManifest(directory_.path(), manifest_);
  const SketchDatabase sketches(directory_.path());
  EXPECT_EQ(sketches.num_views(), 2);
  EXPECT_EQ(sketches.num_drawn_views(), 1);
  EXPECT_EQ(sketches.labelled_view(0), 1);
  EXPECT_EQ(sketches.labelled_view(1), 1);
  EXPECT_EQ(sketches.strokes(0)[0].points.size(), 1u);
  EXPECT_EQ(sketches.curve_points(0), (std::vector<float>{7, 8, 9, 10, 11, 12}));
  EXPECT_FALSE(sketches.has_facts());
  for (const int drawn_views : {0, 2}) {
    manifest_.details["drawn_views"] = drawn_views;
    WriteManifest(directory_.path(), manifest_);
    ExpectError([&] { SketchDatabase(directory_.path()); }, "of 2 views are drawn");
  }
}

TEST(SketchKinds, LipsAndSuggestiveContoursAreWrinkles) {
  EXPECT_TRUE(IsWrinkleKind("wrinkle"));
  EXPECT_TRUE(IsWrinkleKind("lips"));
  EXPECT_FALSE(IsWrinkleKind("upper_mouth"));
}

TEST_F(SketchDatabaseTest, FacesOutsideAreRefused) {
  const SketchDatabase sketches(directory_.path());
  ExpectError([&] { sketches.strokes(2); }, "sketch 2, view 0, of a database of 2 faces");
  ExpectError([&] { sketches.strokes(-1); }, "sketch -1");
}

TEST_F(SketchDatabaseTest, DamagedShardsAreRefused) {
  Write({0, 1, 3, 2, 7});
  ExpectError([&] { SketchDatabase(directory_.path()); }, "stroke_offsets does not rise from 0 to 7 in 4 steps");
  Write({0, 1, 3, 6, 9});
  ExpectError([&] { SketchDatabase(directory_.path()); }, "stroke_offsets");
  Write({0, 1, 3, 6, 7});
  std::string bytes = ReadFile(directory_ / shard_);
  bytes.back() ^= 1;
  WriteFileAtomically(directory_ / shard_, bytes);
  ExpectError([&] { SketchDatabase(directory_.path()); }, shard_);
  WriteFileAtomically(directory_ / shard_, bytes.substr(0, 90));
  ExpectError([&] { SketchDatabase(directory_.path(), Checksums::kSkip); }, shard_);
  std::filesystem::remove(directory_ / shard_);
  ExpectError([&] { SketchDatabase(directory_.path()); }, shard_);
}

TEST_F(SketchDatabaseTest, KindsThatTheManifestDoesNotNameAreRefused) {
  manifest_.details["kinds"] = {"silhouette", "brow", "lips"};
  WriteManifest(directory_.path(), manifest_);
  ExpectError([&] { SketchDatabase(directory_.path()); }, "one of the 3 kinds");
}

TEST_F(SketchDatabaseTest, ManifestsOfOtherThingsAreRefused) {
  manifest_.kind = "faces";
  WriteManifest(directory_.path(), manifest_);
  ExpectError([&] { SketchDatabase(directory_.path()); }, "sketches");
  manifest_.kind = "sketches";
  manifest_.counts.erase("faces");
  WriteManifest(directory_.path(), manifest_);
  ExpectError([&] { SketchDatabase(directory_.path()); }, "malformed");
}

}  // namespace
}  // namespace daumier::datasets
