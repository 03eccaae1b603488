#include "systems/portrait/train/landmark_evaluation.h"

#include "core/files.h"
#include "systems/portrait/system.h"
#include "tests/support/expect_error.h"
#include "tests/support/landmark_run.h"

#include <gtest/gtest.h>

namespace daumier::portrait {
namespace {

class LandmarkEvaluationTest : public testing::LandmarkRunTest {};

TEST_F(LandmarkEvaluationTest, EvaluationMeasuresTheTestSideAndGivenPictures) {
  const std::filesystem::path pictures = folder() / "pictures";
  MakeDirectory(pictures);
  render::WriteImage(pictures / "1.png", testing::DrawnPortraits(1).Get(0).picture);
  std::string text;
  const std::vector<float> truth = testing::DrawnPortraits(1).Get(0).landmarks;
  for (size_t i = 0; i < truth.size(); i += 2) text += fmt::format("{} {}\n", truth[i], truth[i + 1]);
  WriteFileAtomically(pictures / "1.txt", text);
  FolderCache databases;
  const reports::Evaluation evaluation = EvaluateLandmarks(
      folder() / "run", {.pictures = pictures.string(), .negatives = pictures.string()}, databases, {});
  EXPECT_EQ(evaluation.table.rows.size(), 4u);
  EXPECT_EQ(evaluation.metrics.at("num_faces"), 4);
  EXPECT_EQ(evaluation.metrics.at("pictures").at("num"), 1);
  EXPECT_EQ(evaluation.metrics.at("negatives").at("num"), 1);
  EXPECT_TRUE(evaluation.sheet.has_value());
  EXPECT_EQ(LandmarkSystem().read_metrics(evaluation.metrics).rows.size(), 4u);
  reports::WriteEvaluation(folder() / "report", evaluation);
  testing::ExpectError([&] { EvaluateLandmarks(folder() / "run", {.data = {"/nowhere"}}, databases, {}); }, "nowhere");
}

}  // namespace
}  // namespace daumier::portrait
