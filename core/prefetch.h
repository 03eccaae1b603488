#pragma once
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

namespace daumier {

/// Runs work(begin), work(begin + 1), ... ahead of use, each once, on threads of its own. The engine of Prefetcher,
/// whose promises it keeps; work(i) writes slot i % depth, which no other item uses until Release(i).
class PrefetchThreads {
 public:
  PrefetchThreads(int64_t begin, int64_t end, int depth, int num_threads, std::function<void(int64_t)> work);
  ~PrefetchThreads();
  PrefetchThreads(const PrefetchThreads&) = delete;
  PrefetchThreads& operator=(const PrefetchThreads&) = delete;

  /// Returns when item i is done: computes it in this thread if no other has begun it. Items are finished in order.
  /// @throws what its work threw.
  void Finish(int64_t i);
  void Release(int64_t i);

 private:
  size_t Slot(int64_t i) const { return static_cast<size_t>(i % depth_); }
  void Load();
  void WorkOnNext(std::unique_lock<std::mutex>& lock);

  const int64_t end_;
  const int depth_;
  const std::function<void(int64_t)> work_;
  std::mutex mutex_;
  std::condition_variable item_done_, may_begin_;
  int64_t next_;      ///< The first item that has not begun.
  int64_t released_;  ///< Items before it are.
  bool is_stopping_ = false;
  std::vector<bool> is_done_;  ///< By slot; all members below the mutex are guarded by it.
  std::vector<std::exception_ptr> errors_;
  std::vector<std::thread> threads_;
};

/// The results of produce(begin), ..., produce(end - 1) in that order, computed ahead of use by loader threads. At most
/// `depth` results exist at once, those that are being computed included, besides the one that Next has returned.
/// `produce` must be thread-safe if there is more than one thread besides the caller's; it is called once an item, so
/// that the results do not depend on the number of threads. It may use the shared pool (core/parallel.h).
/// The destructor begins no further item and waits for those that run.
template <class T>
class Prefetcher {
 public:
  /// @throws Error if depth or num_threads is below 1.
  Prefetcher(int64_t begin, int64_t end, std::function<T(int64_t)> produce, int depth = 2, int num_threads = 1)
      : next_(begin),
        results_(static_cast<size_t>(depth > 0 ? depth : 0)),
        threads_(begin, end, depth, num_threads,
                 [this, produce = std::move(produce)](int64_t i) { Slot(i).emplace(produce(i)); }) {}

  /// The next result. An item that has not begun is computed in this thread. @throws what produce threw for this item,
  /// Error past the last one; the items behind it are not affected.
  T Next() {
    const int64_t i = next_++;
    threads_.Finish(i);
    T result = std::move(*Slot(i));
    Slot(i).reset();
    threads_.Release(i);
    return result;
  }

 private:
  std::optional<T>& Slot(int64_t i) { return results_[static_cast<size_t>(i) % results_.size()]; }

  int64_t next_;
  std::vector<std::optional<T>> results_;
  PrefetchThreads threads_;  ///< Last: its threads write the results.
};

}  // namespace daumier
