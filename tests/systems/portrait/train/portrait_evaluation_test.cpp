#include "systems/portrait/train/portrait_evaluation.h"

#include "core/files.h"
#include "systems/portrait/portrait_metrics.h"
#include "systems/portrait/portrait_system.h"
#include "tests/support/expect_error.h"
#include "tests/support/warnings.h"
#include "tests/systems/portrait/train/small_portrait_runs.h"

namespace daumier::portrait {
namespace {

TEST(PortraitEvaluation, MeasuresUnseenPersonsByEveryRow) {
  testing::AllowWarnings();  // One of the two portraits has no detected landmarks.
  const testing::TempDir folder;
  FolderCache databases;
  const datasets::PortraitDatabase portraits(testing::SmallPortraitFolder() / "portraits");
  PortraitEvalOptions options{.max_images = 2, .refined_images = 1, .refinement_steps = 2};
  const reports::Evaluation first = EvaluatePortraitRun(testing::SmallPortraitRun(), options, databases);
  ASSERT_EQ(first.table.faces.size(), 2U);
  MakeDirectory(folder / "detected");
  std::string text;
  const std::vector<float> landmarks = portraits.landmarks(first.table.faces[0]);
  for (size_t n = 0; n < 68; ++n) text += fmt::format("{} {}\n", landmarks[2 * n], landmarks[2 * n + 1]);
  WriteFileAtomically(folder / fmt::format("detected/{}.txt", first.table.faces[0]), text);
  MakeDirectory(folder / "pictures");
  render::WriteImage(folder / "pictures/1.png", portraits.picture(first.table.faces[0]));
  WriteFileAtomically(folder / "pictures/1.txt", text);
  options.detected = (folder / "detected").string();
  options.pictures = (folder / "pictures").string();
  options.refined_images = 0;
  const reports::Evaluation evaluation = EvaluatePortraitRun(testing::SmallPortraitRun(), options, databases);
  std::vector<std::string> names;
  for (const reports::MetricRow& row : evaluation.table.rows) names.push_back(row.name);
  EXPECT_EQ(names, (std::vector<std::string>{
                       "network", "mean face, pose fitted", "landmark fit", "network, detected landmarks",
                       "mean face, pose fitted, detected landmarks", "landmark fit, detected landmarks"}));
  EXPECT_EQ(first.table.rows.at(1).name, "network, refined");
  EXPECT_EQ(reports::ValueOf(first.table, first.table.rows[1], "num_images"), 1);
  // The same network, portraits and crops: the same errors.
  EXPECT_EQ(first.table.rows[0].face_errors, evaluation.table.rows[0].face_errors);
  EXPECT_EQ(first.table.rows[0].face_errors[0], evaluation.table.rows[3].face_errors[0]);
  EXPECT_EQ(evaluation.metrics.at("vertex_error_mm"), evaluation.table.rows[0].error().mean);
  EXPECT_EQ(evaluation.metrics.at("num_persons"), 1);
  // The landmark fit sees the true landmarks.
  EXPECT_LT(*reports::ValueOf(evaluation.table, evaluation.table.rows[2], "landmark_error"),
            *reports::ValueOf(evaluation.table, evaluation.table.rows[1], "landmark_error"));
  reports::WriteEvaluation(folder / "report", evaluation);
  const reports::MetricTable read = PortraitSystem().read_metrics(reports::ReadMetrics(folder / "report"));
  EXPECT_EQ(read.rows.size(), names.size());
  EXPECT_DOUBLE_EQ(read.rows[0].error().mean, evaluation.table.rows[0].error().mean);
  const Manifest manifest = ReadManifest(folder / "report", "report");
  for (const char* name : {"sheet.png", "pictures.jpg", "all_pictures.jpg"}) {
    EXPECT_TRUE(std::filesystem::exists(folder / "report" / name)) << name;
    EXPECT_EQ(manifest.checksums.count(name), 1U) << name;
  }
  EXPECT_TRUE(first.pictures.empty());
}

TEST(PortraitEvaluation, RefusesOtherData) {
  FolderCache databases;
  testing::ExpectError(
      [&] { EvaluatePortraitRun(testing::SmallPortraitRun(), {.data = {.faces = "/nowhere"}}, databases); },
      "/nowhere");
  testing::ExpectError(
      [&] {
        EvaluatePortraitRun(testing::SmallPortraitRun(),
                            {.data = {.faces = (testing::SmallPortraitFolder() / "portraits").string()}}, databases);
      },
      "portraits");
}

}  // namespace
}  // namespace daumier::portrait
