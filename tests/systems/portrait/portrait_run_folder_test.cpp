#include "systems/portrait/portrait_run_folder.h"

#include "core/config.h"
#include "core/files.h"
#include "core/run_manifest.h"
#include "tests/support/expect_error.h"
#include "tests/support/small_portraits.h"
#include "tests/support/temp_dir.h"

namespace daumier::portrait {
namespace {

/// A finished run of the synthetic 3DMM, without weights that a network could read.
void WritePortraitRun(const std::filesystem::path& folder, const Json& config, const std::string& system) {
  MakeDirectory(folder / "best");
  WriteFileAtomically(folder / kBestFile, "weights");
  WriteFileAtomically(folder / "resolved.toml", ToToml(config));
  Manifest manifest{.kind = "run", .verb = "train"};
  manifest.config = config;
  manifest.config.erase("data");
  manifest.details = {{"system", system}};
  manifest.checksums = faces::WriteMorphableFiles(folder, testing::SyntheticMorphable());
  manifest.checksums[kBestFile] = Sha256("weights");
  WriteManifest(folder, manifest);
}

Json PortraitRunConfig() {
  PortraitTrainingOptions options;
  options.network = {.depth = 18, .resolution = 96, .width = 8};
  options.pictures.leave_out = {"toon", "bald"};
  options.data = {.faces = "/faces", .portraits = "/portraits"};
  return ToJson(options);
}

TEST(PortraitRunFolder, HasTheOptionsAndTheModelOfItsTraining) {
  const testing::TempDir folder;
  WritePortraitRun(folder / "run", PortraitRunConfig(), kPortraitSystem);
  const PortraitRunFolder run = ReadPortraitRunFolder(folder / "run");
  EXPECT_EQ(run.directory, folder / "run");
  EXPECT_EQ(run.options.network.resolution, 96);
  EXPECT_EQ(run.options.pictures.leave_out, (std::vector<std::string>{"toon", "bald"}));
  EXPECT_EQ(run.options.data.portraits, "/portraits");
  EXPECT_EQ(run.config, PortraitRunConfig());
  EXPECT_EQ(SystemOf(run.manifest), kPortraitSystem);
  const faces::MorphableModel model = testing::SyntheticMorphable();
  EXPECT_TRUE(run.model.identity == model.identity);
  EXPECT_TRUE(run.model.albedo_modes == model.albedo_modes);
  EXPECT_EQ(run.model.expression_names, model.expression_names);
  EXPECT_EQ(run.model.centre, model.centre);
}

TEST(PortraitRunFolder, OfAnotherTaskOrNowhereIsRefused) {
  const testing::TempDir folder;
  WritePortraitRun(folder / "run", {{"system", "landmarks"}}, "landmarks");
  testing::ExpectError([&] { ReadPortraitRunFolder(folder / "run"); }, "landmarks");
  testing::ExpectError([&] { ReadPortraitRunFolder(folder / "nowhere"); }, "nowhere");
}

TEST(PortraitRunFolder, ConfigsThatAreMalformedAreNamed) {
  const testing::TempDir folder;
  Json config = PortraitRunConfig();
  config["loss"]["landmark"] = 1;
  WritePortraitRun(folder / "run", config, kPortraitSystem);
  testing::ExpectError([&] { ReadPortraitRunFolder(folder / "run"); }, "resolved.toml");
  testing::ExpectError([&] { ReadPortraitRunFolder(folder / "run"); }, "loss.landmark");
}

TEST(PortraitRunFolder, WithoutWeightsOrModelIsRefused) {
  const testing::TempDir folder;
  WritePortraitRun(folder / "run", PortraitRunConfig(), kPortraitSystem);
  std::filesystem::remove(folder / "run/morphable.safetensors");
  testing::ExpectError([&] { ReadPortraitRunFolder(folder / "run"); }, "morphable.safetensors");
  std::filesystem::remove(folder / "run" / kBestFile);
  testing::ExpectError([&] { ReadPortraitRunFolder(folder / "run"); }, "no best weights yet");
}

}  // namespace
}  // namespace daumier::portrait
