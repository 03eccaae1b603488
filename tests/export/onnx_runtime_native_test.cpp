#include "export/onnx_runtime_native.h"

#include "tests/export/test_function.h"
#include "tests/support/expect_error.h"

namespace daumier::exporting {
namespace {

TEST(NativeOnnxRuntime, RunsOrIsAnErrorWhereThisBuildHasNone) {
  const testing::TempDir folder;
  const auto model = ExportToOnnx(Weights(), TestFunction({3}, [](const torch::Tensor& x) { return x + x; }));
  WriteFileAtomically(folder / "model.onnx", model.SerializeAsString());
  const auto x = torch::ones({2, 3});
  const auto run = [&] { return RunInNativeOnnxRuntime(folder / "model.onnx", {{{"x", x}}}, {"y"}); };
  if (HasNativeOnnxRuntime()) {
    EXPECT_TRUE(torch::equal(run().outputs.at(0).at("y"), x + x));
  } else {
    testing::ExpectError(run, "no native ONNX Runtime");
  }
}

}  // namespace
}  // namespace daumier::exporting
