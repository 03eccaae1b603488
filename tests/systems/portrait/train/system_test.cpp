#include "systems/portrait/train/system.h"

#include "core/files.h"
#include "core/run_manifest.h"
#include "export/run_export.h"
#include "export/torch_runner.h"
#include "export/weights.h"
#include "systems/portrait/landmark_predictor.h"
#include "systems/portrait/train/landmark_export.h"
#include "tests/support/drawn_portraits.h"
#include "tests/support/expect_error.h"
#include "tests/support/landmark_run.h"
#include "tests/support/warnings.h"

#include <gtest/gtest.h>

namespace daumier::portrait {
namespace {

class PortraitTrainingsTest : public testing::LandmarkRunTest {};

std::filesystem::path MakeReport(const std::filesystem::path& run) {
  MakeDirectory(ReportDirectory(run));
  return ReportDirectory(run);
}

TEST_F(PortraitTrainingsTest, TheRowOfTheTrainingLibraryExportsWithParityAndTimes) {
  testing::AllowWarnings();  // There may be no runtime.
  const systems::SystemTraining row = PortraitTrainings().front();
  EXPECT_EQ(row.name, kLandmarkSystem);
  EXPECT_EQ(row.validation_metric, "nme_percent");
  EXPECT_GT(row.infer_ms(folder() / "run"), 0);
  const Json parity = exporting::WriteExport(row.describe_export(folder() / "run"), folder() / "export");
  EXPECT_EQ(parity.at("inputs").at("pictures"), "crops of portraits");
  if (parity.at("max_abs_diff").is_number()) {
    EXPECT_LT(parity.at("max_abs_diff").get<double>(), 1e-4);
  }
}

/// Two networks, one of them in float16, on a face that is given.
TEST_F(PortraitTrainingsTest, ShippedLandmarkWeightsFindTheLandmarksOfTheRun) {
  WriteFileAtomically(MakeReport(folder() / "run") / "metrics.json", "{}");
  const systems::SystemTraining row = LandmarkTraining();
  exporting::WriteWeights(row.describe_export(folder() / "run"), row.make_network, {.out = folder() / "landmarks"});
  const Manifest manifest = ReadWeights(folder() / "landmarks", kLandmarkSystem, {kWeightsNetwork});
  const LandmarkNetworkOptions options = ReadLandmarkNetworkOptions(folder() / "landmarks");
  EXPECT_EQ(ToJson(options), ToJson(ReadLandmarkNetworkOptions(folder() / "run")));
  const auto detector = [&](const exporting::NetworkFunction& network) {
    return LandmarkDetector(options, std::make_shared<exporting::TorchRunner>(network, torch::kCPU));
  };
  const LandmarkDetector of_run = detector(NetworkOf(row.describe_export(folder() / "run")));
  const LandmarkDetector shipped =
      detector(exporting::ReadWeightsNetwork(folder() / "landmarks", manifest.details, row.make_network));
  const LandmarkSample sample = testing::DrawnPortraits(1).Get(0);
  const DetectedFace face = of_run.FindIn(sample.picture, BoxOf(sample.landmarks)),
                     other = shipped.FindIn(sample.picture, BoxOf(sample.landmarks));
  for (size_t i = 0; i < face.landmarks.size(); ++i) EXPECT_NEAR(face.landmarks[i], other.landmarks[i], 0.5);
  EXPECT_NEAR(face.confidence, other.confidence, 0.02);
}

TEST_F(PortraitTrainingsTest, AnUntrainedNetworkRefusesClutterInWords) {
  const auto network = NetworkOf(DescribeLandmarkExport(folder() / "run"));
  const LandmarkPredictor predictor({.resolution = 64}, std::make_shared<exporting::TorchRunner>(network, torch::kCPU),
                                    {.detector = {.least_confidence = 1}});
  const std::vector<systems::Input> inputs = {render::Image(90, 120, 3, 128)};
  testing::ExpectError([&] { predictor.Predict(inputs); }, "no face found in the picture of 120 x 90");
}

}  // namespace
}  // namespace daumier::portrait
