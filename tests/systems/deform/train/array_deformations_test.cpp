#include "systems/deform/train/array_deformations.h"

#include "tests/support/deform_networks.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>
#include <torch/utils.h>

namespace daumier::deform {
namespace {

using testing::SmallDeformOptions;
using testing::SomeTemplate;

TEST(ArrayDeformation, HasAsManyParametersAsPublished) {
  // 128 -> 400 -> 3 x 11,551: 13.9 million [Jung et al. 2022, supplement 3].
  const ArrayDeformation network({.kind = "positions"}, torch::zeros({11551, 3}), {});
  EXPECT_EQ(network.num_parameters(), 128 * 400 + 400 + 400 * 34653 + 34653);
}

TEST(ArrayDeformation, DisplacementsArePositionsFromTheTemplate) {
  const auto made = [](const std::string& kind) {
    torch::manual_seed(5);
    return MakeDeformNetwork(SmallDeformOptions(kind), SomeTemplate(), {});
  };
  const torch::Tensor codes = torch::randn({3, 8});
  EXPECT_TRUE(torch::allclose(made("displacements")->DeformVertices(codes),
                              made("positions")->DeformVertices(codes) + SomeTemplate(), 1e-5, 1e-6));
}

TEST(ArrayDeformation, OverfitsEightFaces) {
  for (const std::string kind : {"displacements", "positions"}) {
    SCOPED_TRACE(kind);
    torch::manual_seed(6);
    EXPECT_LT(testing::ErrorAfterOverfitting(SmallDeformOptions(kind), 400, 1e-2), 0.1);
  }
}

TEST(VertexDeformation, APointLiesWhereItsCornersAreTaken) {
  LinearDeformation network(SmallDeformOptions("linear"), SomeTemplate(), {});
  const SurfacePoints point{torch::tensor({{2, 5, 7}}), torch::tensor({{0.5f, 0.25f, 0.25f}}), torch::zeros({1, 3})};
  const torch::Tensor expected = 0.5 * SomeTemplate()[2] + 0.25 * SomeTemplate()[5] + 0.25 * SomeTemplate()[7];
  EXPECT_TRUE(torch::allclose(network.Deform(torch::zeros({1, 8}), point)[0][0], expected));
}

TEST(LinearDeformation, IsTheMeanPlusRowsByTheirCode) {
  LinearDeformation network(SmallDeformOptions("linear"), SomeTemplate(), {});
  torch::manual_seed(8);
  const torch::Tensor mean = torch::randn({36}), rows = torch::randn({8, 36});
  network.Set(mean, rows);
  torch::Tensor code = torch::zeros({1, 8});
  code[0][3] = 2;
  EXPECT_TRUE(torch::allclose(network.DeformVertices(code).reshape({-1}), mean + 2 * rows[3]));
  testing::ExpectError([&] { network.Set(mean.slice(0, 3), rows); }, "mean has shape");
  testing::ExpectError([&] { network.Set(mean, rows.slice(0, 3)); }, "rows has shape");
}

}  // namespace
}  // namespace daumier::deform
