#include "tests/export/lowering_example.h"
#include "tests/support/expect_error.h"

#include <torch/types.h>

namespace daumier::exporting {
namespace {

/// As torch::nn::Upsample with a scale calls it.
torch::Tensor Scaled(const torch::Tensor& x, double scale, bool bilinear) {
  const std::vector<double> scales = {scale, scale};
  if (bilinear) return torch::upsample_bilinear2d(x, c10::nullopt, false, scales);
  return torch::upsample_nearest2d(x, c10::nullopt, scales);
}

std::vector<Example> ImageExamples() {
  using Sizes = std::vector<int64_t>;
  const auto bilinear = [](Sizes size, bool align_corners) {
    return [=](auto& x, auto&) { return torch::upsample_bilinear2d(x, size, align_corners); };
  };
  const auto nearest = [](Sizes size) { return [=](auto& x, auto&) { return torch::upsample_nearest2d(x, size); }; };
  const auto adaptive = [](Sizes size) { return [=](auto& x, auto&) { return torch::adaptive_avg_pool2d(x, size); }; };
  return {
      {"aten::adaptive_avg_pool2d", "GlobalAveragePool", {5, 6, 4}, adaptive({1, 1})},
      {"aten::adaptive_avg_pool2d", "AveragePool", {5, 6, 4}, adaptive({3, 2})},
      {"aten::adaptive_avg_pool2d", "MatMul", {5, 6, 7}, adaptive({4, 5})},
      {"aten::avg_pool2d", "AveragePool", {5, 6, 7}, [](auto& x, auto&) { return torch::avg_pool2d(x, 2); }},
      {"aten::avg_pool2d", "Pad", {5, 6, 7}, [](auto& x, auto&) { return torch::avg_pool2d(x, 3, 2, 1); }},
      {"aten::avg_pool2d",
       "AveragePool",
       {5, 6, 7},
       [](auto& x, auto&) { return torch::avg_pool2d(x, 3, 2, 1, false, /*count_include_pad=*/false); }},
      {"aten::max_pool2d", "MaxPool", {5, 7, 7}, [](auto& x, auto&) { return torch::max_pool2d(x, 3, 2, 1); }},
      {"aten::max_pool2d", "MaxPool", {5, 6, 7}, [](auto& x, auto&) { return torch::max_pool2d(x, 2); }},
      {"aten::max_pool2d",
       "MaxPool",
       {5, 7, 7},  // The last window is whole.
       [](auto& x, auto&) { return torch::max_pool2d(x, 3, 2, 0, 1, /*ceil_mode=*/true); }},
      {"aten::upsample_bicubic2d",
       "MatMul",
       {5, 3, 4},
       [](auto& x, auto&) {
         return torch::upsample_bicubic2d(x, {6, 8}, false);
       }},
      {"aten::upsample_bilinear2d", "Resize", {5, 3, 4}, bilinear({6, 8}, false)},
      {"aten::upsample_bilinear2d", "Resize", {5, 3, 4}, bilinear({6, 12}, true)},
      {"aten::upsample_bilinear2d", "Resize", {5, 3, 4}, bilinear({7, 11}, false)},
      {"aten::upsample_bilinear2d", "Resize", {5, 3, 4}, bilinear({7, 11}, true)},
      {"aten::upsample_bilinear2d", "Resize", {5, 6, 4}, bilinear({3, 1}, false)},
      {"aten::upsample_bilinear2d", "Resize", {5, 3, 4}, [](auto& x, auto&) { return Scaled(x, 2, true); }},
      {"aten::upsample_bilinear2d",
       "MatMul",
       {5, 7, 7},  // Steps by 2, not by 7/3.
       [](auto& x, auto&) { return Scaled(x, 0.5, true); }},
      {"aten::upsample_nearest2d", "Resize", {5, 3, 4}, nearest({6, 12})},
      {"aten::upsample_nearest2d", "MatMul", {5, 6, 6}, nearest({9, 4})},
      {"aten::upsample_nearest2d", "Resize", {5, 3, 4}, [](auto& x, auto&) { return Scaled(x, 2, false); }},
      {"aten::upsample_nearest2d", "MatMul", {5, 7, 7}, [](auto& x, auto&) { return Scaled(x, 0.5, false); }},
  };
}

TEST(ImageLowerings, HaveTheOutputsOfLibTorch) {
  ExpectExamples(ImageLowerings(), ImageExamples());
}

TEST(ImageLowerings, AWindowBeyondThePaddingIsAnError) {
  const auto pool = TestFunction({2, 6, 6}, [](const auto& x) { return torch::max_pool2d(x, 3, 2, 0, 1, true); });
  testing::ExpectError([&] { ExportToOnnx(Weights(), pool); }, "ceil_mode adds a window");
}

}  // namespace
}  // namespace daumier::exporting
