#pragma once
#include "core/random.h"

#include <torch/nn/module.h>
#include <torch/types.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace daumier::exporting {

/// A float32 tensor with the batch in dimension 0.
struct ExportedInput {
  std::string name;
  std::vector<int64_t> shape;  ///< Of one sample, without the batch.
  /// Plausible inputs for which outputs are compared, (batch, shape...).
  std::function<torch::Tensor(int64_t batch, Rng& rng)> sample;
  bool batched = true;                         ///< Otherwise it has that shape whatever the batch is.
  std::string sample_text = "random numbers";  ///< What `sample` returns, for reports.
};

/// A network as a function of some tensors to others, each with the batch in dimension 0.
struct ExportedFunction {
  std::string name;
  std::vector<ExportedInput> inputs;
  std::vector<std::string> output_names;
  std::function<std::vector<torch::Tensor>(const std::vector<torch::Tensor>& inputs)> forward;
  std::map<std::string, std::string> metadata = {};  ///< Texts that the model carries.
};

/// A network and the function that it computes.
struct NetworkFunction {
  std::shared_ptr<torch::nn::Module> module;
  ExportedFunction function;
};

}  // namespace daumier::exporting
