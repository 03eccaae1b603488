#include "systems/portrait/train/landmark_training.h"

#include "core/files.h"
#include "core/run_manifest.h"
#include "export/run_export.h"
#include "export/torch_runner.h"
#include "systems/portrait/landmark_evaluation_options.h"
#include "systems/portrait/landmark_metrics.h"
#include "systems/portrait/landmark_options.h"
#include "systems/portrait/landmark_predictor.h"
#include "systems/portrait/train/landmark_evaluation.h"
#include "systems/portrait/train/landmark_export.h"
#include "systems/portrait/train/landmark_run.h"
#include "systems/portrait/train/system.h"
#include "tests/support/drawn_portrait_database.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>
#include <torch/utils.h>

#include <filesystem>
#include <memory>

namespace daumier::portrait {
namespace {

/// A run of one epoch on sixteen drawn portraits.
class LandmarkRunTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<testing::TempDir>();
    testing::WriteDrawnPortraits(*folder_ / "portraits", 16);
    Train(*folder_ / "run", false);
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static Json Config() {
    return {{"system", "landmarks"},
            {"data", {{"portraits", (*folder_ / "portraits").string()}}},
            {"network", {{"resolution", 64}, {"width", 8}, {"point_width", 16}}},
            {"split", {{"validation", 0.2}, {"test", 0.2}}},
            {"epochs", 1},
            {"batch", 4}};
  }
  static TrainingSummary Train(const std::filesystem::path& run, bool resume) {
    FolderCache databases;
    return TrainLandmarks(Config(), {run, resume, {}}, databases, {});
  }

  static std::unique_ptr<testing::TempDir> folder_;
};

std::unique_ptr<testing::TempDir> LandmarkRunTest::folder_;

TEST_F(LandmarkRunTest, LeavesARunFolderWithItsSplitAndGraph) {
  const LandmarkRun run = LoadLandmarkRun(*folder_ / "run");
  EXPECT_EQ(run.network_options.resolution, 64);
  EXPECT_FALSE(run.network->is_training());
  EXPECT_EQ(run.manifest.details.at("split").at("test").at("num_portraits"), 4);
  EXPECT_TRUE(std::filesystem::is_regular_file(*folder_ / "run" / kBestGraph));
  testing::ExpectError([&] { ReadLandmarkRunFolder(*folder_ / "portraits"); }, "portraits");
}

TEST_F(LandmarkRunTest, AFinishedRunResumesToItself) {
  const std::string before = ReadFile(BestWeights(*folder_ / "run"));
  EXPECT_EQ(Train(*folder_ / "run", true).best_epoch, 1);
  EXPECT_EQ(ReadFile(BestWeights(*folder_ / "run")), before);
}

TEST_F(LandmarkRunTest, EqualTrainingsGiveEqualWeights) {
  Train(*folder_ / "again", false);
  EXPECT_EQ(Sha256OfFile(BestWeights(*folder_ / "again")), Sha256OfFile(BestWeights(*folder_ / "run")));
}

TEST_F(LandmarkRunTest, EvaluationMeasuresTheTestSideAndGivenPictures) {
  const std::filesystem::path pictures = *folder_ / "pictures";
  MakeDirectory(pictures);
  render::WriteImage(pictures / "1.png", testing::DrawnPortraits(1).Get(0).picture);
  std::string text;
  const std::vector<float> truth = testing::DrawnPortraits(1).Get(0).landmarks;
  for (size_t i = 0; i < truth.size(); i += 2) text += fmt::format("{} {}\n", truth[i], truth[i + 1]);
  WriteFileAtomically(pictures / "1.txt", text);
  FolderCache databases;
  const reports::Evaluation evaluation = EvaluateLandmarks(
      *folder_ / "run", {.pictures = pictures.string(), .negatives = pictures.string()}, databases, {});
  EXPECT_EQ(evaluation.table.rows.size(), 4u);
  EXPECT_EQ(evaluation.metrics.at("num_faces"), 4);
  EXPECT_EQ(evaluation.metrics.at("pictures").at("num"), 1);
  EXPECT_EQ(evaluation.metrics.at("negatives").at("num"), 1);
  EXPECT_TRUE(evaluation.sheet.has_value());
  EXPECT_EQ(ReadLandmarkMetrics(evaluation.metrics).rows.size(), 4u);
  reports::WriteEvaluation(*folder_ / "report", evaluation);
  testing::ExpectError([&] { EvaluateLandmarks(*folder_ / "run", {.data = {"/nowhere"}}, databases, {}); }, "nowhere");
}

TEST_F(LandmarkRunTest, TheRowOfTheTrainingLibraryExportsWithParityAndTimes) {
  const systems::SystemTraining row = PortraitTrainings().front();
  EXPECT_EQ(row.name, kLandmarkSystem);
  EXPECT_EQ(row.validation_metric, "nme_percent");
  EXPECT_GT(row.infer_ms(*folder_ / "run"), 0);
  const Json parity = exporting::WriteExport(row.describe_export(*folder_ / "run"), *folder_ / "export");
  if (!parity.at("max_abs_diff").is_null()) EXPECT_LT(parity.at("max_abs_diff").get<double>(), 1e-4);
}

TEST_F(LandmarkRunTest, AnUntrainedNetworkRefusesClutterInWords) {
  const exporting::RunExport run = DescribeLandmarkExport(*folder_ / "run");
  const LandmarkPredictor predictor({.resolution = 64}, std::make_shared<exporting::TorchRunner>(run, torch::kCPU),
                                    {.detector = {.least_confidence = 1}});
  const std::vector<systems::Input> inputs = {render::Image(90, 120, 3, 128)};
  testing::ExpectError([&] { predictor.Predict(inputs); }, "no face found in the picture of 120 x 90");
}

}  // namespace
}  // namespace daumier::portrait
