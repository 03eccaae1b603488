#include "export/onnx_runtime.h"
#include "runtime/graph_runner.h"
#include "runtime/onnx_file.h"
#include "tensor/array.h"
#include "tests/support/paths.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::exporting {
namespace {

/// Networks in the form of other exporters (tests/fuzz/make_style_networks.py).
TEST(StyleNetworks, HaveTheOutputsOfOnnxRuntime) {
  const testing::TempDir folder;
  for (const char* name : {"style_nearest", "style_groups", "style_last", "style_transposed", "shapes"}) {
    SCOPED_TRACE(name);
    const auto model = testing::SourceRoot() / "tests/fuzz/seeds/onnx" / (std::string(name) + ".onnx");
    const runtime::Graph graph = runtime::ReadOnnx(model);
    torch::manual_seed(5);
    const torch::Tensor x = torch::rand(graph.inputs.at(0).shape);
    const auto expected = RunInOnnxRuntime(model, {{{"x", x}}}, {"y"}, folder.path());
    if (!expected.has_value()) GTEST_SKIP() << "no ONNX Runtime here; run ./dev setup";
    const FloatArray found = runtime::GraphRunner(graph).Run({{"x", tensor::CopyToArray<float>(x)}}).at("y");
    const torch::Tensor y = expected->outputs.at(0).at("y");
    ASSERT_EQ(found.shape, y.sizes().vec());
    const torch::Tensor difference = torch::from_blob(const_cast<float*>(found.values.data()), y.sizes()) - y;
    // ONNX Runtime sums the moments of norms in float32, ours are of float64.
    EXPECT_LE(difference.abs().max().item<float>(), 3e-5f * y.abs().max().item<float>());
  }
}

}  // namespace
}  // namespace daumier::exporting
