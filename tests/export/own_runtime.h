#pragma once
#include "export/exported_function.h"
#include "runtime/graph_runner.h"
#include "runtime/onnx_file.h"
#include "tensor/array.h"
#include "tensor/torch_version.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace daumier::exporting {

/// The model's outputs in runtime/ are those of LibTorch at batch sizes 1, 2 and 7, up to 1e-5 of an output's largest
/// value.
inline void ExpectTheSameInOwnRuntime(const std::filesystem::path& model, const ExportedFunction& function) {
  const at::NoGradGuard no_grad;
  const runtime::GraphRunner runner(runtime::ReadOnnx(model));
  Rng rng = Stream(1, "own runtime");
  for (const int64_t batch : {1, 2, 7}) {
    std::vector<torch::Tensor> tensors;
    NamedArrays arrays;
    for (const ExportedInput& input : function.inputs) {
      tensors.push_back(input.sample(batch, rng));
      arrays[input.name] = tensor::CopyToArray<float>(tensors.back());
    }
    const std::vector<torch::Tensor> expected = function.forward(tensors);
    const NamedArrays found = runner.Run(arrays);
    for (size_t i = 0; i < expected.size(); ++i) {
      const std::string& name = function.output_names[i];
      const FloatArray own = found.at(name), other = tensor::CopyToArray<float>(expected[i]);
      ASSERT_EQ(own.shape, other.shape) << name;
      double largest = 1e-30, difference = 0;
      for (size_t k = 0; k < own.values.size(); ++k) {
        largest = std::max(largest, std::abs(double(other.values[k])));
        difference = std::max(difference, std::abs(double(own.values[k]) - other.values[k]));
      }
      EXPECT_LE(difference, 1e-5 * largest) << name << " at batch size " << batch;
    }
  }
}

}  // namespace daumier::exporting
