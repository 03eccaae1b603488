#include "systems/deform/train/baselines.h"

#include "core/error.h"
#include "tensor/shape.h"

#include <algorithm>
#include <limits>

namespace daumier::deform {
namespace {

/// (T, V, 3) -> (T, 3V).
torch::Tensor Rows(const torch::Tensor& faces) {
  tensor::CheckShape(faces, {tensor::kAny, tensor::kAny, 3}, "faces");
  return faces.reshape({faces.size(0), -1});
}

}  // namespace

DeformBaselines::DeformBaselines(torch::Tensor training, const torch::Tensor& validation, int num_components)
    : training_(Rows(training)) {
  DAUMIER_CHECK(training_.size(0) > 1, "baselines are fitted to two training faces or more, not {}", training_.size(0));
  DAUMIER_CHECK(validation.size(0) > 0, "the ridge weight of a linear model is chosen on validation faces: none");
  constexpr uint64_t kSeed = 1;
  components_ =
      models::FitPrincipalComponents(training_, std::min<int64_t>(num_components, training_.size(0) - 1), kSeed);
  training_.sub_(components_.mean);
  double least = std::numeric_limits<double>::infinity();
  for (const double ridge : {0.0, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1}) {
    const double error = (Linear(validation, ridge) - validation).norm(2, {2}).mean().item<double>();
    if (error < least) {
      least = error;
      ridge_ = ridge;
    }
  }
}

std::optional<int> DeformBaselines::ComponentsFor(double share) const {
  const double total = training_.square().sum(1).to(torch::kFloat64).mean().item<double>();
  const torch::Tensor explained = components_.deviations.to(torch::kFloat64).square().cumsum(0);
  const int count = int((explained < share * total).sum().item<int64_t>()) + 1;
  return count > explained.size(0) ? std::nullopt : std::optional<int>(count);
}

torch::Tensor DeformBaselines::Mean() const {
  return components_.mean.reshape({-1, 3});
}

torch::Tensor DeformBaselines::Nearest(const torch::Tensor& faces) const {
  // |a - b|^2 without |a|^2, which all have in common.
  const torch::Tensor distances = training_.square().sum(1) - 2 * torch::matmul(Centred(faces), training_.t());
  return (training_.index_select(0, distances.argmin(1)) + components_.mean).reshape(faces.sizes());
}

torch::Tensor DeformBaselines::Linear(const torch::Tensor& faces, double ridge) const {
  const torch::Tensor variances = components_.deviations.square();
  const torch::Tensor shrinkage = variances / (variances + ridge * variances.mean());
  const torch::Tensor scores = torch::matmul(Centred(faces), components_.rows.t()) * shrinkage;
  return (torch::matmul(scores, components_.rows) + components_.mean).reshape(faces.sizes());
}

torch::Tensor DeformBaselines::Centred(const torch::Tensor& faces) const {
  const torch::Tensor rows = Rows(faces);
  tensor::CheckShape(rows, {tensor::kAny, training_.size(1)}, "faces as rows");
  return rows - components_.mean;
}

}  // namespace daumier::deform
