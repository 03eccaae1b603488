#include "runtime/siren_math.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace daumier::runtime {
namespace {

struct Block {
  int64_t rows, width;
  std::vector<float> x, bias;
};

/// Angles omega (x + b) of up to about 1,900 for omega = 30.
Block SomeBlock(int64_t width) {
  Block block{
      .rows = 7, .width = width, .x = std::vector<float>(size_t(7 * width)), .bias = std::vector<float>(size_t(width))};
  for (size_t i = 0; i < block.x.size(); ++i) block.x[i] = 60.0f * std::sin(0.7f * float(i));
  for (size_t i = 0; i < block.bias.size(); ++i) block.bias[i] = std::cos(1.3f * float(i));
  return block;
}

// A width that fills whole vectors, and ones that leave a rest.
const std::vector<int64_t> kWidths = {32, 5, 19};

TEST(SirenMath, SineIsThatOfTheStandardLibrary) {
  for (const int64_t width : kWidths) {
    const Block block = SomeBlock(width);
    std::vector<float> sine = block.x;
    SineOfBlock(sine.data(), block.bias.data(), block.rows, width, 30);
    for (size_t i = 0; i < sine.size(); ++i) {
      const float angle = (block.x[i] + block.bias[i % size_t(width)]) * 30;
      ASSERT_LT(std::abs(angle), 2000);
      EXPECT_NEAR(sine[i], std::sin(double(angle)), 3e-7) << angle;
    }
  }
}

TEST(SirenMath, SlopeIsTheDerivative) {
  for (const int64_t width : kWidths) {
    const Block block = SomeBlock(width);
    std::vector<float> sine = block.x, slope(block.x.size());
    SineAndSlopeOfBlock(sine.data(), slope.data(), block.bias.data(), block.rows, width, 30);
    for (size_t i = 0; i < sine.size(); ++i) {
      const double angle = (block.x[i] + block.bias[i % size_t(width)]) * 30;
      EXPECT_NEAR(sine[i], std::sin(angle), 3e-7);
      EXPECT_NEAR(slope[i], 30 * std::cos(angle), 30 * 3e-7);
    }
  }
}

TEST(SirenMath, ZeroGivesZeroAndFullSlope) {
  float x[3] = {0, 0, 0}, slope[3];
  const float bias[3] = {0, 0, 0};
  SineAndSlopeOfBlock(x, slope, bias, 1, 3, 30);
  EXPECT_EQ(x[1], 0);
  EXPECT_NEAR(slope[1], 30, 1e-5);
}

TEST(SirenMath, ProductsAndSumsOfRowsWithARest) {
  for (const int64_t width : kWidths) {
    const Block block = SomeBlock(width);
    std::vector<float> product = block.x, sum = block.bias;
    MultiplyBlock(block.x.data(), int64_t(block.x.size()), product.data());
    for (size_t i = 0; i < product.size(); ++i) EXPECT_EQ(product[i], block.x[i] * block.x[i]);
    AddRowsOfBlock(block.x.data(), block.rows, width, sum.data());
    for (size_t i = 0; i < sum.size(); ++i) {
      double expected = block.bias[i];
      for (int64_t row = 0; row < block.rows; ++row) expected += block.x[size_t(row * width) + i];
      EXPECT_NEAR(sum[i], expected, 1e-4);
    }
  }
}

TEST(SirenMath, SumsOfProductsAndMultiplesOfRowsWorkedOutByHand) {
  for (const int64_t width : kWidths) {
    const Block block = SomeBlock(width);
    std::vector<float> products(static_cast<size_t>(width)), sum(static_cast<size_t>(width), 1.0f);
    SumOfProductsOfBlock(block.x.data(), block.x.data(), block.rows, width, products.data());
    const std::vector<const float*> rows = {block.x.data(), block.x.data() + 3 * width, block.bias.data(),
                                            block.x.data() + width, block.x.data() + 6 * width};
    const std::vector<float> factors = {2, -1, 0.5f, 3, 1};
    AddMultiplesOfRows(rows.data(), factors.data(), 5, width, sum.data());
    for (int64_t i = 0; i < width; ++i) {
      double squares = 0, multiples = 1;
      for (int64_t row = 0; row < block.rows; ++row) squares += std::pow(block.x[size_t(row * width + i)], 2);
      for (size_t r = 0; r < rows.size(); ++r) multiples += double(factors[r]) * rows[r][i];
      EXPECT_NEAR(products[size_t(i)], squares, 1e-6 * squares + 1e-3);
      EXPECT_NEAR(sum[size_t(i)], multiples, 1e-4);
    }
  }
}

}  // namespace
}  // namespace daumier::runtime
