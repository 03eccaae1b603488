#include "export/weights.h"

#include "core/error.h"
#include "core/files.h"
#include "core/run_manifest.h"
#include "runtime/graph_runner.h"
#include "runtime/onnx_file.h"
#include "tensor/array.h"
#include "tensor/half_module.h"
#include "tensor/torch_version.h"
#include "tests/export/test_function.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>
#include <torch/utils.h>

namespace daumier::exporting {
namespace {

namespace fs = std::filesystem;
using testing::ExpectError;

/// y = x W of `size` numbers.
NetworkFunction MakeProduct(const Json& network) {
  const auto size = network.at("size").get<int64_t>();
  const auto module = std::make_shared<Weights>(tensor::NamedTensors{{"w", torch::zeros({size, size})}});
  const torch::Tensor w = module->named_parameters()["w"];
  return {module, TestFunction({size}, [w](const torch::Tensor& x) { return torch::matmul(x, w); })};
}

class WeightsTest : public ::testing::Test {
 protected:
  WeightsTest() {
    MakeDirectory(folder_ / "run/report");
    WriteManifest(folder_ / "run", ManifestOfProduct());
    WriteFileAtomically(folder_ / "run/report/metrics.json", R"({"vertex_error_mm": 1.25})");
  }

  static Manifest ManifestOfProduct() {
    Manifest manifest{.kind = "run", .verb = "train", .seed = 7};
    manifest.config = {{"epochs", 3}};
    manifest.sources = Json::array({{{"name", "Faces"}, {"licence", "MIT, (c) 2020 A University"}}});
    manifest.counts = {{"training_faces", 12}};
    manifest.details = {{"system", "product"}};
    return manifest;
  }

  RunExport Run(double scale = 1) const {
    torch::manual_seed(5);
    const NetworkFunction network = MakeProduct({{"size", 6}});
    const at::NoGradGuard no_grad;
    network.module->named_parameters()["w"].copy_(scale * torch::randn({6, 6}));
    RunExport run{.run_directory = folder_ / "run", .run_manifest = ManifestOfProduct()};
    run.module = network.module;
    run.function = network.function;
    run.card = {.title = "A product", .summary = "x W.", .inputs_and_outputs = "x, y\n\n", .limits = {"It errs."}};
    run.counts = {{"parameters", 36}};
    run.for_weights = RunExport::ForWeights{.network = {{"size", 6}}, .write_rest = {}};
    return run;
  }
  Json Write(const RunExport& run, std::vector<RecipeStep> recipe = {}, const std::string& notes = "") const {
    return WriteWeights(
        run, MakeProduct,
        {.out = folder_ / "product", .training_seconds = 61.4, .recipe = std::move(recipe), .notes = notes});
  }

