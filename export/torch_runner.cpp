#include "export/torch_runner.h"

#include "core/error.h"
#include "tensor/array.h"
#include "tensor/torch_version.h"

namespace daumier::exporting {
namespace {

/// "(N, 1, 128, 128)", or without N where the input has one shape whatever the batch is.
std::string ShapeText(const ExportedInput& input) {
  std::string text = input.batched ? "N" : "";
  for (const int64_t size : input.shape) text += fmt::format("{}{}", text.empty() ? "" : ", ", size);
  return "(" + text + ")";
}

torch::Tensor InputOf(const ExportedInput& input, const NamedArrays& inputs) {
  const auto found = inputs.find(input.name);
  DAUMIER_CHECK(found != inputs.end(), "the network reads '{}', which is missing", input.name);
  const std::vector<int64_t>& shape = found->second.shape;
  const std::vector<int64_t> sample(shape.begin() + (input.batched && !shape.empty() ? 1 : 0), shape.end());
  DAUMIER_CHECK(sample == input.shape, "the input '{}' is ({}), expected {}", input.name, fmt::join(shape, ", "),
                ShapeText(input));
  return torch::from_blob(const_cast<float*>(found->second.values.data()), shape, torch::kFloat32);
}

}  // namespace

TorchRunner::TorchRunner(NetworkFunction network, const torch::Device& device)
    : network_(std::move(network)), device_(device) {
  network_.module->eval();
  network_.module->to(device_);
}

NamedArrays TorchRunner::Run(const NamedArrays& inputs) const {
  const at::NoGradGuard no_grad;
  std::vector<torch::Tensor> tensors;
  for (const ExportedInput& input : network_.function.inputs) tensors.push_back(InputOf(input, inputs).to(device_));
  const std::vector<torch::Tensor> outputs = network_.function.forward(tensors);
  NamedArrays arrays;
  for (size_t i = 0; i < outputs.size(); ++i)
    arrays[network_.function.output_names[i]] = tensor::CopyToArray<float>(outputs[i]);
  return arrays;
}

}  // namespace daumier::exporting
