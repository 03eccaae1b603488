#pragma once
#include <torch/types.h>

#include <string>
#include <string_view>

namespace daumier::tensor {

/// In an expected shape: any size.
inline constexpr int64_t kAny = -1;

/// "(2, 1, 128)"; kAny reads "*".
std::string ShapeText(at::IntArrayRef shape);

/// CheckShape(images, {kAny, 1, 128, 128}, "images").
/// @throws Error "images has shape (2, 3), expected (*, 1, 128, 128)" if the number of dimensions or a size differs, or
/// if the tensor is undefined.
void CheckShape(const torch::Tensor& tensor, at::IntArrayRef expected, std::string_view name);

/// Whether its numbers are float32 in one piece of this computer's memory, in whatever order of dimensions: what loops
/// over data_ptr() need.
bool IsDenseFloat(const torch::Tensor& tensor);

}  // namespace daumier::tensor
