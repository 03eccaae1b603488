#pragma once
#include "core/sample_batch.h"
#include "tensor/tensor_file.h"

namespace daumier::train {

/// A SampleBatch on the device of a training: the same arrays and indices by the same names.
struct Batch {
  torch::Tensor samples;  ///< (B) int64, indices of the dataset.
  tensor::NamedTensors tensors;

  /// @throws Error if the batch has no tensor of that name.
  const torch::Tensor& at(const std::string& name) const;
  /// The tensor of that name, undefined if there is none.
  torch::Tensor find(const std::string& name) const;
};

/// Takes over the memory of the arrays; to a GPU it copies them.
Batch ToDevice(SampleBatch batch, const torch::Device& device);

}  // namespace daumier::train
