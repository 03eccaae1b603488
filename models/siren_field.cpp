#include "models/siren_field.h"

#include "core/error.h"
#include "tensor/shape.h"

#include <ATen/Parallel.h>
#include <torch/csrc/autograd/custom_function.h>
#include <torch/csrc/jit/frontend/tracer.h>

#include <algorithm>

namespace daumier::models {
namespace {

void CheckShapes(const runtime::SirenLayout& layout, const torch::Tensor& parameters, const torch::Tensor& points) {
  tensor::CheckShape(parameters, {tensor::kAny, layout.num_parameters()}, "parameters");
  if (points.dim() == 2) {
    tensor::CheckShape(points, {tensor::kAny, 3}, "points");
  } else {
    tensor::CheckShape(points, {parameters.size(0), tensor::kAny, 3}, "points");
  }
}

/// What one thread does: some points of one SIREN. There are as many pieces of a SIREN as are needed to keep every
/// thread busy.
struct Work {
  Work(const torch::Tensor& parameters, const torch::Tensor& points)
      : num_sirens(parameters.size(0)),
        num_points(points.size(-2)),
        num_pieces(num_sirens >= at::get_num_threads() ? 1 : at::get_num_threads()),
        stride(points.dim() == 3 ? 3 * num_points : 0) {}

  /// Calls work(kernel, siren, piece, first point, number of points) for all of them.
  template <class Call>
  void ForEach(const runtime::SirenLayout& layout, const Call& call) const {
    at::parallel_for(0, num_sirens * num_pieces, 1, [&](int64_t begin, int64_t end) {
      runtime::SirenKernel kernel(layout);
      for (int64_t i = begin; i < end; ++i) {
        const int64_t siren = i / num_pieces, piece = i % num_pieces;
        const int64_t first = num_points * piece / num_pieces, last = num_points * (piece + 1) / num_pieces;
        if (last > first) call(kernel, siren, piece, first, last - first);
      }
    });
  }

  int64_t num_sirens, num_points, num_pieces, stride;
};

torch::Tensor Displacements(const runtime::SirenLayout& layout, const torch::Tensor& parameters,
                            const torch::Tensor& points) {
  const Work work(parameters, points);
  torch::Tensor displacements = torch::empty({work.num_sirens, work.num_points, 3}, points.options());
  const float *const p = parameters.data_ptr<float>(), *const x = points.data_ptr<float>();
  float* const y = displacements.data_ptr<float>();
  work.ForEach(layout, [&](runtime::SirenKernel& kernel, int64_t siren, int64_t, int64_t first, int64_t count) {
    kernel.Forward(p + siren * layout.num_parameters(), x + siren * work.stride + 3 * first, count,
                   y + 3 * (siren * work.num_points + first));
  });
  return displacements;
}

torch::Tensor ParameterGradient(const runtime::SirenLayout& layout, const torch::Tensor& parameters,
                                const torch::Tensor& points, const torch::Tensor& displacement_gradient) {
  const Work work(parameters, points);
  torch::Tensor gradient =
      torch::zeros({work.num_sirens, work.num_pieces, layout.num_parameters()}, parameters.options());
  const float *const p = parameters.data_ptr<float>(), *const x = points.data_ptr<float>(),
                     *const dy = displacement_gradient.data_ptr<float>();
  float* const dp = gradient.data_ptr<float>();
  work.ForEach(layout, [&](runtime::SirenKernel& kernel, int64_t siren, int64_t piece, int64_t first, int64_t count) {
    kernel.Backward(p + siren * layout.num_parameters(), x + siren * work.stride + 3 * first, count,
                    dy + 3 * (siren * work.num_points + first),
                    dp + (siren * work.num_pieces + piece) * layout.num_parameters());
  });
  return work.num_pieces == 1 ? gradient.squeeze(1) : gradient.sum(1);
}

class KernelFunction : public torch::autograd::Function<KernelFunction> {
 public:
  static torch::Tensor forward(torch::autograd::AutogradContext* context, const torch::Tensor& parameters,
                               const torch::Tensor& points, int64_t width, int64_t hidden_layers, double omega) {
    const runtime::SirenLayout layout{int(width), int(hidden_layers), omega};
    context->saved_data["width"] = width;
    context->saved_data["hidden_layers"] = hidden_layers;
    context->saved_data["omega"] = omega;
    context->save_for_backward({parameters, points});
    return Displacements(layout, parameters, points);
  }

  static torch::autograd::variable_list backward(torch::autograd::AutogradContext* context,
                                                 const torch::autograd::variable_list& gradients) {
    const auto saved = context->get_saved_variables();
    const runtime::SirenLayout layout{int(context->saved_data["width"].toInt()),
                                      int(context->saved_data["hidden_layers"].toInt()),
                                      context->saved_data["omega"].toDouble()};
    return {ParameterGradient(layout, saved[0], saved[1], gradients[0].contiguous()), {}, {}, {}, {}};
  }
};

}  // namespace

torch::Tensor SirenField(const runtime::SirenLayout& layout, const torch::Tensor& parameters,
                         const torch::Tensor& points) {
  CheckShapes(layout, parameters, points);
  const bool by_kernel = parameters.is_cpu() && parameters.scalar_type() == torch::kFloat32 &&
                         points.scalar_type() == torch::kFloat32 && !torch::jit::tracer::isTracing();
  if (!by_kernel) return SirenFieldByOperations(layout, parameters, points);
  DAUMIER_CHECK(!points.requires_grad(), "the field of a SIREN has no gradient by its points");
  return KernelFunction::apply(parameters.contiguous(), points.contiguous(), layout.width, layout.hidden_layers,
                               layout.omega);
}

torch::Tensor SirenFieldByOperations(const runtime::SirenLayout& layout, const torch::Tensor& parameters,
                                     const torch::Tensor& points) {
  CheckShapes(layout, parameters, points);
  torch::Tensor features = points;
  for (int layer = 0; layer < layout.num_layers(); ++layer) {
    const int64_t outputs = layout.outputs(layer), inputs = layout.inputs(layer);
    const torch::Tensor weights =
        parameters.narrow(1, layout.weight_offset(layer), outputs * inputs).reshape({-1, outputs, inputs});
    const torch::Tensor biases = parameters.narrow(1, layout.bias_offset(layer), outputs).unsqueeze(1);
    features = torch::matmul(features, weights.transpose(1, 2)) + biases;
    if (layer + 1 < layout.num_layers()) features = torch::sin(features * layout.omega);
  }
  return features;
}

}  // namespace daumier::models
