#pragma once
#include <torch/types.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace daumier::exporting {

/// A network as a function of one tensor to several, each with the batch in dimension 0.
struct ExportedFunction {
  std::string name;
  std::string input_name;
  std::vector<int64_t> input_shape;  ///< Of one sample, without the batch.
  std::vector<std::string> output_names;
  std::function<std::vector<torch::Tensor>(const torch::Tensor& input)> forward;
};

}  // namespace daumier::exporting
