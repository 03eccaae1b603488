#include "systems/deform/train/siren_deformations.h"

#include "models/siren_field.h"

#include <torch/nn/functional/activation.h>
#include <torch/nn/init.h>

#include <cmath>

namespace daumier::deform {

namespace nn = torch::nn;

torch::Tensor SirenDeformation::Positions(const torch::Tensor& codes, const SurfacePoints& points) {
  return points.positions + models::SirenField(options().siren(), SirenParameters(codes), points.positions);
}

HypernetworkBranchImpl::HypernetworkBranchImpl(int latent, int width, int64_t outputs, double last_bias)
    : first_(register_module("first", nn::Linear(latent, width))),
      second_(register_module("second", nn::Linear(width, width))),
      last_(register_module("last", nn::Linear(width, outputs))) {
  const at::NoGradGuard no_grad;
  for (nn::Linear& layer : {std::ref(first_), std::ref(second_), std::ref(last_)})
    nn::init::kaiming_normal_(layer->weight, 0.0, torch::kFanIn, torch::kReLU);
  last_->weight.div_(100);
  nn::init::uniform_(last_->bias, -last_bias, last_bias);
}

torch::Tensor HypernetworkBranchImpl::forward(const torch::Tensor& codes) {
  return last_->forward(torch::relu(second_->forward(torch::relu(first_->forward(codes)))));
}

HypernetworkDeformation::HypernetworkDeformation(const DeformOptions& options, const torch::Tensor& template_vertices,
                                                 const faces::ModelFrame& frame)
    : SirenDeformation(options, template_vertices, frame) {
  const runtime::SirenLayout siren = options.siren();
  for (int layer = 0; layer < siren.num_layers(); ++layer) {
    const int64_t outputs = siren.outputs(layer), inputs = siren.inputs(layer);
    const std::string number = std::to_string(layer);
    branches_.push_back(register_module(
        "weights_" + number,
        HypernetworkBranch(options.latent, options.hyper_width, outputs * inputs, 1.0 / double(inputs))));
    branches_.push_back(register_module("biases_" + number, HypernetworkBranch(options.latent, options.hyper_width,
                                                                               outputs, 1.0 / options.hyper_width)));
  }
}

torch::Tensor HypernetworkDeformation::SirenParameters(const torch::Tensor& codes) {
  std::vector<torch::Tensor> parts;
  for (HypernetworkBranch& branch : branches_) parts.push_back(branch->forward(codes));
  return torch::cat(parts, 1);
}

ConditionedDeformation::ConditionedDeformation(const DeformOptions& options, const torch::Tensor& template_vertices,
                                               const faces::ModelFrame& frame)
    : SirenDeformation(options, template_vertices, frame) {
  const runtime::SirenLayout siren = options.siren();
  shared_ = register_parameter("shared", torch::empty({siren.num_parameters()}));
  first_code_ = register_parameter("first_code", torch::empty({siren.width, options.latent}));
  mid_code_ = register_parameter("mid_code", torch::empty({siren.width, options.latent}));
  const at::NoGradGuard no_grad;
  nn::init::uniform_(first_code_, -1.0 / 3, 1.0 / 3);
  nn::init::uniform_(mid_code_, -1.0 / 3, 1.0 / 3);
  for (int layer = 0; layer < siren.num_layers(); ++layer) {
    const double inputs = siren.inputs(layer);
    const double weight = layer == 0 ? 1 / inputs : std::sqrt(6 / inputs) / siren.omega;
    const double bias = 1 / std::sqrt(inputs) / siren.omega;
    const int64_t begin = siren.weight_offset(layer), middle = siren.bias_offset(layer),
                  end = siren.weight_offset(layer + 1);
    shared_.slice(0, begin, middle).uniform_(-weight, weight);
    shared_.slice(0, middle, end).uniform_(-bias, bias);
  }
}

torch::Tensor ConditionedDeformation::SirenParameters(const torch::Tensor& codes) {
  const runtime::SirenLayout siren = options().siren();
  const torch::Tensor zero = codes.narrow(1, 0, 1) * 0;  // (B, 1), makes a row a code of what they share.
  const auto shared = [&](int64_t begin, int64_t end) { return zero + shared_.narrow(0, begin, end - begin); };
  const int mid = siren.num_layers() / 2;
  const int64_t first_bias = siren.bias_offset(0), after_first = siren.weight_offset(1),
                mid_bias = siren.bias_offset(mid), after_mid = siren.weight_offset(mid + 1);
  return torch::cat({shared(0, first_bias), shared(first_bias, after_first) + torch::matmul(codes, first_code_.t()),
                     shared(after_first, mid_bias), shared(mid_bias, after_mid) + torch::matmul(codes, mid_code_.t()),
                     shared(after_mid, siren.num_parameters())},
                    1);
}

}  // namespace daumier::deform
