#include "export/opencv_runtime.h"

#include "tests/export/test_function.h"
#include "tests/support/expect_error.h"

namespace daumier::exporting {
namespace {

TEST(OpenCvRuntime, RunsEveryInputAtItsOwnBatchSize) {
  const testing::TempDir folder;
  const auto model = ExportToOnnx(Weights(), TestFunction({3, 2, 2}, [](const torch::Tensor& x) { return x + x; }));
  WriteFileAtomically(folder / "model.onnx", model.SerializeAsString());
  const auto one = torch::randn({1, 3, 2, 2}), four = torch::randn({4, 3, 2, 2});
  const auto result = RunInOpenCv(folder / "model.onnx", {{{"x", one}}, {{"x", four}}}, {"y"});
  EXPECT_EQ(result.runtime, OpenCvName());
  EXPECT_TRUE(torch::equal(result.outputs.at(0).at("y"), 2 * one));
  EXPECT_TRUE(torch::equal(result.outputs.at(1).at("y"), 2 * four));
}

TEST(OpenCvRuntime, ModelThatCannotBeLoadedOrRunIsAnErrorThatNamesIt) {
  const testing::TempDir folder;
  const std::filesystem::path file = folder / "model.onnx";
  WriteFileAtomically(file, "no model");
  testing::ExpectError([&] { RunInOpenCv(file, {}, {"y"}); }, "OpenCV cannot run " + file.string());
  // A kernel without its optional shape, as other writers leave it.
  const auto weight = torch::randn({2, 1, 3, 3});
  auto model = ExportToOnnx(Weights({{"w", weight}}),
                            TestFunction({1, 5, 5}, [&](const torch::Tensor& x) { return torch::conv2d(x, weight); }));
  auto& attributes = *model.mutable_graph()->mutable_node(0)->mutable_attribute();
  for (int i = 0; i < attributes.size(); ++i)
    if (attributes[i].name() == "kernel_shape") attributes.DeleteSubrange(i, 1);
  WriteFileAtomically(file, model.SerializeAsString());
  testing::ExpectError([&] { RunInOpenCv(file, {{{"x", torch::zeros({1, 1, 5, 5})}}}, {"y"}); }, "OpenCV cannot run");
}

}  // namespace
}  // namespace daumier::exporting
