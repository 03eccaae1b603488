#pragma once
#include "core/array.h"

namespace daumier {

/// What a training step reads of B samples, as plain numbers. Loader threads fill it; the trainer moves it to tensors.
struct SampleBatch {
  std::vector<int> samples;  ///< Their indices in the dataset.
  NamedArrays arrays;        ///< B x ..., by name.
  std::map<std::string, Array<int64_t>> indices;
};

}  // namespace daumier
