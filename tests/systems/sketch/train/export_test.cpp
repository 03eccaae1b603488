#include "systems/sketch/train/export.h"

#include "core/manifest.h"
#include "export/onnx_export.h"
#include "tests/export/test_function.h"
#include "tests/support/expect_error.h"
#include "tests/support/sketch_run_folder.h"
#include "tests/support/warnings.h"

#include <algorithm>

namespace daumier::sketch {
namespace {

namespace fs = std::filesystem;
using testing::ExpectError;
using testing::TempDir;
using testing::WriteSketchRun;

std::vector<std::string> NamesIn(const fs::path& directory) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(directory)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

Json Export(const fs::path& run, const fs::path& out) {
  return exporting::WriteExport(DescribeSketchExport(run), out);
}

onnx::ModelProto ReadModel(const fs::path& file) {
  onnx::ModelProto model;
  EXPECT_TRUE(model.ParseFromString(ReadFile(file)));
  return model;
}

TEST(SketchExport, FunctionIsTheNetworkAndItsDecoder) {
  const TempDir folder;
  auto network = WriteSketchRun(folder.path());
  const auto sketches = torch::rand({2, 1, 32, 32});
  const auto outputs = SketchFunction(network).forward({sketches});
  const auto coefficients = network->forward({sketches, {}, {}});
  EXPECT_TRUE(torch::equal(outputs[0], coefficients.u));
  EXPECT_TRUE(torch::equal(outputs[1], coefficients.v));
  EXPECT_TRUE(torch::equal(outputs[2].flatten(1), network->Decode(coefficients)));
  EXPECT_EQ(outputs[2].size(2), 3);
}

// Never skips: where there is no ONNX Runtime the graph itself is what can be checked.
TEST(SketchExport, WithoutARuntimeWritesAGraphThatHoldsTheNetwork) {
  testing::AllowWarnings();
  const TempDir folder;
  const exporting::WithoutNpmPackage without;
  auto network = WriteSketchRun(folder / "run");
  const Json report = Export(folder / "run", folder / "out");
  EXPECT_EQ(NamesIn(folder / "out"),
            (std::vector<std::string>{"manifest.json", "model.onnx", "model_card.md", "parity.json", "template.json",
                                      "template.safetensors"}));
  EXPECT_EQ(Json::parse(ReadFile(folder / "out/parity.json")), report);
  const auto model = ReadModel(folder / "out/model.onnx");
  EXPECT_NO_THROW(exporting::CheckOnnx(model));

  const auto sizes = [](const onnx::ValueInfoProto& info) {
    std::vector<int64_t> sizes;
    for (const auto& dimension : info.type().tensor_type().shape().dim()) sizes.push_back(dimension.dim_value());
    return sizes;
  };
  ASSERT_EQ(model.graph().output_size(), 3);
  EXPECT_EQ(model.graph().input(0).name(), "sketch");
  EXPECT_EQ(sizes(model.graph().input(0)), (std::vector<int64_t>{0, 1, 32, 32}));
  EXPECT_EQ(model.graph().output(0).name(), "u");
  EXPECT_EQ(sizes(model.graph().output(0)), (std::vector<int64_t>{0, 6}));
  EXPECT_EQ(model.graph().output(1).name(), "v");
  EXPECT_EQ(sizes(model.graph().output(1)), (std::vector<int64_t>{0, 3}));
  EXPECT_EQ(model.graph().output(2).name(), "vertices");
  EXPECT_EQ(sizes(model.graph().output(2)), (std::vector<int64_t>{0, network->num_vertices(), 3}));

  const auto state = tensor::StateOf(*network);
  int num_found = 0;
  for (const auto& stored : model.graph().initializer()) {
    if (state.count(stored.name()) == 0) continue;
    const auto weight = state.at(stored.name()).contiguous();
    EXPECT_EQ(stored.raw_data(), std::string(static_cast<const char*>(weight.data_ptr()), weight.nbytes()))
        << stored.name();
    ++num_found;
  }
  const auto is_unused = [](const auto& item) {  // This network reads no shape-level numbers.
    return item.first.find("num_batches_tracked") != std::string::npos || item.first.rfind("shape_", 0) == 0;
  };
  EXPECT_EQ(num_found, static_cast<int>(state.size()) - std::count_if(state.begin(), state.end(), is_unused));
}

TEST(SketchExport, HasTheOutputsOfLibTorchInOnnxRuntime) {
  const TempDir folder;
  WriteSketchRun(folder / "run");
  testing::AllowWarnings();  // There may be no runtime.
  const Json report = Export(folder / "run", folder / "out");
  if (report["runtime"].is_null()) GTEST_SKIP() << "no ONNX Runtime here; run ./dev setup";
  EXPECT_LT(report["max_abs_diff"].get<double>(), 1e-4);
  EXPECT_EQ(report["opset"], 13);
}

TEST(SketchExport, EveryKindOfNetworkHasTheOutputsOfLibTorchInOnnxRuntimeAndOpenCv) {
  testing::AllowWarnings();  // There may be no runtime.
  for (const auto& [name, options] : testing::SmallSketchNetworks()) {
    SCOPED_TRACE(name);
    const TempDir folder;
    WriteSketchRun(folder / "run", name);
    const Json report = Export(folder / "run", folder / "out");
    const auto model = ReadModel(folder / "out/model.onnx");
    EXPECT_EQ(model.graph().input_size(),
              int(options.reads_image()) + int(options.reads_points()) + int(options.reads_shape()));
    EXPECT_EQ(model.graph().output_size(), options.residual > 0 ? 4 : 3);
    ASSERT_EQ(report["other_runtimes"].size(), 1u);
    const Json& opencv = report["other_runtimes"][0];
    EXPECT_TRUE(opencv["refusal"].is_null()) << opencv["refusal"];
    if (opencv["max_relative_diff"].is_number()) {
      EXPECT_LT(opencv["max_relative_diff"].get<double>(), 1e-4);
    }
    if (!report["runtime"].is_null()) {
      EXPECT_LT(report["max_abs_diff"].get<double>(), 1e-4);
    }
  }
}

TEST(SketchExport, ManifestCarriesSourcesAndChecksums) {
  testing::AllowWarnings();
  const TempDir folder;
  const exporting::WithoutNpmPackage without;
  WriteSketchRun(folder / "run");
  Export(folder / "run", folder / "out");
  const Manifest manifest = ReadManifest(folder / "out", "export");
  EXPECT_NO_THROW(VerifyChecksums(folder / "out", manifest));
  EXPECT_EQ(manifest.checksums.size(), 5u);
  EXPECT_EQ(manifest.sources, ReadManifest(folder / "run", "run").sources);
  EXPECT_EQ(manifest.details["run_data_hash"], DataHash(folder / "run"));
  // The same run gives the same bytes.
  Export(folder / "run", folder / "again");
  EXPECT_EQ(ReadFile(folder / "out/manifest.json"), ReadFile(folder / "again/manifest.json"));
}

TEST(SketchExport, FailureLeavesNothingBehind) {
  const TempDir folder;
  ExpectError([&] { Export(folder / "run", folder / "out"); }, "is not a run folder");
  WriteSketchRun(folder / "run");
  MakeDirectory(folder / "run/report");
  WriteFileAtomically(folder / "run/report/metrics.json", "[");
  ExpectError([&] { Export(folder / "run", folder / "out"); }, "metrics.json");
  EXPECT_EQ(NamesIn(folder.path()), (std::vector<std::string>{"run"}));
  fs::remove_all(folder / "run/report");
  ExpectError([&] { Export(folder / "run", folder / "run"); }, "holds no earlier export");
  EXPECT_TRUE(fs::exists(folder / "run/best/model.safetensors"));
}

}  // namespace
}  // namespace daumier::sketch
