#include "eval/drawing_labels.h"

#include "core/files.h"
#include "core/json.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::eval {
namespace {

using testing::ExpectError;

std::vector<LabelledDrawing> LabelsOf(const Json& drawings) {
  const testing::TempDir folder;
  WriteFileAtomically(folder / "labels.json", Json{{"about", "..."}, {"drawings", drawings}}.dump());
  return ReadDrawingLabels(folder / "labels.json");
}

const Json kPoints = {{"chin", {30.5, 80}}, {"mouth_left", {40, 60}}, {"mouth_right", nullptr}};

TEST(ReadDrawingLabels, ReadsPointsStatesAndFiles) {
  const auto drawings =
      LabelsOf({{"b", {{"file", "b.png"}, {"points", kPoints}, {"interocular", 40.5}, {"mouth", "teeth"}}},
                {"a-2", {{"file", "a.ndjson"}, {"line", 2}, {"points", kPoints}, {"usable", false}, {"eyes", nullptr}}},
                {"c", {{"file", "c.svg"}, {"points", kPoints}, {"interocular", nullptr}, {"eyes", "closed"}}}});
  ASSERT_EQ(drawings.size(), 3U);
  EXPECT_EQ(drawings[0].name, "b") << "in the order of the file";
  EXPECT_EQ(drawings[0].group, "pictures");
  EXPECT_EQ(drawings[0].file.filename(), "b.png");
  EXPECT_EQ(drawings[0].interocular, 40.5);
  EXPECT_EQ(drawings[0].mouth, faces::MouthState::kTeeth);
  EXPECT_FALSE(drawings[0].eyes.has_value());
  EXPECT_EQ(drawings[0].points[size_t(faces::FacePoint::kChin)], Eigen::Vector2d(30.5, 80));
  EXPECT_FALSE(drawings[0].points[size_t(faces::FacePoint::kMouthRight)].has_value());
  EXPECT_TRUE(drawings[0].is_scored());
  EXPECT_EQ(drawings[1].group, "doodles");
  EXPECT_EQ(drawings[1].line, 2);
  EXPECT_FALSE(drawings[1].is_scored()) << "not usable";
  EXPECT_EQ(drawings[2].eyes, faces::EyeState::kClosed);
  EXPECT_FALSE(drawings[2].is_scored()) << "without a unit";
}

TEST(ReadDrawingLabels, RefusesWhatItDoesNotKnow) {
  const auto with = [](const char* key, const Json& value) {
    Json drawing = {{"file", "b.png"}, {"points", kPoints}, {"interocular", 40}};
    drawing[key] = value;
    return Json{{"face", drawing}};
  };
  ExpectError([&] { LabelsOf(with("points", {{"chinn", {1, 2}}})); }, "drawing 'face': there is no point 'chinn'");
  ExpectError([&] { LabelsOf(with("points", {{"chinn", {1, 2}}})); }, "did you mean 'chin'?");
  ExpectError([&] { LabelsOf(with("mouth", "smiling")); },
              "there is no mouth 'smiling' (expected closed, open, teeth)");
  ExpectError([&] { LabelsOf(with("points", {{"chin", {1, 2, 3}}})); }, "chin has 3 numbers");
  ExpectError([&] { LabelsOf(with("points", {{"chin", {1, 2}}, {"contour_left", {1, 2}}})); }, "expected 2 or more");
  ExpectError([&] { LabelsOf(with("interocular", "wide")); }, "drawing 'face' is malformed");
  ExpectError([&] { LabelsOf(with("interocular", -1)); }, "interocular is -1");
  ExpectError([&] { LabelsOf(Json::object()); }, "no labels of drawings");
}

TEST(ReadDrawingLabels, ReadsTheSharedLabels) {
  const auto shared = testing::SharedData();
  if (!shared || !std::filesystem::exists(*shared / "sketches/landmarks.json"))
    GTEST_SKIP() << "no labelled drawings next to the checkout";
  int num_scored = 0;
  for (const LabelledDrawing& drawing : ReadDrawingLabels(*shared / "sketches/landmarks.json")) {
    num_scored += drawing.is_scored() ? 1 : 0;
    EXPECT_TRUE(std::filesystem::exists(drawing.file)) << drawing.name;
  }
  EXPECT_EQ(num_scored, 18);
}

}  // namespace
}  // namespace daumier::eval
