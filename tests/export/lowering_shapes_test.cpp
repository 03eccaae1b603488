#include "tests/export/lowering_example.h"
#include "tests/support/expect_error.h"

#include <torch/nn/functional.h>

namespace daumier::exporting {
namespace {

std::vector<Example> ShapeExamples() {
  using Shape = std::vector<int64_t>;
  namespace F = torch::nn::functional;
  const auto pad = [](F::PadFuncOptions options) { return [=](auto& x, auto&) { return F::pad(x, options); }; };
  const auto stack = [](auto& x, auto&) { return torch::stack({x, x.relu()}, -1); };
  const auto cat = [](int64_t axis) { return [=](auto& x, auto&) { return torch::cat({x, x.relu()}, axis); }; };
  return {
      {"aten::_pad_enum", "Pad", {5, 6, 6}, pad(F::PadFuncOptions({1, 2, 0, 1}).value(2))},
      {"aten::_pad_enum", "Pad", {5, 6, 6}, pad(F::PadFuncOptions({1, 2, 1, 1}).mode(torch::kReflect))},
      {"aten::_pad_enum", "Pad", {5, 6, 6}, pad(F::PadFuncOptions({1, 2, 1, 1}).mode(torch::kReplicate))},
      {"aten::cat", "Concat", {5, 3, 4}, cat(1)},
      {"aten::cat", "Concat", {5, 4}, cat(-1)},
      {"aten::clone", "Identity", {4}, [](auto& x, auto&) { return x.clone(); }},
      {"aten::constant_pad_nd",
       "Pad",
       {5, 6, 6},
       [](auto& x, auto&) {
         return torch::constant_pad_nd(x, Shape{1, 0, 2, 1});
       }},
      {"aten::contiguous", "Transpose", {5, 4}, [](auto& x, auto&) { return x.transpose(1, 2).contiguous(); }},
      {"aten::detach", "Identity", {4}, [](auto& x, auto&) { return x.detach(); }},
      {"aten::expand",
       "Expand",
       {5},
       [](auto& x, auto&) {
         return x.unsqueeze(2).expand({-1, -1, 7});
       },
       {},
       false},
      {"aten::expand_as",
       "Add",
       {5, 3, 4},  // Arithmetic repeats by itself.
       [](auto& x, auto& w) {
         return x + w.at("w").view({1, 5, 1, 1}).expand_as(x);
       },
       {{"w", torch::randn({5})}}},
      {"aten::flatten", "Flatten", {5, 3}, [](auto& x, auto&) { return x.flatten(1); }},
      {"aten::flatten", "Reshape", {5, 3, 4}, [](auto& x, auto&) { return x.flatten(2); }},
      {"aten::flatten", "Reshape", {5, 3, 4}, [](auto& x, auto&) { return x.flatten(1, 2); }},
      {"aten::flatten", "Reshape", {5, 3, 4}, [](auto& x, auto&) { return x.flatten(0, 1); }},
      {"aten::narrow", "Slice", {6}, [](auto& x, auto&) { return x.narrow(1, 2, 3); }},
      {"aten::permute",
       "Transpose",
       {5, 3, 4},
       [](auto& x, auto&) {
         return x.permute({0, 2, -1, 1});
       }},
      {"aten::reshape",
       "Reshape",
       {6},
       [](auto& x, auto&) {
         return x.reshape({-1, 2, 3});
       }},
      {"aten::reshape",
       "Reshape",
       {6},
       [](auto& x, auto&) {
         return x.reshape({x.size(0), 2, 3});
       }},
      {"aten::select", "Slice", {5, 3, 4}, [](auto& x, auto&) { return x.select(1, 2); }},
      {"aten::select", "Slice", {5, 4}, [](auto& x, auto&) { return x.select(-1, -1); }},
      {"aten::slice", "Slice", {6}, [](auto& x, auto&) { return x.slice(1, 1, 4); }},
      {"aten::slice", "Slice", {5, 6, 6}, [](auto& x, auto&) { return x.slice(2, 1, 6, /*step=*/2); }},
      {"aten::slice", "Slice", {5, 6, 6}, [](auto& x, auto&) { return x.slice(0).slice(-1, -2); }},
      {"aten::squeeze", "Reshape", {1, 4}, [](auto& x, auto&) { return x.squeeze(1); }},
      {"aten::stack", "Concat", {5}, stack},
      {"aten::stack", "Concat", {5, 4}, stack},
      {"aten::to", "Relu", {4}, [](auto& x, auto&) { return x.relu().to(torch::kFloat32, false, /*copy=*/true); }},
      {"aten::transpose", "Transpose", {3, 4}, [](auto& x, auto&) { return x.transpose(1, 2); }},
      {"aten::unflatten",
       "Reshape",
       {12},
       [](auto& x, auto&) {
         return x.unflatten(1, {3, 4});
       }},
      {"aten::unsqueeze", "Reshape", {5, 4}, [](auto& x, auto&) { return x.unsqueeze(-1); }},
      {"aten::view",
       "Reshape",
       {5, 4},
       [](auto& x, auto&) {
         return x.view({x.size(0), -1});
       }},
  };
}

TEST(ShapeLowerings, HaveTheOutputsOfLibTorch) {
  ExpectExamples(ShapeLowerings(), ShapeExamples());
}

TEST(ShapeLowerings, AViewOfTheBatchKeepsItFree) {
  const auto model = ExportToOnnx(Weights(), TestFunction({6}, [](const auto& x) {
                                    return x.view({x.size(0), 2, 3});
                                  }));
  ASSERT_EQ(model.graph().initializer_size(), 1);
  const auto* shape = reinterpret_cast<const int64_t*>(model.graph().initializer(0).raw_data().data());
  EXPECT_EQ(std::vector<int64_t>(shape, shape + 3), (std::vector<int64_t>{0, 2, 3}));
}

TEST(ShapeLowerings, UsesThatAreNotCoveredAreErrors) {
  const auto expect = [](torch::Tensor (*function)(const torch::Tensor&), const char* message) {
    testing::ExpectError([&] { ExportToOnnx(Weights(), TestFunction({4, 4}, function)); }, message);
  };
  expect([](const torch::Tensor& x) { return x.select(0, 1); }, "it takes one sample out of the batch");
  expect([](const torch::Tensor& x) { return x.to(torch::kFloat64); }, "the result is not float32");
  expect([](const torch::Tensor& x) { return torch::stack({x, x}, 0); }, "the batch cannot be stacked");
  expect([](const torch::Tensor& x) { return x.chunk(2, 1)[0]; }, "aten::chunk cannot be exported");
}

}  // namespace
}  // namespace daumier::exporting
