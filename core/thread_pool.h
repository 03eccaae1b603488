#pragma once
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace daumier {

/// A fixed number of threads that run jobs in the order in which they were added. Jobs must neither throw nor wait for
/// a job that is not running yet; core/parallel.h is the interface for loops.
class ThreadPool {
 public:
  explicit ThreadPool(int num_workers);
  /// Runs the jobs that remain, then joins its threads.
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  int num_workers() const { return static_cast<int>(workers_.size()); }
  /// Thread-safe; also from a job.
  void Add(std::function<void()> job);

 private:
  void Work();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> jobs_;
  bool is_closing_ = false;
  std::vector<std::thread> workers_;
};

/// The pool of the process, made on first use and never destroyed: NumCores() - 1 threads, since the thread that starts
/// a loop works too.
ThreadPool& SharedThreadPool();

}  // namespace daumier
