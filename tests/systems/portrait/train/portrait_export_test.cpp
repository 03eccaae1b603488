#include "systems/portrait/train/portrait_export.h"

#include "export/onnx_export.h"
#include "export/parity.h"
#include "tests/support/expect_error.h"
#include "tests/support/warnings.h"
#include "tests/systems/portrait/train/small_portrait_runs.h"

namespace daumier::portrait {
namespace {

TEST(PortraitFunction, HasTheNumbersOfTheNetworkWithExpressionsInRange) {
  torch::manual_seed(4);
  PortraitNetwork network(PortraitNetworkOptions{.depth = 18, .resolution = 32, .width = 8},
                          faces::ExpressionWeights::kUnit);
  {
    const torch::NoGradGuard no_grad;
    for (auto& parameter : network->parameters())
      if (parameter.abs().max().item<float>() == 0) parameter.normal_(0, 0.5);
  }
  network->eval();
  const exporting::ExportedFunction function = PortraitFunction(network);
  ASSERT_EQ(function.inputs.size(), 1U);
  Rng rng(1);
  const torch::Tensor crops = function.inputs[0].sample(3, rng);
  EXPECT_EQ(crops.sizes(), (std::vector<int64_t>{3, 3, 32, 32}));
  const torch::Tensor x = function.forward({crops})[0], expression = x.slice(1, 80, 144);
  EXPECT_GE(expression.min().item<float>(), 0);
  EXPECT_LE(expression.max().item<float>(), 1);
  EXPECT_TRUE(x.slice(1, 0, 80).allclose(network->forward(crops).slice(1, 0, 80)));
}

TEST(PortraitExport, DescribesAFinishedRunWhoseGraphAgreesWithLibTorch) {
  testing::AllowWarnings();  // There may be no runtime.
  const exporting::RunExport run = DescribePortraitExport(testing::SmallPortraitRun());
  EXPECT_EQ(run.counts.at("vertices"), testing::SyntheticFace().num_vertices());
  EXPECT_NE(run.card.inputs_and_outputs.find("3, 32, 32"), std::string::npos);
  const testing::TempDir folder;
  const Json parity = exporting::WriteExport(run, folder / "export");
  if (parity.at("max_abs_diff").is_number()) {
    EXPECT_LT(parity.at("max_abs_diff").get<double>(), 1e-4);
  }
  const faces::MorphableModel model = faces::ReadMorphableModel(folder / "export");
  EXPECT_EQ(model.expression_names, testing::SyntheticMorphable().expression_names);
  testing::ExpectError([] { DescribePortraitExport(testing::SmallPortraitFolder() / "portraits"); }, "portraits");
}

}  // namespace
}  // namespace daumier::portrait
