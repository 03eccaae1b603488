#include "tests/runtime/graph_example.h"
#include "tests/support/expect_error.h"

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

std::map<std::string, GraphAttribute> Mode(const std::string& mode, const std::string& places) {
  return {{"mode", mode}, {"coordinate_transformation_mode", places}, {"nearest_mode", std::string("floor")}};
}

TEST(RuntimeResize, NearestRepeatsPixels) {
  GraphExample example({1, 1, 2, 2});
  example.Weight("s", {4}, {1, 1, 2, 2}).Node("Resize", {"x", "", "s"}, "y", Mode("nearest", "asymmetric"));
  EXPECT_EQ(example.Run(ImageRamp(2)).values, (std::vector<float>{0, 0, 1, 1, 0, 0, 1, 1, 2, 2, 3, 3, 2, 2, 3, 3}));
  GraphExample smaller({1, 1, 4, 4});
  smaller.Weight("s", {4}, {1, 1, 0.5f, 0.5f}).Node("Resize", {"x", "", "s"}, "y", Mode("nearest", "asymmetric"));
  EXPECT_EQ(smaller.Run(ImageRamp(4)).values, (std::vector<float>{0, 2, 8, 10}));
}

TEST(RuntimeResize, NearestInBlocksKeepsThePaddingZero) {
  GraphExample example({1, 1, 3, 3});  // 12 channels in two blocks of 8; a convolution reads all 16.
  example.Weight("w", {12, 1, 1, 1}, std::vector<float>(12, 1)).Node("Conv", {"x", "w"}, "c");
  example.Weight("s", {4}, {1, 1, 2, 2}).Node("Resize", {"c", "", "s"}, "r", Mode("nearest", "asymmetric"));
  example.Weight("v", {1, 12, 1, 1}, std::vector<float>(12, 1)).Node("Conv", {"r", "v"}, "y");
  const FloatArray y = example.Run(ImageRamp(3));
  for (size_t row = 0; row < 6; ++row)
    for (size_t column = 0; column < 6; ++column)
      EXPECT_EQ(y.values[6 * row + column], 12 * float(row / 2 * 3 + column / 2));
}

TEST(RuntimeResize, LinearIsExactOnALine) {
  GraphExample half({1, 1, 1, 2});
  half.Weight("s", {4}, {1, 1, 1, 2}).Node("Resize", {"x", "", "s"}, "y", Mode("linear", "half_pixel"));
  EXPECT_EQ(half.Run({{1, 1, 1, 2}, {0, 4}}).values, (std::vector<float>{0, 1, 3, 4}));
  GraphExample aligned({1, 1, 1, 2});
  aligned.Weight("s", {4}, {1, 1, 1, 2.5f}).Node("Resize", {"x", "", "s"}, "y", Mode("linear", "align_corners"));
  EXPECT_EQ(aligned.Run({{1, 1, 1, 2}, {0, 4}}).values, (std::vector<float>{0, 1, 2, 3, 4}));
}

TEST(RuntimeResize, RefusesOtherModes) {
  GraphExample cubic({1, 1, 2, 2});
  cubic.Weight("s", {4}, {1, 1, 2, 2}).Node("Resize", {"x", "", "s"}, "y", Mode("cubic", "half_pixel"));
  testing::ExpectError([&] { cubic.Run(ImageRamp(2)); }, "there is no resizing of mode cubic");
  GraphExample huge({1, 1, 2, 2});
  huge.Weight("s", {4}, {1, 1, 1e9f, 1e9f}).Node("Resize", {"x", "", "s"}, "y", Mode("nearest", "asymmetric"));
  testing::ExpectError([&] { huge.Run(ImageRamp(2)); }, "are no image");
  GraphExample negative({1, 1, 2, 2});
  negative.Weight("s", {4}, {1, 1, -1, 1}).Node("Resize", {"x", "", "s"}, "y", Mode("nearest", "asymmetric"));
  testing::ExpectError([&] { negative.Run(ImageRamp(2)); }, "are no image");
}

}  // namespace
}  // namespace daumier::runtime
