#pragma once
#include "core/statistics.h"
#include "core/stopwatch.h"

#include <vector>

namespace daumier {

/// The median of the milliseconds of `num_calls` calls of `work`.
template <class Work>
double MedianMs(const Work& work, int num_calls = 51) {
  std::vector<double> ms;
  for (int call = 0; call < num_calls; ++call) {
    const Stopwatch stopwatch;
    work();
    ms.push_back(1e3 * stopwatch.seconds());
  }
  return Median(ms);
}

}  // namespace daumier
