#include "benchmark/baselines.h"

#include "benchmark/score.h"
#include "core/files.h"
#include "tests/support/expect_error.h"
#include "tests/support/small_kit.h"

#include <gtest/gtest.h>

namespace daumier::benchmark {
namespace {

using testing::SmallKit;

double MeanOfBaseline(KitTask task, Baseline baseline, KitSplit split = KitSplit::kTest) {
  const Kit kit(SmallKit());
  const testing::TempDir folder;
  WriteBaseline(kit, task, split, baseline, folder / "out");
  const KitScores scores = ScorePredictions(folder / "out", kit, task, split);
  EXPECT_EQ(scores.num_missing(), 0);
  EXPECT_EQ(scores.method.at("name"), kBaselineNames[size_t(baseline)]);
  const Json json = KitScoresToJson(scores);
  return json.at(task == KitTask::kLandmarks ? "nme_percent" : "vertex_error_mm").at("mean");
}

TEST(Baselines, OfEachTaskAreScored) {
  for (size_t task = 0; task < kKitTaskNames.size(); ++task)
    for (const Baseline baseline : {Baseline::kMean, Baseline::kNearest, Baseline::kRegression})
      EXPECT_GT(MeanOfBaseline(KitTask(task), baseline), 0) << kKitTaskNames[task];
}

TEST(Baselines, TheNearestNeighbourOfATrainingInputIsItself) {
  for (const KitTask task : {KitTask::kDrawings, KitTask::kCaricatures})
    EXPECT_LT(MeanOfBaseline(task, Baseline::kNearest, KitSplit::kTrain), 1e-3) << kKitTaskNames[size_t(task)];
}

TEST(Baselines, AShapeModelIsBetterThanTheMean) {
  const double mean = MeanOfBaseline(KitTask::kCaricatures, Baseline::kMean);
  EXPECT_LT(MeanOfBaseline(KitTask::kCaricatures, Baseline::kShapeModel), mean);
  EXPECT_LT(MeanOfBaseline(KitTask::kCaricatures, Baseline::kShapeModel3d), mean);
}

TEST(Baselines, PlacingTheMeanByTheTruthIsBetterThanTheMean) {
  EXPECT_LT(MeanOfBaseline(KitTask::kLandmarks, Baseline::kMeanPlaced),
            MeanOfBaseline(KitTask::kLandmarks, Baseline::kMean));
}

TEST(Baselines, FeaturesOfLandmarksAreFreeOfSimilarity) {
  const Kit kit(SmallKit());
  const eval::FaceRows features = FeaturesOf(kit, KitTask::kCaricatures, KitSplit::kTest);
  EXPECT_EQ(features.rows(), 6);
  EXPECT_EQ(features.cols(), 136);
  const double height = kit.face_template().neutral.col(1).maxCoeff() - kit.face_template().neutral.col(1).minCoeff();
  EXPECT_LT(features.cwiseAbs().maxCoeff(), 2 * height) << "in the size of the template, not in pixels";
}

TEST(Baselines, SayWhatTheyCannot) {
  testing::ExpectError([] { BaselineNamed("median"); },
                       "expected mean, nearest, regression, shape_model, shape_model_3d, mean_placed");
  const testing::TempDir folder;
  const Kit kit(SmallKit());
  testing::ExpectError(
      [&] { WriteBaseline(kit, KitTask::kDrawings, KitSplit::kTest, Baseline::kShapeModel, folder / "a"); },
      "--task caricatures");
  testing::ExpectError(
      [&] { WriteBaseline(kit, KitTask::kDrawings, KitSplit::kTest, Baseline::kMeanPlaced, folder / "a"); },
      "after a similarity");
  EXPECT_FALSE(std::filesystem::exists(folder / "a"));
}

}  // namespace
}  // namespace daumier::benchmark
