#include "systems/deform/run_folder.h"

#include "core/config.h"
#include "core/files.h"
#include "core/run_manifest.h"
#include "core/safetensors.h"
#include "faces/face_database.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_face.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <array>

namespace daumier::deform {
namespace {

using testing::ExpectError;

/// A finished run on the synthetic face whose weights are no network.
class DeformRunFolderTest : public ::testing::Test {
 protected:
  DeformRunFolderTest() {
    MakeDirectory(run() / "best");
    WriteConfig({{"system", kSystem},
                 {"network", ToJson(DeformOptions{.kind = "positions", .latent = 12})},
                 {"loss", {{"data_weight", 2e3}, {"code_weight", 5e5}}}});
    Manifest manifest;
    manifest.kind = "run";
    manifest.verb = "train";
    manifest.details = {{"system", kSystem}};
    manifest.checksums = faces::WriteFaceTemplate(run(), testing::SyntheticFace());
    SafetensorsWriter weights;
    const std::array<float, 2> numbers{1, 2};
    weights.Add<float>("weight", {2}, numbers);
    manifest.checksums[kBestFile] = weights.Write(BestWeights(run()));
    WriteManifest(run(), manifest);
  }

  std::filesystem::path run() const { return folder_ / "run"; }
  void WriteConfig(const Json& config) const { WriteFileAtomically(ResolvedConfig(run()), ToToml(config)); }
  void SetDetails(const Json& details) const {
    Manifest manifest = ReadManifest(run(), "run");
    manifest.details = details;
    WriteManifest(run(), manifest);
  }
  void ExpectRefused(const std::string& part) const {
    ExpectError([&] { ReadDeformRunFolder(run()); }, part);
  }

  const testing::TempDir folder_;
};

TEST_F(DeformRunFolderTest, IsReadBackWithTemplateOptionsAndWeightsOfTheEnergy) {
  const DeformRunFolder read = ReadDeformRunFolder(run());
  EXPECT_EQ(read.directory, run());
  EXPECT_EQ(SystemOf(read.manifest), "deform");
  EXPECT_EQ(read.config["system"], "deform");
  EXPECT_EQ(read.face_template.triangles, testing::SyntheticFace().triangles);
  EXPECT_EQ(read.network_options.kind, "positions");
  EXPECT_EQ(read.network_options.latent, 12);
  EXPECT_EQ(read.data_weight, 2e3);
  EXPECT_EQ(read.code_weight, 5e5);
}

TEST_F(DeformRunFolderTest, AnEarlierRunHasAProductInsteadOfASystem) {
  SetDetails({{"product", "deform"}});
  EXPECT_EQ(ReadDeformRunFolder(run()).network_options.latent, 12);
}

TEST_F(DeformRunFolderTest, ARunOfAnotherTaskIsRefusedWithBothNames) {
  const std::string message = "this is a run of the task 'sketch' (expected a run of 'deform')";
  SetDetails({{"system", "sketch"}});
  ExpectRefused(message);
  SetDetails(Json::object());
  ExpectRefused(message);
}

TEST_F(DeformRunFolderTest, AConfigWithoutNetworkOrLossIsRefusedWithTheFile) {
  WriteConfig({{"loss", {{"data_weight", 2e3}, {"code_weight", 5e5}}}});
  ExpectRefused("resolved.toml is malformed");
  WriteConfig({{"network", ToJson(DeformOptions())}});
  ExpectRefused("resolved.toml is malformed");
}

TEST_F(DeformRunFolderTest, AnUnknownNetworkOptionIsRefusedWithTheFile) {
  WriteConfig({{"network", {{"latents", 12}}}, {"loss", {{"data_weight", 2e3}, {"code_weight", 5e5}}}});
  ExpectRefused("resolved.toml: unknown key 'latents'; did you mean 'latent'?");
}

TEST_F(DeformRunFolderTest, AMissingTemplateIsRefused) {
  std::filesystem::remove(run() / "template.json");
  ExpectRefused("template.json");
}

}  // namespace
}  // namespace daumier::deform
