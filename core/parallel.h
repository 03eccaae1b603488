#pragma once
#include "core/runtime.h"

#include <algorithm>
#include <future>
#include <vector>

namespace daumier {

/// Calls result = work(i) for i = 0..count-1 on up to `max_threads` cores, and merge(std::move(result)) on this thread
/// in the order of i, so that what is merged does not depend on the number of threads. At most `max_threads` results
/// exist at once. What work or merge throws is thrown here, after the calls that are under way have ended; no further
/// call is begun.
template <class Work, class Merge>
void ForEachInOrder(int count, const Work& work, const Merge& merge, unsigned max_threads = 8) {
  const int num_threads = static_cast<int>(std::clamp(static_cast<unsigned>(NumCores()), 1u, max_threads));
  std::vector<std::future<decltype(work(0))>> running(num_threads);
  for (int i = 0; i < count + num_threads; ++i) {
    auto& slot = running[i % num_threads];
    if (slot.valid()) merge(slot.get());
    if (i < count) slot = std::async(std::launch::async, [&work, i] { return work(i); });
  }
}

}  // namespace daumier
