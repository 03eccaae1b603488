#include "core/prefetch.h"

#include "core/error.h"

namespace daumier {

PrefetchThreads::PrefetchThreads(int64_t begin, int64_t end, int depth, int num_threads,
                                 std::function<void(int64_t)> work)
    : end_(end), depth_(depth), work_(std::move(work)), next_(begin), released_(begin) {
  DAUMIER_CHECK(depth > 0 && num_threads > 0, "cannot prefetch {} items by {} threads", depth, num_threads);
  is_done_.resize(static_cast<size_t>(depth));
  errors_.resize(static_cast<size_t>(depth));
  for (int i = 0; i < num_threads; ++i) threads_.emplace_back([this] { Load(); });
}

PrefetchThreads::~PrefetchThreads() {
  {
    const std::lock_guard lock(mutex_);
    is_stopping_ = true;
  }
  may_begin_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void PrefetchThreads::Load() {
  std::unique_lock lock(mutex_);
  for (;;) {
    may_begin_.wait(lock, [this] { return is_stopping_ || next_ == end_ || next_ < released_ + depth_; });
    if (is_stopping_ || next_ == end_) return;
    WorkOnNext(lock);
  }
}

void PrefetchThreads::WorkOnNext(std::unique_lock<std::mutex>& lock) {
  const int64_t i = next_++;
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
  item_done_.notify_all();
}

void PrefetchThreads::Finish(int64_t i) {
  std::unique_lock lock(mutex_);
  DAUMIER_CHECK(i < end_, "item {} requested, expected 0 .. {}", i, end_ - 1);
  if (next_ == i) WorkOnNext(lock);
  item_done_.wait(lock, [&] { return is_done_[Slot(i)]; });
  is_done_[Slot(i)] = false;
  if (errors_[Slot(i)] == nullptr) return;
  const std::exception_ptr error = std::move(errors_[Slot(i)]);
  lock.unlock();
  Release(i);
  std::rethrow_exception(error);
}

void PrefetchThreads::Release(int64_t i) {
  {
    const std::lock_guard lock(mutex_);
    released_ = i + 1;
  }
  may_begin_.notify_all();
}

}  // namespace daumier
