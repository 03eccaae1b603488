#include "systems/sketch/train/run.h"

#include "tests/support/expect_error.h"
#include "tests/support/sketch_run_folder.h"
#include "tests/support/temp_dir.h"

namespace daumier::sketch {
namespace {

using testing::ExpectError;
using testing::TempDir;

TEST(SketchRun, LoadedNetworkPredictsAsTheSavedOne) {
  const TempDir folder;
  auto saved = testing::WriteSketchRun(folder.path());
  auto run = LoadSketchRun(folder.path());
  EXPECT_FALSE(run.network->is_training());
  EXPECT_EQ(run.network->options().resolution, 32);
  EXPECT_EQ(run.models.bilinear.num_coordinates(), 3 * run.face_template.num_vertices());
  EXPECT_EQ(run.manifest.seed, 7u);
  EXPECT_TRUE(run.config.contains("network"));
  EXPECT_EQ(run.feature_curves, std::vector<std::string>{"upper_mouth"});
  EXPECT_EQ(run.camera.width, 256);
  const SketchInput input{torch::rand({2, 1, 32, 32}), {}, {}};
  EXPECT_TRUE(torch::equal(run.network->Decode(run.network->forward(input)), saved->Decode(saved->forward(input))));
}

TEST(SketchRun, EveryKindOfNetworkComesBack) {
  for (const auto& [name, options] : testing::SmallSketchNetworks()) {
    SCOPED_TRACE(name);
    const TempDir folder;
    auto saved = testing::WriteSketchRun(folder.path(), name);
    auto run = LoadSketchRun(folder.path());
    const auto input = testing::RandomSketchInput(options, 2);
    EXPECT_TRUE(torch::equal(run.network->Decode(run.network->forward(input)), saved->Decode(saved->forward(input))));
  }
}

TEST(SketchRun, SaysWhatIsWrongWithAFolder) {
  const TempDir folder;
  ExpectError([&] { LoadSketchRun(folder / "nothing"); }, "make one with `daumier train");
  testing::WriteSketchRun(folder.path());
  const auto load = [&] { LoadSketchRun(folder.path()); };

  const Manifest manifest = ReadManifest(folder.path(), "run");
  WriteFileAtomically(folder / "resolved.toml", "[network]\nresolution = 32\nwidth = 5\nhidden = 16\nbranch = 16\n");
  ExpectError(load, "resolved.toml was edited");
  Manifest without_config = manifest;
  without_config.config = Json::object();
  WriteManifest(folder.path(), without_config);
  WriteFileAtomically(folder / "resolved.toml", "[network]\nresolution = 32\nwidth = 5\nhidden = 16\nbranch = 16\n");
  ExpectError(load, "does not fit this network");
  WriteFileAtomically(folder / "resolved.toml", "[net]\nwidth = 5\n");
  ExpectError(load, "no table 'network'");
  std::filesystem::resize_file(folder / "bilinear.safetensors", 100);
  ExpectError(load, "bilinear.safetensors");
  std::filesystem::remove(folder / "best/model.safetensors");
  ExpectError(load, "resume it with `daumier train ");
}

}  // namespace
}  // namespace daumier::sketch
