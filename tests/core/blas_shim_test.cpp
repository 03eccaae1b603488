#include "core/error.h"
#include "core/random.h"
#include "core/runtime.h"
#include "core/sgemm.h"

#include <gtest/gtest.h>

#include <numeric>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace daumier {
namespace {

/// One call of sgemm_: sizes, transposes, scales, and how much longer the stored columns are than they need to be.
struct Product {
  int m, n, k;
  char transposed_a = 'N', transposed_b = 'N';
  float alpha = 1, beta = 0;
  int padding = 0;
};

class BlasShim : public ::testing::Test {
 protected:
  void SetUp() override {
    sgemm_ = FindSgemm();
    if (sgemm_ == nullptr) GTEST_SKIP() << "built without oneDNN's sgemm_, as under the sanitizers";
  }

  std::vector<float> RandomValues(size_t count) {
    std::vector<float> values(count);
    for (float& value : values) value = static_cast<float>(rng_.Normal());
    return values;
  }

  /// Expects what the definition gives, summed in double, and that what lies between the columns of C stays.
  void ExpectProduct(const Product& p, std::vector<float> c = {}) {
    const bool ta = p.transposed_a != 'N', tb = p.transposed_b != 'N';
    const int lda = std::max(1, (ta ? p.k : p.m) + p.padding), ldb = std::max(1, (tb ? p.n : p.k) + p.padding);
    const int ldc = std::max(1, p.m + p.padding);
    const std::vector<float> a = RandomValues(static_cast<size_t>(lda) * (ta ? p.m : p.k) + 1);
    const std::vector<float> b = RandomValues(static_cast<size_t>(ldb) * (tb ? p.k : p.n) + 1);
    if (c.empty()) c = RandomValues(static_cast<size_t>(ldc) * p.n + 1);
    std::vector<float> expected = c;
    for (int j = 0; j < p.n; ++j) {
      for (int i = 0; i < p.m; ++i) {
        double sum = 0;
        for (int l = 0; l < p.k; ++l) {
          sum += static_cast<double>(ta ? a[l + i * lda] : a[i + l * lda]) * (tb ? b[j + l * ldb] : b[l + j * ldb]);
        }
        float& value = expected[i + j * ldc];
        value = static_cast<float>(p.alpha * sum + (p.beta == 0 ? 0.0 : static_cast<double>(p.beta) * value));
      }
    }
    sgemm_(&p.transposed_a, &p.transposed_b, &p.m, &p.n, &p.k, &p.alpha, a.data(), &lda, b.data(), &ldb, &p.beta,
           c.data(), &ldc);
    const double tolerance = 1e-5 * std::sqrt(p.k + 1.0) * std::max(1.0f, std::abs(p.alpha));
    for (size_t i = 0; i < c.size(); ++i) {
      ASSERT_NEAR(c[i], expected[i], tolerance) << p.m << " x " << p.n << " x " << p.k << ", entry " << i;
    }
  }

  Rng rng_{1};
  Sgemm* sgemm_ = nullptr;
};

TEST_F(BlasShim, ProductByHand) {
  // (1 3; 2 4) (5 7; 6 8) = (23 31; 34 46), column by column.
  const std::vector<float> a = {1, 2, 3, 4}, b = {5, 6, 7, 8};
  std::vector<float> c(4);
  const int two = 2;
  const float one = 1, zero = 0;
  sgemm_("N", "N", &two, &two, &two, &one, a.data(), &two, b.data(), &two, &zero, c.data(), &two);
  EXPECT_EQ(c, (std::vector<float>{23, 34, 31, 46}));
}

TEST_F(BlasShim, EveryTransposeAndStrideGivesTheProduct) {
  for (const char transposed_a : {'N', 'T', 'C'}) {
    for (const char transposed_b : {'N', 'T', 'C'}) {
      for (const int padding : {0, 3}) {
        ExpectProduct({5, 7, 4, transposed_a, transposed_b, 1, 0, padding});
        ExpectProduct({33, 1, 65, transposed_a, transposed_b, 1, 0, padding});
      }
    }
  }
}

TEST_F(BlasShim, ScalesGiveTheProduct) {
  for (const float alpha : {1.0f, -2.5f, 0.0f}) {
    for (const float beta : {0.0f, 1.0f, -0.5f}) ExpectProduct({17, 9, 12, 'N', 'T', alpha, beta, 1});
  }
}

TEST_F(BlasShim, RandomShapesGiveTheProduct) {
  const char words[] = {'N', 'T'};
  for (int i = 0; i < 60; ++i) {
    Product product{static_cast<int>(1 + rng_.Below(70)), static_cast<int>(1 + rng_.Below(70)),
                    static_cast<int>(1 + rng_.Below(70))};
    product.transposed_a = words[rng_.Below(2)];
    product.transposed_b = words[rng_.Below(2)];
    product.beta = static_cast<float>(rng_.Below(2));
    product.padding = static_cast<int>(rng_.Below(5));
    ExpectProduct(product);
  }
}

TEST_F(BlasShim, EmptySizesLeaveOrScaleC) {
  for (const float beta : {0.0f, 1.0f, 2.0f}) {
    ExpectProduct({0, 4, 3, 'N', 'N', 1, beta});
    ExpectProduct({4, 0, 3, 'N', 'N', 1, beta});
    ExpectProduct({4, 3, 0, 'N', 'N', 1, beta, 2});
  }
}

TEST_F(BlasShim, BetaZeroDoesNotReadC) {
  const std::vector<float> nans(6 * 5 + 1, std::numeric_limits<float>::quiet_NaN());
  for (const int k : {0, 1, 40}) {
    std::vector<float> c(nans.begin(), nans.end() - 1);
    ExpectProduct({6, 5, k}, c);
  }
}

TEST_F(BlasShim, WhatOneDnnRefusesIsComputedByItsDefinition) {
  if (FindSgemm(RTLD_NEXT) != nullptr) GTEST_SKIP() << "another BLAS would handle the call and end the program";
  std::vector<float> a(16), b(16), c(4, 1.0f);
  std::iota(a.begin(), a.end(), 1.0f);
  std::iota(b.begin(), b.end(), -3.0f);
  const int two = 2, too_small = 1;  // Columns of A overlap: (1 2; 2 3).
  const float scale = 2, keep = 1;
  sgemm_("N", "T", &two, &two, &two, &scale, a.data(), &too_small, b.data(), &two, &keep, c.data(), &two);
  // op(B) = (-3 -2; -1 0): 1 + 2 (1 2; 2 3) op(B), column by column.
  EXPECT_EQ(c, (std::vector<float>{-9, -17, -3, -7}));
}

TEST_F(BlasShim, IsTheOneThatTheProgramReports) {
  const BlasInfo blas = DescribeBlas();
  EXPECT_EQ(blas.library.rfind("oneDNN ", 0), 0u) << blas.library;
  EXPECT_NE(blas.kernel, "unknown");
}

}  // namespace
}  // namespace daumier
