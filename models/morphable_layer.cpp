#include "models/morphable_layer.h"

#include "tensor/eigen.h"
#include "tensor/shape.h"

#include <ATen/Functions.h>

namespace daumier::models {

MorphableLayer::MorphableLayer(const faces::MorphableModel& model, torch::ScalarType type, torch::Device device)
    : num_identity_(model.identity.cols()), num_expression_(model.expression.cols()) {
  const auto place = [&](const torch::Tensor& tensor) { return tensor.to(device, type).contiguous(); };
  mean_ = place(tensor::CopyToTensor(model.face_template.neutral)).flatten();
  const torch::Tensor identity = tensor::CopyToTensor(model.identity.transpose()),
                      expression = tensor::CopyToTensor(model.expression.transpose());
  shapes_ = place(at::cat({identity, expression}, 0));
  albedo_mean_ = place(tensor::CopyToTensor(model.albedo_mean)).flatten();
  albedo_modes_ = place(tensor::CopyToTensor(model.albedo_modes.transpose()));
  std::vector<int64_t> coordinates;
  for (const int vertex : model.face_template.annotation.landmarks)
    for (int64_t axis = 0; axis < 3; ++axis) coordinates.push_back(3 * int64_t(vertex) + axis);
  const torch::Tensor index = torch::tensor(coordinates, torch::TensorOptions().dtype(torch::kInt64).device(device));
  landmark_mean_ = mean_.index_select(0, index);
  landmark_shapes_ = shapes_.index_select(1, index);
  triangles_ = tensor::CopyToTensor(model.face_template.triangles).to(device, torch::kInt32).contiguous();
}

torch::Tensor MorphableLayer::ShapeNumbers(const torch::Tensor& coefficients) const {
  tensor::CheckShape(coefficients, {tensor::kAny, faces::kNumCoefficients}, "coefficients");
  return at::cat({coefficients.narrow(1, faces::kIdentitySlot.first, num_identity_),
                  coefficients.narrow(1, faces::kExpressionSlot.first, num_expression_)},
                 1);
}

torch::Tensor MorphableLayer::Vertices(const torch::Tensor& coefficients) const {
  return at::addmm(mean_, ShapeNumbers(coefficients), shapes_).view({coefficients.size(0), -1, 3});
}

torch::Tensor MorphableLayer::Landmarks(const torch::Tensor& coefficients) const {
  return at::addmm(landmark_mean_, ShapeNumbers(coefficients), landmark_shapes_).view({coefficients.size(0), -1, 3});
}

torch::Tensor MorphableLayer::Albedo(const torch::Tensor& coefficients) const {
  tensor::CheckShape(coefficients, {tensor::kAny, faces::kNumCoefficients}, "coefficients");
  const torch::Tensor numbers = coefficients.narrow(1, faces::kAlbedoSlot.first, albedo_modes_.size(0));
  return at::addmm(albedo_mean_, numbers, albedo_modes_).view({coefficients.size(0), -1, 3});
}

}  // namespace daumier::models
