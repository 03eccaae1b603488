#include "tensor/tensor_file.h"

#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <torch/utils.h>

namespace daumier::tensor {
namespace {

using testing::ExpectError;
using testing::TempDir;

NamedTensors OneOfEachType() {
  torch::manual_seed(1);
  return {{"u8", torch::tensor({0, 128, 255}, torch::kUInt8)},
          {"i32", torch::tensor({-1, 7}, torch::kInt32)},
          {"i64", torch::tensor({int64_t{1} << 40}, torch::kInt64)},
          {"f32", torch::randn({2, 3, 4})},
          {"f64", torch::randn({3, 2}, torch::kFloat64).t()},
          {"scalar", torch::tensor(3.5f)},
          {"f16", torch::randn({3}).to(torch::kFloat16)},
          {"i8", torch::tensor({-128, 127}, torch::kInt8)},
          {"i16", torch::tensor({-32768, 5}, torch::kInt16)}};
}

TEST(TensorFile, SaveAndLoadRoundTripsEveryType) {
  const TempDir folder;
  const auto tensors = OneOfEachType();
  SaveTensors(folder / "a.safetensors", tensors);
  const auto loaded = LoadTensors(folder / "a.safetensors");
  ASSERT_EQ(loaded.size(), tensors.size());
  for (const auto& [name, tensor] : tensors) {
    EXPECT_EQ(loaded.at(name).scalar_type(), tensor.scalar_type()) << name;
    EXPECT_TRUE(torch::equal(loaded.at(name), tensor)) << name;
  }
}

TEST(TensorFile, EqualTensorsGiveEqualBytesWhateverTheirLayout) {
  const TempDir folder;
  const auto tensor = torch::arange(6, torch::kFloat32).view({2, 3});
  const auto transposed_twice = tensor.t().contiguous().t();
  ASSERT_FALSE(transposed_twice.is_contiguous());
  const auto first = SaveTensors(folder / "a", {{"x", tensor}});
  EXPECT_EQ(first, SaveTensors(folder / "b", {{"x", transposed_twice}}));
  EXPECT_EQ(first, Sha256OfFile(folder / "a"));
}

TEST(TensorFile, LoadedTensorsMayBeWritten) {
  const TempDir folder;
  SaveTensors(folder / "a", {{"x", torch::ones({2})}});
  auto x = LoadTensors(folder / "a").at("x");
  x += 1;
  EXPECT_EQ(x.sum().item<float>(), 4.0f);
}

TEST(TensorFile, ViewKeepsTheMappingAlive) {
  const TempDir folder;
  SaveTensors(folder / "a", {{"x", torch::arange(5)}});
  torch::Tensor view;
  {
    const SafetensorsFile file(folder / "a");
    view = ViewOfArray(file, "x");
    EXPECT_EQ(view.data_ptr(), file.at("x").data);
  }
  EXPECT_TRUE(torch::equal(view, torch::arange(5)));
}

TEST(TensorFile, RefusesTypesThatCannotBeStoredAndArraysThatAreNotThere) {
  const TempDir folder;
  ExpectError(
      [&] {
        SaveTensors(folder / "a", {{"mask", torch::ones({2}, torch::kBool)}});
      },
      "tensor 'mask' has element type Bool");
  EXPECT_FALSE(std::filesystem::exists(folder / "a"));
  SaveTensors(folder / "a", {{"x", torch::ones({2})}});
  ExpectError([&] { ViewOfArray(SafetensorsFile(folder / "a"), "y"); }, "y");
}

}  // namespace
}  // namespace daumier::tensor
