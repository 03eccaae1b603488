#pragma once
#include "core/runtime.h"

#include <algorithm>
#include <cstdint>
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

/// Calls work(i) for i = 0..count-1 on all cores, in one block of neighbours a core. What work throws is
/// thrown here, as by ForEachInOrder.
template <class Work>
void OnAllCores(int64_t count, const Work& work) {
  const int num_cores = NumCores(), num_blocks = static_cast<int>(std::min<int64_t>(num_cores, count));
  const auto work_on = [&](int block) {
    const int64_t end = count * (block + 1) / num_blocks;
    for (int64_t i = count * block / num_blocks; i < end; ++i) work(i);
    return end;
  };
  ForEachInOrder(
      num_blocks, work_on, [](int64_t) {}, static_cast<unsigned>(num_cores));
}

}  // namespace daumier
