#include "losses/state_loss.h"

#include "core/error.h"
#include "losses/label_loss.h"
#include "tensor/shape.h"

#include <ATen/ops/log_softmax.h>

#include <numeric>

namespace daumier::losses {

torch::Tensor StateLoss(const torch::Tensor& scores, const std::vector<int>& num_classes, const torch::Tensor& classes,
                        const torch::Tensor& state_weights) {
  const auto num_states = int64_t(num_classes.size());
  tensor::CheckShape(scores, {tensor::kAny, std::accumulate(num_classes.begin(), num_classes.end(), int64_t{0})},
                     "scores");
  tensor::CheckShape(classes, {scores.size(0), num_states}, "classes");
  tensor::CheckShape(state_weights, {num_states}, "state_weights");
  torch::Tensor sum = scores.sum() * 0, total = state_weights.sum() * 0;
  int64_t first = 0;
  for (int64_t state = 0; state < num_states; ++state) {
    const int64_t count = num_classes[size_t(state)];
    const torch::Tensor of_state = classes.select(1, state);
    const torch::Tensor weight = (of_state != kNoLabel).to(scores.scalar_type()) * state_weights[state];
    const torch::Tensor likelihood =
        at::log_softmax(scores.narrow(1, first, count), 1).gather(1, of_state.clamp_min(0).unsqueeze(1)).squeeze(1);
    sum = sum - (likelihood * weight).sum();
    total = total + weight.sum();
    first += count;
  }
  return sum / total.clamp_min(1);
}

}  // namespace daumier::losses
