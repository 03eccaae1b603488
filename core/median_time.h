#pragma once
#include "core/statistics.h"

#include <chrono>
#include <vector>

namespace daumier {

/// The median of the milliseconds of `num_calls` calls of `work`.
template <class Work>
double MedianMs(const Work& work, int num_calls = 51) {
  std::vector<double> ms;
  for (int call = 0; call < num_calls; ++call) {
    const auto start = std::chrono::steady_clock::now();
    work();
    ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  return Median(ms);
}

}  // namespace daumier
