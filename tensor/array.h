#pragma once
#include "core/array.h"

#include <torch/types.h>

namespace daumier::tensor {

/// A tensor of the array's shape that takes over its memory, on the CPU; undefined if the array is.
template <class T>
torch::Tensor TakeTensor(Array<T> array) {
  if (!array.defined()) return {};
  auto* const kept = new Array<T>(std::move(array));
  return torch::from_blob(
      kept->values.data(), kept->shape, [kept](void*) { delete kept; }, c10::CppTypeToScalarType<T>::value);
}

/// A copy of a tensor of any layout and device. @throws c10::Error if the tensor is undefined.
template <class T>
Array<T> CopyToArray(const torch::Tensor& tensor) {
  const torch::Tensor plain = tensor.detach().to(torch::kCPU, c10::CppTypeToScalarType<T>::value).contiguous();
  return {plain.sizes().vec(), {plain.data_ptr<T>(), plain.data_ptr<T>() + plain.numel()}};
}

}  // namespace daumier::tensor
