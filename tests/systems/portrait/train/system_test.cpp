#include "systems/portrait/train/system.h"

#include "export/run_export.h"
#include "export/torch_runner.h"
#include "systems/portrait/landmark_predictor.h"
#include "systems/portrait/train/landmark_export.h"
#include "tests/support/expect_error.h"
#include "tests/support/landmark_run.h"
#include "tests/support/warnings.h"

#include <gtest/gtest.h>

namespace daumier::portrait {
namespace {

class PortraitTrainingsTest : public testing::LandmarkRunTest {};

TEST_F(PortraitTrainingsTest, TheRowOfTheTrainingLibraryExportsWithParityAndTimes) {
  testing::AllowWarnings();  // There may be no runtime.
  const systems::SystemTraining row = PortraitTrainings().front();
  EXPECT_EQ(row.name, kLandmarkSystem);
  EXPECT_EQ(row.validation_metric, "nme_percent");
  EXPECT_GT(row.infer_ms(folder() / "run"), 0);
  const Json parity = exporting::WriteExport(row.describe_export(folder() / "run"), folder() / "export");
  if (parity.at("max_abs_diff").is_number()) {
    EXPECT_LT(parity.at("max_abs_diff").get<double>(), 1e-4);
  }
}

TEST_F(PortraitTrainingsTest, AnUntrainedNetworkRefusesClutterInWords) {
  const exporting::RunExport run = DescribeLandmarkExport(folder() / "run");
  const LandmarkPredictor predictor({.resolution = 64}, std::make_shared<exporting::TorchRunner>(run, torch::kCPU),
                                    {.detector = {.least_confidence = 1}});
  const std::vector<systems::Input> inputs = {render::Image(90, 120, 3, 128)};
  testing::ExpectError([&] { predictor.Predict(inputs); }, "no face found in the picture of 120 x 90");
}

}  // namespace
}  // namespace daumier::portrait
