#include "systems/deform/train/network.h"

#include "tests/support/deform_networks.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>
#include <torch/utils.h>

namespace daumier::deform {
namespace {

using testing::ExpectError;
using testing::SmallDeformOptions;
using testing::SomeTemplate;

const faces::ModelFrame kFrame{0.125, {0.5, -0.71, 0.25}};

TEST(DeformNetwork, EveryKindMovesVerticesAndPointsBetweenThem) {
  for (const std::string& kind : testing::DeformKinds()) {
    SCOPED_TRACE(kind);
    torch::manual_seed(1);
    const auto network = MakeDeformNetwork(SmallDeformOptions(kind), SomeTemplate(), kFrame);
    const torch::Tensor codes = torch::randn({4, 8}) * 0.01;
    EXPECT_EQ(network->DeformVertices(codes).sizes().vec(), (std::vector<int64_t>{4, 12, 3}));
    EXPECT_EQ(network->Deform(codes, testing::SomePoints(0)).sizes().vec(), (std::vector<int64_t>{4, 20, 3}));
    EXPECT_EQ(network->Deform(codes, testing::SomePoints(4)).sizes().vec(), (std::vector<int64_t>{4, 20, 3}));
  }
}

TEST(DeformNetwork, PointsOfItsOwnAreAsThoseSharedByAll) {
  for (const std::string& kind : testing::DeformKinds()) {
    SCOPED_TRACE(kind);
    torch::manual_seed(1);
    const auto network = MakeDeformNetwork(SmallDeformOptions(kind), SomeTemplate(), kFrame);
    const torch::Tensor codes = torch::randn({3, 8}) * 0.01;
    const SurfacePoints shared = testing::SomePoints(0);
    const SurfacePoints own{shared.corners.unsqueeze(0).expand({3, -1, -1}),
                            shared.weights.unsqueeze(0).expand({3, -1, -1}),
                            shared.positions.unsqueeze(0).expand({3, -1, -1})};
    EXPECT_TRUE(torch::allclose(network->Deform(codes, shared), network->Deform(codes, own), 1e-5, 1e-6));
  }
}

TEST(DeformNetwork, AVertexIsThePointOnIt) {
  for (const std::string& kind : testing::DeformKinds()) {
    SCOPED_TRACE(kind);
    torch::manual_seed(1);
    const auto network = MakeDeformNetwork(SmallDeformOptions(kind), SomeTemplate(), kFrame);
    const torch::Tensor codes = torch::randn({2, 8}) * 0.01;
    const SurfacePoints vertices = VerticesAsPoints(network->template_vertices().clone());
    EXPECT_TRUE(torch::allclose(network->DeformVertices(codes), network->Deform(codes, vertices), 1e-5, 1e-6));
  }
}

TEST(DeformNetwork, KeepsItsFrameAndTemplateAmongItsWeights) {
  const auto network = MakeDeformNetwork(SmallDeformOptions("positions"), SomeTemplate(), kFrame);
  EXPECT_EQ(network->frame().scale, 0.125);
  EXPECT_EQ(network->frame().offset, kFrame.offset);
  EXPECT_TRUE(network->named_buffers().contains("model_from_cm"));
  EXPECT_TRUE(torch::equal(network->named_buffers()["template_vertices"], SomeTemplate()));
}

TEST(DeformNetwork, RefusesAWidthThatTheKernelCannotTake) {
  DeformOptions odd = SmallDeformOptions("conditioning");
  odd.width = 40;
  ExpectError([&] { MakeDeformNetwork(odd, SomeTemplate(), kFrame); },
              "network.width is 40, expected a multiple of 16");
}

TEST(DeformNetwork, RefusesShapesThatDisagree) {
  const auto network = MakeDeformNetwork(SmallDeformOptions("displacements"), SomeTemplate(), kFrame);
  ExpectError([&] { network->DeformVertices(torch::zeros({2, 7})); }, "codes has shape (2, 7), expected (*, 8)");
  ExpectError(
      [&] {
        network->Deform(torch::zeros({3, 8}), testing::SomePoints(4));
      },
      "points.positions has shape (4, 20, 3)");
  ExpectError(
      [&] {
        MakeDeformNetwork(SmallDeformOptions("positions"), torch::zeros({4, 2}), kFrame);
      },
      "template_vertices");
}

}  // namespace
}  // namespace daumier::deform
