#include "export/onnx_runtime.h"

#include "export/onnx_runtime_native.h"
#include "tests/export/test_function.h"
#include "tests/support/expect_error.h"

namespace daumier::exporting {
namespace {

using testing::TempDir;

std::filesystem::path WriteDoubler(const TempDir& folder) {
  const auto model = ExportToOnnx(Weights(), TestFunction({3}, [](const torch::Tensor& x) { return x + x; }));
  WriteFileAtomically(folder / "model.onnx", model.SerializeAsString());
  return folder / "model.onnx";
}

TEST(OnnxRuntime, RunsEveryInputAtItsOwnBatchSize) {
  const TempDir folder;
  const auto one = torch::randn({1, 3}), four = torch::randn({4, 3});
  const auto result = RunInOnnxRuntime(WriteDoubler(folder), {{{"x", one}}, {{"x", four}}}, {"y"}, folder.path());
  if (!result.has_value()) GTEST_SKIP() << "no ONNX Runtime here; run ./dev setup";
  EXPECT_NE(result->runtime.find("onnxruntime"), std::string::npos);
  EXPECT_TRUE(torch::equal(result->outputs.at(0).at("y"), 2 * one));
  EXPECT_TRUE(torch::equal(result->outputs.at(1).at("y"), 2 * four));
}

TEST(OnnxRuntime, ReturnsTheMedianTimeOfEachRunIfRequested) {
  const TempDir folder;
  const auto model = WriteDoubler(folder);
  const std::vector<tensor::NamedTensors> runs = {{{"x", torch::zeros({1, 3})}}, {{"x", torch::zeros({4, 3})}}};
  const auto result = RunInOnnxRuntime(model, runs, {"y"}, folder.path(), 5);
  if (!result.has_value()) GTEST_SKIP() << "no ONNX Runtime here; run ./dev setup";
  ASSERT_EQ(result->milliseconds.size(), 2u);
  for (const double milliseconds : result->milliseconds) EXPECT_GT(milliseconds, 0);
  EXPECT_TRUE(RunInOnnxRuntime(model, runs, {"y"}, folder.path())->milliseconds.empty());
}

TEST(OnnxRuntime, ModelThatCannotBeLoadedIsAnErrorThatNamesIt) {
  const TempDir folder;
  const auto model = WriteDoubler(folder);
  if (!RunInOnnxRuntime(model, {{{"x", torch::zeros({1, 3})}}}, {"y"}, folder.path()).has_value()) {
    GTEST_SKIP() << "no ONNX Runtime here; run ./dev setup";
  }
  std::filesystem::resize_file(model, 20);
  testing::ExpectError(
      [&] {
        RunInOnnxRuntime(model, {{{"x", torch::zeros({1, 3})}}}, {"y"}, folder.path());
      },
      "ONNX Runtime cannot run " + model.string());
}

TEST(OnnxRuntime, IsNothingWhereNeitherLibraryNorPackageIsThere) {
  if (HasNativeOnnxRuntime()) GTEST_SKIP() << "this build has ONNX Runtime itself";
  const TempDir folder;
  const WithoutNpmPackage without;
  EXPECT_FALSE(
      RunInOnnxRuntime(WriteDoubler(folder), {{{"x", torch::zeros({1, 3})}}}, {"y"}, folder.path()).has_value());
}

}  // namespace
}  // namespace daumier::exporting
