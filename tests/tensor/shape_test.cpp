#include "tensor/shape.h"

#include "tests/support/expect_error.h"

#include <torch/types.h>

namespace daumier::tensor {
namespace {

using testing::ExpectError;

TEST(Shape, TextNamesWildcards) {
  EXPECT_EQ(ShapeText({2, kAny, 7}), "(2, *, 7)");
}

TEST(Shape, AcceptsEqualSizesAndAnySizeForWildcards) {
  EXPECT_NO_THROW(CheckShape(torch::zeros({2, 3}), {2, 3}, "x"));
  EXPECT_NO_THROW(CheckShape(torch::zeros({2, 3}), {kAny, 3}, "x"));
  EXPECT_NO_THROW(CheckShape(torch::zeros({}), {}, "x"));
}

TEST(Shape, RefusesAnotherSizeAnotherRankAndUndefined) {
  ExpectError(
      [] {
        CheckShape(torch::zeros({2, 3}), {kAny, 4}, "images");
      },
      "images has shape (2, 3), expected (*, 4)");
  ExpectError([] { CheckShape(torch::zeros({2, 3}), {2}, "images"); }, "images has shape (2, 3), expected (2)");
  ExpectError([] { CheckShape(torch::Tensor(), {2}, "images"); }, "images is undefined");
}

TEST(Shape, DetectsTensorsThatALoopMayRead) {
  const torch::Tensor images = torch::zeros({2, 3, 4, 5});
  EXPECT_TRUE(IsDenseFloat(images));
  EXPECT_TRUE(IsDenseFloat(images.contiguous(torch::MemoryFormat::ChannelsLast)));
  EXPECT_TRUE(IsDenseFloat(images.transpose(0, 3)));
  EXPECT_FALSE(IsDenseFloat(images.select(1, 0)));
  EXPECT_FALSE(IsDenseFloat(images.to(torch::kFloat64)));
}

}  // namespace
}  // namespace daumier::tensor
