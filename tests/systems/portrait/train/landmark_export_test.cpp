#include "systems/portrait/train/landmark_export.h"

#include "core/files.h"
#include "export/onnx_export.h"
#include "export/parity.h"
#include "systems/portrait/train/landmark_network.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>
#include <torch/utils.h>

namespace daumier::portrait {
namespace {

TEST(LandmarkExport, OnnxAgreesWithLibTorchAtSeveralBatchSizes) {
  torch::manual_seed(3);
  models::HeatMapUnet network = MakeLandmarkNetwork({.resolution = 64, .width = 8, .point_width = 16});
  network->forward(torch::rand({4, 3, 64, 64}));  // Batch norms move away from 0 and 1.
  network->eval();
  const exporting::ExportedFunction function = LandmarkFunction(network, 64);
  const testing::TempDir folder;
  WriteFileAtomically(folder / "model.onnx", exporting::ExportToOnnx(*network, function).SerializeAsString());
  const exporting::ParityReport report = exporting::CheckParity(folder / "model.onnx", function, 1, folder.path());
  if (!report.runtime) GTEST_SKIP() << "there is no ONNX Runtime to compare with";
  EXPECT_EQ(report.max_abs_diffs.size(), 4u);
  EXPECT_LT(report.max_abs_diff(), 1e-4);
}

}  // namespace
}  // namespace daumier::portrait
