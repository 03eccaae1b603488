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
  EXPECT_EQ(report.batch_sizes.empty(), !report.runtime.has_value());
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
  ParityReport with_inputs = report;
  with_inputs.sample_texts = {{"x", "crops of portraits"}};
  EXPECT_EQ(ParityToJson(with_inputs)["inputs"]["x"], "crops of portraits");
}

TEST(Parity, OpenCvIsComparedAtTheNumberOfChannels) {
  const TempDir folder;
  const auto weight = torch::randn({7, 2, 3, 3});
  const auto function = TestFunction({2, 6, 6}, [weight](const torch::Tensor& x) { return torch::conv2d(x, weight); });
  const auto model = WriteModel(folder, function, {{"w", weight}});
  const OtherRuntime same = CompareWithOpenCv(model, function, 1);
  EXPECT_EQ(same.batch_sizes, (std::vector<int64_t>{1, 2, 7}));
  EXPECT_TRUE(same.agrees());
  EXPECT_EQ(same.runtime.rfind("OpenCV ", 0), 0u);
  const auto doubled =
      TestFunction({2, 6, 6}, [weight](const torch::Tensor& x) { return 2 * torch::conv2d(x, weight); });
  const OtherRuntime other = CompareWithOpenCv(model, doubled, 1);
  EXPECT_FALSE(other.agrees());
  EXPECT_NEAR(other.max_relative_diff.value(), 0.5, 1e-4);
}

TEST(Parity, WhatOpenCvRefusesIsAFinding) {
  const TempDir folder;
  const auto function = TestFunction({3}, [](const torch::Tensor& x) { return x.clamp(-100, 100); });
  const auto model = WriteModel(folder, function, {});
  const OtherRuntime refused = CompareWithOpenCv(model, function, 1);
  EXPECT_FALSE(refused.agrees());
  EXPECT_NE(refused.refusal.value().find("OpenCV cannot run"), std::string::npos);
  const Json json = ParityToJson({std::nullopt, {1}, {"y"}, {}, {refused}});
  EXPECT_EQ(json["other_runtimes"][0]["refusal"], *refused.refusal);
  EXPECT_TRUE(json["other_runtimes"][0]["max_relative_diff"].is_null());
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
