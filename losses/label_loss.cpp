#include "losses/label_loss.h"

#include "core/error.h"
#include "tensor/shape.h"

#include <ATen/ops/log_softmax.h>

namespace daumier::losses {

torch::Tensor LabelLoss(const torch::Tensor& scores, const torch::Tensor& labels, const torch::Tensor& class_weights) {
  tensor::CheckShape(scores, {tensor::kAny, tensor::kAny, tensor::kAny, tensor::kAny}, "scores");
  tensor::CheckShape(labels, {scores.size(0), scores.size(2), scores.size(3)}, "labels");
  tensor::CheckShape(class_weights, {scores.size(1)}, "class_weights");
  const torch::Tensor counts = labels != kNoLabel, classes = labels.clamp_min(0);
  const torch::Tensor weights =
      class_weights.index_select(0, classes.flatten()).view_as(classes) * counts.to(class_weights.scalar_type());
  const torch::Tensor likelihood = at::log_softmax(scores, 1).gather(1, classes.unsqueeze(1)).squeeze(1);
  return -(likelihood * weights).sum() / weights.sum().clamp_min(1);
}

}  // namespace daumier::losses
