#include "systems/deform/train/baselines.h"

#include "tensor/eigen.h"
#include "tensor/shape.h"

namespace daumier::deform {
namespace {

/// (n, V, 3) -> n x 3V.
eval::FaceRows RowsOf(const torch::Tensor& faces) {
  tensor::CheckShape(faces, {tensor::kAny, tensor::kAny, 3}, "faces");
  return tensor::CopyToMatrix<float>(faces.flatten(1));
}

/// Takes ownership of the faces and frees them.
eval::FaceRows TakeRows(torch::Tensor faces) {
  eval::FaceRows rows = RowsOf(faces);
  faces.reset();  // The caller keeps the argument until the end of its expression.
  return rows;
}

}  // namespace

DeformBaselines::DeformBaselines(torch::Tensor training, const torch::Tensor& validation, int num_components)
    : DeformBaselines(eval::Centre(TakeRows(std::move(training))), RowsOf(validation), num_components) {}

DeformBaselines::DeformBaselines(eval::CentredRows training, const eval::FaceRows& validation, int num_components)
    : linear_model_(eval::FitLinearModel(training, validation, num_components, 1)),
      nearest_(std::move(training.rows)) {}

torch::Tensor DeformBaselines::Mean() const {
  return tensor::CopyToTensor(linear_model_.components.mean).reshape({-1, 3});
}

torch::Tensor DeformBaselines::Nearest(const torch::Tensor& faces) const {
  const Eigen::RowVectorXf& mean = linear_model_.components.mean;
  eval::FaceRows rows = RowsOf(faces);
  DAUMIER_CHECK(rows.cols() == mean.size(), "faces have {} coordinates, expected {}", rows.cols(), mean.size());
  rows.rowwise() -= mean;
  const std::vector<int> nearest = nearest_.Nearest(rows);
  for (size_t i = 0; i < nearest.size(); ++i) rows.row(Eigen::Index(i)) = nearest_.rows().row(nearest[i]) + mean;
  return tensor::ViewAsTensor(rows).clone().reshape(faces.sizes());
}

torch::Tensor DeformBaselines::Linear(const torch::Tensor& faces) const {
  eval::FaceRows rows = linear_model_.Predict(RowsOf(faces));
  return tensor::ViewAsTensor(rows).clone().reshape(faces.sizes());
}

}  // namespace daumier::deform
