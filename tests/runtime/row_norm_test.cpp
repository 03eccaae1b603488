#include "runtime/row_norm.h"

#include "tests/runtime/graph_example.h"

#include <cmath>

namespace daumier::runtime {
namespace {

TEST(RowNorm, MomentsOfManyNumbersAreThoseOfFloat64) {
  // A million numbers around 1000, in parts that are merged: sums in float32 would lose their variance of 1/12.
  std::vector<float> numbers = FixedNumbers(1 << 20);
  for (float& number : numbers) number = 1000 + number / 2;
  double mean = 0, variance = 0;
  for (const float number : numbers) mean += number / double(numbers.size());
  for (const float number : numbers) variance += std::pow(number - mean, 2) / double(numbers.size());
  const Moments moments = MomentsOf(numbers.data(), int64_t(numbers.size()));
  EXPECT_EQ(moments.count, 1 << 20);
  EXPECT_NEAR(moments.mean, mean, 1e-9);
  EXPECT_NEAR(moments.variance, variance, 1e-9);
  EXPECT_NEAR(moments.variance, 1.0 / 12, 1e-3);
}

TEST(RowNorm, EachRowHasMomentsAndEachRunAScale) {
  // Rows (1, 3) and (-5, -9): means 2 and -7, deviations 1 and 2.
  const std::vector<float> x = {1, 3, -5, -9};
  std::vector<float> y(4);
  RowNorm norm{.rows = 2, .runs = 2, .length = 1, .epsilon = 1e-12f, .scales = {10, 20}, .shifts = {0, 1}};
  norm.Run(x.data(), y.data());
  ExpectNear({{4}, y}, {{4}, {-10, 21, 10, -19}}, 1e-6);
  norm = {.rows = 2, .runs = 1, .length = 2, .kinds = 2, .epsilon = 1e-12f, .scales = {10, 20}, .shifts = {0, 1}};
  norm.Run(x.data(), y.data());
  ExpectNear({{4}, y}, {{4}, {-10, 10, 21, -19}}, 1e-6);
  norm.with_relu = true;
  norm.Run(x.data(), y.data());
  ExpectNear({{4}, y}, {{4}, {0, 10, 21, 0}}, 1e-6);
}

TEST(RowNorm, OfBlocksEqualsThatOfRows) {
  constexpr int64_t kArea = 3000;  // Several parts of blocks of 16.
  for (const int block : {8, 16}) {
    const std::vector<float> rows = FixedNumbers(size_t(block * kArea));
    std::vector<float> blocks(rows.size()), expected(rows.size()), found(rows.size());
    for (size_t i = 0; i < rows.size(); ++i) blocks[i % kArea * size_t(block) + i / kArea] = rows[i];
    const std::vector<float> scales = FixedNumbers(size_t(block), 2), shifts = FixedNumbers(size_t(block), 3);
    RowNorm{
        .rows = block, .runs = 1, .length = kArea, .kinds = block, .epsilon = 1e-5f, .scales = scales, .shifts = shifts}
        .Run(rows.data(), expected.data());
    BlockNorm{.channels = block, .area = kArea, .block = block, .epsilon = 1e-5f, .scales = scales, .shifts = shifts}
        .Run(blocks.data(), found.data());
    std::vector<float> sorted(rows.size());
    for (size_t i = 0; i < rows.size(); ++i) sorted[i] = found[i % kArea * size_t(block) + i / kArea];
    ExpectNear({{int64_t(rows.size())}, sorted}, {{int64_t(rows.size())}, expected}, 1e-6);
  }
}

TEST(RowNorm, OfGroupsInBlocksEqualsThatOfRows) {
  constexpr int64_t kArea = 300, kChannels = 12;  // Two groups of six, of which one lies in two blocks of 8.
  const std::vector<float> rows = FixedNumbers(size_t(kChannels * kArea));
  std::vector<float> blocks(16 * kArea, 0), found(16 * kArea, 9), expected(rows.size());
  const auto place = [](size_t i) {
    const size_t channel = i / kArea, pixel = i % kArea;
    return (channel / 8 * kArea + pixel) * 8 + channel % 8;
  };
  for (size_t i = 0; i < rows.size(); ++i) blocks[place(i)] = rows[i];
  const std::vector<float> scales = FixedNumbers(kChannels, 2), shifts = FixedNumbers(kChannels, 3);
  RowNorm{.rows = 2, .runs = 6, .length = kArea, .kinds = 2, .epsilon = 1e-5f, .scales = scales, .shifts = shifts}.Run(
      rows.data(), expected.data());
  BlockNorm{.channels = kChannels, .area = kArea, .of_group = 6, .epsilon = 1e-5f, .scales = scales, .shifts = shifts}
      .Run(blocks.data(), found.data());
  std::vector<float> sorted(rows.size());
  for (size_t i = 0; i < rows.size(); ++i) sorted[i] = found[place(i)];
  ExpectNear({{int64_t(rows.size())}, sorted}, {{int64_t(rows.size())}, expected}, 1e-6);
  for (size_t i = 0; i < 4 * kArea; ++i) EXPECT_EQ(found[(kArea + i / 4) * 8 + 4 + i % 4], 0);
}

}  // namespace
}  // namespace daumier::runtime