  const testing::TempDir folder_;
};

TEST_F(WeightsTest, AreReadWithTheNumbersOfTheRunRoundedToHalf) {
  const RunExport run = Run();
  Write(run);
  const Manifest manifest = ReadWeights(folder_ / "product", "product", {kWeightsNetwork});
  const NetworkFunction read = ReadWeightsNetwork(folder_ / "product", manifest.details, MakeProduct);
  const torch::Tensor x = torch::randn({4, 6});
  const torch::Tensor own = run.function.forward({x})[0], other = read.function.forward({x})[0];
  EXPECT_TRUE(torch::allclose(own, other, 0, 0.01));
  EXPECT_FALSE(torch::equal(own, other));
  EXPECT_TRUE(torch::equal(read.module->named_parameters()["w"],
                           run.module->named_parameters()["w"].to(torch::kFloat16).to(torch::kFloat32)));
}

TEST_F(WeightsTest, TheirGraphComputesTheSameWithoutLibTorch) {
  Write(Run());
  const Manifest manifest = ReadWeights(folder_ / "product", "product", {kWeightsNetwork, kWeightsGraph});
  const NetworkFunction read = ReadWeightsNetwork(folder_ / "product", manifest.details, MakeProduct);
  const torch::Tensor x = torch::randn({4, 6});
  const FloatArray found = runtime::GraphRunner(runtime::ReadOnnx(folder_ / "product" / kWeightsGraph))
                               .Run({{"x", tensor::CopyToArray<float>(x)}})
                               .at("y");
  const FloatArray expected = tensor::CopyToArray<float>(read.function.forward({x})[0]);
  ASSERT_EQ(found.shape, expected.shape);
  for (size_t i = 0; i < found.values.size(); ++i) EXPECT_NEAR(found.values[i], expected.values[i], 1e-5);
  EXPECT_LT(fs::file_size(folder_ / "product" / kWeightsGraph), 500u);  // The numbers lie in network.safetensors.
}

TEST_F(WeightsTest, TheManifestSaysOfWhatTheyAreMade) {
  const Json details = Write(Run(), {{"daumier dataset faces --out data", 12.4}, {"daumier train a.toml", 61}});
  const Manifest manifest = ReadManifest(folder_ / "product", kWeightsKind);
  EXPECT_EQ(manifest.details, details);
  EXPECT_EQ(manifest.seed, 7U);
  EXPECT_EQ(manifest.config, ManifestOfProduct().config);
  EXPECT_EQ(manifest.sources, ManifestOfProduct().sources);
  EXPECT_EQ(manifest.counts, (Json{{"training_faces", 12}, {"parameters", 36}}));
  EXPECT_EQ(details.at("network"), (Json{{"size", 6}}));
  EXPECT_EQ(details.at("training_seconds"), 61);
  EXPECT_EQ(details.at("recipe")[0], (Json{{"command", "daumier dataset faces --out data"}, {"seconds", 12}}));
  EXPECT_EQ(details.at("run_data_hash"), DataHash(folder_ / "run"));
  const Json& half = details.at("float16");
  EXPECT_GT(half.at("largest_difference").at("y").get<double>(), 0);
  EXPECT_LT(half.at("largest_difference").at("y").get<double>(), 1e-3);
  EXPECT_EQ(half.at("samples"), "`x`: random numbers");
}

TEST_F(WeightsTest, TheCardHasDataLicencesCommandsErrorsAndLimits) {
  Write(Run(), {{"daumier train a.toml", 61}}, "## Known failures\n\nIt fails on zeros.");
  const std::string card = ReadFile(folder_ / "product" / kWeightsCard);
  for (const char* part :
       {"# A product\n", "Copyright (c) 2020 A University", "| `daumier train a.toml` | 61 |", "took 61 s", "seed is 7",
        "| vertex_error_mm | 1.25 |", "It fails on zeros.", "| `y` | ", "At most 0.01 is allowed", "- It errs."})
    EXPECT_NE(card.find(part), std::string::npos) << part << "\n" << card;
}

TEST_F(WeightsTest, ASystemAddsItsFilesAndWhatItNeeds) {
  RunExport run = Run();
  fs::path neighbours;
  run.for_weights->write_rest = [&](const fs::path& out, const fs::path& next_to) {
    neighbours = next_to.lexically_normal();
    WriteFileAtomically(out / "more.txt", "more");
    return WeightsParts{{{"more.txt", Sha256("more")}}, {{"needs", {{"face-ict", "abc"}}}}};
  };
  const Json details = Write(run);
  EXPECT_EQ(fs::absolute(neighbours / "x").parent_path(), fs::absolute(folder_.path() / "x").parent_path());
  EXPECT_EQ(details.at("needs").at("face-ict"), "abc");
  EXPECT_NO_THROW(ReadWeights(folder_ / "product", "product", {"more.txt", kWeightsNetwork}));
  EXPECT_NE(ReadFile(folder_ / "product" / kWeightsCard).find("needs the weights `face-ict`"), std::string::npos);
}

TEST_F(WeightsTest, WhatCannotBeShippedIsRefusedAndReplacesNothing) {
  Write(Run());
  const std::string before = DataHash(folder_ / "product");
  ExpectError([&] { Write(Run(1e6)); }, "which float16 does not hold");
  RunExport run = Run();
  run.for_weights.reset();
  ExpectError([&] { Write(run); }, "runs of the task 'product' are not shipped as weights");
  run = Run();
  run.for_weights->network = {{"size", 5}};
  ExpectError([&] { Write(run); }, "w is Float (6, 6), expected Float (5, 5)");
  fs::remove(folder_ / "run/report/metrics.json");
  ExpectError([&] { Write(Run()); }, "Run `daumier eval " + (folder_ / "run").string() + "` first");
  EXPECT_EQ(DataHash(folder_ / "product"), before);
}

/// A difference of large numbers loses what float16 drops: 300 (a - b) with a and b near 40.
TEST_F(WeightsTest, ANetworkThatFloat16ChangesTooMuchIsRefused) {
  RunExport run = Run();
  const torch::Tensor w = run.module->named_parameters()["w"];
  {
    const at::NoGradGuard no_grad;
    w.copy_(40 + 1e-3 * torch::randn({6, 6}));
  }
  run.function = TestFunction({6}, [w](const torch::Tensor& x) { return torch::matmul(x, w - 40); });
  const MakeNetwork make = [](const Json& network) {
    NetworkFunction made = MakeProduct(network);
    const torch::Tensor of_made = made.module->named_parameters()["w"];
    made.function = TestFunction({6}, [of_made](const torch::Tensor& x) { return torch::matmul(x, of_made - 40); });
    return made;
  };
  ExpectError([&] { WriteWeights(run, make, {.out = folder_ / "product"}); }, "float16 moves the output 'y' by ");
  EXPECT_FALSE(fs::exists(folder_ / "product"));
}

TEST_F(WeightsTest, RecipesAreListsOfCommands) {
  const auto read = [&](const std::string& text) {
    WriteFileAtomically(folder_ / "recipe.json", text);
    return ReadRecipe(folder_ / "recipe.json");
  };
  const std::vector<RecipeStep> steps = read(R"([{"command": "a b", "seconds": 2.5}, {"command": "c", "seconds": 0}])");
  ASSERT_EQ(steps.size(), 2U);
  EXPECT_EQ(steps[0].command, "a b");
  EXPECT_EQ(steps[0].seconds, 2.5);
  ExpectError([&] { read("{}"); }, "recipe.json: this is no list");
  ExpectError([&] { read(R"([{"command": "a"}])"); }, "recipe.json: step 1 is ");
  ExpectError([&] { read(R"([{"command": "a", "seconds": -1}])"); }, "step 1");
  ExpectError([&] { read(R"([{"command": 3, "seconds": 1}])"); }, "step 1");
}

}  // namespace
}  // namespace daumier::exporting
