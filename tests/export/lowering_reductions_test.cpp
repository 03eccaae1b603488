#include "tests/export/lowering_example.h"
#include "tests/support/expect_error.h"

namespace daumier::exporting {
namespace {

std::vector<Example> ReductionExamples() {
  const std::vector<int64_t> image = {5, 3, 4}, rows = {5, 6};
  return {
      {"aten::amax", "ReduceMax", rows, [](auto& x, auto&) { return x.amax(2); }},
      {"aten::amax", "ReduceMax", image,
       [](auto& x, auto&) {
         return x.amax({-2, -1}, /*keepdim=*/true);
       }},
      {"aten::amin", "ReduceMin", rows, [](auto& x, auto&) { return x.amin(1); }},
      {"aten::log_softmax", "LogSoftmax", rows, [](auto& x, auto&) { return x.log_softmax(-1); }},
      {"aten::mean", "GlobalAveragePool", image,
       [](auto& x, auto&) {
         return x.mean({2, 3});
       }},
      {"aten::mean", "GlobalAveragePool", image,
       [](auto& x, auto&) {
         return x.mean({-1, -2}, true);
       }},
      {"aten::mean", "ReduceMean", image, [](auto& x, auto&) { return x.mean(3); }},
      {"aten::mean", "ReduceMean", image, [](auto& x, auto&) { return x.mean(std::vector<int64_t>{1}, true); }},
      {"aten::mean", "ReduceMean", rows, [](auto& x, auto&) { return x.mean(-1); }},
      {"aten::softmax", "Softmax", rows, [](auto& x, auto&) { return x.softmax(-1); }},
      {"aten::softmax", "Softmax", image, [](auto& x, auto&) { return x.softmax(1); }},
      {"aten::sum", "Mul", image,
       [](auto& x, auto&) {
         return x.sum({2, 3});
       }},
      {"aten::sum", "Mul", rows, [](auto& x, auto&) { return x.sum(std::vector<int64_t>{-1}, true); }},
  };
}

TEST(ReductionLowerings, HaveTheOutputsOfLibTorch) {
  ExpectExamples(ReductionLowerings(), ReductionExamples());
}

TEST(ReductionLowerings, ReductionsOfTheBatchAreErrors) {
  const auto expect = [](torch::Tensor (*function)(const torch::Tensor&), const char* message) {
    testing::ExpectError([&] { ExportToOnnx(Weights(), TestFunction({4}, function)); }, message);
  };
  expect([](const torch::Tensor& x) { return x.mean(); }, "it reduces all axes, the batch among them");
  expect([](const torch::Tensor& x) { return x.sum(0); }, "it sums over the batch");
}

}  // namespace
}  // namespace daumier::exporting
