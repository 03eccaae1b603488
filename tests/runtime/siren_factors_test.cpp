#include "runtime/siren_factors.h"

#include "core/random.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace daumier::runtime {
namespace {

std::vector<float> RandomNumbers(Rng& rng, int64_t count, double range) {
  std::vector<float> numbers(static_cast<size_t>(count));
  for (float& number : numbers) number = float(rng.Uniform(-range, range));
  return numbers;
}

/// Points of one block, of a block that is not full, and of several blocks.
const std::vector<int64_t> kCounts = {1, 16, 40, 150};
const SirenLayout kLayout{.width = 16, .hidden_layers = 2, .omega = 3};

SirenFactors Filled(const std::vector<float>& parameters, const std::vector<float>& points) {
  SirenFactors factors(kLayout, std::ssize(points) / 3);
  for (int64_t b = 0; b < factors.num_blocks(); ++b) factors.Fill(parameters.data(), points.data(), b);
  return factors;
}

/// SirenKernel::Backward of one coordinate of one point is the gradient by all parameters.
TEST(SirenFactors, AreThoseOfTheBackwardPass) {
  Rng rng(1);
  const auto parameters = RandomNumbers(rng, kLayout.num_parameters(), 0.3);
  for (const int64_t count : kCounts) {
    const auto points = RandomNumbers(rng, 3 * count, 1);
    const SirenFactors factors = Filled(parameters, points);
    const int64_t point = count - 1, b = point / factors.block(), p = point % factors.block();
    EXPECT_EQ(factors.NumPointsOf(factors.num_blocks() - 1), p + 1);
    for (int64_t i = 0; i < 3; ++i) {
      const float slope[3] = {i == 0 ? 1.0f : 0, i == 1 ? 1.0f : 0, i == 2 ? 1.0f : 0};
      std::vector<float> gradient(parameters.size(), 0.0f);
      SirenKernel(kLayout).Backward(parameters.data(), points.data() + 3 * point, 1, slope, gradient.data());
      for (int layer = 0; layer < kLayout.num_layers(); ++layer) {
        const int64_t inputs = kLayout.inputs(layer), outputs = kLayout.outputs(layer);
        for (int64_t o = 0; o < outputs; ++o) {
          const float by_output = factors.Gradients(layer, b)[(i * outputs + o) * factors.block() + p];
          EXPECT_NEAR(by_output, gradient[size_t(kLayout.bias_offset(layer) + o)], 1e-4);
          for (int64_t k = 0; k < inputs; ++k)
            EXPECT_NEAR(by_output * factors.Inputs(layer, b)[k * factors.block() + p],
                        gradient[size_t(kLayout.weight_offset(layer) + o * inputs + k)], 1e-4);
        }
      }
    }
  }
}

TEST(SirenFactors, DerivativesAlongDirectionsAreCentralDifferences) {
  Rng rng(2);
  const auto parameters = RandomNumbers(rng, kLayout.num_parameters(), 0.3);
  for (const int64_t count : kCounts) {
    const auto points = RandomNumbers(rng, 3 * count, 1);
    const SirenFactors factors = Filled(parameters, points);
    for (int layer = 0; layer < kLayout.num_layers(); ++layer) {
      for (const bool is_bias : {false, true}) {
        const int64_t outputs = kLayout.outputs(layer),
                      offset = is_bias ? kLayout.bias_offset(layer) : kLayout.weight_offset(layer);
        const auto direction = RandomNumbers(rng, outputs * (is_bias ? 1 : kLayout.inputs(layer)), 1);
        constexpr float kStep = 1e-3f;
        const auto displaced = [&](float step) {
          std::vector<float> moved = parameters, displacements(points.size());
          for (size_t d = 0; d < direction.size(); ++d) moved[size_t(offset) + d] += step * direction[d];
          SirenKernel(kLayout).Forward(moved.data(), points.data(), count, displacements.data());
          return displacements;
        };
        const auto ahead = displaced(kStep), behind = displaced(-kStep);
        std::vector<float> product(size_t(outputs * factors.block())), derivative(size_t(3 * factors.block()));
        for (int64_t b = 0; b < factors.num_blocks(); ++b) {
          if (is_bias) {
            factors.AlongBiases(layer, b, direction.data(), derivative.data());
          } else {
            factors.AlongWeights(layer, b, direction.data(), product.data(), derivative.data());
          }
          for (int64_t p = 0; p < factors.NumPointsOf(b); ++p) {
            for (int64_t i = 0; i < 3; ++i) {
              const size_t at = size_t(3 * (b * factors.block() + p) + i);
              const float found = derivative[size_t(i * factors.block() + p)];
              EXPECT_NEAR(found, (ahead[at] - behind[at]) / (2 * kStep), 1e-2 * (1 + std::abs(found)));
            }
          }
        }
      }
    }
  }
}

TEST(SirenFactors, RefusesAWidthThatItsProductsCannotTake) {
  testing::ExpectError([] { SirenFactors(SirenLayout{.width = 40}, 3); }, "40, expected a multiple of 16");
}

}  // namespace
}  // namespace daumier::runtime
