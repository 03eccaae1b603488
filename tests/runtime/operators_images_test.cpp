#include "tests/runtime/graph_example.h"

namespace daumier::runtime {
namespace {

using Integers = std::vector<int64_t>;

FloatArray ImageRamp(int64_t side, int64_t channels = 1) {
  FloatArray x({1, channels, side, side});
  for (size_t i = 0; i < x.values.size(); ++i) x.values[i] = float(i);
  return x;
}

TEST(RuntimePool, TakesMaximaAndMeansOfWindows) {
  GraphExample largest({1, 1, 4, 4});
  largest.Node("MaxPool", {"x"}, "y", {{"kernel_shape", Integers{2, 2}}, {"strides", Integers{2, 2}}});
  EXPECT_EQ(largest.Run(ImageRamp(4)).values, (std::vector<float>{5, 7, 13, 15}));
  GraphExample mean({1, 1, 4, 4});
  mean.Node("AveragePool", {"x"}, "y", {{"kernel_shape", Integers{2, 2}}, {"strides", Integers{2, 2}}});
  EXPECT_EQ(mean.Run(ImageRamp(4)).values, (std::vector<float>{2.5f, 4.5f, 10.5f, 12.5f}));
  GraphExample padded({1, 1, 2, 2});
  padded.Node("AveragePool", {"x"}, "y", {{"kernel_shape", Integers{3, 3}}, {"pads", Integers{1, 1, 1, 1}}});
  EXPECT_EQ(padded.Run(ImageRamp(2)).values, std::vector<float>(4, 1.5f));  // Padding is left out.
  GraphExample global({1, 2, 2, 2});
  global.Node("GlobalAveragePool", {"x"}, "y");
  EXPECT_EQ(global.Run(ImageRamp(2, 2)).values, (std::vector<float>{1.5f, 5.5f}));
}

TEST(RuntimePool, OfBlocksOfChannelsEqualsThatOfPlainOnes) {
  const FloatArray x = FixedArray({2, 12, 9, 9});
  const Integers kernel = {3, 3}, strides = {2, 2}, pads = {1, 1, 1, 1};
  GraphExample plain({-1, 12, 9, 9});
  plain.Node("MaxPool", {"x"}, "y", {{"kernel_shape", kernel}, {"strides", strides}, {"pads", pads}});
  GraphExample blocked({-1, 12, 9, 9});  // Behind a convolution that copies.
  std::vector<float> unit(144);
  for (size_t i = 0; i < 12; ++i) unit[13 * i] = 1;
  blocked.Weight("w", {12, 12, 1, 1}, unit).Node("Conv", {"x", "w"}, "c");
  blocked.Node("MaxPool", {"c"}, "y", {{"kernel_shape", kernel}, {"strides", strides}, {"pads", pads}});
  EXPECT_EQ(blocked.Run(x).values, plain.Run(x).values);
}

TEST(RuntimePool, OfTheWholeImageOrWithPadding) {
  GraphExample global({1, 2, 2, 2});
  global.Node("GlobalMaxPool", {"x"}, "y");
  EXPECT_EQ(global.Run(ImageRamp(2, 2)).values, (std::vector<float>{3, 7}));
  GraphExample padded({1, 1, 2, 2});
  padded.Node("AveragePool", {"x"}, "y",
              {{"kernel_shape", Integers{3, 3}}, {"pads", Integers{1, 1, 1, 1}}, {"count_include_pad", int64_t{1}}});
  ExpectNear(padded.Run(ImageRamp(2)), {{1, 1, 2, 2}, std::vector<float>(4, 6.0f / 9)}, 1e-6);
}

}  // namespace
}  // namespace daumier::runtime
