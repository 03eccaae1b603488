#include "train/batch.h"

#include "core/error.h"
#include "tensor/array.h"

namespace daumier::train {

const torch::Tensor& Batch::at(const std::string& name) const {
  const auto found = tensors.find(name);
  DAUMIER_CHECK(found != tensors.end(), "the batch has no tensor '{}'", name);
  return found->second;
}

torch::Tensor Batch::find(const std::string& name) const {
  const auto found = tensors.find(name);
  return found == tensors.end() ? torch::Tensor() : found->second;
}

Batch ToDevice(SampleBatch batch, const torch::Device& device) {
  const std::vector<int64_t> samples(batch.samples.begin(), batch.samples.end());
  Batch moved{torch::tensor(samples, torch::kInt64).to(device), {}};
  for (auto& [name, array] : batch.arrays) moved.tensors[name] = tensor::TakeTensor(std::move(array)).to(device);
  for (auto& [name, array] : batch.indices) moved.tensors[name] = tensor::TakeTensor(std::move(array)).to(device);
  return moved;
}

}  // namespace daumier::train
