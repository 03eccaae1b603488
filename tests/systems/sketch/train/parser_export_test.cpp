#include "systems/sketch/train/parser_export.h"

#include "core/files.h"
#include "export/onnx_export.h"
#include "export/parity.h"
#include "export/torch_runner.h"
#include "systems/sketch/train/parser_network.h"
#include "tests/fitting/drawn_circles.h"
#include "tests/support/expect_error.h"
#include "tests/support/parser_run_folder.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>
#include <torch/utils.h>

namespace daumier::sketch {
namespace {

TEST(ParserExport, OnnxAgreesWithLibTorchAtSeveralBatchSizes) {
  torch::manual_seed(3);
  const ParserNetworkOptions options{.resolution = 64, .width = 16, .point_width = 16};
  models::HeatMapUnet network = MakeParserNetwork(options);
  network->forward(torch::rand({4, 1, 64, 64}));  // Batch norms move away from 0 and 1.
  network->eval();
  const exporting::ExportedFunction function = ParserFunction(network, options);
  const testing::TempDir folder;
  WriteFileAtomically(folder / "model.onnx", exporting::ExportToOnnx(*network, function).SerializeAsString());
  const exporting::ParityReport report = exporting::CheckParity(folder / "model.onnx", function, 1, folder.path());
  if (!report.runtime) GTEST_SKIP() << "there is no ONNX Runtime to compare with";
  EXPECT_EQ(report.max_abs_diffs.size(), 3u);
  EXPECT_LT(report.max_abs_diff(), 1e-4);
}

TEST(ParserExport, AFunctionOfShippedWeightsHasTheSameInputsAndOutputs) {
  const ParserNetworkOptions options{.resolution = 64, .width = 16, .point_width = 16};
  const exporting::NetworkFunction made = MakeParserFunction(ToJson(options));
  EXPECT_EQ(made.function.inputs.at(0).shape, (std::vector<int64_t>{1, 64, 64}));
  EXPECT_EQ(made.function.output_names, (std::vector<std::string>{"heat_maps", "labels", "states"}));
}

TEST(OpenParserOfRun, ParsesAsTheNetworkOfTheRun) {
  const testing::TempDir folder;
  testing::WriteParserRun(folder / "run");
  const auto circles = fitting::Circles();
  const ParsedDrawing parsed = OpenParserOfRun(folder / "run").Parse(circles);
  const exporting::RunExport described = DescribeParserExport(folder / "run");
  const DrawingParser expected(ReadParserNetworkOptions(folder / "run"),
                               std::make_shared<exporting::TorchRunner>(exporting::NetworkOf(described), torch::kCPU));
  EXPECT_EQ(parsed.points, expected.Parse(circles).points);
  testing::ExpectError([&] { OpenParserOfRun(folder / "nowhere"); }, "nowhere");
}

}  // namespace
}  // namespace daumier::sketch
