#include "tests/runtime/graph_example.h"

#include <cmath>

namespace daumier::runtime {
namespace {

using Ints = std::vector<int64_t>;

FloatArray Six() {
  FloatArray x({2, 3});
  x.values = {1, 2, 3, 4, 5, 9};
  return x;
}

TEST(RuntimeReductions, MeansAndExtremesAlongAxes) {
  const auto reduce = [](const std::string& op, int64_t axis, int64_t keeps) {
    return GraphExample({2, 3}).Node(op, {"x"}, "y", {{"axes", Ints{axis}}, {"keepdims", keeps}}).Run(Six());
  };
  const FloatArray mean = reduce("ReduceMean", 1, 1);
  EXPECT_EQ(mean.shape, (Shape{2, 1}));
  EXPECT_EQ(mean.values, (std::vector<float>{2, 6}));
  const FloatArray most = reduce("ReduceMax", 0, 0);
  EXPECT_EQ(most.shape, (Shape{3}));
  EXPECT_EQ(most.values, (std::vector<float>{4, 5, 9}));
  EXPECT_EQ(reduce("ReduceMin", -1, 0).values, (std::vector<float>{1, 4}));
}

TEST(RuntimeReductions, SoftmaxIsThatOfItsAxis) {
  const FloatArray y = GraphExample({2, 3}).Node("Softmax", {"x"}, "y", {{"axis", int64_t(0)}}).Run(Six());
  EXPECT_NEAR(y.values[0], 1 / (1 + std::exp(3.0)), 1e-6);
  EXPECT_NEAR(y.values[0] + y.values[3], 1, 1e-6);
  const FloatArray logarithm = GraphExample({2, 3}).Node("LogSoftmax", {"x"}, "y", {{"axis", int64_t(0)}}).Run(Six());
  for (size_t i = 0; i < 6; ++i) EXPECT_NEAR(logarithm.values[i], std::log(y.values[i]), 1e-5);
}

TEST(RuntimeReductions, MeansOfImagesInBlocksAreThoseOfPlainOnes) {
  // A convolution leaves its image in blocks of channels; the mean of one times each channel is the channel's own.
  const int64_t channels = 16;
  std::vector<float> identity(size_t(channels * channels), 0.0f);
  for (int64_t c = 0; c < channels; ++c) identity[size_t(c * channels + c)] = 1;
  const FloatArray x = FixedArray({1, channels, 4, 4});
  const auto mean_of = [&](GraphExample example, const std::string& from) {
    return example.Node("ReduceMean", {from}, "y", {{"axes", Ints{2, 3}}, {"keepdims", int64_t(0)}}).Run(x);
  };
  const FloatArray plain = mean_of(GraphExample({1, channels, 4, 4}), "x");
  GraphExample convolved({1, channels, 4, 4});
  convolved.Weight("w", {channels, channels, 1, 1}, identity).Node("Conv", {"x", "w"}, "c");
  ExpectNear(mean_of(convolved, "c"), plain);
}

}  // namespace
}  // namespace daumier::runtime
