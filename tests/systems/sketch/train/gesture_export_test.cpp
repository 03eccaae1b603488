#include "systems/sketch/train/gesture_export.h"

#include "core/files.h"
#include "core/weights_folder.h"
#include "export/onnx_export.h"
#include "export/parity.h"
#include "export/weights.h"
#include "systems/sketch/gesture_recogniser.h"
#include "systems/sketch/train/gesture_evaluation.h"
#include "systems/sketch/train/gesture_network.h"
#include "tests/support/gesture_run.h"

#include <gtest/gtest.h>
#include <torch/utils.h>

namespace daumier::sketch {
namespace {

TEST(GestureExport, OnnxAgreesWithLibTorchForBothKinds) {
  for (const char* kind : {"compact", "paper"}) {
    torch::manual_seed(3);
    const GestureNetworkOptions options{.kind = kind};
    torch::nn::Sequential network = MakeGestureNetwork(options);
    const int side = options.raster().side;
    network->forward(torch::rand({4, 1, side, side}));  // Batch norms move away from 0 and 1.
    network->eval();
    const exporting::ExportedFunction function = GestureFunction(network, options);
    const testing::TempDir folder;
    WriteFileAtomically(folder / "model.onnx", exporting::ExportToOnnx(*network, function).SerializeAsString());
    const exporting::ParityReport report = exporting::CheckParity(folder / "model.onnx", function, 1, folder.path());
    if (!report.runtime) GTEST_SKIP() << "there is no ONNX Runtime to compare with";
    EXPECT_LT(report.max_abs_diff(), 1e-4) << kind;
  }
}

class GestureWeightsTest : public testing::GestureRunTest {};

TEST_F(GestureWeightsTest, RecogniseAsTheRunWithItsThreshold) {
  FolderCache databases;
  reports::WriteEvaluation(folder() / "run" / "report", EvaluateGestures(folder() / "run", {}, databases, {}));
  exporting::WriteWeights(DescribeGestureExport(folder() / "run"), MakeGestureFunction, {.out = folder() / "weights"});
  EXPECT_EQ(ReadGestureDecision(folder() / "weights").rejection.threshold,
            ReadGestureDecision(folder() / "run").rejection.threshold);
  const datasets::Polyline stroke = {{0, 0}, {100, 3}, {80, 20}};
  EXPECT_NEAR(OpenGestureRecogniser(folder() / "weights").Recognise(stroke).probability,
              OpenGestureRecogniser(folder() / "run").Recognise(stroke).probability, 0.01);
  uintmax_t bytes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder() / "weights")) bytes += entry.file_size();
  EXPECT_LE(bytes, 1'000'000u);
}

}  // namespace
}  // namespace daumier::sketch
