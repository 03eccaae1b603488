#include "systems/portrait/train/portrait_run.h"

#include "core/run_manifest.h"
#include "tensor/module_state.h"
#include "tests/support/expect_error.h"
#include "tests/systems/portrait/train/small_portrait_runs.h"

namespace daumier::portrait {
namespace {

TEST(PortraitRun, HasTheTrainedNetworkWithoutGradients) {
  PortraitRun run = LoadPortraitRun(testing::SmallPortraitRun());
  EXPECT_FALSE(run.network->is_training());
  EXPECT_EQ(run.network->options().resolution, 32);
  EXPECT_EQ(run.manifest.counts.at("parameters"), run.network->num_parameters());
  for (const torch::Tensor& parameter : run.network->parameters()) EXPECT_FALSE(parameter.requires_grad());
  const tensor::NamedTensors loaded = tensor::StateOf(*run.network);
  PortraitNetwork other(run.options.network, run.model.expression_weights);
  tensor::LoadModule(BestWeights(testing::SmallPortraitRun()), *other);
  for (const auto& [name, tensor] : tensor::StateOf(*other)) EXPECT_TRUE(loaded.at(name).equal(tensor)) << name;
  // The usual pose is that of the training's crops.
  EXPECT_GT(run.network->usual_pose().abs().max().item<float>(), 1);
}

TEST(PortraitRun, RefusesWeightsOfAnotherNetwork) {
  const testing::TempDir folder;
  std::filesystem::copy(testing::SmallPortraitRun(), folder / "run", std::filesystem::copy_options::recursive);
  PortraitNetwork wider(PortraitNetworkOptions{.depth = 18, .resolution = 32, .width = 16},
                        faces::ExpressionWeights::kUnit);
  Manifest manifest = ReadManifest(folder / "run", "run");
  manifest.checksums[kBestFile] = tensor::SaveModule(BestWeights(folder / "run"), *wider);
  WriteManifest(folder / "run", manifest);
  testing::ExpectError([&] { LoadPortraitRun(folder / "run"); }, "model.safetensors");
  testing::ExpectError([] { LoadPortraitRun(testing::SmallPortraitFolder() / "portraits"); }, "portraits");
}

}  // namespace
}  // namespace daumier::portrait
