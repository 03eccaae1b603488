#include "export/parity.h"

#include "export/onnx_runtime_native.h"
#include "tests/export/test_function.h"
#include "tests/support/expect_error.h"

namespace daumier::exporting {
namespace {

using testing::TempDir;

ExportedFunction Scale(float factor) {
  return TestFunction({3}, [factor](const torch::Tensor& x) { return x * torch::full({3}, factor); });
}

std::filesystem::path WriteModel(const TempDir& folder, const ExportedFunction& function,
                                 const tensor::NamedTensors& weights) {
  WriteFileAtomically(folder / "model.onnx", ExportToOnnx(Weights(weights), function).SerializeAsString());
  return folder / "model.onnx";
}

TEST(Parity, FindsAModelWithOtherOutputs) {
  const TempDir folder;
  const auto weight = torch::full({3}, 2.0f);
  const auto function = TestFunction({3}, [weight](const torch::Tensor& x) { return x * weight; });
  const auto model = WriteModel(folder, function, {{"w", weight}});
  const auto report = CheckParity(model, function, 1, folder.path());
  if (!report.runtime.has_value()) GTEST_SKIP() << "no ONNX Runtime here; run ./dev setup";
  EXPECT_EQ(report.batch_sizes, (std::vector<int64_t>{1, 2, 5}));
  EXPECT_EQ(report.max_abs_diff(), 0);
  testing::ExpectError([&] { CheckParity(model, Scale(2.001f), 1, folder.path()); }, "in output 'y' at batch size");
  testing::ExpectError([&] { CheckParity(model, Scale(std::nanf("")), 1, folder.path()); }, "differ by nan");
}

TEST(Parity, JsonHoldsTheWorstDifferenceAndTheRuntime) {
  const ParityReport report{"onnxruntime 9", {1, 2}, {"u", "v"}, {1e-6, 3e-5}};
  EXPECT_EQ(report.max_abs_diff(), 3e-5);
  const Json json = ParityToJson(report);
  EXPECT_EQ(json["max_abs_diff"], 3e-5);
  EXPECT_EQ(json["runtime"], "onnxruntime 9");
  EXPECT_EQ(json["opset"], 13);
  EXPECT_EQ(json["format_version"], 1);
  EXPECT_EQ(json["outputs"]["u"], 1e-6);
}

TEST(Parity, WithoutARuntimeNothingIsClaimed) {
  if (HasNativeOnnxRuntime()) GTEST_SKIP() << "this build has ONNX Runtime itself";
  const TempDir folder;
  const WithoutNpmPackage without;
  const auto weight = torch::full({3}, 2.0f);
  const auto function = TestFunction({3}, [weight](const torch::Tensor& x) { return x * weight; });
  const auto report = CheckParity(WriteModel(folder, function, {{"w", weight}}), function, 1, folder.path());
  const Json json = ParityToJson(report);
  EXPECT_TRUE(json["runtime"].is_null());
  EXPECT_TRUE(json["max_abs_diff"].is_null());
  EXPECT_TRUE(json["outputs"]["y"].is_null());
}

}  // namespace
}  // namespace daumier::exporting
