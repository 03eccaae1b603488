// LibTorch multiplies matrices with the Fortran sgemm_ of whatever BLAS the machine picked, up to ten times slower than
// the machine can; core/blas_shim.cpp forwards it to oneDNN. This test fails where that does not take effect.
#include "tensor/runtime.h"

#include <dlfcn.h>
#include <dnnl.h>
#include <gtest/gtest.h>
#include <torch/utils.h>

#include <algorithm>
#include <chrono>
#include <vector>

extern "C" void sgemm_(const char*, const char*, const int*, const int*, const int*, const float*, const float*,
                       const int*, const float*, const int*, const float*, float*, const int*);

namespace daumier::tensor {
namespace {

template <class Action>
double Seconds(Action&& action) {
  const auto start = std::chrono::steady_clock::now();
  action();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::string LibraryOfSgemm() {
  Dl_info info{};
  return dladdr(reinterpret_cast<void*>(&sgemm_), &info) != 0 && info.dli_fname != nullptr ? info.dli_fname : "unknown";
}

TEST(MatrixProduct, RunsAtHalfOfOneDnnsOwnSpeedAtLeast) {
  const int threads_before = torch::get_num_threads();
  SetUpTorch();
  torch::NoGradGuard no_grad;
  torch::manual_seed(1);
  const int64_t n = 768;
  const auto a = torch::randn({n, n}), b = torch::randn({n, n});
  auto ours = torch::empty({n, n}), reference = torch::empty({n, n});
  const auto multiply = [&] { at::mm_out(ours, a, b); };
  const auto multiply_by_dnnl = [&] {
    dnnl_sgemm('N', 'N', n, n, n, 1.0f, a.data_ptr<float>(), n, b.data_ptr<float>(), n, 0.0f,
               reference.data_ptr<float>(), n);
  };
  multiply();
  multiply_by_dnnl();
  EXPECT_TRUE(torch::allclose(ours, reference, 1e-4, 1e-3));

  // Both are timed in turns, and the middle one of the ratios is taken: what slows a busy machine down hits either.
  constexpr int kRounds = 21;
  std::vector<double> ratios, seconds;
  for (int round = 0; round < kRounds; ++round) {
    seconds.push_back(Seconds(multiply));
    ratios.push_back(seconds.back() / Seconds(multiply_by_dnnl));
  }
  for (std::vector<double>* values : {&ratios, &seconds}) std::sort(values->begin(), values->end());
  EXPECT_LT(ratios[kRounds / 2], 2) << "at::mm reaches " << 2e-9 * n * n * n / seconds.front()
                                    << " GFLOP/s; sgemm_ comes from " << LibraryOfSgemm();
  torch::set_num_threads(threads_before);
}

}  // namespace
}  // namespace daumier::tensor
