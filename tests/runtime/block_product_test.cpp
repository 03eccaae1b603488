#include "runtime/block_product.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace daumier::runtime {
namespace {

std::vector<float> Numbers(int64_t count, float step) {
  std::vector<float> numbers(static_cast<size_t>(count));
  for (size_t i = 0; i < numbers.size(); ++i) numbers[i] = std::sin(step * float(i + 1));
  return numbers;
}

TEST(BlockProduct, IsTheSumOverTheInnerIndexForEveryRemainderOfRows) {
  for (const bool transposed : {false, true}) {
    for (const int64_t rows : {1, 2, 3, 11, 12, 13, 25}) {
      for (const int64_t inner : {1, 3, 40}) {
        for (const int64_t columns : {kProductColumns, 3 * kProductColumns}) {
          const auto a = Numbers(rows * inner, 0.3f), b = Numbers(inner * columns, 0.7f);
          std::vector<float> c = Numbers(rows * columns, 1.1f);
          const std::vector<float> before = c;
          const bool add = rows % 2 == 0;
          BlockProduct(a.data(), transposed ? Factor::kTransposed : Factor::kPlain, b.data(), rows, inner, columns,
                       add ? ProductTo::kSum : ProductTo::kValue, c.data());
          for (int64_t i = 0; i < rows; ++i) {
            for (int64_t j = 0; j < columns; ++j) {
              double sum = add ? before[size_t(i * columns + j)] : 0;
              for (int64_t k = 0; k < inner; ++k)
                sum += double(a[size_t(transposed ? k * rows + i : i * inner + k)]) * b[size_t(k * columns + j)];
              ASSERT_NEAR(c[size_t(i * columns + j)], sum, 1e-5) << rows << " x " << inner << " x " << columns;
            }
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace daumier::runtime
