#include "losses/box_loss.h"

#include "core/error.h"
#include "tensor/shape.h"

#include <ATen/ops/log_sigmoid.h>

namespace daumier::losses {

BoxLossTerms BoxLoss(const torch::Tensor& boxes, const BoxTargets& targets) {
  tensor::CheckShape(boxes, {tensor::kAny, 5, tensor::kAny, tensor::kAny}, "boxes");
  const int64_t batch = boxes.size(0), height = boxes.size(2), width = boxes.size(3);
  tensor::CheckShape(targets.score, {batch, height, width}, "targets.score");
  tensor::CheckShape(targets.box, {batch, 4, height, width}, "targets.box");
  tensor::CheckShape(targets.weight, {batch, height, width}, "targets.weight");
  const torch::Tensor scores = boxes.select(1, 0), p = scores.sigmoid();
  const torch::Tensor is_centre = (targets.score == 1).to(scores.scalar_type());
  const torch::Tensor at_centre = is_centre * (1 - p).square() * at::log_sigmoid(scores);
  const torch::Tensor elsewhere = (1 - is_centre) * (1 - targets.score).pow(4) * p.square() * at::log_sigmoid(-scores);
  const torch::Tensor miss = (boxes.narrow(1, 1, 4) - targets.box).abs().sum(1);
  return {-(at_centre + elsewhere).sum() / is_centre.sum().clamp_min(1),
          (miss * targets.weight).sum() / targets.weight.sum().clamp_min(1)};
}

}  // namespace daumier::losses
