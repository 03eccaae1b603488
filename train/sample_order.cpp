#include "train/sample_order.h"

#include "core/error.h"
#include "core/random.h"

#include <algorithm>

namespace daumier::train {

SampleOrder::SampleOrder(uint64_t seed, int num_samples, int batch, int accumulate)
    : seed_(seed), num_samples_(num_samples), batch_(std::min(batch, num_samples)), accumulate_(accumulate) {
  DAUMIER_CHECK(num_samples > 0, "there is no training sample");
  DAUMIER_CHECK(int64_t(batch_) * accumulate <= num_samples,
                "a step of accumulate={} batches of {} samples needs more than the {} training samples", accumulate,
                batch_, num_samples);
}

std::shared_ptr<const std::vector<int>> SampleOrder::Permutation(int64_t epoch) const {
  const std::lock_guard lock(mutex_);
  if (epoch != epoch_) {
    permutation_ = std::make_shared<const std::vector<int>>(
        Stream(seed_, "training order", uint64_t(epoch)).Permutation(num_samples_));
    epoch_ = epoch;
  }
  return permutation_;
}

std::vector<int> SampleOrder::Batch(int64_t index) const {
  const int64_t step = index / accumulate_, position = index % (steps_per_epoch() * accumulate_);
  const auto order = Permutation(Epoch(step));
  const auto begin = order->begin() + position * batch_;
  return {begin, begin + batch_};
}

std::vector<int> SampleOrder::Step(int64_t step) const {
  std::vector<int> samples;
  for (int64_t index = step * accumulate_; index < (step + 1) * accumulate_; ++index)
    for (const int sample : Batch(index)) samples.push_back(sample);
  return samples;
}

}  // namespace daumier::train
