#include "systems/open_network.h"

#include "core/files.h"
#include "core/manifest.h"
#include "core/run_manifest.h"
#include "core/weights_folder.h"
#include "tests/runtime/onnx_bytes.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <cmath>

namespace daumier::systems {
namespace {

namespace fs = std::filesystem;

class OpenNetworkTest : public ::testing::Test {
 protected:
  /// A folder of that kind whose network is a convolution of ones, in these files.
  fs::path Folder(const std::string& kind, const std::string& weights, const std::string& graph) const {
    const fs::path folder = folder_ / kind;
    Manifest manifest{.kind = kind, .verb = "train"};
    manifest.details = {{"weights_version", kWeightsVersion}, {"system", "ones"}};
    for (const auto& [name, bytes] : std::map<std::string, std::string>{
             {weights, "weights"}, {graph, runtime::OnesModel()}, {kWeightsCard, "card"}}) {
      if (name.empty()) continue;
      MakeDirectory((folder / name).parent_path());
      WriteFileAtomically(folder / name, bytes);
      manifest.checksums[name] = Sha256(bytes);
    }
    WriteManifest(folder, manifest);
    return folder;
  }
  static void ExpectOnes(const fs::path& folder) {
    const NamedArrays outputs = OpenNetwork(folder, {})->Run({{"x", {{1, 1, 3, 3}, std::vector<float>(9, 1)}}});
    EXPECT_EQ(outputs.at("y").values, (std::vector<float>{4, 6, 4, 6, 9, 6, 4, 6, 4}));
  }

  const testing::TempDir folder_;
};

TEST_F(OpenNetworkTest, ReadsTheGraphOfARunAndOfWeights) {
  ExpectOnes(Folder("run", kBestFile, kBestGraph));
  ExpectOnes(Folder(kWeightsKind, kWeightsNetwork, kWeightsGraph));
}

/// Test binaries without LibTorch have no run path to the library.
TEST_F(OpenNetworkTest, WithoutAGraphOrOnAnotherDeviceItIsLibTorchs) {
  const fs::path old = Folder("run", kBestFile, "");
  testing::ExpectError([&] { OpenNetwork(old, {}); }, "libdaumier_training.so");
  const fs::path weights = Folder(kWeightsKind, kWeightsNetwork, kWeightsGraph);
  testing::ExpectError([&] { OpenNetwork(weights, {Device::Kind::kCuda, 0}); }, "libdaumier_training.so");
}

TEST_F(OpenNetworkTest, ADamagedGraphIsRefused) {
  const fs::path weights = Folder(kWeightsKind, kWeightsNetwork, kWeightsGraph);
  WriteFileAtomically(weights / kWeightsGraph, "damaged");
  testing::ExpectError([&] { OpenNetwork(weights, {}); }, "network.onnx has changed");
}

TEST_F(OpenNetworkTest, EveryShippedNetworkRunsWithoutLibTorch) {
  struct Case {
    const char *name, *input;
    int64_t channels, side;
    std::vector<std::string> outputs;
  };
  const Case cases[] = {{"parser", "pictures", 1, 256, {"heat_maps", "labels", "states"}},
                        {"sketch-ict", "sketch", 1, 128, {"residual", "u", "v", "vertices"}},
                        {"landmarks", "pictures", 3, 128, {"boxes", "heat_maps", "labels", "states"}},
                        {"portrait", "crop", 3, 128, {"coefficients"}}};
  for (const auto& [name, input, channels, side, outputs] : cases) {
    const auto network = OpenNetwork(testing::SourceRoot() / "weights" / name, {});
    const NamedArrays found = network->Run({{input, FloatArray({2, channels, side, side})}});
    std::vector<std::string> names;
    for (const auto& [output, array] : found) {
      names.push_back(output);
      EXPECT_EQ(array.shape.at(0), 2) << output;
      EXPECT_TRUE(std::equal(array.row(0), array.row(1), array.row(1), [](float a, float b) {
        return std::isfinite(a) && std::abs(a - b) <= 1e-5f * std::max(1.0f, std::abs(a));
      })) << output;
    }
    EXPECT_EQ(names, outputs);
  }
}

}  // namespace
}  // namespace daumier::systems
