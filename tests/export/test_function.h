#pragma once
#include "core/files.h"
#include "export/onnx_export.h"
#include "export/onnx_runtime.h"
#include "tensor/module_state.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>
#include <torch/nn/module.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>

namespace daumier::exporting {

/// A module with the named parameters of `weights`, in evaluation mode.
struct Weights : torch::nn::Module {
  explicit Weights(const tensor::NamedTensors& weights = {}) {
    for (const auto& [name, weight] : weights) register_parameter(name, weight);
    eval();
  }
};

/// A function of one input "x" to one output "y".
inline ExportedFunction TestFunction(std::vector<int64_t> shape,
                                     std::function<torch::Tensor(const torch::Tensor&)> forward) {
  const auto sample = [shape](int64_t batch, Rng& rng) {
    std::vector<int64_t> whole = shape;
    whole.insert(whole.begin(), batch);
    auto values = torch::empty(whole);
    std::generate_n(values.data_ptr<float>(), values.numel(), [&] { return float(rng.Uniform(-1, 1)); });
    return values;
  };
  return {
      "test", {{"x", shape, sample}}, {"y"}, [forward = std::move(forward)](const std::vector<torch::Tensor>& inputs) {
        return std::vector<torch::Tensor>{forward(inputs[0])};
      }};
}

/// Where a Daumier without native ONNX Runtime finds none, as on a machine without the npm package.
class WithoutNpmPackage {
 public:
  WithoutNpmPackage() { setenv("DAUMIER_NPM", "/nonexistent", 1); }
  ~WithoutNpmPackage() { unsetenv("DAUMIER_NPM"); }
};

}  // namespace daumier::exporting
