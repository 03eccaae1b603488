#include "tensor/half_module.h"

#include "core/half.h"
#include "core/safetensors.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <torch/nn/modules/batchnorm.h>
#include <torch/nn/modules/container/sequential.h>
#include <torch/nn/modules/conv.h>
#include <torch/utils.h>

#include <limits>

namespace daumier::tensor {
namespace {

using testing::ExpectError;

torch::nn::Sequential NetworkToHalve(uint64_t seed) {
  torch::manual_seed(seed);
  torch::nn::Sequential network(torch::nn::Conv2d(3, 8, 3), torch::nn::BatchNorm2d(8), torch::nn::Conv2d(8, 4, 3));
  network->forward(torch::randn({5, 3, 9, 9}));
  network->eval();
  return network;
}

class HalfModuleTest : public ::testing::Test {
 protected:
  const testing::TempDir folder_;
};

TEST_F(HalfModuleTest, StoresProductsAsFloat16AndTheRestAsItIs) {
  auto network = NetworkToHalve(1);
  const std::string checksum = SaveHalfModule(folder_ / "a", *network);
  EXPECT_EQ(checksum, Sha256OfFile(folder_ / "a"));
  const SafetensorsFile file(folder_ / "a");
  EXPECT_EQ(file.at("0.weight").dtype, Dtype::kF16);
  EXPECT_EQ(file.at("2.weight").dtype, Dtype::kF16);
  for (const char* name : {"0.bias", "1.weight", "1.running_mean", "1.running_var"})
    EXPECT_EQ(file.at(name).dtype, Dtype::kF32) << name;
  EXPECT_EQ(file.at("1.num_batches_tracked").dtype, Dtype::kI64);
}

TEST_F(HalfModuleTest, RoundsEachWeightToTheNearestHalf) {
  auto network = NetworkToHalve(1), loaded = NetworkToHalve(2);
  SaveHalfModule(folder_ / "a", *network);
  LoadHalfModule(folder_ / "a", *loaded);
  const NamedTensors before = StateOf(*network), after = StateOf(*loaded);
  for (const auto& [name, tensor] : before) {
    if (tensor.dim() < 2) {
      EXPECT_TRUE(torch::equal(tensor, after.at(name))) << name;
      continue;
    }
    const torch::Tensor flat = tensor.flatten().detach(), other = after.at(name).flatten().detach();
    for (int64_t i = 0; i < flat.numel(); ++i)
      ASSERT_EQ(other[i].item<float>(), FloatFromHalf(HalfFromFloat(flat[i].item<float>()))) << name;
  }
  const torch::Tensor pictures = torch::randn({2, 3, 9, 9});
  const torch::Tensor own = network->forward(pictures), rounded = loaded->forward(pictures);
  const double difference = (own - rounded).abs().max().item<double>() / own.abs().max().item<double>();
  EXPECT_LT(difference, 2e-3);
  EXPECT_GT(difference, 0) << "float16 is coarser";
}

TEST_F(HalfModuleTest, RefusesWhatFloat16DoesNotHold) {
  auto network = NetworkToHalve(1);
  const at::NoGradGuard no_grad;
  NamedTensors state = StateOf(*network);
  state.at("1.running_var")[0] = 1e6;
  EXPECT_NO_THROW(SaveHalfModule(folder_ / "a", *network)) << "batch norms stay float32";
  state.at("2.weight").flatten()[3] = 65600;
  ExpectError([&] { SaveHalfModule(folder_ / "b", *network); }, "'2.weight' have values up to 65600");
  state.at("2.weight").flatten()[3] = std::numeric_limits<float>::quiet_NaN();
  ExpectError([&] { SaveHalfModule(folder_ / "b", *network); }, "'2.weight' are not all finite numbers");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "b"));
}

TEST_F(HalfModuleTest, OfAnotherShapeIsRefused) {
  SaveHalfModule(folder_ / "a", *NetworkToHalve(1));
  torch::nn::Sequential other(torch::nn::Conv2d(3, 7, 3), torch::nn::BatchNorm2d(7), torch::nn::Conv2d(7, 4, 3));
  ExpectError([&] { LoadHalfModule(folder_ / "a", *other); }, "0.weight is Float (8, 3, 3, 3), expected Float (7");
}

}  // namespace
}  // namespace daumier::tensor
