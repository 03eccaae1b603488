#include "core/parallel.h"

#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>

namespace daumier {
namespace {

/// One RunInOrder. Workers share it: a job that is run after the end of the loop finds that no item may begin.
///
/// No deadlock: a thread waits only for an item of its own loop that another thread is running, and workers never wait
/// between items. Loops inside items form a tree, so a chain of waiting threads ends at one that runs.
class Loop : public std::enable_shared_from_this<Loop> {
 public:
  Loop(int count, int window, const std::function<void(int)>& work, ThreadPool& pool)
      : count_(count),
        window_(window),
        work_(work),
        pool_(pool),
        max_helpers_(std::min(window - 1, pool.num_workers())),
        is_done_(static_cast<size_t>(window)),
        errors_(static_cast<size_t>(window)) {}

  void Run(const std::function<void(int)>& merge) {
    try {
      for (int i = 0; i < count_; ++i) {
        Finish(i);
        merge(i);
      }
    } catch (...) {
      Stop();
      throw;
    }
  }

 private:
  size_t Slot(int i) const { return static_cast<size_t>(i % window_); }

  /// Returns when item i is done, all items before it being merged. @throws what its work threw.
  void Finish(int i) {
    std::unique_lock lock(mutex_);
    end_ = std::min(count_, i + window_);
    // The item that this thread is about to begin needs no helper.
    for (int num_open = end_ - next_ - 1; num_helpers_ < max_helpers_ && num_open > 0; --num_open) {
      ++num_helpers_;
      pool_.Add([self = shared_from_this()] { self->Help(); });
    }
    while (!is_done_[Slot(i)]) {
      if (next_ < end_) {
        WorkOnNext(lock);
      } else {
        item_done_.wait(lock);
      }
    }
    is_done_[Slot(i)] = false;
    if (errors_[Slot(i)]) std::rethrow_exception(std::move(errors_[Slot(i)]));
  }

  void Help() {
    std::unique_lock lock(mutex_);
    while (next_ < end_) WorkOnNext(lock);
    --num_helpers_;
  }

  void WorkOnNext(std::unique_lock<std::mutex>& lock) {
    const int i = next_++;
    ++num_running_;
    lock.unlock();
    std::exception_ptr error;
    try {
      work_(i);
    } catch (...) {
      error = std::current_exception();
    }
    lock.lock();
    errors_[Slot(i)] = std::move(error);
    is_done_[Slot(i)] = true;
    --num_running_;
    item_done_.notify_all();
  }

  void Stop() {
    std::unique_lock lock(mutex_);
    end_ = next_;
    item_done_.wait(lock, [this] { return num_running_ == 0; });
    errors_.clear();  // Errors of later items are destroyed in this thread.
  }

  const int count_, window_;
  const std::function<void(int)>& work_;  ///< Alive while an item may begin.
  ThreadPool& pool_;
  const int max_helpers_;
  std::mutex mutex_;
  std::condition_variable item_done_;
  int next_ = 0;  ///< The first item that has not begun.
  int end_ = 0;   ///< Items before it may begin.
  int num_running_ = 0, num_helpers_ = 0;
  std::vector<bool> is_done_;  ///< By slot; all members below the mutex are guarded by it.
  std::vector<std::exception_ptr> errors_;
};

}  // namespace

void RunInOrder(int count, int window, const std::function<void(int)>& work, const std::function<void(int)>& merge,
                ThreadPool& pool) {
  if (window <= 1 || count <= 1 || pool.num_workers() == 0) {
    for (int i = 0; i < count; ++i) {
      work(i);
      merge(i);
    }
    return;
  }
  std::make_shared<Loop>(count, window, work, pool)->Run(merge);
}

}  // namespace daumier
