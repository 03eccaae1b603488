#include "systems/deform/train/unseen_faces.h"

#include "tests/support/deform_networks.h"

#include <gtest/gtest.h>
#include <torch/utils.h>

namespace daumier::deform {
namespace {

TEST(UnseenFaces, FacesThatTheNetworkCanMakeAreMissedByLittleAndOthersByTheirDistance) {
  torch::manual_seed(3);
  const auto network =
      MakeDeformNetwork(testing::SmallDeformOptions("displacements"), testing::SomeTemplate(), {});
  const at::NoGradGuard no_grad;
  const torch::Tensor makes = network->DeformVertices(torch::randn({2, 8}));
  const CodeFitOptions free{.code_weight = 0, .solve = {.num_rows = 12}};
  EXPECT_LT(UnseenError(*network, makes, free), 1e-3);
  // So heavy a weight keeps the code at zero.
  const CodeFitOptions held{.code_weight = 1e12, .solve = {.num_rows = 12}};
  const torch::Tensor at_zero = network->DeformVertices(torch::zeros({1, 8}));
  EXPECT_NEAR(UnseenError(*network, at_zero + torch::tensor({0.0f, 0.3f, 0.4f}), held), 0.5, 1e-3);
}

}  // namespace
}  // namespace daumier::deform
