#include "systems/deform/train/surface_decoder.h"

#include "tests/support/deform_networks.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>
#include <torch/utils.h>

namespace daumier::deform {
namespace {

geometry::Triangles SomeTriangles() {
  geometry::Triangles triangles(10, 3);
  for (int t = 0; t < 10; ++t) triangles.row(t) << t, t + 1, t + 2;
  return triangles;
}

std::shared_ptr<DeformNetwork> NetworkOf(const std::string& kind) {
  torch::manual_seed(1);
  return MakeDeformNetwork(testing::SmallDeformOptions(kind), testing::SomeTemplate(), {});
}

TEST(SurfaceDecoder, IsTheNetworkOfEveryKind) {
  for (const std::string& kind : testing::DeformKinds()) {
    SCOPED_TRACE(kind);
    const auto network = NetworkOf(kind);
    const torch::Tensor code = 0.1 * torch::randn({8});
    const SurfaceDecoder decoder(network, code);
    EXPECT_TRUE(torch::allclose(decoder.Vertices(), network->DeformVertices(code.unsqueeze(0))[0]));
  }
}

TEST(SurfaceDecoder, ASubdividedSurfaceBeginsWithTheVertices) {
  const geometry::Subdivider subdivider(SomeTriangles(), 12, 2);
  for (const std::string& kind : testing::DeformKinds()) {
    SCOPED_TRACE(kind);
    const auto network = NetworkOf(kind);
    const SurfaceDecoder decoder(network, 0.1 * torch::randn({8}));
    const torch::Tensor fine = decoder.Vertices(subdivider, SubdividedTemplate(*network, subdivider));
    EXPECT_EQ(fine.size(0), subdivider.num_vertices());
    EXPECT_TRUE(torch::allclose(fine.slice(0, 0, 12), decoder.Vertices(), 1e-5, 1e-6));
  }
}

TEST(SurfaceDecoder, ASirenIsEvaluatedBetweenVertices) {
  const geometry::Subdivider subdivider(SomeTriangles(), 12, 1);
  const auto network = NetworkOf("hypernetwork");
  const torch::Tensor code = 0.1 * torch::randn({8}), fine = SubdividedTemplate(*network, subdivider);
  const SurfacePoints points{torch::zeros({fine.size(0), 3}, torch::kInt64), torch::zeros_like(fine), fine};
  const torch::Tensor expected = network->Deform(code.unsqueeze(0), points)[0],
                      decoded = SurfaceDecoder(network, code).Vertices(subdivider, fine);
  EXPECT_TRUE(torch::allclose(decoded, expected, 1e-5, 1e-6));
  const auto [a, b] = geometry::SubdivideOnce(SomeTriangles(), 12).edges.front();
  EXPECT_GT((decoded[12] - 0.5 * (decoded[a] + decoded[b])).norm().item<double>(), 1e-4);
}

TEST(SurfaceDecoder, RefusesACodeOfAnotherLength) {
  testing::ExpectError([] { SurfaceDecoder(NetworkOf("positions"), torch::zeros({7})); }, "code has shape (7)");
}

}  // namespace
}  // namespace daumier::deform
