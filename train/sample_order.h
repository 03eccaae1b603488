#pragma once
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace daumier::train {

/// Which samples every step of a training reads: in each epoch a permutation of them all, a function of (seed, epoch)
/// alone, cut into steps; those left over at its end are skipped. Thread-safe.
class SampleOrder {
 public:
  /// A step has `accumulate` batches of `batch` samples; a batch has num_samples where that is less.
  /// @throws Error if a step needs more samples than there are.
  SampleOrder(uint64_t seed, int num_samples, int batch, int accumulate);

  int accumulate() const { return accumulate_; }
  int64_t steps_per_epoch() const { return num_samples_ / (batch_ * accumulate_); }
  int64_t Epoch(int64_t step) const { return step / steps_per_epoch(); }
  /// Samples of batch number step * accumulate + k, k = 0, ..., accumulate - 1.
  std::vector<int> Batch(int64_t index) const;
  /// Samples of all batches of a step.
  std::vector<int> Step(int64_t step) const;

 private:
  std::shared_ptr<const std::vector<int>> Permutation(int64_t epoch) const;

  const uint64_t seed_;
  const int num_samples_, batch_, accumulate_;
  mutable std::mutex mutex_;
  mutable int64_t epoch_ = -1;  ///< Of the permutation that is kept.
  mutable std::shared_ptr<const std::vector<int>> permutation_;
};

}  // namespace daumier::train
