#pragma once
#include "core/thread_pool.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace daumier {

/// Calls work(i) for i = 0..count-1 on this thread and on workers of `pool`, and merge(i) on this thread in the order
/// of i. work(i) begins after merge(i - window) has ended. The engine of ForEachInOrder, whose promises on errors it
/// keeps.
void RunInOrder(int count, int window, const std::function<void(int)>& work, const std::function<void(int)>& merge,
                ThreadPool& pool);

/// Calls result = work(i) for i = 0..count-1 on up to `max_threads` cores, and merge(std::move(result)) on this thread
/// in the order of i, so that what is merged does not depend on the number of threads. At most `max_threads` results
/// exist at once. The first error of work or merge, in the order of i, is thrown here after the calls that are under
/// way have ended; no further call is begun. work may itself call ForEachInOrder. This thread works too; workers come
/// from one pool that all loops share.
template <class Work, class Merge>
void ForEachInOrder(int count, const Work& work, const Merge& merge, unsigned max_threads = 8,
                    ThreadPool& pool = SharedThreadPool()) {
  const int window = static_cast<int>(std::clamp(static_cast<unsigned>(pool.num_workers() + 1), 1u, max_threads));
  std::vector<std::optional<decltype(work(0))>> results(static_cast<size_t>(window));
  const auto slot = [&](int i) -> auto& {
    return results[static_cast<size_t>(i % window)];
  };
  RunInOrder(
      count, window, [&](int i) { slot(i).emplace(work(i)); },
      [&](int i) {
        merge(std::move(*slot(i)));
        slot(i).reset();
      },
      pool);
}

/// Calls work(i) for i = 0..count-1 on all cores, in one block of neighbours a core. What work throws is
/// thrown here, as by ForEachInOrder.
template <class Work>
void OnAllCores(int64_t count, const Work& work, ThreadPool& pool = SharedThreadPool()) {
  const int num_cores = pool.num_workers() + 1, num_blocks = static_cast<int>(std::min<int64_t>(num_cores, count));
  RunInOrder(
      num_blocks, num_cores,
      [&](int block) {
        const int64_t end = count * (block + 1) / num_blocks;
        for (int64_t i = count * block / num_blocks; i < end; ++i) work(i);
      },
      [](int) {}, pool);
}

}  // namespace daumier
