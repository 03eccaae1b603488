#include "runtime/primitives.h"

#include "core/error.h"

#include <gtest/gtest.h>

namespace daumier::runtime {
namespace {

/// A convolution of ones, run by hand on plain layouts: every interior pixel is the number of weights.
TEST(RuntimePrimitives, AConvolutionOfOnesCountsItsWeights) {
  const Layout image = PlainLayout({1, 2, 4, 4}), weights = PlainLayout({3, 2, 3, 3}),
               target = PlainLayout({1, 3, 2, 2});
  const Primitive convolution =
      MakeConvolution(image, weights, {}, target, {{3, 3}, {1, 1}, {1, 1}, {0, 0}, {0, 0}}, {});
  std::vector<float> x(32, 1.0f), w(54, 1.0f), y(12, 0.0f);
  std::vector<float> scratch(convolution.scratch.get_size() / sizeof(float) + 16);
  const auto memory = [](const Layout& layout, std::vector<float>& numbers) {
    return dnnl::memory(layout, CpuEngine(), numbers.data());
  };
  Execute(convolution.primitive,
          {{DNNL_ARG_SRC, memory(image, x)},
           {DNNL_ARG_WEIGHTS, memory(weights, w)},
           {DNNL_ARG_DST, memory(target, y)},
           {DNNL_ARG_SCRATCHPAD, memory(convolution.scratch, scratch)}},
          "ones");
  for (const float number : y) EXPECT_FLOAT_EQ(number, 18);
  EXPECT_FALSE(convolution.kernel.empty());
}

TEST(RuntimePrimitives, BlocksOfChannelsAreRecognised) {
  const Shape shape = {1, 16, 4, 4};
  for (const int block : {1, 8, 16}) EXPECT_EQ(BlockOf(BlockedLayout(shape, block), shape), block);
  EXPECT_EQ(PlainLayout(shape).get_size(), 16u * 16 * sizeof(float));
  EXPECT_EQ(BlockedLayout({1, 5, 2, 2}, 8).get_size(), 8u * 4 * sizeof(float)) << "channels are filled up to a block";
}

TEST(RuntimePrimitives, WhatOneDnnRefusesIsAnError) {
  // 2 channels of image, weights of 3.
  EXPECT_THROW(MakeConvolution(PlainLayout({1, 2, 4, 4}), PlainLayout({3, 3, 3, 3}), {}, PlainLayout({1, 3, 2, 2}),
                               {{3, 3}, {1, 1}, {1, 1}, {0, 0}, {0, 0}}, {}),
               Error);
}

}  // namespace
}  // namespace daumier::runtime
