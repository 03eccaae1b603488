#include "tensor/shape.h"

#include "core/error.h"

#include <algorithm>

namespace daumier::tensor {

std::string ShapeText(at::IntArrayRef shape) {
  std::string text;
  for (const int64_t size : shape) {
    text += (text.empty() ? "" : ", ") + (size == kAny ? std::string("*") : std::to_string(size));
  }
  return "(" + text + ")";
}

void CheckShape(const torch::Tensor& tensor, at::IntArrayRef expected, std::string_view name) {
  DAUMIER_CHECK(tensor.defined(), "{} is undefined, expected a tensor of shape {}", name, ShapeText(expected));
  const auto sizes = tensor.sizes();
  const bool equal = std::equal(sizes.begin(), sizes.end(), expected.begin(), expected.end(),
                                [](int64_t size, int64_t wanted) { return wanted == kAny || size == wanted; });
  DAUMIER_CHECK(equal, "{} has shape {}, expected {}", name, ShapeText(sizes), ShapeText(expected));
}

bool IsDenseFloat(const torch::Tensor& tensor) {
  return tensor.is_cpu() && tensor.scalar_type() == torch::kFloat32 && tensor.is_non_overlapping_and_dense();
}

}  // namespace daumier::tensor
