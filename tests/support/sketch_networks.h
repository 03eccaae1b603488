#pragma once
#include "systems/sketch/train/network.h"
#include "tests/support/random_bilinear.h"

#include <map>
#include <string>

namespace daumier::testing {

/// Models of random numbers for faces of num_vertices vertices: 6 identity and 3 expression weights; curves of 9
/// points.
inline sketch::FittedModels RandomModels(int num_vertices, int residual = 0, uint64_t seed = 1) {
  sketch::FittedModels models{RandomBilinear(num_vertices, 6, 3, seed), RandomBilinear(6, 4, 2, seed + 1), {}};
  if (residual > 0) {
    Rng rng(seed + 2);
    const auto draw = [&] { return static_cast<float>(rng.Normal()); };
    models.basis.rows = faces::BilinearModel::Core::NullaryExpr(residual, 3 * num_vertices, draw);
    models.basis.deviation = Eigen::VectorXf::Constant(residual, 0.1f);
  }
  return models;
}

/// Every kind of network in a compact width, by the name of its row.
inline std::map<std::string, sketch::SketchNetworkOptions> SmallSketchNetworks() {
  const sketch::SketchNetworkOptions compact{.resolution = 32, .width = 8, .hidden = 16, .branch = 16};
  sketch::SketchNetworkOptions alexnet{.trunk = "alexnet",
                                       .resolution = 64,
                                       .width = 24,
                                       .hidden = 24,
                                       .branch = 16,
                                       .identity_layers = 3,
                                       .expression_layers = 1,
                                       .shape_hidden = 8};
  std::map<std::string, sketch::SketchNetworkOptions> networks{{"compact", compact}, {"PixelCNN", alexnet}};
  const auto add = [&](const std::string& name, const auto& change) {
    sketch::SketchNetworkOptions options = alexnet;
    change(options);
    networks[name] = options;
  };
  add("PixelCNN without batch norm", [](auto& options) { options.batch_norm = false; });
  add("PixelShapeCNN", [](auto& options) { options.shape_input = "late"; });
  add("early shape", [](auto& options) { options.shape_input = "early"; });
  add("PixelCNNSingle", [](auto& options) { options.branches = "one"; });
  add("ShapeNN", [](auto& options) { options.trunk = "shape"; });
  add("points", [](auto& options) {
    options.trunk = "points";
    options.width = 4;
    options.num_points = 20;
  });
  add("residual", [](auto& options) {
    options.trunk = "residual";
    options.width = 8;
    options.resolution = 32;
    options.residual = 8;
  });
  return networks;
}

/// What such a network reads of `batch` sketches.
inline sketch::SketchInput RandomSketchInput(const sketch::SketchNetworkOptions& options, int64_t batch) {
  return {(torch::rand({batch, 1, options.resolution, options.resolution}) < 0.1).to(torch::kFloat32),
          2 * torch::rand({batch, 4, options.num_points}) - 1, torch::randn({batch, 6})};
}

}  // namespace daumier::testing
