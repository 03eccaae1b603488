#include "tests/runtime/graph_example.h"
#include "tests/support/expect_error.h"

#include <cmath>

namespace daumier::runtime {
namespace {

/// A norm by its definition: `rows` rows of `x`, each of `runs` runs with a scale and a shift of its own.
FloatArray Normalised(const FloatArray& x, int64_t rows, int64_t runs, const std::vector<float>& scales,
                      const std::vector<float>& shifts, double epsilon) {
  FloatArray y = x;
  const size_t size = x.values.size() / size_t(rows), length = size / size_t(runs);
  for (size_t r = 0; r < size_t(rows); ++r) {
    double mean = 0, variance = 0;
    for (size_t i = 0; i < size; ++i) mean += x.values[r * size + i] / double(size);
    for (size_t i = 0; i < size; ++i) variance += std::pow(x.values[r * size + i] - mean, 2) / double(size);
    for (size_t i = 0; i < size; ++i) {
      const size_t kind = (r * size_t(runs) + i / length) % scales.size();
      y.values[r * size + i] =
          float((x.values[r * size + i] - mean) / std::sqrt(variance + epsilon) * scales[kind] + shifts[kind]);
    }
  }
  return y;
}

TEST(RuntimeNorms, OfImagesFollowTheirDefinition) {
  const FloatArray x = FixedArray({2, 3, 4, 5});
  const std::vector<float> scales = {1, 2, -3}, shifts = {0, 0.5f, 1};
  GraphExample example({-1, 3, 4, 5});
  example.Weight("s", {3}, scales).Weight("t", {3}, shifts);
  example.Node("InstanceNormalization", {"x", "s", "t"}, "y", {{"epsilon", 0.1f}});
  ExpectNear(example.Run(x), Normalised(x, 6, 1, scales, shifts, 0.1), 1e-6);
  GraphExample wrong({-1, 4, 4, 5});
  wrong.Weight("s", {3}, scales).Weight("t", {3}, shifts).Node("InstanceNormalization", {"x", "s", "t"}, "y");
  testing::ExpectError([&] { wrong.Run(FloatArray({1, 4, 4, 5})); }, "input 1 has 3 numbers, expected 4");
}

TEST(RuntimeNorms, OfImagesInBlocksEqualThoseOfPlainOnes) {
  for (const int64_t channels : {12, 16, 32}) {
    const FloatArray x = FixedArray({3, 4, 6, 5}), w = FixedArray({channels, 4, 3, 3}, 3);
    const std::vector<float> scales = FixedNumbers(size_t(channels), 5), shifts = FixedNumbers(size_t(channels), 6);
    GraphExample example({-1, 4, 6, 5}, {"c", "y"});
    example.Weight("w", w.shape, w.values).Weight("s", {channels}, scales).Weight("t", {channels}, shifts);
    example.Node("Conv", {"x", "w"}, "c").Node("InstanceNormalization", {"c", "s", "t"}, "n");
    example.Node("Relu", {"n"}, "y");  // Part of the norm.
    const NamedArrays outputs = GraphRunner(example.graph).Run({{"x", x}});
    FloatArray expected = Normalised(outputs.at("c"), 3 * channels, 1, scales, shifts, 1e-5);
    for (float& number : expected.values) number = std::max(number, 0.0f);
    ExpectNear(outputs.at("y"), expected, 1e-5);
    const auto steps = GraphRunner(example.graph).StepsFor({{"x", x}});
    EXPECT_TRUE(
        std::ranges::none_of(steps, [](const auto& step) { return step.node.find("(Relu)") != std::string::npos; }));
  }
}

TEST(RuntimeNorms, InBlocksKeepThePaddingZero) {
  GraphExample example({1, 1, 3, 3});  // 12 channels of shift 1 in blocks; a convolution reads all of them.
  example.Weight("w", {12, 1, 1, 1}, std::vector<float>(12, 1)).Node("Conv", {"x", "w"}, "c");
  example.Weight("s", {12}, std::vector<float>(12, 0)).Weight("t", {12}, std::vector<float>(12, 1));
  example.Node("InstanceNormalization", {"c", "s", "t"}, "n");
  example.Weight("v", {1, 12, 1, 1}, std::vector<float>(12, 1)).Node("Conv", {"n", "v"}, "y");
  EXPECT_EQ(example.Run(FixedArray({1, 1, 3, 3})).values, std::vector<float>(9, 12));
}

TEST(RuntimeNorms, OfLayersAndGroupsFollowTheirDefinition) {
  const FloatArray x = FixedArray({2, 4, 3, 5});
  const std::vector<float> of_layer = FixedNumbers(15, 4), shifts = FixedNumbers(15, 5);
  GraphExample layer({-1, 4, 3, 5});
  layer.Weight("s", {3, 5}, of_layer).Weight("t", {3, 5}, shifts);
  layer.Node("LayerNormalization", {"x", "s", "t"}, "y", {{"axis", int64_t{-2}}});
  ExpectNear(layer.Run(x), Normalised(x, 8, 15, of_layer, shifts, 1e-5), 1e-5);

  const std::vector<float> scales = {1, 2, 3, 4}, offsets = {4, 3, 2, 1};
  GraphExample group({-1, 4, 3, 5});
  group.Weight("s", {4}, scales).Weight("t", {4}, offsets);
  group.Node("GroupNormalization", {"x", "s", "t"}, "y", {{"num_groups", int64_t{2}}});
  ExpectNear(group.Run(x), Normalised(x, 4, 2, scales, offsets, 1e-5), 1e-5);

  GraphExample scaled({-1, 4, 3, 5});
  scaled.Weight("s", {2}, {1, 2}).Weight("t", {2}, {3, 4});
  scaled.Node("GroupNormalization", {"x", "s", "t"}, "y", {{"num_groups", int64_t{2}}, {"scales_groups", int64_t{1}}});
  ExpectNear(scaled.Run(x), Normalised(x, 4, 2, {1, 1, 2, 2}, {3, 3, 4, 4}, 1e-5), 1e-5);
}

TEST(RuntimeNorms, LoseNothingOnLargeImages) {
  // A million numbers around 1000: sums in float32 would lose their variance of 1/12.
  constexpr int64_t kSide = 1024;
  FloatArray x({1, 1, kSide, kSide});
  x.values = FixedNumbers(x.values.size());
  for (float& number : x.values) number = 1000 + number / 2;
  GraphExample example({1, 1, kSide, kSide});
  example.Weight("s", {1}, {1}).Weight("t", {1}, {0}).Node("InstanceNormalization", {"x", "s", "t"}, "y");
  ExpectNear(example.Run(x), Normalised(x, 1, 1, {1}, {0}, 1e-5), 2e-4);  // Of float32 at 1000.
}

}  // namespace
}  // namespace daumier::runtime
