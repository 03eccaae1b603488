#include "tensor/module_state.h"

#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <torch/nn/modules/batchnorm.h>
#include <torch/nn/modules/container/sequential.h>
#include <torch/nn/modules/conv.h>
#include <torch/nn/modules/linear.h>
#include <torch/utils.h>

namespace daumier::tensor {
namespace {

using testing::ExpectError;
using testing::TempDir;

torch::nn::Sequential SmallNetwork(uint64_t seed) {
  torch::manual_seed(seed);
  torch::nn::Sequential network(torch::nn::Conv2d(1, 2, 3), torch::nn::BatchNorm2d(2), torch::nn::Flatten());
  network->forward(torch::randn({3, 1, 5, 5}));  // Moves the running statistics.
  return network;
}

TEST(ModuleState, HoldsParametersAndBuffersByName) {
  const auto state = StateOf(*SmallNetwork(1));
  std::vector<std::string> names;
  for (const auto& [name, tensor] : state) names.push_back(name);
  EXPECT_EQ(names, (std::vector<std::string>{"0.bias", "0.weight", "1.bias", "1.num_batches_tracked", "1.running_mean",
                                             "1.running_var", "1.weight"}));
}

TEST(ModuleState, SavedAndLoadedModuleHasTheSameOutput) {
  const TempDir folder;
  auto saved = SmallNetwork(1), loaded = SmallNetwork(2);
  const auto images = torch::randn({2, 1, 5, 5});
  saved->eval();
  loaded->eval();
  ASSERT_FALSE(torch::equal(saved->forward(images), loaded->forward(images)));
  const std::string checksum = SaveModule(folder / "model.safetensors", *saved);
  EXPECT_EQ(checksum, Sha256OfFile(folder / "model.safetensors"));
  LoadModule(folder / "model.safetensors", *loaded);
  EXPECT_TRUE(torch::equal(saved->forward(images), loaded->forward(images)));
}

TEST(ModuleState, LoadNamesWhatDoesNotFitAndChangesNothing) {
  auto network = SmallNetwork(1);
  NamedTensors state;
  for (const auto& [name, tensor] : StateOf(*network)) state[name] = tensor.clone() + 1;
  state.erase("0.bias");
  state["1.weight"] = torch::ones({3});
  state["1.bias"] = torch::ones({2}, torch::kFloat64);
  state["extra"] = torch::ones({1});
  const auto before = StateOf(*network).at("0.weight").clone();
  const auto load = [&] { LoadState(*network, state, "best/model.safetensors"); };
  ExpectError(load, "best/model.safetensors does not fit this network");
  ExpectError(load, "0.bias is missing");
  ExpectError(load, "1.weight is Float (3), expected Float (2)");
  ExpectError(load, "1.bias is Double (2), expected Float (2)");
  ExpectError(load, "extra is not part of this network");
  EXPECT_TRUE(torch::equal(StateOf(*network).at("0.weight"), before));
}

}  // namespace
}  // namespace daumier::tensor
