#include "export/lowering.h"

#include "tests/export/lowering_example.h"
#include "tests/support/expect_error.h"

#include <torch/csrc/jit/ir/ir.h>

namespace daumier::exporting {
namespace {

using testing::ExpectError;

onnx::ModelProto Export(const tensor::NamedTensors& weights, const ExportedFunction& function) {
  return ExportToOnnx(Weights(weights), function);
}

TEST(Lowering, TheTableHasAllParts) {
  size_t num_operators = 1;  // aten::t, which is read where it is used.
  for (const Lowerings& part :
       {LayerLowerings(), ImageLowerings(), PointwiseLowerings(), ShapeLowerings(), ReductionLowerings()}) {
    for (const auto& [op, lowering] : part) EXPECT_EQ(LoweringTable().count(op), 1u) << op;
    num_operators += part.size();
  }
  EXPECT_EQ(LoweringTable().size(), num_operators);
}

TEST(Lowering, ATransposedWeightIsWhatItWouldBeInLibTorch) {
  const Example example{
      "aten::t", "Transpose", {3}, [](auto& x, auto& w) { return x.mm(w.at("w").t()); }, {{"w", torch::randn({5, 3})}}};
  ExpectExamples({{"aten::t", LoweringTable().at("aten::t")}}, {example});
}

TEST(Lowering, WhatReadsWeightsAndConstantsAloneIsComputedOnce) {
  const tensor::NamedTensors weights = {{"w", torch::arange(4, torch::kFloat32)}};
  const auto model = Export(weights, TestFunction({4}, [&](const torch::Tensor& x) {
                              return x + (weights.at("w").exp() * torch::ones({4})).view({1, 4});
                            }));
  EXPECT_EQ(OperatorsOf(model), (std::set<std::string>{"Add", "Identity"}));
  ASSERT_EQ(model.graph().initializer_size(), 1);
  const auto* values = reinterpret_cast<const float*>(model.graph().initializer(0).raw_data().data());
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(values[i], std::exp(float(i)), 1e-5);
}

TEST(Lowering, AConstantOfTheSizeOfTheBatchIsAnError) {
  const auto baked = TestFunction({4}, [](const torch::Tensor& x) { return x + torch::ones({x.size(0), 1}); });
  ExpectError([&] { Export({}, baked); }, "has the batch size baked in");
}

TEST(Lowering, UnknownOperatorIsAnErrorThatNamesItAndItsLine) {
  const auto cumulative = TestFunction({3}, [](const auto& x) { return x.relu().cumsum(1); });
  ExpectError([&] { Export({}, cumulative); }, "operator aten::cumsum cannot be exported to ONNX");
  ExpectError([&] { Export({}, cumulative); }, "= aten::cumsum(%");
}

}  // namespace
}  // namespace daumier::exporting
