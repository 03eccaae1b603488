#include "export/run_export.h"

#include "core/error.h"
#include "core/files.h"
#include "core/run_manifest.h"
#include "tests/export/test_function.h"
#include "tests/support/expect_error.h"
#include "tests/support/warnings.h"

#include <gtest/gtest.h>

namespace daumier::exporting {
namespace {

namespace fs = std::filesystem;

class RunExportTest : public ::testing::Test {
 protected:
  RunExportTest() {
    testing::AllowWarnings();  // There may be no runtime.
    MakeDirectory(folder_ / "run/best");
    WriteManifest(folder_ / "run", ManifestOfRun());
  }

  static Manifest ManifestOfRun() {
    Manifest manifest;
    manifest.kind = "run";
    manifest.sources = Json::array({{{"name", "synthetic"}, {"licence", "CC0-1.0"}}});
    return manifest;
  }

  RunExport Export() const {
    const auto module = std::make_shared<Weights>(tensor::NamedTensors{{"w", torch::full({3}, 2.0f)}});
    const torch::Tensor w = module->named_parameters()["w"];
    return {.run_directory = folder_ / "run",
            .run_manifest = ManifestOfRun(),
            .module = module,
            .function = TestFunction({3}, [w](const torch::Tensor& x) { return x * w; }),
            .card = {.title = "A product", .summary = "Twice x.", .inputs_and_outputs = "x, y\n\n", .limits = {}},
            .counts = {{"parts", 3}},
            .details = {{"colour", "blue"}},
            .write_rest = [](const fs::path& folder) {
              WriteFileAtomically(folder / "more.txt", "more");
              return std::map<std::string, std::string>{{"more.txt", Sha256("more")}};
            }};
  }

  const testing::TempDir folder_;
  const WithoutNpmPackage without_;
};

TEST_F(RunExportTest, ManifestListsTheFilesAndTheEntriesOfTheCaller) {
  WriteExport(Export(), folder_ / "out");
  const Manifest manifest = ReadManifest(folder_ / "out", "export");
  VerifyChecksums(folder_ / "out", manifest);
  EXPECT_EQ(manifest.checksums.count("more.txt"), 1u);
  EXPECT_EQ(manifest.counts.at("parts"), 3);
  EXPECT_EQ(manifest.details.at("colour"), "blue");
  EXPECT_EQ(manifest.details.at("opset"), 13);
  EXPECT_NE(ReadFile(folder_ / "out/model_card.md").find("Not measured"), std::string::npos);
}

TEST_F(RunExportTest, TheCardSeesTheRunsMetrics) {
  MakeDirectory(folder_ / "run/report");
  WriteFileAtomically(folder_ / "run/report/metrics.json", "{}");
  WriteExport(Export(), folder_ / "out");
  EXPECT_EQ(ReadFile(folder_ / "out/model_card.md").find("Not measured"), std::string::npos);
}

TEST_F(RunExportTest, AFailureReplacesNothing) {
  WriteExport(Export(), folder_ / "out");
  const std::string before = ReadFile(folder_ / "out/manifest.json");
  RunExport fails = Export();
  fails.write_rest = [](const fs::path&) -> std::map<std::string, std::string> { throw Error("no room left"); };
  testing::ExpectError([&] { WriteExport(fails, folder_ / "out"); }, "no room left");
  EXPECT_EQ(ReadFile(folder_ / "out/manifest.json"), before);
}

TEST_F(RunExportTest, SamplesOfTheRunsDataTakeThePlaceOfRandomOnes) {
  RunExport run = Export();
  EXPECT_EQ(FunctionWithSamples(run).inputs[0].sample_text, "random numbers");
  run.find_samples = [](ExportedFunction& function) { function.inputs[0].sample_text = "drawn numbers"; };
  EXPECT_EQ(FunctionWithSamples(run).inputs[0].sample_text, "drawn numbers");
  EXPECT_EQ(run.function.inputs[0].sample_text, "random numbers");
  EXPECT_EQ(WriteExport(run, folder_ / "out").at("inputs").at("x"), "drawn numbers");
}

TEST_F(RunExportTest, AGraphIsStoredNextToTheWeightsAndInTheManifest) {
  StoreGraph(Export());
  const Manifest manifest = ReadManifest(folder_ / "run", "run");
  VerifyChecksums(folder_ / "run", manifest);
  EXPECT_EQ(manifest.checksums.count(kBestGraph), 1u);
  onnx::ModelProto model;
  ASSERT_TRUE(model.ParseFromString(ReadFile(folder_ / "run" / kBestGraph)));
  EXPECT_NO_THROW(CheckOnnx(model));
}

}  // namespace
}  // namespace daumier::exporting
