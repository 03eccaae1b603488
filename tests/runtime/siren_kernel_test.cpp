#include "runtime/siren_kernel.h"

#include "core/random.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace daumier::runtime {
namespace {

std::vector<float> Draw(Rng& rng, int64_t count, double range) {
  std::vector<float> numbers(static_cast<size_t>(count));
  for (float& number : numbers) number = float(rng.Uniform(-range, range));
  return numbers;
}

TEST(SirenKernel, LayoutOfTheSmallestSirenCountedByHand) {
  const SirenLayout layout{.width = 32, .hidden_layers = 1};
  EXPECT_EQ(layout.num_layers(), 3);
  EXPECT_EQ(layout.weight_offset(0), 0);
  EXPECT_EQ(layout.bias_offset(0), 96);
  EXPECT_EQ(layout.weight_offset(1), 128);
  EXPECT_EQ(layout.bias_offset(1), 128 + 1024);
  EXPECT_EQ(layout.weight_offset(2), 128 + 1056);
  EXPECT_EQ(layout.num_parameters(), 128 + 1056 + 99);
  EXPECT_EQ(SirenLayout{}.num_parameters(), 50435);  // [Jung et al. 2022, supplement 2]
}

TEST(SirenKernel, OnePointOfASirenOfOnesWorkedOutByHand) {
  // All weights 0 but the last layer's, which are 1, and all biases 0.1: sin(30 * 0.1) from 32 features, plus 0.1.
  const SirenLayout layout{.width = 32, .hidden_layers = 1};
  std::vector<float> parameters(size_t(layout.num_parameters()), 0.0f);
  for (int layer = 0; layer < 3; ++layer) {
    const auto weights = parameters.begin() + layout.weight_offset(layer),
               biases = parameters.begin() + layout.bias_offset(layer);
    if (layer == 2) std::fill(weights, biases, 1.0f);
    std::fill_n(biases, layout.outputs(layer), 0.1f);
  }
  const float point[3] = {1, 2, 3};
  float displacement[3];
  SirenKernel(layout).Forward(parameters.data(), point, 1, displacement);
  for (const float coordinate : displacement) EXPECT_NEAR(coordinate, 32 * std::sin(3.0) + 0.1, 1e-4);
}

TEST(SirenKernel, PointsOfManyBlocksAreAsEachAlone) {
  const SirenLayout layout{.width = 32, .hidden_layers = 2};
  Rng rng(3);
  const auto parameters = Draw(rng, layout.num_parameters(), 0.1), points = Draw(rng, 3 * 501, 1);
  SirenKernel kernel(layout);
  std::vector<float> together(points.size()), alone(3);
  kernel.Forward(parameters.data(), points.data(), 501, together.data());
  for (const size_t point : {size_t{0}, size_t{239}, size_t{240}, size_t{500}}) {
    kernel.Forward(parameters.data(), points.data() + 3 * point, 1, alone.data());
    for (size_t i = 0; i < 3; ++i) EXPECT_NEAR(together[3 * point + i], alone[i], 1e-5);
  }
}

TEST(SirenKernel, BackwardAddsToWhatIsThere) {
  const SirenLayout layout{.width = 32, .hidden_layers = 1};
  Rng rng(4);
  const auto parameters = Draw(rng, layout.num_parameters(), 0.1), points = Draw(rng, 3 * 300, 1),
             slope = Draw(rng, 3 * 300, 1);
  std::vector<float> once(parameters.size(), 0.0f), twice(parameters.size(), 0.0f);
  SirenKernel kernel(layout);
  kernel.Backward(parameters.data(), points.data(), 300, slope.data(), once.data());
  for (int i = 0; i < 2; ++i) kernel.Backward(parameters.data(), points.data(), 300, slope.data(), twice.data());
  for (size_t i = 0; i < once.size(); ++i) EXPECT_NEAR(twice[i], 2 * once[i], 1e-3 + 1e-4 * std::abs(once[i]));
}

TEST(SirenKernel, RefusesAWidthThatItsProductsCannotTake) {
  testing::ExpectError([] { SirenKernel(SirenLayout{.width = 40}); }, "40, expected a multiple of 16");
}

}  // namespace
}  // namespace daumier::runtime
