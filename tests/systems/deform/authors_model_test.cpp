#include "systems/deform/authors_model.h"

#include "core/safetensors.h"
#include "tests/support/authors_model.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <limits>

namespace daumier::deform {
namespace {

using testing::AuthorsState;
using testing::ExpectError;
using testing::TempDir;

TEST(AuthorsModel, ThePapersSizesHave71TensorsAndItsNumberOfParameters) {
  NamedArrays state;
  testing::ForEachAuthorsTensor(testing::kPaperSizes, [&](const std::string& name, const std::vector<int64_t>& shape,
                                                          double) { state[name] = FloatArray(shape); });
  EXPECT_EQ(state.size(), 71u);
  const AuthorsModel model = AuthorsModelOf(state, "a.pth");
  EXPECT_EQ(ToJson(model.options), ToJson(DeformOptions()));
  EXPECT_EQ(model.unused.size(), 10u);
  int64_t hyper = 0, unused = 0;
  for (const auto& [name, array] : model.arrays)
    if (name != "codes") hyper += std::ssize(array.values);
  for (const std::string& name : model.unused) unused += std::ssize(state.at(name).values);
  EXPECT_EQ(hyper, 13949955);
  EXPECT_EQ(unused, 50435);
  EXPECT_EQ(std::ssize(model.arrays.at("codes").values), 162304);
}

TEST(AuthorsModel, SizesAreThoseOfTheTensors) {
  const AuthorsModel model =
      AuthorsModelOf(AuthorsState({.faces = 3, .latent = 4, .width = 32, .hyper_width = 8, .layers = 3}), "a.pth");
  EXPECT_EQ(model.options.latent, 4);
  EXPECT_EQ(model.options.width, 32);
  EXPECT_EQ(model.options.hyper_width, 8);
  EXPECT_EQ(model.options.hidden_layers, 1);
  EXPECT_EQ(model.options.omega, 30);
}

TEST(AuthorsModel, TheUnusedParametersMayBeAbsent) {
  NamedArrays state = AuthorsState();
  std::erase_if(state, [](const auto& item) { return item.first.starts_with("deform_net"); });
  EXPECT_TRUE(AuthorsModelOf(state, "a.pth").unused.empty());
}

TEST(AuthorsModel, NamesTensorsThatAreMissingOrOthersOrHaveAnotherShape) {
  const auto refused = [](auto change, const std::string& part) {
    NamedArrays state = AuthorsState();
    change(state);
    ExpectError([&] { AuthorsModelOf(state, "a.pth"); }, part);
  };
  refused([](NamedArrays& state) { state.erase("latent_codes.weight"); },
          "a.pth: there is no tensor 'latent_codes.weight' (expected one of shape (faces, length of a code))");
  refused([](NamedArrays& state) { state.erase("hyper_net.nets.4.net.1.0.bias"); },
          "there is no tensor 'hyper_net.nets.4.net.1.0.bias' (expected one of shape (32))");
  refused(
      [](NamedArrays& state) {
        state["hyper_net.nets.4.net.2.0.weight"] = FloatArray({256, 31});
      },
      "the tensor 'hyper_net.nets.4.net.2.0.weight' has the shape (256, 31), expected (256, 32)");
  refused(
      [](NamedArrays& state) {
        state["deform_net.net.net.0.0.weight"] = FloatArray({3, 16});
      },
      "the tensor 'deform_net.net.net.0.0.weight' has the shape (3, 16), expected (16, 3)");
  refused([](NamedArrays& state) { state["latent_codes.weight"] = FloatArray({320}); },
          "'latent_codes.weight' has the shape (320), expected (faces, length of a code)");
  refused(
      [](NamedArrays& state) {
        state["encoder.weight"] = FloatArray({2, 5});
      },
      "the network has no tensors encoder.weight (2, 5)");
  refused([](NamedArrays& state) { state.erase("hyper_net.nets.9.net.0.0.weight"); },
          "the weights of 9 networks hyper_net.nets.N");
  refused(
      [](NamedArrays& state) {
        state["hyper_net.nets.0.net.0.0.bias"].values[3] = std::numeric_limits<float>::quiet_NaN();
      },
      "'hyper_net.nets.0.net.0.0.bias' has a number that is not finite");
}

TEST(AuthorsModel, TheStateIsReadFromSafetensorsToo) {
  const TempDir folder;
  const NamedArrays state = AuthorsState();
  SafetensorsWriter writer;
  for (const auto& [name, array] : state) writer.Add<float>(name, array.shape, array.values);
  writer.Write(folder / "state.safetensors");
  testing::WriteTorchState(folder / "state.pth", state);
  for (const char* name : {"state.safetensors", "state.pth"}) {
    const NamedArrays read = ReadStateFile(folder / name);
    ASSERT_EQ(read.size(), state.size());
    for (const auto& [tensor, array] : state) {
      EXPECT_EQ(read.at(tensor).shape, array.shape) << tensor;
      EXPECT_EQ(read.at(tensor).values, array.values) << tensor;
    }
  }
  SafetensorsWriter others;
  const std::vector<Half> half = {HalfFromFloat(0.5f)};
  others.Add<Half>("half", {1}, half);
  others.Write(folder / "half.safetensors");
  EXPECT_EQ(ReadStateFile(folder / "half.safetensors").at("half").values[0], 0.5f);
  SafetensorsWriter whole;
  const std::vector<int64_t> integers = {3};
  whole.Add<int64_t>("integers", {1}, integers);
  whole.Write(folder / "whole.safetensors");
  ExpectError([&] { ReadStateFile(folder / "whole.safetensors"); }, "'integers' are neither float32 nor float16");
  ExpectError([&] { ReadStateFile(folder / "absent.pth"); }, "there is no such file");
}

}  // namespace
}  // namespace daumier::deform
